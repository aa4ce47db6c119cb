"""Cell files with robot and meshes: what is read, and what cannot be."""

from __future__ import annotations

import copy
import shutil
from pathlib import Path

import numpy as np
import pytest

import handey
from handey.errors import InvalidInput
from handey.formats.pose import pose_from_xyz_rpy
from handey.task import PlaceAt, PlaceInside, PlaceOn

pytest.importorskip("handey._core")

MODELS = Path(__file__).resolve().parents[1] / "models"
CELLS = sorted((MODELS / "cells").glob("*.yaml"))
GOOD = [path for path in CELLS if not path.name.startswith("bad_")]

CELL = {
    "handey_cell": 1,
    "name": "test",
    "robot": {"file": "robots/puma560/robot.yaml"},
    "fixtures": {
        "table": {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
    },
    "parts": {
        "block": {"box": [0.04, 0.06, 0.03], "pose": {"xyz": [0.5, 0.1, 0.015]}},
        "bar": {"box": [0.02, 0.02, 0.1], "pose": {"xyz": [0.5, -0.2, 0.05]}},
    },
    "task": [{"place": "block", "at": {"xyz": [0.5, -0.1, 0.015]}}],
}


def parsed(changes: dict | None = None, **entries):
    """The small cell above with `changes` at dotted places, and more entries at its top."""
    cell = copy.deepcopy(CELL) | entries
    for place, value in (changes or {}).items():
        *steps, last = place.split(".")
        target = cell
        for step in steps:
            target = target[step]
        target[last] = value
    return handey.parse_cell(cell, MODELS)


def faults_of(*arguments, **entries) -> list[tuple[str, str]]:
    with pytest.raises(InvalidInput) as caught:
        parsed(*arguments, **entries)
    return [(fault.code, fault.place) for fault in caught.value.faults]


@pytest.mark.parametrize("path", GOOD, ids=lambda path: path.stem)
def test_every_cell_of_the_models_loads_without_a_warning(path):
    loaded = handey.load_cell(path)
    assert loaded.name == path.stem and loaded.file == path
    assert loaded.cell.parts and loaded.cell.fixtures and loaded.goals
    assert loaded.warnings == ()


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("bad_goal_in_collision", [("E_GOAL_IN_COLLISION", "task[0].at")]),
        ("bad_goal_in_the_air", [("E_GOAL_UNSTABLE", "task[0].at")]),
        ("bad_start_in_solid", [("E_START_IN_COLLISION", "parts.block.pose")]),
        (
            "bad_faults",
            [
                ("E_UNKNOWN_KEY", "fixtures.table.suport"),
                ("E_TYPE", "fixtures.table.pose.xyz"),
                ("E_PATH", "parts.block.mesh"),
                ("E_REF", "task[0].place"),
            ],
        ),
    ],
)
def test_every_bad_cell_of_the_models_is_refused_with_all_its_faults(name, expected):
    path = MODELS / "cells" / f"{name}.yaml"
    with pytest.raises(InvalidInput) as caught:
        handey.load_cell(path)
    assert [(fault.code, fault.place) for fault in caught.value.faults] == expected
    assert all(fault.file == str(path) for fault in caught.value.faults)


def test_the_cell_is_what_the_file_says():
    loaded = parsed({"parts.block.friction": 0.3, "parts.block.mass": 0.2, "finish": "anywhere"})
    cell = loaded.cell
    assert [fixture.name for fixture in cell.fixtures] == ["table"]
    assert [part.name for part in cell.parts] == ["block", "bar"]
    assert cell.fixtures[0].support and not cell.parts[0].support
    assert (cell.parts[0].friction, cell.parts[1].friction) == (0.3, 0.4)
    assert (cell.parts[0].mass, cell.parts[0].density) == (0.2, None)
    assert np.array_equal(cell.parts[0].X_WB, pose_from_xyz_rpy([0.5, 0.1, 0.015], np.zeros(3)))
    assert np.array_equal(cell.X_WR, np.eye(4))
    assert cell.held is None
    assert not loaded.task.return_to_start and not loaded.task.any_order
    (goal,) = loaded.goals
    assert isinstance(goal, PlaceAt) and goal.part == "block"


