"""Advice, applied to the files of a cell that does not plan, makes it plan; the plan is valid."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

import handey
from handey import PlanOptions
from handey.advice import Advice
from handey.advising.change import edited, with_edits
from handey.cli import main
from handey.robot_file import load_robot

MODELS = Path(__file__).resolve().parent.parent / "models"
ROBOT = MODELS / "robots" / "puma560"
TABLE = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
# No test asserts a time; a slow machine may take as long as it needs.
PATIENT = PlanOptions(advice_seconds=10.0)


def box(size: list[float], x: float, y: float, z: float | None = None) -> dict[str, Any]:
    """A box that stands on the table, or has its centre at z."""
    return {"box": size, "pose": {"xyz": [x, y, size[2] / 2 if z is None else z]}}


def to(x: float, y: float, z: float = 0.025, part: str = "block") -> dict[str, Any]:
    return {"place": part, "at": {"xyz": [x, y, z]}}


BLOCK = box([0.06, 0.04, 0.05], 0.5, 0.2)
BAR = box([0.04, 0.12, 0.05], 0.5, 0.25)  # only its long sides can be held


def write(folder: Path, fixtures: dict[str, Any], parts: dict[str, Any], **more: Any) -> Path:
    """A cell with a robot of its own in a folder, so that both may be edited."""
    if not (folder / "robot").exists():
        shutil.copytree(ROBOT, folder / "robot")
    cell = {
        "handey_cell": 1,
        "name": "broken",
        "robot": {"file": "robot/robot.yaml"},
        "fixtures": {"table": TABLE, **fixtures},
        "parts": parts,
        **more,
    }
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(cell, sort_keys=False))
    return path


def apply(advice: Advice) -> None:
    """Set what the edits say, in their files."""
    for file in {edit.file for edit in advice.edits}:
        edits = [edit for edit in advice.edits if edit.file == file]
        path = Path(file)
        if path.suffix == ".urdf":
            tree = ElementTree.parse(path)
            for edit in edits:
                element, _, attribute = edit.place.rpartition("/@")
                found = tree.getroot().findall(element)
                assert len(found) == 1
                found[0].set(attribute, repr(edit.value))
            tree.write(path)
        else:
            content = with_edits(yaml.safe_load(path.read_text()), edits)
            path.write_text(yaml.safe_dump(content, sort_keys=False))


def advised(path: Path, options: PlanOptions = PATIENT) -> Advice:
    """The advice for a cell that does not plan; applied, there is a plan, and it is valid."""
    result = handey.plan(path, options)
    assert result.plan is None
    told = [goal.advice for goal in result.report.goals if goal.advice is not None]
    assert len(told) == 1, result.report.reasons
    apply(told[0])
    again = handey.plan(path)
    assert again.plan is not None, told[0].text
    checked = handey.check(path, again.plan)
    assert checked.ok, f"{told[0].text}: {checked}"
    return told[0]


def test_jaws_that_are_too_narrow_are_told_how_wide_they_must_be(tmp_path: Path) -> None:
    part = box([0.088, 0.13, 0.11], 0.5, 0.2)
    path = write(tmp_path, {}, {"block": part}, task=[to(0.5, -0.2, 0.055)])
    file = tmp_path / "robot" / "robot.yaml"
    robot = yaml.safe_load(file.read_text())
    robot["gripper"]["opening"] = [0.0, 0.085]
    file.write_text(yaml.safe_dump(robot))
    advice = advised(path)
    assert advice.kind == "jaws"
    assert [edit.place for edit in advice.edits] == ["gripper.opening"]
    assert 0.088 < advice.edits[0].value[1] <= 0.096


def test_fingers_that_do_not_go_so_far_are_told_by_their_place_in_the_urdf(tmp_path: Path) -> None:
    cube = box([0.12, 0.12, 0.12], 0.5, 0.2)
    advice = advised(write(tmp_path, {}, {"cube": cube}, task=[to(0.5, -0.2, 0.06, "cube")]))
    assert advice.kind == "jaws"
    limits = [edit for edit in advice.edits if edit.file.endswith(".urdf")]
    assert len(limits) == 2
    assert all(0.06 < edit.value <= 0.07 for edit in limits)


def test_goal_out_of_reach_is_shifted_towards_the_robot(tmp_path: Path) -> None:
    advice = advised(write(tmp_path, {}, {"block": BLOCK}, task=[to(0.90, 0.0)]))
    assert advice.kind == "goal shifted"
    assert 0.01 <= advice.size <= 0.08
    assert "towards the robot" in advice.text
    assert advice.edits[0].place == "task[0].at.xyz"


def test_wall_beside_the_goal_is_moved_or_the_goal_away_from_it(tmp_path: Path) -> None:
    wall = box([0.02, 0.3, 0.15], 0.533, -0.25)
    path = write(tmp_path, {"wall": wall}, {"bar": BAR}, task=[to(0.5, -0.25, part="bar")])
    advice = advised(path)
    assert advice.kind in ("fixture moved", "goal shifted")
    assert 0.005 <= advice.size <= 0.05


def test_no_advice_where_none_is_wanted_or_a_plan_is_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path, {}, {"block": BLOCK}, task=[to(0.90, 0.0)])
    report = handey.plan(path, PlanOptions(advice=False)).report
    assert [goal.advice for goal in report.goals] == [None]
    assert "advice" not in report.stages
    output = str(tmp_path / "plan.json")
    assert main(["plan", str(path), "-o", output, "--json", "--no-advice"]) == 3
    assert json.loads(capsys.readouterr().out)["goals"][0]["advice"] is None
    assert main(["plan", str(path), "-o", output, "--json"]) == 3
    advice = json.loads(capsys.readouterr().out)["goals"][0]["advice"]
    assert advice is None or advice["verified"]
    good = handey.plan(write(tmp_path, {}, {"block": BLOCK}, task=[to(0.5, -0.2)]))
    assert good.plan is not None
    assert "advice" not in good.report.stages


def test_places_are_those_of_the_file() -> None:
    content = {"fixtures": {"a.b": {"box": [1, 1, 1]}, "a": {}}, "task": [{"at": {}}, {"at": {}}]}
    moved = edited(content, "fixtures.a.b.pose.xyz", [0, 0, 1])
    assert moved["fixtures"]["a.b"] == {"box": [1, 1, 1], "pose": {"xyz": [0, 0, 1]}}
    assert moved["fixtures"]["a"] == {}
    assert edited(content, "task[1].at.xyz", [1, 2, 3])["task"][1] == {"at": {"xyz": [1, 2, 3]}}
    assert "a" not in edited(content, "fixtures.a", None)["fixtures"]
    assert edited(content, "order", "any")["order"] == "any"
    assert content["task"][1] == {"at": {}}
    assert "pose" not in content["fixtures"]["a.b"]


def test_robot_with_other_jaws_is_another_robot() -> None:
    robot = load_robot(ROBOT / "robot.yaml")[0]
    wider = robot.with_jaws(0.14)
    assert (robot.gripper.max_opening, wider.gripper.max_opening) == (0.10, 0.14)
    assert np.allclose(wider.home, robot.home)
    for opening in (0.0, float("nan"), "0.1"):
        with pytest.raises((ValueError, TypeError)):
            robot.with_jaws(opening)
