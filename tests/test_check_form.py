"""Form, time and joints of a plan: each rule is broken once, and the check finds it."""

from __future__ import annotations

import numpy as np
import pytest
from hand_made import clauses, step_of, write_cell

from handey.check import check
from handey.errors import InvalidInput


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