def test_the_robot_starts_at_home_with_the_jaw_open_unless_told():
    loaded = parsed()
    robot = loaded.cell.robot
    assert np.array_equal(loaded.cell.start.q, robot.home)
    assert loaded.cell.start.opening == robot.gripper.max_opening
    q = np.array(robot.home) * 0.9
    told = parsed({"robot.start": q, "robot.start_opening": 0.02})
    assert np.array_equal(told.cell.start.q, q) and told.cell.start.opening == 0.02


def test_a_start_of_wrong_length_or_outside_the_limits_is_refused():
    robot = parsed().cell.robot
    home, limit = np.array(robot.home), robot.joints[1].limit
    assert faults_of({"robot.start": home[:5]}) == [("E_DOF", "robot.start")]
    q = home.copy()
    q[1] = limit.upper + 1e-6
    assert faults_of({"robot.start": q}) == [("E_LIMIT", "robot.start[1]")]
    assert faults_of({"robot.start_opening": 0.5}) == [("E_RANGE", "robot.start_opening")]


def test_goals_of_all_kinds_are_read():
    loaded = parsed(
        task=[
            {"place": "block", "on": "table", "region": [[0, 0], [1, 1]], "resting": "same"},
            {"place": "bar", "inside": "table"},
        ],
        order="any",
    )
    on, inside = loaded.goals
    assert isinstance(on, PlaceOn) and on.same_resting and on.region.tolist() == [[0, 0], [1, 1]]
    assert inside == PlaceInside("bar", "table")
    assert loaded.task.any_order


def test_bodies_of_several_shapes_keep_the_poses_of_their_shapes():
    shapes = [
        {"cylinder": {"radius": 0.02, "length": 0.04}, "pose": {"xyz": [0, 0, 0.02]}},
        {"sphere": {"radius": 0.01}, "pose": {"xyz": [0, 0, 0.05]}},
    ]
    loaded = parsed({"parts.knob": {"shapes": shapes, "pose": {"xyz": [0.3, 0.3, 0]}}})
    knob = loaded.cell.parts[2]
    assert [shape.X_BS[2, 3] for shape in knob.shapes] == [0.02, 0.05]
    assert knob.shapes[0].geometry.radius == 0.02 and knob.shapes[1].geometry.radius == 0.01


# What cannot be


def test_parts_that_overlap_at_the_start_are_refused_with_names_and_depth():
    with pytest.raises(InvalidInput) as caught:
        parsed({"parts.bar.pose": {"xyz": [0.5, 0.12, 0.05]}})
    (fault,) = caught.value.faults
    assert fault.code == "E_START_IN_COLLISION"
    assert "'block'" in fault.message and "'bar'" in fault.message and " mm" in fault.message


def test_contact_of_half_a_millimetre_is_no_overlap():
    parsed({"parts.block.pose": {"xyz": [0.5, 0.1, 0.0146]}})
    faults = faults_of({"parts.block.pose": {"xyz": [0.5, 0.1, 0.0143]}})
    assert faults == [("E_START_IN_COLLISION", "parts.block.pose")]


def test_fixtures_may_overlap_each_other():
    parsed({"fixtures.wall": {"box": [0.1, 0.1, 0.1], "pose": {"xyz": [0.8, 0.4, 0.02]}}})


def test_the_robot_inside_something_at_the_start_is_refused():
    faults = faults_of({"fixtures.room": {"box": [3, 3, 3], "pose": {"xyz": [0, 0, 1.6]}}})
    assert ("E_START_IN_COLLISION", "robot.start") in faults


def test_goals_are_taken_in_their_order():
    away = {"place": "bar", "at": {"xyz": [0.3, 0.3, 0.05]}}
    there = {"place": "block", "at": {"xyz": [0.5, -0.2, 0.015]}}
    parsed(task=[away, there])
    assert faults_of(task=[there, away]) == [("E_GOAL_IN_COLLISION", "task[0].at")]
    parsed(task=[there, away], order="any")


