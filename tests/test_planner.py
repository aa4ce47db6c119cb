"""The whole path: every cell of models/cells is planned and checked, or refused with its reason."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import random_cells

import handey
from handey import _core
from handey.planner import PlanOptions

CELLS = Path(__file__).resolve().parent.parent / "models" / "cells"
ALL = sorted(CELLS.glob("*.yaml"))
IMPOSSIBLE = [path for path in ALL if path.stem.startswith("impossible_")]
BAD = [path for path in ALL if path.stem.startswith("bad_")]
POSSIBLE = [path for path in ALL if path not in IMPOSSIBLE and path not in BAD]


def name(path: Path) -> str:
    return path.stem


def handey_command(*arguments: object) -> subprocess.CompletedProcess[str]:
    code = "import sys; from handey.cli import main; sys.exit(main())"
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=os.environ, check=False)


def test_there_are_cells_of_each_kind() -> None:
    assert len(POSSIBLE) >= 10
    assert len(IMPOSSIBLE) >= 3
    assert len(BAD) >= 3


@pytest.mark.parametrize("path", POSSIBLE, ids=name)
def test_cell_is_planned_and_the_plan_is_valid(path: Path, tmp_path: Path) -> None:
    result = handey.plan(handey.load_cell(path))
    assert result.plan is not None, "\n".join(result.report.reasons)
    out = tmp_path / "plan.json"
    result.plan.save(out)
    checked = handey.check(path, out)
    assert checked.ok, "\n".join(map(str, checked.faults))


def write_cell(folder: Path, **changes: object) -> Path:
    """A block on a table; `changes` replace keys of the cell."""
    cell = {
        "handey_cell": 1,
        "name": "block",
        "robot": {"file": str(random_cells.ROBOT)},
        "fixtures": {"table": random_cells.TABLE},
        "parts": {"block": block_at(0.15)},
        **changes,
    }
    path = folder / "cell.yaml"
    path.write_text(json.dumps(cell))
    return path


def block_at(y: float, z: float = 0.025) -> dict[str, object]:
    return {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.5, y, z]}}


def to(y: float, part: str = "block") -> dict[str, object]:
    return {"place": part, "at": {"xyz": [0.5, y, 0.025]}}


@pytest.mark.parametrize("goals", [(-0.15, 0.15), (-0.15, -0.15), (-0.15, -0.15003)])
def test_one_part_may_have_several_goals(goals: tuple[float, ...], tmp_path: Path) -> None:
    """There and back, there twice, there and nearly there: back home in the end, and only then."""
    path = write_cell(tmp_path, task=[to(y) for y in goals])
    result = handey.plan(path)
    assert result.plan is not None, "\n".join(result.report.reasons)
    assert handey.check(path, result.plan).ok, str(handey.check(path, result.plan))
    assert set(result.plan.placements) == {"block"}
    home = handey.load_cell(path).cell.start.q
    ends = [bool((abs(step.positions[-1] - home) < 1e-9).all()) for step in result.plan.steps]
    assert ends == [False] * (len(ends) - 1) + [True]


def test_what_stands_on_a_part_is_moved_first_or_named(tmp_path: Path) -> None:
    parts = {"block": block_at(0.15), "top": block_at(0.15, 0.075)}
    alone = handey.plan(write_cell(tmp_path, parts=parts, task=[to(-0.15)]))
    assert alone.plan is None
    assert any("top would fall" in reason for reason in alone.report.reasons)
    goals = [to(-0.15), to(0.0, "top")]
    path = write_cell(tmp_path, parts=parts, task=goals, order="any")
    result = handey.plan(path)
    assert result.plan is not None, "\n".join(result.report.reasons)
    assert handey.check(path, result.plan).ok
    assert result.plan.steps[0].goal == 1


def test_part_is_not_lifted_through_a_thin_lip(tmp_path: Path) -> None:
    """At the ends of the lift's first edge the flange is below the lip, and above it."""
    thick = 0.00052
    flange = {"box": [0.08, 0.08, thick], "pose": {"xyz": [0, 0, thick / 2]}}
    knob = {"box": [0.03, 0.03, 0.05], "pose": {"xyz": [0, 0, 0.025]}}
    plate = {"shapes": [flange, knob], "pose": {"xyz": [0.5, 0.15, 0]}}
    above = {"xyz": [0.545, 0.15, 1.5 * thick + 0.0002]}
    lip = {"box": [0.02, 0.08, thick], "pose": above}
    path = write_cell(
        tmp_path,
        fixtures={"table": random_cells.TABLE, "lip": lip},
        parts={"plate": plate},
        task=[{"place": "plate", "at": {"xyz": [0.5, -0.15, 0]}}],
    )
    result = handey.plan(path)
    assert result.plan is None or handey.check(path, result.plan).ok
    attempts = result.report.goals[0].attempts
    assert any("would pass through lip" in attempt.reason for attempt in attempts)


