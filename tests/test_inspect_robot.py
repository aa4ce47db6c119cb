"""What `handey inspect` tells of robots."""

from __future__ import annotations

import json
import re
import shutil

import numpy as np
import pytest
from inspected import CELLS, PARTS, ROBOT, run, scene_of

from handey import _core
from handey.cell_file import load_cell
from handey.inspection import inspect_cell, inspect_robot
from handey.inspection.page import write_page
from handey.inspection.robot_text import robot_lines
from handey.robot_file import load_robot


def test_the_reach_is_where_the_hand_gets(robot):
    report = inspect_robot(robot)
    assert report.objection == "" and report.reach is not None
    solver = _core.SphericalWristSolver(robot)
    row = next(row for row in report.reach.rows if row.height == pytest.approx(0.2))
    ((low, high),) = row.ranges["down"]

    def reaches(radius):
        X_RH = np.diag([1.0, -1.0, -1.0, 1.0])
        X_RH[:3, 3] = [radius, 0.0, 0.2]
        return bool(solver.solve(X_RH).solutions)

    assert reaches((low + high) / 2) and reaches(high) and not reaches(high + 0.02)
    assert 0.1 < low < 0.4 < 0.7 < high < 1.0
    assert report.nearest == ("link3", "link5")
    assert ("link4", "link6") in report.ignored and ("link1", "link2") in report.joined


def test_the_text_of_a_robot_fits_a_screen(robot):
    lines = robot_lines(inspect_robot(robot))
    assert len(lines) <= 40 and max(map(len, lines)) <= 80
    assert any(line.split()[:4] == ["joint1", "-160.0", "160.0", "100.0"] for line in lines)


def test_why_a_robot_cannot_be_planned_for_is_told(tmp_path):
    folder = tmp_path / "puma"
    shutil.copytree(ROBOT.parent, folder)
    urdf = folder / "puma560.urdf"
    origin = '<origin xyz="0.4318 0 0.15005"/>'
    assert urdf.read_text().count(origin) == 1
    turned = origin.replace("/>", ' rpy="0.3 0.2 0.1"/>')
    urdf.write_text(urdf.read_text().replace(origin, turned))
    report = inspect_robot(*load_robot(folder / "robot.yaml"))
    assert "axes 2 and 3" in report.objection and report.reach is None
    assert "NOT supported" in "\n".join(robot_lines(report))
    assert report.as_dict()["inverse_kinematics"]["supported"] is False
    cell = (CELLS / "on_table.yaml").read_text().replace("../robots/puma560", str(folder))
    (tmp_path / "cell.yaml").write_text(cell.replace("../parts", str(PARTS)))
    report = inspect_cell(load_cell(tmp_path / "cell.yaml"))
    assert "axes 2 and 3" in report.objection
    assert [goal.verdict for goal in report.goals] == ["not known", "not known"]
    assert all(figures.held is None and figures.part.pairs for figures in report.parts)
    write_page(report, tmp_path / "page.html")


def test_a_urdf_alone_tells_what_was_taken_for_what(capsys, tmp_path):
    status, out, err = run(capsys, ROBOT.parent / "puma560.urdf", "--json")
    summary = json.loads(out)
    assert (status, err) == (0, "")
    assert [joint["name"] for joint in summary["joints"]] == [f"joint{i}" for i in range(1, 7)]
    assert "no robot file" in summary["warnings"][0]
    assert summary["jaws"]["opening_m"] == [0.0, 0.1]
    bare = tmp_path / "bare.urdf"
    bare.write_text('<robot name="r"><link name="a"/></robot>')
    status, out, err = run(capsys, bare)
    assert (status, out) == (2, "")
    assert err.startswith(f"handey: {bare}: found no single longest chain of revolute joints")


def test_a_urdf_without_fingers_tells_the_kinematics(capsys, tmp_path, robot):
    text = (ROBOT.parent / "puma560.urdf").read_text()
    for finger in ("left_finger", "right_finger"):
        text = re.sub(rf'<joint name="{finger}_joint".*?</joint>', "", text, flags=re.S)
        text = re.sub(rf'<link name="{finger}">.*?</link>', "", text, flags=re.S)
    (tmp_path / "arm.urdf").write_text(text)  # its meshes are not there: shapes are not read
    status, out, err = run(capsys, tmp_path / "arm.urdf", "--json")
    summary = json.loads(out)
    assert (status, err) == (0, "")
    assert [joint["name"] for joint in summary["joints"]] == [f"joint{i}" for i in range(1, 7)]
    lower = [joint["lower_rad"] for joint in summary["joints"]]
    assert lower == pytest.approx([joint.limit.lower for joint in robot.joints])
    assert not any("made_up" in name for name in summary["bodies"])
    assert summary["jaws"] is None and "shapes are not looked at" in summary["warnings"][0]
    assert summary["inverse_kinematics"]["supported"] and len(summary["reach"]["rows"]) >= 4
    assert "jaws      none" in run(capsys, tmp_path / "arm.urdf", "-o", tmp_path / "a.html")[1]
    sticks = scene_of(tmp_path / "a.html")["sticks"]
    assert len(sticks) == 7 and len(sticks[0]) == 8
    (tmp_path / "slow.urdf").write_text(re.sub(r'velocity="[^"]*"', 'velocity="0"', text))
    status, out, err = run(capsys, tmp_path / "slow.urdf")
    assert (status, out) == (2, "")
    assert err.splitlines()[0].startswith(f"handey: {tmp_path / 'slow.urdf'}: joint 'joint1': the")
    (tmp_path / "no.urdf").write_text("<robot")
    assert run(capsys, tmp_path / "no.urdf")[0] == 2
    assert run(capsys, tmp_path / "none.urdf")[0] == 2


def test_verbose_leaves_nothing_out(capsys):
    cell = CELLS / "restack.yaml"
    short, long = (run(capsys, cell, *more)[1].splitlines() for more in ((), ("--verbose",)))
    assert len(short) <= 40 < len(long)
    assert sum("ways, when it falls" in line for line in long) == 5
    robot_lines_ = run(capsys, ROBOT, "--verbose")[1]
    assert "base_link/link1" in robot_lines_


def test_a_cell_that_cannot_be_is_bad_input(capsys):
    status, out, err = run(capsys, CELLS / "bad_start_in_solid.yaml")
    assert (status, out) == (2, "") and "overlap at the start by 80.0 mm" in err