def test_a_part_may_be_put_on_a_part_that_an_earlier_goal_put_there():
    under = {"place": "block", "at": {"xyz": [0.4, 0.2, 0.015]}}
    over = {"place": "bar", "at": {"xyz": [0.4, 0.2, 0.08]}}
    parsed(task=[under, over])
    assert ("E_GOAL_UNSTABLE", "task[0].at") in faults_of(task=[over, under])


def test_a_goal_in_the_air_or_over_the_edge_is_refused():
    for xyz in ([0.5, 0, 0.017], [1.36, 0, 0.015]):
        assert faults_of(task=[{"place": "block", "at": {"xyz": xyz}}]) == [
            ("E_GOAL_UNSTABLE", "task[0].at")
        ]
    parsed(task=[{"place": "block", "at": {"xyz": [1.34, 0, 0.015]}}])


def test_a_goal_on_an_edge_is_refused():
    height = (0.015 + 0.03) / np.sqrt(2)
    pose = {"xyz": [0.5, 0, height], "rpy": [np.pi / 4, 0, 0]}
    assert faults_of(task=[{"place": "block", "at": pose}]) == [("E_GOAL_UNSTABLE", "task[0].at")]


def test_a_part_that_does_not_stand_at_the_start_is_a_warning():
    loaded = parsed({"parts.bar.pose": {"xyz": [0.5, -0.2, 0.2]}})
    (warning,) = loaded.warnings
    assert "bar does not stand stably" in warning


def test_a_depth_map_is_a_fixture_after_those_of_the_file(tmp_path):
    np.save(tmp_path / "heap.npy", np.full((4, 4), 0.1))
    heap = {"heights": str(tmp_path / "heap.npy"), "cell": 0.01, "pose": {"xyz": [0.5, 0.5, 0]}}
    plain = parsed()
    loaded = parsed(depth_maps={"heap": heap})
    assert loaded.depth_maps[0].shape == (4, 4)
    names = [fixture.name for fixture in plain.cell.fixtures]
    assert [fixture.name for fixture in loaded.cell.fixtures] == [*names, "heap"]


# Meshes


def test_a_fault_of_a_mesh_is_told_at_the_place_that_names_it(tmp_path):
    path = tmp_path / "open.stl"
    content = (MODELS / "parts" / "block.stl").read_bytes()
    count = int.from_bytes(content[80:84], "little")
    path.write_bytes(content[:80] + (count - 1).to_bytes(4, "little") + content[84:-50])
    mesh = {"mesh": str(path), "scale": 0.001, "pose": {"xyz": [0.3, 0.3, 0]}}
    assert faults_of({"parts.lid": mesh}) == [("E_NOT_CLOSED", "parts.lid.mesh")]
    loaded = parsed({"fixtures.lid": mesh})
    assert not loaded.cell.fixtures[1].shapes[0].geometry.solid


def test_faults_of_robot_and_meshes_are_told_together(tmp_path):
    folder = tmp_path / "puma560"
    shutil.copytree(MODELS / "robots" / "puma560", folder)
    urdf = folder / "puma560.urdf"
    urdf.write_text(urdf.read_text().replace("</robot>", ""))
    for name in ("a", "b"):
        (tmp_path / f"{name}.stl").write_text("")
    faults = faults_of(
        {
            "robot.file": str(folder / "robot.yaml"),
            "parts.a": {"mesh": str(tmp_path / "a.stl")},
            "fixtures.b": {"mesh": str(tmp_path / "b.stl")},
        }
    )
    codes = {code for code, _ in faults}
    assert "E_XML" in codes and {place for _, place in faults} >= {
        "parts.a.mesh",
        "fixtures.b.mesh",
    }


def test_metres_for_millimetres_are_refused_with_a_hint():
    mesh = {"mesh": "parts/block.stl", "pose": {"xyz": [0.3, 0.3, 0]}}
    with pytest.raises(InvalidInput) as caught:
        parsed({"parts.lid": mesh})
    assert caught.value.faults[0].code == "E_UNITS"
    assert caught.value.faults[0].place == "parts.lid.mesh"
