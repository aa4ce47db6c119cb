"""What overlaps in a plan: each way is made once, and the check finds it."""

from __future__ import annotations

import hand_made
import numpy as np
import pytest
from hand_made import (
    BLOCK,
    BLOCK_GOAL,
    X_PH,
    PlanMaker,
    clauses,
    pick_and_place,
    pose,
    step_of,
    wall,
    write_cell,
)

from handey.check import check


def test_finds_a_wall_between_the_ends_of_a_transfer(valid, tmp_path):
    cell = write_cell(tmp_path, fixtures=wall([0.3, 0.02, 0.3], [0.5, 0.0, 0.15]))
    report = check(cell, valid)
    assert clauses(report) == {"collision"}
    assert {"wall"} < {word for f in report.faults for word in f.message.split()}
    assert step_of(valid, "transfer") in {fault.step for fault in report.faults}
    assert report.least_clearance == 0.0


@pytest.mark.parametrize("thickness", [1e-3, 5e-5])
def test_finds_a_wall_thinner_than_any_step(cell, plan, tmp_path, thickness):
    # All rows of the transfer but its ends are left out: the part goes right through in one stride.
    step = plan["steps"][4]
    middle = [0, -1]
    for key in ("time", "positions", "opening"):
        step[key] = [step[key][k] for k in middle]
    assert check(cell, plan).ok
    thin = write_cell(tmp_path, fixtures=wall([0.3, thickness, 0.3], [0.5, 0.013, 0.15]))
    report = check(thin, plan)
    assert clauses(report) == {"collision"}
    assert any("block and wall" in fault.message for fault in report.faults)


def test_tells_a_hair_from_a_collision(valid, tmp_path):
    # The part's top is at 0.05 + 0.12 where it is carried; find the least height of a beam above
    # it.
    step = valid["steps"][0]
    assert step["opening"][-1] == pytest.approx(0.07)
    for gap, fine in ((1e-4, True), (-1e-4, False)):
        # In the approach the pads pass beside a post of this distance from the open finger.
        y = 0.15 + 0.035 + 0.012 + gap + 0.01
        post = {"post": {"box": [0.02, 0.02, 0.06], "pose": {"xyz": [0.5, y, 0.03]}}}
        report = check(write_cell(tmp_path, fixtures=post), valid)
        assert report.ok is fine, str(report)
        if fine:
            assert report.least_clearance == pytest.approx(gap, rel=0.25)
        else:
            assert clauses(report) == {"collision"}


def mesh_of_cube(path, size, inverted=False):
    import trimesh

    cube = trimesh.creation.box([size, size, size])
    # A dent makes it concave, so that the engine knows only its skin.
    cube = cube.subdivide()
    corner = np.argmin(cube.vertices.sum(axis=1))
    cube.vertices[corner] *= 0.5
    cube.export(path)


def test_finds_a_part_that_is_wholly_inside_a_solid(valid, tmp_path):
    mesh_of_cube(tmp_path / "cube.stl", 1.2)
    cell = write_cell(
        tmp_path, fixtures={"cube": {"mesh": "cube.stl", "pose": {"xyz": [0.5, 0.0, 0.2]}}}
    )
    report = check(cell, valid)
    assert "collision" in clauses(report)
    held = [
        f
        for f in report.faults
        if f.message.startswith("block and cube") and f.action == "transfer"
    ]
    assert held


def test_knows_the_inside_of_an_open_tray_from_its_walls(valid, tmp_path):
    import trimesh

    outer = trimesh.creation.box([0.4, 0.3, 0.03])
    floor = [
        trimesh.creation.box(s, trimesh.transformations.translation_matrix(t))
        for s, t in (
            ([0.4, 0.005, 0.03], [0, 0.15, 0.015]),
            ([0.4, 0.005, 0.03], [0, -0.15, 0.015]),
        )
    ]
    assert outer.is_watertight
    trimesh.util.concatenate(floor).export(tmp_path / "walls.stl")
    cell = write_cell(
        tmp_path, fixtures={"walls": {"mesh": "walls.stl", "pose": {"xyz": [0.5, -0.15, 0]}}}
    )
    assert check(cell, valid).ok


