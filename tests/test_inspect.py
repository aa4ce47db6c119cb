"""`handey inspect` as a command: what is refused, JSON, what is written."""

from __future__ import annotations

import json
import shutil

import numpy as np
import pytest
from inspected import CELLS, MM, PARTS, ROBOT, run

from handey.inspection.lines import direction, listed


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere.stl"], "nowhere.stl: no such file"),
        (["nowhere.yaml"], "nowhere.yaml: cannot be read: No such file or directory"),
        ([ROBOT, "--part", "x"], f"{ROBOT}: --part: belongs to a cell file"),
        (
            [PARTS / "block.stl", "--robot", CELLS / "demo.yaml"],
            f"{CELLS / 'demo.yaml'}: --robot: expected a robot file, found a cell",
        ),
        ([ROBOT, "--scale", "2"], f"{ROBOT}: --scale: belongs to a mesh file"),
        (
            [f"{CELLS / 'stack.yaml'}:bass"],
            f"{CELLS / 'stack.yaml'}: parts: no part 'bass'; the cell has: "
            "stepped_block, block, base",
        ),
    ],
)
def test_bad_input_is_one_line_and_status_2(capsys, arguments, message):
    status, out, err = run(capsys, *arguments)
    assert (status, out, err) == (2, "", f"handey: {message}\n")


def test_a_yaml_that_is_neither_is_refused(capsys, tmp_path):
    (tmp_path / "a.yaml").write_text("name: a\n")
    status, _, err = run(capsys, tmp_path / "a.yaml")
    assert status == 2 and "handey_cell" in err and "handey_robot" in err and err.count("\n") == 1


def test_a_page_does_not_replace_what_is_read(capsys, tmp_path):
    mesh = tmp_path / "bracket.stl"
    shutil.copy(PARTS / "bracket.stl", mesh)
    before = mesh.read_bytes()
    status, _, err = run(capsys, mesh, "-o", mesh)
    assert status == 2 and "the output needs another name" in err
    assert mesh.read_bytes() == before
    assert run(capsys, mesh, "-o", tmp_path / "none" / "page.html")[0] == 2


def test_the_json_of_a_part_has_its_keys(capsys):
    told = run(capsys, PARTS / "bracket.stl", "--scale", MM, "--robot", ROBOT, "--json")
    summary = json.loads(told[1])
    assert told[0] == 0 and told[2] == ""
    assert summary["kind"] == "part" and summary["file"].endswith("bracket.stl")
    assert {
        "size_m", "volume_m3", "centre_of_mass_m", "closed", "surfaces", "faces", "jaws", "pairs",
        "pairs_by_kind", "rejected", "placements", "warnings",
    } <= set(summary)  # fmt: skip
    assert summary["size_m"] == pytest.approx([0.07, 0.06, 0.07])
    assert set(summary["placements"][0]) == {
        "probability", "tip_angle_rad", "margin_m", "height_m", "top_m", "up", "pose",
    }  # fmt: skip


def test_a_part_of_a_cell_is_told_by_either_name(capsys):
    by_colon = run(capsys, f"{CELLS / 'stack.yaml'}:base", "--json")
    by_option = run(capsys, CELLS / "stack.yaml", "--part", "base", "--json")
    assert by_colon == by_option
    summary = json.loads(by_colon[1])
    assert (summary["name"], summary["kind"]) == ("base", "part")
    assert summary["jaws"]["robot"] == "puma560" and summary["pairs_by_kind"] == {"two faces": 1}


def test_quiet_prints_nothing_and_still_writes_the_page(capsys, tmp_path):
    page = tmp_path / "page.html"
    assert run(capsys, PARTS / "wedge.stl", "--scale", MM, "-o", page, "--quiet") == (0, "", "")
    assert page.stat().st_size > 5000


def test_directions_have_names():
    assert direction(np.array([0.0, 0.0, -1.0])) == "-z"
    assert direction(np.array([0.6, 0.8, -1e-9])) == "(0.60, 0.80, 0.00)"
    assert listed(["one", "two", "three"], 12, "a: ") == ["a: one, two,", "   three"]
