"""Grip, rest and goals: each rule is broken once, and the check finds it."""

from __future__ import annotations

import copy

import hand_made
import numpy as np
import pytest
from hand_made import BLOCK, BLOCK_GOAL, X_PH, PlanMaker, clauses, pick_and_place, pose, write_cell

from handey.check import check


def test_finds_pads_that_do_not_reach_the_part(cell):
    report = check(cell, pick_and_place(cell, width=0.0415))
    assert clauses(report) == {"pads"}


def test_finds_pads_beside_the_face(cell):
    # 0.6 mm of the 20 mm wide pads are on the 60 mm long face: 18 mm2 < 25 mm2.
    beside = hand_made.pose([0.0394, 0, 0.005])
    report = check(cell, pick_and_place(cell, X_PH=beside))
    assert clauses(report) == {"pads"}
    enough = hand_made.pose([0.0388, 0, 0.005])
    assert check(cell, pick_and_place(cell, X_PH=enough)).ok


def test_finds_pads_askew_to_the_faces(cell):
    askew = hand_made.pose([0, 0, 0.005], hand_made.rpy_matrix(np.pi, 0, np.radians(1.5)))
    report = check(cell, pick_and_place(cell, X_PH=askew, width=0.0402))
    assert clauses(report) == {"pads"} and "askew" in report.faults[0].message


def test_finds_a_part_that_jumps_into_the_hand(cell, plan):
    for step in plan["steps"][3:6]:
        step["part_in_grasp_frame"]["xyz"][0] += 2e-4
    assert "jump" in clauses(check(cell, plan))


@pytest.mark.parametrize(
    ("x", "stable"),
    [(0.0, True), (0.028, True), (0.032, False)],
    ids=["whole", "edge", "over the edge"],
)
def test_finds_parts_that_tip_over(tmp_path, x, stable):
    # A plinth under the goal; the block's middle is x from its middle, its edge is at 30 mm.
    plinth = {"plinth": {"box": [0.06, 0.1, 0.02], "pose": {"xyz": [0.5, -0.15, 0.01]}}}
    goal = pose([0.5 + x, -0.15, 0.045], np.eye(3))
    cell = write_cell(
        tmp_path, fixtures=plinth, task=[{"place": "block", "at": {"xyz": goal[:3, 3].tolist()}}]
    )
    report = check(cell, pick_and_place(cell, X_to=goal))
    assert report.ok is stable, str(report)
    if not stable:
        assert clauses(report) == {"stability"} and "tips over" in report.faults[0].message


def test_finds_parts_let_go_in_the_air(tmp_path):
    goal = pose([0.5, -0.15, 0.0257], np.eye(3))
    cell = write_cell(tmp_path, task=[{"place": "block", "at": {"xyz": goal[:3, 3].tolist()}}])
    report = check(cell, pick_and_place(cell, X_to=goal))
    assert clauses(report) == {"stability"} and "nothing" in report.faults[0].message


def test_finds_a_part_on_a_ridge(tmp_path):
    ridge = {"ridge": {"box": [0.0018, 0.1, 0.02], "pose": {"xyz": [0.5, -0.15, 0.01]}}}
    goal = pose([0.5, -0.15, 0.045], np.eye(3))
    cell = write_cell(
        tmp_path, fixtures=ridge, task=[{"place": "block", "at": {"xyz": goal[:3, 3].tolist()}}]
    )
    report = check(cell, pick_and_place(cell, X_to=goal))
    assert clauses(report) == {"stability"} and "wide" in report.faults[0].message


def regrasp(cell):
    maker = PlanMaker(cell)
    between = pose([0.6, 0.0, 0.025], np.eye(3))
    maker.carry("block", BLOCK, between, X_PH, 0.04)
    maker.carry("block", between, BLOCK_GOAL, X_PH, 0.04)
    maker.finish()
    return maker.plan()


def test_accepts_a_regrasp_on_a_support_and_on_nothing_else(cell, tmp_path):
    plan = regrasp(cell)
    assert check(cell, plan).ok, str(check(cell, plan))
    bare = copy.deepcopy(hand_made.CELL["fixtures"]["table"])
    bare["support"] = False
    report = check(write_cell(tmp_path, fixtures={"table": bare}), plan)
    assert clauses(report) == {"support"}


def drawn_out(cell):
    """The block is drawn sideways out from under what stands on it."""
    maker = PlanMaker(cell)
    pick, put = BLOCK @ X_PH, BLOCK_GOAL @ X_PH
    held = {"part": "block", "X_HP": np.linalg.inv(X_PH)}

    def moved(X, x=0.0, z=0.0):
        return X + np.array([[0, 0, 0, x], [0, 0, 0, 0], [0, 0, 0, z], [0, 0, 0, 0]])

    # The hand comes from the side too: what stands on the block is to stay.
    start = hand_made.solve(maker.cell, moved(pick, 0.08), maker.near_start)
    maker.move(
        "transit", hand_made.solve(maker.cell, moved(pick, 0.08, 0.12), maker.near_start), 0.07
    )
    maker.move("transit", start)
    maker.slide("approach", pick)
    maker.grip("grasp", 0.04)
    maker.slide("depart", moved(pick, 0.08), rows=60, **held)
    maker.slide("transfer", moved(pick, 0.08, 0.12), rows=60, **held)
    maker.move("transfer", hand_made.solve(maker.cell, moved(put, 0, 0.12), maker.q), **held)
    maker.slide("deposit", put, rows=60, **held)
    maker.grip("release", 0.07)
    maker.slide("withdraw", moved(put, 0, 0.12))
    maker.placements["block"] = {"xyz": [0.50, -0.15, 0.025]}
    maker.finish()
    return maker.plan()


