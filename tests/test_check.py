"""Each clause of 'a valid plan' is broken once; each time the check finds it under its name."""

from __future__ import annotations

import copy
import json

import hand_made
import numpy as np
import pytest
from hand_made import BLOCK, BLOCK_GOAL, X_PH, PlanMaker, pick_and_place, pose, write_cell

from handey.check import CLAUSES, check
from handey.errors import InvalidInput

ACTIONS = [
    "transit",
    "approach",
    "grasp",
    "depart",
    "transfer",
    "deposit",
    "release",
    "withdraw",
    "transit",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("cell")


@pytest.fixture(scope="module")
def cell(folder):
    return write_cell(folder)


@pytest.fixture(scope="module")
def valid(cell):
    return pick_and_place(cell)


@pytest.fixture
def plan(valid):
    return copy.deepcopy(valid)


def clauses(report):
    return {fault.clause for fault in report.faults}


def step_of(plan, action):
    return next(i for i, step in enumerate(plan["steps"]) if step["action"] == action)


def test_finds_nothing_wrong_with_a_valid_plan(cell, valid):
    report = check(cell, valid)
    assert report.ok, str(report)
    assert [step["action"] for step in valid["steps"]] == ACTIONS
    assert report.duration == pytest.approx(valid["steps"][-1]["time"][-1])
    # The hand opens to 70 mm around 40 mm: 15 mm to either side.
    assert report.least_clearance == pytest.approx(0.015, abs=1e-5)
    assert set(report.least_clearance_between) & {"left_finger", "right_finger"}
    assert 0.005 < report.least_self_clearance < 0.1


def test_reads_a_plan_from_a_file_and_reports_as_json(cell, valid, tmp_path):
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(valid))
    report = check(cell, path)
    assert json.loads(json.dumps(report.to_json()))["ok"] is True


# -------------------------------------------------------------------------------- form of the plan


def test_finds_a_report_that_is_no_mapping(cell, plan):
    plan["report"] = [1]
    assert clauses(check(cell, plan)) == {"format"}


def test_finds_missing_keys(cell, plan):
    del plan["placements"]
    assert clauses(check(cell, plan)) == {"format"}


def test_finds_a_missing_key_of_a_step(cell, plan):
    del plan["steps"][2]["opening"]
    report = check(cell, plan)
    assert clauses(report) == {"format"} and report.faults[0].step == 2


@pytest.mark.parametrize(
    ("key", "value"),
    [("joints", ["a"]), ("cell", "other"), ("handey_plan", 2), ("steps", {}), ("extra", 1)],
)
def test_finds_wrong_heads(cell, plan, key, value):
    plan[key] = value
    assert clauses(check(cell, plan)) == {"format"}


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("action", "jump"),
        ("goal", 7),
        ("goal", True),
        ("part", "nobody"),
        ("time", [0.0]),
        ("opening", ["x"] * 60),
    ],
)
def test_finds_wrong_values_of_a_step(cell, plan, key, value):
    plan["steps"][0][key] = value
    assert clauses(check(cell, plan)) == {"format"}


def test_takes_neither_texts_nor_truths_for_numbers(cell, plan):
    grip = plan["steps"][step_of(plan, "depart")]["part_in_grasp_frame"]
    grip["xyz"] = [str(x) for x in grip["xyz"]]
    plan["steps"][0]["time"][0] = False
    plan["steps"][1]["positions"][0][0] = 1e300
    plan["placements"]["block"] = None
    report = check(cell, plan)
    assert clauses(report) == {"format"}
    assert len(report.faults) == 4


def test_refuses_what_is_no_plan_at_all(cell, tmp_path):
    path = tmp_path / "plan.json"
    path.write_text('{"handey_plan": NaN}')
    with pytest.raises(InvalidInput):
        check(cell, path)
    with pytest.raises(InvalidInput):
        check(cell, tmp_path / "none.json")


@pytest.mark.parametrize("swap", [(2, 3), (5, 6), (1, 2), (6, 7)])
def test_finds_a_wrong_order_of_steps(cell, plan, swap):
    a, b = swap
    plan["steps"][a]["action"], plan["steps"][b]["action"] = (
        plan["steps"][b]["action"],
        plan["steps"][a]["action"],
    )
    report = check(cell, plan)
    assert "grammar" in clauses(report)
    assert next(f for f in report.faults if f.clause == "grammar").step in (a, b)


def test_finds_a_plan_that_ends_with_the_part_in_the_hand(cell, plan):
    plan["steps"] = plan["steps"][:5]
    assert "grammar" in clauses(check(cell, plan))


