"""Advice, applied to the files of a cell that does not plan, makes it plan; the plan is valid."""

from __future__ import annotations

import json
import shutil
import threading
import time
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

import handey
from handey import PlanOptions, _core
from handey.advising.change import edited, with_edits
from handey.cli import main
from handey.reporting.advice import Advice
from handey.robot_file import load_robot

MODELS = Path(__file__).resolve().parent.parent / "models"
ROBOT = MODELS / "robots" / "puma560"
TABLE = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
# No test asserts a time; a slow machine may take as long as it needs.
PATIENT = PlanOptions(advice_seconds=5.0)


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


def test_pads_that_slip_are_told_the_friction_that_holds(tmp_path: Path) -> None:
    advice = advised(write(tmp_path, {}, {"block": {**BLOCK, "mass": 12.0}}, task=[to(0.5, -0.2)]))
    assert advice.kind == "friction"
    # 12 kg, held by twice 70 N times the friction.
    assert 0.84 <= advice.edits[0].value <= 0.90


def test_roof_over_the_part_is_moved_off_it(tmp_path: Path) -> None:
    roof = box([0.36, 0.36, 0.02], 0.5, 0.25, 0.075)
    block = box([0.04, 0.06, 0.05], 0.5, 0.25)
    advice = advised(write(tmp_path, {"roof": roof}, {"block": block}, task=[to(0.5, -0.25)]))
    assert advice.kind == "fixture moved"
    assert advice.edits[0].place == "fixtures.roof.pose.xyz"


def test_neighbours_against_both_sides_are_avoided(tmp_path: Path) -> None:
    """At the start, then at the goal: the one end is shifted or turned where they are not."""
    for end, y in (("parts.bar.pose", 0.25), ("task[0].at", -0.25)):
        sides = {
            name: box([0.06, 0.14, 0.06], 0.5 + x, y)
            for name, x in (("left", -0.054), ("right", 0.054))
        }
        path = write(tmp_path, {}, {"bar": BAR, **sides}, task=[to(0.5, -0.25, part="bar")])
        assert advised(path).edits[0].place.startswith(end)


TOP = box([0.04, 0.04, 0.04], 0.5, 0.2, 0.07)  # stands on BLOCK
NO_SUPPORT = {key: value for key, value in TABLE.items() if key != "support"}


def test_part_that_stands_on_another_may_be_moved_aside(tmp_path: Path) -> None:
    advice = advised(write(tmp_path, {}, {"block": BLOCK, "top": TOP}, task=[to(0.5, -0.2)]))
    assert advice.kind == "may move"
    assert advice.edits[0].place == "parts.top.may_move"


def test_without_a_support_an_earlier_goal_takes_it_away(tmp_path: Path) -> None:
    parts = {"block": BLOCK, "top": TOP}
    path = write(tmp_path, {"table": NO_SUPPORT}, parts, task=[to(0.5, -0.2)])
    advice = advised(path)
    assert advice.kind in ("earlier goal", "may move")


def test_order_of_goals_is_left_open_where_it_is_what_blocks(tmp_path: Path) -> None:
    task = [to(0.5, -0.2), to(0.4, 0.0, 0.02, "top")]
    parts = {"block": BLOCK, "top": TOP}
    advice = advised(write(tmp_path, {"table": NO_SUPPORT}, parts, task=task))
    assert advice.kind == "order"


def test_support_is_named_where_a_part_must_be_turned_over(tmp_path: Path) -> None:
    goal = {"place": "block", "at": {"xyz": [0.5, -0.2, 0.025], "rpy": [np.pi, 0, 0]}}
    block = box([0.04, 0.06, 0.05], 0.5, 0.2)
    advice = advised(write(tmp_path, {"table": NO_SUPPORT}, {"block": block}, task=[goal]))
    assert advice.kind in ("support", "support added")


def test_region_without_room_is_widened(tmp_path: Path) -> None:
    goal = {"place": "block", "on": "table", "region": [[0.48, -0.22], [0.52, -0.18]]}
    parts = {"block": BLOCK, "other": box([0.06, 0.04, 0.05], 0.5, -0.2)}
    advice = advised(write(tmp_path, {}, parts, task=[goal]))
    assert advice.kind == "region"
    assert advice.edits[0].place == "task[0].region"


def tray(x: float, y: float, scale: float) -> dict[str, Any]:
    """An open box."""
    walls = [box([0.05 * scale, 0.05 * scale, 0.01], 0, 0)]
    for side in (-1, 1):
        walls.append(box([0.01, 0.06 * scale, 0.03], side * 0.03 * scale, 0))
        walls.append(box([0.06 * scale, 0.01, 0.03], 0, side * 0.03 * scale))
    return {"pose": {"xyz": [x, y, 0]}, "shapes": walls}