def test_finds_a_part_drawn_from_under_another(tmp_path):
    def report(tile):
        cell = write_cell(tmp_path, parts={"tile": tile})
        return check(cell, drawn_out(cell))

    on_it = {"box": [0.02, 0.02, 0.005], "pose": {"xyz": [0.50, 0.15, 0.0525]}}
    assert clauses(report(on_it)) == {"stability"}
    beside_it = {"box": [0.02, 0.02, 0.005], "pose": {"xyz": [0.40, 0.15, 0.0025]}}
    assert report(beside_it).ok, str(report(beside_it))


def test_finds_a_wrong_place(tmp_path, valid):
    for off, fine in ((0.9e-4, True), (1.2e-4, False)):
        cell = write_cell(
            tmp_path, task=[{"place": "block", "at": {"xyz": [0.5 + off, -0.15, 0.025]}}]
        )
        report = check(cell, valid)
        assert report.ok is fine
        assert fine or clauses(report) == {"goal"}


def test_finds_a_wrong_turn(tmp_path, valid):
    goal = {"xyz": [0.5, -0.15, 0.025], "rpy": [0, 0, 2e-3]}
    assert clauses(check(write_cell(tmp_path, task=[{"place": "block", "at": goal}]), valid)) == {
        "goal"
    }


def test_finds_an_unmet_goal_of_another_part(tmp_path, valid):
    task = [*hand_made.CELL["task"], {"place": "bystander", "at": {"xyz": [0.35, 0.30, 0.02]}}]
    report = check(write_cell(tmp_path, task=task), valid)
    assert clauses(report) == {"goal"} and "bystander" in report.faults[0].message


def test_accepts_goals_that_are_met_without_a_step(tmp_path, valid):
    task = [*hand_made.CELL["task"], {"place": "bystander", "at": {"xyz": [0.35, 0.35, 0.02]}}]
    assert check(write_cell(tmp_path, task=task), valid).ok
    empty = {
        "handey_plan": 1,
        "cell": "hand_made",
        "joints": valid["joints"],
        "steps": [],
        "placements": {},
    }
    assert check(write_cell(tmp_path, task=task[1:]), empty).ok
    assert clauses(check(write_cell(tmp_path, task=task), empty)) == {"goal"}


def test_finds_goals_in_a_wrong_order(tmp_path, cell):
    there = {"place": "block", "at": {"xyz": [0.6, 0.0, 0.025]}}
    plan = regrasp(cell)
    for step in plan["steps"][8:]:
        step["goal"] = 1
    assert check(write_cell(tmp_path, task=[there, *hand_made.CELL["task"]]), plan).ok
    for step in plan["steps"]:
        step["goal"] = 1 - step["goal"]
    assert "goal" in clauses(
        check(write_cell(tmp_path, task=[*hand_made.CELL["task"], there]), plan)
    )


def test_finds_a_goal_that_changes_in_the_middle_of_a_turn(tmp_path, cell):
    there = {"place": "block", "at": {"xyz": [0.6, 0.0, 0.025]}}
    two = write_cell(tmp_path, task=[there, *hand_made.CELL["task"]])
    for first, fine in ((6, False), (7, False), (8, True), (10, False), (11, False)):
        plan = regrasp(cell)
        for step in plan["steps"][first:]:
            step["goal"] = 1
        assert check(two, plan).ok is fine, f"from step {first}"


@pytest.mark.parametrize(
    ("goal", "fine"),
    [
        ({"on": "table"}, True),
        ({"on": "table", "resting": "same"}, True),
        ({"on": "table", "region": [[0.45, -0.2], [0.55, -0.1]]}, True),
        ({"on": "table", "region": [[0.50, -0.2], [0.55, -0.1]]}, False),
        ({"inside": "table"}, False),
    ],
)
def test_judges_goals_without_a_pose(tmp_path, valid, goal, fine):
    report = check(write_cell(tmp_path, task=[{"place": "block", **goal}]), valid)
    assert report.ok is fine, str(report)
    assert fine or clauses(report) == {"goal"}


def test_finds_a_part_moved_without_leave(tmp_path, cell):
    maker = PlanMaker(cell)
    maker.carry("block", BLOCK, BLOCK_GOAL, X_PH, 0.04)
    maker.finish()
    task = [{"place": "bystander", "at": {"xyz": [0.35, 0.35, 0.02]}}]
    report = check(write_cell(tmp_path, task=task), maker.plan())
    assert clauses(report) == {"moved"}
    free = {**hand_made.CELL["parts"]["block"], "may_move": True}
    assert check(write_cell(tmp_path, task=task, parts={"block": free}), maker.plan()).ok


def test_finds_wrong_placements(cell, plan):
    plan["placements"]["block"]["xyz"][0] += 2e-4
    assert clauses(check(cell, plan)) == {"placements"}
    plan["placements"] = {}
    assert clauses(check(cell, plan)) == {"placements"}