def test_finds_a_part_named_while_none_is_held(cell, plan):
    plan["steps"][7]["part"] = "block"
    assert clauses(check(cell, plan)) == {"held"}


def test_finds_a_part_that_slips_in_the_hand(cell, plan):
    plan["steps"][4]["part_in_grasp_frame"]["xyz"][0] += 1e-5
    assert clauses(check(cell, plan)) == {"held"}


# --------------------------------------------------------------------------------- time and joints


def test_finds_a_gap_between_steps(cell, plan):
    for row in plan["steps"][8]["positions"][:1]:
        row[5] += 1e-6
    report = check(cell, plan)
    assert clauses(report) == {"continuity"} and report.faults[0].step == 8


def test_finds_an_opening_that_jumps_between_steps(cell, plan):
    plan["steps"][8]["opening"][0] += 1e-6
    assert "continuity" in clauses(check(cell, plan))


def test_finds_time_that_goes_back(cell, plan):
    plan["steps"][4]["time"][10] = plan["steps"][4]["time"][8]
    assert "time" in clauses(check(cell, plan))


def test_finds_time_that_does_not_start_at_zero(cell, plan):
    for step in plan["steps"]:
        step["time"] = [t + 1.0 for t in step["time"]]
    assert clauses(check(cell, plan)) == {"time"}


def test_finds_a_joint_that_is_too_fast(cell, plan):
    for step in plan["steps"]:
        step["time"] = [t * 0.45 for t in step["time"]]
    report = check(cell, plan)
    assert clauses(report) == {"velocity"}
    assert any("joint" in fault.message for fault in report.faults)


def test_finds_fingers_that_are_too_fast(cell, plan):
    times = plan["steps"][2]["time"]
    start = times[0]
    plan["steps"][2]["time"] = [start + (t - start) * 0.3 for t in times]
    report = check(cell, plan)
    assert clauses(report) == {"velocity"} and report.faults[0].step == 2
    assert "finger" in report.faults[0].message


def test_finds_a_joint_beyond_its_limit(cell, plan):
    step = plan["steps"][8]
    for k, row in enumerate(step["positions"][1:-1]):
        row[4] += 1.9 * np.sin(np.pi * (k + 1) / 59)
    step["time"] = [step["time"][0] + 10 * (t - step["time"][0]) for t in step["time"]]
    report = check(cell, plan)
    assert "joint-limits" in clauses(report)
    assert any("joint5" in fault.message for fault in report.faults)


def test_finds_an_opening_beyond_its_limit(cell, plan):
    plan["steps"][0]["opening"][5] = 0.11
    assert "joint-limits" in clauses(check(cell, plan))


def test_finds_an_arm_that_moves_while_the_hand_closes(cell, plan):
    plan["steps"][2]["positions"][4][0] += 1e-6
    assert clauses(check(cell, plan)) == {"still"}


@pytest.mark.parametrize(("action", "row"), [("grasp", -1), ("release", 0)])
def test_finds_fingers_that_do_not_close_or_open(cell, plan, action, row):
    """The opening changes outside of its own step: the part is pushed or dragged."""
    i = step_of(plan, action)
    step = plan["steps"][i]
    at_rest = step["opening"][row]
    step["opening"] = [at_rest] * len(step["opening"])
    neighbour = plan["steps"][i - 1 if action == "grasp" else i + 1]
    neighbour["opening"][row if action == "grasp" else 0] = at_rest
    assert "still" in clauses(check(cell, plan))


def test_finds_a_hand_that_works_while_it_carries(cell, plan):
    plan["steps"][4]["opening"][30] -= 2e-5
    assert clauses(check(cell, plan)) == {"still"}


def test_finds_a_start_that_is_not_the_cells(folder, valid, tmp_path):
    moved = write_cell(tmp_path, robot={"start": [0.01, 1.5708, -1.5708, 0, 0, 0]})
    assert clauses(check(moved, valid)) == {"start", "finish"}


def test_finds_a_start_opening_that_is_not_the_cells(valid, tmp_path):
    moved = write_cell(tmp_path, robot={"start_opening": 0.09})
    assert clauses(check(moved, valid)) == {"start"}


def test_finds_an_arm_that_does_not_return(cell, plan, tmp_path):
    plan["steps"].pop()
    assert clauses(check(cell, plan)) == {"finish"}
    assert check(write_cell(tmp_path, finish="anywhere"), plan).ok


# --------------------------------------------------------------------------------------- collision