def test_tray_that_is_too_small_is_replaced_by_another(tmp_path: Path) -> None:
    trays = {"tray": tray(0.5, -0.25, 1.0), "big": tray(0.35, -0.4, 3.0)}
    goal = {"place": "block", "inside": "tray"}
    advice = advised(write(tmp_path, trays, {"block": BLOCK}, task=[goal]))
    assert advice.kind == "other fixture"
    assert [edit.value for edit in advice.edits] == ["big"]


def write_start(path: Path, q: np.ndarray) -> Path:
    """The same cell with another start of the arm."""
    cell = yaml.safe_load(path.read_text())
    cell["robot"]["start"] = [float(value) for value in q]
    path.write_text(yaml.safe_dump(cell, sort_keys=False))
    return path


QUICK = replace(PATIENT, thorough=False, sampling_rounds=(50,), most_by_arm=0)


def test_arm_that_cannot_come_home_over_the_goal_ends_elsewhere(tmp_path: Path) -> None:
    robot = load_robot(ROBOT / "robot.yaml")[0]
    X_RH = np.diag([1.0, -1, -1, 1])
    X_RH[:3, 3] = 0.5, -0.2, 0.03
    q = _core.SphericalWristSolver(robot).solve(X_RH).solutions[0].q
    block = box([0.06, 0.04, 0.12], 0.5, 0.2)
    path = write(tmp_path, {}, {"block": block}, task=[to(0.5, -0.2, 0.06)])
    advice = advised(write_start(path, q), QUICK)
    assert advice.kind in ("finish", "robot start", "goal shifted")


def test_arm_that_starts_in_a_collar_starts_at_home(tmp_path: Path) -> None:
    """The collar is about the flange, narrower than the palm: the cause names it."""
    robot = load_robot(ROBOT / "robot.yaml")[0]
    q = np.array(robot.home)
    q[0] = np.pi / 2
    middle = _core.hand_pose(robot, q)[:3, 3] - [0, 0, 0.15]
    hole, half = 0.045, 0.12
    ring = []
    for side in (-1, 1):
        beside = side * (half + hole) / 2
        ring.append({"box": [2 * half, half - hole, 0.01], "pose": {"xyz": [0, beside, 0]}})
        ring.append({"box": [half - hole, 2 * hole, 0.01], "pose": {"xyz": [beside, 0, 0]}})
    collar = {"pose": {"xyz": middle.tolist()}, "shapes": ring}
    path = write(tmp_path, {"collar": collar}, {"block": BLOCK}, task=[to(0.5, -0.2)])
    path = write_start(path, q)
    cause = handey.plan(path, QUICK).report.goals[0].cause
    assert cause is not None
    assert cause.bodies[0] == "collar"
    assert "without collar it plans" in cause.text
    assert advised(path, QUICK).kind in ("robot start", "fixture moved")


def test_goals_before_the_failed_one_are_planned_too(tmp_path: Path) -> None:
    parts = {"block": BLOCK, "other": box([0.06, 0.04, 0.05], 0.4, 0.3)}
    task = [to(0.4, -0.3, part="other"), to(0.90, 0.0), to(0.3, -0.4, part="other")]
    result = handey.plan(write(tmp_path, {}, parts, task=task), PATIENT)
    assert [goal.advice is not None for goal in result.report.goals] == [False, True, False]
    advice = result.report.goals[1].advice
    assert advice is not None
    assert advice.edits[0].place == "task[1].at.xyz"
    apply(advice)
    assert handey.plan(tmp_path / "cell.yaml").plan is not None


def test_deadline_and_cancelling_end_the_search_for_advice(tmp_path: Path) -> None:
    """No advice is found for a part far too high: the search goes on until it is stopped."""
    path = write(tmp_path, {}, {"block": BLOCK}, task=[to(0.90, 0.0)])
    cell = handey.load_cell(path)
    whole = handey.plan(cell, PlanOptions(advice=False))
    deadline = whole.report.wall_s + 0.5
    start = time.monotonic()
    report = handey.plan(cell, PlanOptions(advice_seconds=600.0, deadline=deadline)).report
    assert time.monotonic() - start < deadline + 5.0
    assert report.verdict == whole.report.verdict or report.deadline_passed
    token = handey.CancelToken()
    timer = threading.Timer(deadline, token.cancel)
    timer.start()
    start = time.monotonic()
    report = handey.plan(cell, PlanOptions(advice_seconds=600.0), cancel=token).report
    timer.cancel()
    assert time.monotonic() - start < deadline + 5.0
    assert report.verdict == whole.report.verdict or report.cancelled


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
