"""What `handey inspect` tells of cells."""

from __future__ import annotations

import json

import numpy as np
import pytest
from inspected import CELLS, run

import handey
from handey.cell_file import load_cell
from handey.inspection import inspect_cell


def test_a_cell_tells_what_stands_on_what_and_what_can_be_held(demo):
    on = {figures.part.name: figures.standing.on for figures in demo.parts}
    assert on == {"bracket": ("table",), "block": ("tray",), "hex_peg": ("tray",)}
    assert all(figures.held.legal > 0 for figures in demo.parts)
    assert [goal.verdict for goal in demo.goals] == ["within reach"]
    assert [name for name, _ in demo.supports] == ["table"]
    summary = json.loads(json.dumps(demo.as_dict(), allow_nan=False))
    assert summary["supports"]["table"]["area_m2"] == pytest.approx(1.6 * 1.4)


@pytest.mark.parametrize(
    ("cell", "verdicts"),
    [
        ("impossible_out_of_reach", ["no grasp found there"]),
        ("impossible_too_wide", ["no grasp found where it stands"]),
        ("impossible_closed_box", ["no grasp found where it stands"]),
        ("already_met", ["met already"]),
        ("figure_1", ["by a regrasp at best"]),
        ("on_table", ["within reach", "within reach"]),
    ],
)
def test_the_goals_of_a_cell_are_told(cell, verdicts):
    report = inspect_cell(load_cell(CELLS / f"{cell}.yaml"))
    assert [goal.verdict for goal in report.goals] == verdicts


def test_what_the_planner_grasps_with_is_among_the_legal_grasps():
    """Each end of a plan's grasp is legal by itself; a goal that is planned is within reach."""
    file = load_cell(CELLS / "open_table.yaml")
    report = inspect_cell(file)
    (goal,) = report.goals
    assert goal.verdict == "within reach"
    assert 0 < goal.both.legal <= min(goal.here.legal, goal.there.legal)
    assert goal.here.legal == report.parts[0].held.legal
    assert handey.plan(file).plan is not None


def test_reasons_are_told_where_no_grasp_is_legal(capsys):
    out_of_reach = run(capsys, CELLS / "impossible_out_of_reach.yaml")[1]
    assert "beyond reach" in out_of_reach
    too_wide = run(capsys, CELLS / "impossible_too_wide.yaml")[1]
    assert "the jaws open 24.0 mm too little" in too_wide
    closed_box = run(capsys, CELLS / "impossible_closed_box.yaml")[1]
    assert "where it stands: none of" in closed_box and "hand hits box" in closed_box


def test_the_share_that_was_not_measured_is_told():
    report = inspect_cell(load_cell(CELLS / "depth_map.yaml"))
    heap = np.load(CELLS / "depth" / "heap.npy")
    unmeasured = {entry.name: entry.unmeasured for entry in report.depth_maps}
    assert set(unmeasured) == {"camera", "heap"}
    assert unmeasured["heap"] == pytest.approx(np.isnan(heap).mean())
    assert 0 < unmeasured["camera"] < 0.05