def test_looks_at_a_robot_that_only_stands(tmp_path):
    """One row of one step is a moment, too."""
    plan = {
        "handey_plan": 1, "cell": "hand_made", "joints": [f"joint{i}" for i in range(1, 7)],
        "steps": [
            {
                "action": "transit", "goal": 0, "part": None, "part_in_grasp_frame": None,
                "time": [0.0], "positions": [[0.0, 1.5708, -1.5708, 0.0, 0.0, 0.0]],
                "opening": [0.1],
            }
        ],
        "placements": {},
    }  # fmt: skip
    met = [{"place": "block", "at": {"xyz": [0.50, 0.15, 0.025]}}]
    assert check(write_cell(tmp_path, task=met), plan).ok
    beam = {"box": [0.6, 0.6, 0.1], "pose": {"xyz": [0.0, 0.0, 1.2]}}
    assert "collision" in clauses(
        check(write_cell(tmp_path, task=met, fixtures={"beam": beam}), plan)
    )


def test_finds_an_arm_that_hits_itself(cell):
    maker = PlanMaker(cell)
    folded = [0.0, 3.39, 0.01, 2.64, -0.19, 2.14]  # behind the base, a finger in it
    maker.move("transit", folded)
    maker.finish()
    report = check(cell, maker.plan())
    assert "self-collision" in clauses(report)


def test_finds_a_hit_of_what_is_held_with_a_part_that_stands(valid, tmp_path):
    cell = write_cell(
        tmp_path, parts={"bystander": {"box": [0.04, 0.04, 0.2], "pose": {"xyz": [0.5, 0.0, 0.1]}}}
    )
    report = check(cell, valid)
    assert any(
        "block and bystander" in f.message and f.clause == "collision" for f in report.faults
    )


def test_finds_fingers_pressed_too_deep(cell):
    report = check(cell, pick_and_place(cell, width=0.0385))
    assert {"contact", "pads"} <= clauses(report)
    assert check(cell, pick_and_place(cell, width=0.0394)).ok


def test_finds_a_part_pressed_into_the_table(tmp_path):
    low = pose([0.50, -0.15, 0.0243], np.eye(3))
    cell = write_cell(tmp_path, task=[{"place": "block", "at": {"xyz": low[:3, 3].tolist()}}])
    report = check(cell, pick_and_place(cell, X_to=low))
    assert "contact" in clauses(report)
    near = pose([0.50, -0.15, 0.0247], np.eye(3))
    cell = write_cell(tmp_path, task=[{"place": "block", "at": {"xyz": near[:3, 3].tolist()}}])
    assert check(cell, pick_and_place(cell, X_to=near)).ok


def test_allows_contact_only_near_the_place(tmp_path):
    # The block is 0.3 mm deep in a wall beside it. Drawn along the wall it stays so: no more a
    # contact.
    beside = {
        "wall": {"box": [0.3, 0.02, 0.3], "pose": {"xyz": [0.5, 0.15 + 0.02 + 0.01 - 3e-4, 0.15]}}
    }
    cell = write_cell(tmp_path, fixtures=beside)
    turned = hand_made.pose([0, 0, 0.005], hand_made.rpy_matrix(np.pi, 0, np.pi / 2))
    report = check(cell, pick_and_place(cell, X_PH=turned, width=0.06, open_to=0.08))
    along = [f for f in report.faults if f.message.startswith("block and wall")]
    assert {f.action for f in along} == {"depart", "transfer"}
    assert {f.clause for f in along} == {"collision"}


def test_finds_a_hand_that_hits_the_part_it_goes_for(cell, plan):
    maker = PlanMaker(cell)
    maker.carry("block", BLOCK, BLOCK_GOAL, X_PH, 0.04, open_to=0.0399)
    maker.finish()
    report = check(cell, maker.plan())
    assert any(f.clause == "collision" and f.action == "approach" for f in report.faults)