def test_goals_in_any_order_are_built_from_below(tmp_path: Path) -> None:
    upper = {"place": "upper", "at": {"xyz": [0.5, -0.15, 0.075]}}
    parts = {"block": block_at(0.15), "upper": block_at(0.3)}
    path = write_cell(tmp_path, parts=parts, task=[upper, to(-0.15)], order="any")
    result = handey.plan(path)
    assert result.plan is not None, "\n".join(result.report.reasons)
    assert result.plan.steps[0].goal == 1
    assert handey.check(path, result.plan).ok, str(handey.check(path, result.plan))


@pytest.mark.parametrize("path", IMPOSSIBLE, ids=name)
def test_impossible_cell_gets_a_reason_and_no_plan(path: Path) -> None:
    result = handey.plan(handey.load_cell(path))
    assert result.plan is None
    assert result.report.verdict in ("infeasible", "unknown")
    assert result.report.reasons


def test_infeasible_is_said_only_where_it_is_proved() -> None:
    verdicts = {
        path.stem: handey.plan(handey.load_cell(path)).report.verdict for path in IMPOSSIBLE
    }
    proved = [cell for cell, verdict in verdicts.items() if verdict == "infeasible"]
    kinds = ("closed_box", "out_of_reach", "too_wide")
    assert proved == [f"impossible_{kind}" for kind in kinds]


@pytest.mark.parametrize("path", BAD, ids=name)
def test_bad_cell_is_refused(path: Path) -> None:
    with pytest.raises(handey.InvalidInput) as caught:
        handey.load_cell(path)
    assert all(fault.place and fault.message for fault in caught.value.faults)


@pytest.mark.parametrize(
    ("cell", "words"),
    [
        ("impossible_tetrahedron", ["no two faces"]),
        ("impossible_too_wide", ["120.0 mm", "100.0 mm"]),
        ("impossible_out_of_reach", ["reach", "destination"]),
        ("impossible_closed_box", ["box"]),
    ],
)
def test_the_reason_names_what_and_where(cell: str, words: list[str], tmp_path: Path) -> None:
    out = tmp_path / "plan.json"
    run = handey_command("plan", CELLS / f"{cell}.yaml", "-o", out)
    assert run.returncode == 3 and not out.exists()
    for word in words:
        assert word in run.stdout + run.stderr


def test_a_goal_in_collision_is_bad_input_with_names_and_depth(tmp_path: Path) -> None:
    out = tmp_path / "plan.json"
    run = handey_command("plan", CELLS / "bad_goal_in_collision.yaml", "-o", out)
    assert run.returncode == 2
    assert "block" in run.stderr and "wall" in run.stderr and "mm" in run.stderr
    assert not out.exists()


def test_the_same_seed_gives_the_same_bytes(tmp_path: Path) -> None:
    texts = []
    for index in range(2):
        result = handey.plan(handey.load_cell(CELLS / "demo.yaml"), PlanOptions(seed=7))
        assert result.plan is not None
        out = tmp_path / f"{index}.json"
        dataclasses.replace(result.plan, report={}).save(out)
        texts.append(out.read_bytes())
    assert texts[0] == texts[1]


def test_a_goal_that_is_met_already_needs_no_step() -> None:
    result = handey.plan(handey.load_cell(CELLS / "already_met.yaml"))
    assert result.plan is not None
    assert result.plan.steps == [] or list(result.plan.steps) == []