def wall(size, xyz):
    return {"wall": {"box": size, "pose": {"xyz": xyz}}}


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


# ----------------------------------------------------------------------------------- grip and rest


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


# ------------------------------------------------------------------------------------------- goals


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


# ------------------------------------------------------------------------------------- the checker


def test_shares_no_code_with_the_planner():
    import ast
    from pathlib import Path

    from handey.check import report

    for source in Path(report.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(source.read_text())):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
                assert node.level == 0
                assert node.module != "handey", source
            for name in names:
                if name.split(".")[0] == "handey":
                    assert name.startswith("handey.check") or name == "handey.errors", (
                        source,
                        name,
                    )


def test_each_clause_is_broken_by_some_test():
    from pathlib import Path

    text = Path(__file__).read_text()
    assert [clause for clause in CLAUSES if f'"{clause}"' not in text] == []


# -------------------------------------------------------------------------- its means, one by one


def test_agrees_with_another_kinematics(cell):
    pinocchio = pytest.importorskip("pinocchio")
    from handey.check.cell import read_cell
    from handey.check.kinematics import forward

    robot = read_cell(cell).robot
    model = pinocchio.buildModelFromUrdf(str(hand_made.ROBOT.parent / "puma560.urdf"))
    data = model.createData()
    random = np.random.default_rng(3)
    low, high = ([getattr(j, side) for j in robot.joints] for side in ("lower", "upper"))
    q, opening = random.uniform(low, high, (50, 6)), random.uniform(*robot.opening, 50)
    frames = forward(robot, np.eye(4), q, opening)
    for k in range(50):
        state = pinocchio.neutral(model)
        values = dict(zip(robot.joint_names(), q[k], strict=True))
        values |= {finger.name: opening[k] / 2 for finger in robot.fingers}
        for name, value in values.items():
            state[model.joints[model.getJointId(name)].idx_q] = value
        pinocchio.framesForwardKinematics(model, data, state)
        for i, body in enumerate(robot.bodies):
            expected = data.oMf[model.getFrameId(body.name)].homogeneous
            assert np.abs(frames.matrix(i, k) - expected).max() < 1e-12


def random_solid(random, size):
    from handey.check import shapes

    kind = random.integers(4)
    X = np.eye(4)
    X[:3, :3] = hand_made.rpy_matrix(*random.uniform(-3, 3, 3))
    X[:3, 3] = random.uniform(-0.02, 0.02, 3)
    if kind == 0:
        return shapes.box(random.uniform(0.3, 1.0, 3) * size, X)
    if kind == 1:
        return shapes.cylinder(size * random.uniform(0.2, 0.5), size, X)
    if kind == 2:
        return shapes.sphere(size * random.uniform(0.2, 0.5), X)
    pieces = [shapes.box(np.array(s) * size, np.eye(4)) for s in ([1, 0.3, 0.3], [0.3, 0.3, 1.1])]
    vertices = np.vstack([p.vertices for p in pieces])
    faces = np.vstack([pieces[0].faces, pieces[1].faces + 8])
    return shapes.mesh(vertices, faces, X)


def test_distances_never_exceed_those_of_dense_points():
    from handey.check.solids import Engine, Placed, pieces_of

    random, engine = np.random.default_rng(5), Engine()
    for _ in range(40):
        a, b = random_solid(random, 0.1), random_solid(random, 0.15)
        R = hand_made.rpy_matrix(*random.uniform(-3, 3, 3))
        p = random.normal(size=3)
        p *= random.uniform(0.05, 0.3) / np.linalg.norm(p)
        found = min(
            engine.distance(Placed(i, np.eye(3), np.zeros(3)), Placed(j, R, p))
            for i in pieces_of([a])
            for j in pieces_of([b])
        )
        weights = random.dirichlet(np.ones(3), 60)

        def cloud(shape, weights=weights):
            points = np.einsum("wk,fki->fwi", weights, shape.triangles()).reshape(-1, 3)
            return points[:: max(len(points) // 3000, 1)]

        first, second = cloud(a), cloud(b) @ R.T + p
        from scipy.spatial import cKDTree

        nearest = cKDTree(first).query(second)[0].min()
        assert found <= nearest + 1e-6
        assert found > 0 or nearest < 0.06


def test_bounds_on_motion_hold(cell, valid):
    """No point moves further between two samples than the sweep believes."""
    from handey.check.cell import read_cell
    from handey.check.kinematics import forward
    from handey.check.solids import Engine, pieces_of
    from handey.check.sweep import Actor, Job, Samples, Sweep

    content = read_cell(cell)
    random = np.random.default_rng(7)
    robot = content.robot
    q = np.cumsum(np.vstack([robot.home, random.normal(0, 0.05, (40, 6))]), axis=0)
    opening = random.uniform(0, 0.1, 41)
    frames = forward(robot, content.base, q, opening)
    samples = Samples(q, opening, np.arange(41.0), np.zeros(40, int), frames)
    sweep = Sweep(robot, content.base, Engine())
    live = np.ones(40, bool)
    actors = [Actor(b.name, pieces_of(b.shapes), i) for i, b in enumerate(robot.bodies)]
    for a, b in ((0, 8), (2, 8), (7, 8), (3, 6), (1, 2)):
        job = Job(actors[a], actors[b], live, np.zeros(40), live)
        bound = sweep._motion(samples, job)
        points = np.vstack([s.points() for s in robot.bodies[b].shapes])
        for k in range(40):
            s = np.linspace(0, 1, 21)[:, None]
            dense = forward(
                robot, content.base, q[k] * (1 - s) + q[k + 1] * s,
                opening[k] * (1 - s[:, 0]) + opening[k + 1] * s[:, 0],
            )  # fmt: skip
            R, p = dense.R, dense.p
            seen = np.array(
                [((points @ R[b, i].T + p[b, i]) - p[a, i]) @ R[a, i] for i in range(21)]
            )
            moved = np.linalg.norm(np.diff(seen, axis=0), axis=2).sum(axis=0).max()
            assert moved <= bound[k] + 1e-9
            assert bound[k] < 4 * moved + 0.15  # and is of use


def test_misses_no_overlap_that_dense_sampling_finds(cell, tmp_path):
    """Random strides through random obstacles, against the engine at 2000 points of each."""
    from handey.check.cell import read_cell
    from handey.check.kinematics import forward
    from handey.check.solids import Engine, Placed, pieces_of

    random = np.random.default_rng(11)
    engine = Engine()
    verdicts = {True: 0, False: 0}
    for _ in range(12):
        start = read_cell(cell).start
        goal = start + random.uniform(-1.2, 0.8, 6)
        goal[4] = np.clip(goal[4], -1.7, 1.7)
        # Near the hand somewhere on its way.
        halfway = read_cell(cell), start + random.uniform(0.2, 0.8) * (goal - start)
        centre = hand_made.hand_pose(*halfway)[:3, 3] + random.uniform(-0.15, 0.15, 3)
        size = [random.uniform(0.001, 0.08) for _ in range(3)]
        changed = write_cell(tmp_path, finish="anywhere", fixtures=wall(size, centre.tolist()))
        maker = PlanMaker(changed)
        maker.step("transit", [start, goal], [0.1, 0.1])
        report = check(changed, maker.plan())
        found = any(" wall " in f.message for f in report.faults)
        content = read_cell(changed)
        s = np.linspace(0, 1, 2000)[:, None]
        q = content.start * (1 - s) + goal * s
        frames = forward(content.robot, content.base, q, np.full(2000, 0.1))
        obstacle = [
            Placed(piece, body.pose[:3, :3], body.pose[:3, 3])
            for body in content.fixtures
            if body.name == "wall"
            for piece in pieces_of(body.shapes)
        ]
        deepest = min(
            engine.distance(Placed(piece, frames.R[i, k], frames.p[i, k]), other)
            for i, body in enumerate(content.robot.bodies)
            if i
            for piece in pieces_of(body.shapes)
            for k in range(0, 2000, 8)
            for other in obstacle
        )
        if deepest < -2e-5:
            assert found
        elif deepest > 5e-3:
            assert not found
        verdicts[found] += 1
    assert min(verdicts.values()) >= 2


# --------------------------------------------------------------------------- measured obstacles


def volume(shape):
    a, b, c = np.moveaxis(shape.triangles(), 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def test_columns_are_solid_and_closed():
    from handey.check.depth import column_surface
    from handey.check.solids import _inside

    random = np.random.default_rng(2)
    heights = random.choice([0.0, 0.01, 0.02, 0.05], (7, 9))
    shape = column_surface(heights, 0.01)
    assert volume(shape) == pytest.approx(heights.sum() * 1e-4)
    for _ in range(300):
        x, y, z = random.uniform([-0.02, -0.02, -0.01], [0.10, 0.08, 0.06])
        j, i = round(x / 0.01), round(y / 0.01)
        expected = 0 <= i < 7 and 0 <= j < 9 and 0 < z < heights[i, j]
        assert _inside(shape.triangles(), np.array([x, y, z])) == expected


def test_cones_behind_pixels_are_solid_and_closed():
    from handey.check.camera import camera_surface
    from handey.check.solids import _inside

    random = np.random.default_rng(4)
    depth = random.choice([np.nan, 0.5, 0.6, 0.85], (6, 8))
    fx, fy, cx, cy, far = 20.0, 25.0, 3.5, 2.0, 0.3
    shape = camera_surface(depth, (fx, fy, cx, cy), far)
    near, d = depth[np.isfinite(depth)], far
    expected = (((near + d) ** 3 - near**3) / 3 / (fx * fy)).sum()
    assert volume(shape) == pytest.approx(expected)
    for _ in range(300):
        z = random.uniform(0.4, 1.2)
        u, v = random.uniform([-1, -1], [8.5, 6.5])
        i, j = round(v), round(u)
        inside = 0 <= i < 6 and 0 <= j < 8 and depth[i, j] < z < depth[i, j] + far
        point = np.array([(u - cx) / fx * z, (v - cy) / fy * z, z])
        assert _inside(shape.triangles(), point) == bool(inside)


def png16(image, kinds):
    """A 16-bit grey PNG, its lines filtered by these kinds in turn."""
    import struct
    import zlib

    rows, columns = image.shape
    plain = image.astype(">u2").view(np.uint8).reshape(rows, -1).astype(int)
    lines = b""
    for y in range(rows):
        kind = kinds[y % len(kinds)]
        up = plain[y - 1] if y else np.zeros_like(plain[0])
        left, corner = (np.r_[0, 0, line[:-2]] for line in (plain[y], up))
        p = left + up - corner
        off = np.array([abs(p - left), abs(p - up), abs(p - corner)])
        paeth = np.choose(off.argmin(axis=0), [left, up, corner])
        guess = [0 * up, left, up, (left + up) // 2, paeth][kind]
        lines += bytes([kind]) + ((plain[y] - guess) & 255).astype(np.uint8).tobytes()

    def chunk(kind, data):
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    head = struct.pack(">IIBBBBB", columns, rows, 16, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def test_reads_png_of_all_filters():
    import zlib

    from handey.check.camera import read_png

    image = np.random.default_rng(1).integers(0, 65536, (23, 17)).astype(np.uint16)
    assert np.array_equal(read_png(png16(image, [0, 1, 2, 3, 4])), image)
    for broken in (b"", png16(image, [0])[:200], b"\x89PNG\r\n\x1a\n"):
        with pytest.raises((ValueError, zlib.error)):
            read_png(broken)


def test_finds_hits_of_a_map_of_heights(valid, tmp_path):
    heights = np.zeros((30, 30))
    heights[:, 15] = 0.2
    np.save(tmp_path / "heights.npy", heights)
    for x, fine in ((0.4, False), (0.9, True)):
        map_ = {"heights": "heights.npy", "cell": 0.005, "pose": {"xyz": [x, 0.0, 0.0]}}
        report = check(write_cell(tmp_path, depth_maps={"heap": map_}), valid)
        assert report.ok is fine, str(report)
        assert fine or "heap" in str(report)


def test_finds_hits_of_what_a_camera_saw_and_nothing_explains(valid, tmp_path):
    # Looking down from 1 m: the table explains its pixels, nothing explains a pile 0.15 m high.
    image = np.full((60, 80), 1000, np.uint16)
    image[30, 40:43] = 850
    (tmp_path / "depth.png").write_bytes(png16(image, [4]))
    lens = {"fx": 100, "fy": 100, "cx": 40, "cy": 30}
    look_down = {"xyz": [0.5, 0.0, 1.0], "rpy": [np.pi, 0, 0]}
    seen = {
        "depth": "depth.png",
        "scale": 0.001,
        "intrinsics": lens,
        "pose": look_down,
        "far": 0.15,
    }
    report = check(write_cell(tmp_path, depth_maps={"camera": seen}), valid)
    assert clauses(report) == {"collision"} and "camera" in str(report)
    away = {**seen, "pose": {"xyz": [0.5, -0.9, 1.0], "rpy": [np.pi, 0, 0]}, "far": 0.01}
    image[:] = 1000
    (tmp_path / "depth.png").write_bytes(png16(image, [1]))
    away["explained"] = (
        0.06  # the blocks stand out of the table, and the picture does not show them
    )
    assert check(write_cell(tmp_path, depth_maps={"camera": away}), valid).ok