def test_the_best_grasp_at_the_origin_alone_fails_at_the_destination_of_figure_4() -> None:
    cell_file = handey.load_cell(CELLS / "figure_4.yaml")
    cell, goal = cell_file.cell, cell_file.goals[0]
    part = cell.part_index(goal.part)
    origin_only = _core.RankingOptions(use_destination=False)
    narrow = _core.rank_grasps(cell, part, goal.X_WP, origin_only).ranked[0]
    wise = _core.rank_grasps(cell, part, goal.X_WP).ranked[0]
    assert str(narrow.pair) != str(wise.pair)
    scene = _core.GraspScene(
        model=_core.make_collision_model(cell), cell=cell, part=part, X_WP_goal=goal.X_WP
    )
    solver = _core.SphericalWristSolver(cell.robot)
    fallen = _core.find_legal_grasps(scene, solver, narrow)
    assert not fallen.poses
    assert "destination" in fallen.worst_reason
    assert _core.find_legal_grasps(scene, solver, wise).poses


def test_the_summary_is_one_json_object(tmp_path: Path) -> None:
    out = tmp_path / "plan.json"
    run = handey_command("plan", CELLS / "open_table.yaml", "-o", out, "--json")
    assert run.returncode == 0
    summary = json.loads(run.stdout)
    assert summary["verdict"] == "plan"
    assert summary["duration_s"] > 0 and summary["cpu_s"] > 0 and summary["regrasps"] == 0
    assert sum(summary["stages"].values()) <= summary["cpu_s"] * 1.01


@pytest.mark.parametrize("cell", ["demo", "two_goals", "between_walls"])
def test_every_gross_motion_of_the_plan_is_reported_with_planner_and_time(cell: str) -> None:
    result = handey.plan(handey.load_cell(CELLS / f"{cell}.yaml"))
    assert result.plan is not None
    steps = result.plan.steps
    told = result.plan.report["gross_motions"]
    gross = [i for i, step in enumerate(steps) if step.action in ("transit", "transfer")]
    assert gross and [motion["step"] for motion in told] == gross
    for motion in told:
        step = steps[motion["step"]]
        assert (motion["action"], motion["goal"]) == (step.action, step.goal)
        assert motion["planner"] in ("straight", "slices", "RRT-Connect")
        assert 0 <= motion["cpu_s"] <= result.report.cpu_s
        if motion["planner"] in ("straight", "slices"):
            assert motion["fallback_reason"] == ""
    spent = sum(motion["cpu_s"] for motion in told)
    assert spent <= sum(result.report.stages[s] for s in ("transit", "transfer", "home"))


@pytest.mark.parametrize("cell", ["demo", "two_goals", "between_walls"])
def test_the_planner_of_every_motion_near_obstacles_is_reported(cell: str) -> None:
    result = handey.plan(handey.load_cell(CELLS / f"{cell}.yaml"))
    assert result.plan is not None
    report, steps = result.plan.report, result.plan.steps
    actions = ("approach", "depart", "deposit", "withdraw")
    near = [i for i, step in enumerate(steps) if step.action in actions]
    assert near and [motion["step"] for motion in report["local_motions"]] == near
    for motion in report["local_motions"]:
        step = steps[motion["step"]]
        assert (motion["action"], motion["goal"]) == (step.action, step.goal)
        assert report["planners"][motion["action"]][motion["planner"]] >= 1
    for action in actions:
        given = sum(report["planners"][action].values())
        assert given >= sum(step.action == action for step in steps)


def test_the_report_tells_how_wide_the_jaws_open_and_close() -> None:
    result = handey.plan(handey.load_cell(CELLS / "demo.yaml"))
    assert result.plan is not None
    jaws = result.plan.report["goals"][0]["jaws"]
    step = next(step for step in result.plan.steps if step.action == "grasp")
    assert jaws == {"open": step.opening[0], "closed": step.opening[-1]}


def test_random_direct_cells_are_planned_validly_and_repeatably(tmp_path: Path) -> None:
    cells = random_cells.direct_cells(
        seed=3, count=12, parts=random_cells.own_parts(), folder=tmp_path
    )
    tally = random_cells.run(cells)
    assert tally.tried == 12
    assert tally.valid == tally.planned == tally.repeated
    assert tally.planned >= 11, "\n".join(tally.failed)
