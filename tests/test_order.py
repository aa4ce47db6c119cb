"""Goals in their order, in any order, and parts that must be moved aside first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml

import handey
from handey import _core, planner
from handey.planning.plan_options import PlanOptions

ROOT = Path(__file__).resolve().parent.parent
CELLS = ROOT / "models" / "cells"
ROBOT = str(ROOT / "models" / "robots" / "puma560" / "robot.yaml")
TABLE = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}


def box(size, xyz, yaw=0.0, **more):
    return {"box": size, "pose": {"xyz": xyz, "rpy": [0, 0, yaw]}, **more}


def goal(part, xyz, yaw=0.0):  # a list of its own: YAML has no anchors here
    return {"place": part, "at": {"xyz": list(xyz), "rpy": [0, 0, yaw]}}


def write(folder: Path, parts: dict, task: list, fixtures: dict | None = None, **more) -> Path:
    content = {
        "handey_cell": 1,
        "name": "order",
        "robot": {"file": ROBOT},
        "fixtures": {"table": TABLE, **(fixtures or {})},
        "parts": parts,
        "task": task,
        **more,
    }
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(content, sort_keys=False))
    return path


def planned(path: Path, folder: Path | None = None, **options):
    """The plan of a cell, checked; and the parts in the order in which they are carried."""
    result = handey.plan(handey.load_cell(path), PlanOptions(**options))
    assert result.plan is not None, "\n".join(result.report.reasons)
    out = (folder or path.parent) / "plan.json"
    result.plan.save(out)
    report = handey.check(path, out)
    assert report.ok, str(report)
    return result, [step.part for step in result.plan.steps if step.action == "depart"]


STACK = {
    "a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02]),
    "b": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.06]),
    "c": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.10]),
}


def test_a_stack_is_turned_over_on_its_spot_and_a_block_taken_out_from_under_another(
    tmp_path,
) -> None:
    result, carried = planned(CELLS / "restack.yaml", tmp_path)
    # On the same spot, all of the stack must be put aside before the first goal can be reached.
    stack = [part for part in carried if part in ("alpha", "beta", "gamma")]
    assert stack == ["gamma", "beta", "alpha", "gamma", "beta", "alpha"]
    assert carried.index("upper") < carried.index("lower")
    assert result.report.goals[2].aside == ["gamma", "beta", "alpha"]
    assert result.report.goals[3].aside == ["upper"]


@pytest.mark.parametrize("order", ["given", "any"])
def test_a_stack_built_anew_beside_needs_no_place_on_the_way(tmp_path, order) -> None:
    places = [goal(part, [0.5, -0.15, 0.02 + 0.04 * i]) for i, part in enumerate("cba")]
    task = places if order == "given" else places[::-1]
    _, carried = planned(write(tmp_path, STACK, task, order=order))
    assert carried == ["c", "b", "a"]


def test_in_the_order_given_what_stands_on_a_part_is_not_moved_without_leave(tmp_path) -> None:
    path = write(tmp_path, STACK, [goal("a", [0.5, -0.15, 0.02])])
    result = handey.plan(handey.load_cell(path))
    assert result.plan is None
    assert "b would fall" in "\n".join(result.report.reasons)


def test_what_may_move_is_put_aside_from_the_top_down(tmp_path) -> None:
    parts = {name: {**part, "may_move": name != "a"} for name, part in STACK.items()}
    _, carried = planned(write(tmp_path, parts, [goal("a", [0.5, -0.15, 0.02])]))
    assert carried == ["c", "b", "a"]


def test_two_parts_change_places_over_a_third_place(tmp_path) -> None:
    parts = {
        "a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02]),
        "b": box([0.05, 0.06, 0.04], [0.48, -0.15, 0.02]),
    }
    task = [goal("a", [0.48, -0.15, 0.02]), goal("b", [0.48, 0.15, 0.02])]
    _, carried = planned(write(tmp_path, parts, task, order="any"))
    assert carried in (["b", "a", "b"], ["a", "b", "a"])


def test_two_parts_change_places_and_one_is_turned_upside_down(tmp_path) -> None:
    parts = {
        "a": box([0.04, 0.05, 0.06], [0.5, 0.15, 0.03]),
        "b": box([0.04, 0.05, 0.06], [0.5, -0.15, 0.03]),
    }
    task = [goal("a", [0.5, -0.15, 0.03]), goal("b", [0.5, 0.15, 0.025])]
    task[0]["at"]["rpy"] = [np.pi, 0.0, 0.0]
    task[1]["at"]["rpy"] = [np.pi / 2, 0.0, 0.0]
    result, carried = planned(write(tmp_path, parts, task, order="any"))
    assert result.report.regrasps >= 1
    assert len(carried) == 3 + result.report.regrasps


def test_a_part_where_another_is_to_go_goes_first(tmp_path) -> None:
    parts = {
        "a": box([0.05, 0.06, 0.04], [0.48, 0.25, 0.02]),
        "b": box([0.05, 0.06, 0.04], [0.48, 0.0, 0.02]),
        "c": box([0.05, 0.06, 0.04], [0.48, -0.25, 0.02]),
    }
    # A ring with a gap: a where b is, b where c is, c to a free place.
    task = [goal("a", [0.48, 0, 0.02]), goal("b", [0.48, -0.25, 0.02]), goal("c", [0.62, 0, 0.02])]
    _, carried = planned(write(tmp_path, parts, task, order="any"))
    assert carried == ["c", "b", "a"]


def between(may_move: bool) -> tuple[dict, dict]:
    """A part between two walls and two blocks, all too near for a finger; parts and fixtures."""
    parts = {
        "left": box([0.04, 0.04, 0.06], [0.5, 0.045, 0.03], may_move=may_move),
        "right": box([0.04, 0.04, 0.06], [0.5, -0.045, 0.03], may_move=may_move),
        "part": box([0.04, 0.04, 0.04], [0.5, 0.0, 0.02]),
    }
    walls = {
        f"wall{i}": box([0.01, 0.036, 0.05], [0.5 + s * 0.028, 0, 0.025])
        for i, s in enumerate((-1, 1))
    }
    return parts, walls


def test_parts_that_leave_the_fingers_no_room_are_put_aside(tmp_path) -> None:
    task = [goal("part", [0.6, -0.25, 0.02])]
    parts, walls = between(may_move=True)
    result, carried = planned(write(tmp_path, parts, task, walls))
    assert sorted(carried) == ["left", "part", "right"] and carried[-1] == "part"
    parts, walls = between(may_move=False)
    result = handey.plan(handey.load_cell(write(tmp_path, parts, task, walls)))
    assert result.plan is None and result.report.goals[0].status == "failed"


def test_a_part_at_its_goal_may_be_put_aside_and_brought_back(tmp_path) -> None:
    parts, walls = between(may_move=False)
    task = [goal(name, part["pose"]["xyz"]) for name, part in parts.items()]
    task[2] = goal("part", [0.6, -0.25, 0.02])
    result, carried = planned(write(tmp_path, parts, task, walls, order="any"))
    # One side is enough for the fingers of neither: both are put aside and come back.
    assert carried[2] == "part" and sorted(carried) == ["left", "left", "part", "right", "right"]
    assert [goal.status for goal in result.report.goals] == ["planned"] * 3


def test_an_order_that_leads_nowhere_is_given_up_for_another(tmp_path) -> None:
    # The goals say the two blocks first; then no finger gets to where the part is to go.
    parts, walls = between(may_move=False)
    task = [goal(name, part["pose"]["xyz"]) for name, part in parts.items()]
    for i, part in enumerate(parts.values()):
        part["pose"]["xyz"] = [0.45, 0.2 + 0.12 * i, part["pose"]["xyz"][2]]
    _, carried = planned(write(tmp_path, parts, task, walls, order="any"))
    assert carried == ["part", "left", "right"]
    result = handey.plan(handey.load_cell(write(tmp_path, parts, task, walls)))
    assert result.plan is None
    assert [goal.status for goal in result.report.goals] == ["planned", "planned", "failed"]


def test_a_goal_that_no_order_reaches_ends_the_search_soon(tmp_path) -> None:
    parts = {f"p{i}": box([0.05, 0.06, 0.04], [0.45, -0.2 + 0.1 * i, 0.02]) for i in range(5)}
    task = [goal(name, [0.6, -0.2 + 0.1 * i, 0.02]) for i, name in enumerate(parts)]
    task[2] = goal("p2", [1.25, 0.6, 0.02])
    calls = []
    plan_goal = planner._plan_goal

    def counted(*arguments):
        calls.append(arguments)
        return plan_goal(*arguments)

    planner._plan_goal = counted
    try:
        path = write(tmp_path, parts, task, order="any")
        result = handey.plan(path, PlanOptions(advice=False))
    finally:
        planner._plan_goal = plan_goal
    assert result.plan is None
    assert any("goal 2 (p2" in reason for reason in result.report.reasons)
    assert len(calls) <= 20


def test_a_lid_that_may_move_is_taken_off_a_box(tmp_path) -> None:
    wall, floor = 0.008, 0.004
    outer = [0.10, 0.11, 0.06]
    walls = {
        "pose": {"xyz": [0.48, 0.15, 0]},
        "shapes": [
            {"box": [outer[0], outer[1], floor], "pose": {"xyz": [0, 0, floor / 2]}},
            *(
                {"box": [wall, outer[1], outer[2]], "pose": {"xyz": [s * 0.046, 0, 0.03]}}
                for s in (-1, 1)
            ),
            *(
                {"box": [outer[0], wall, outer[2]], "pose": {"xyz": [0, s * 0.051, 0.03]}}
                for s in (-1, 1)
            ),
        ],
    }
    parts = {
        "part": box([0.03, 0.03, 0.05], [0.48, 0.15, 0.029]),
        "lid": {
            "pose": {"xyz": [0.48, 0.15, 0.06]},
            "shapes": [
                {"box": [0.10, 0.11, 0.01], "pose": {"xyz": [0, 0, 0.005]}},
                {"box": [0.02, 0.04, 0.03], "pose": {"xyz": [0, 0, 0.025]}},
            ],
            "may_move": True,
        },
    }
    path = write(tmp_path, parts, [goal("part", [0.6, -0.2, 0.025])], {"crate": walls})
    result, carried = planned(path)
    assert carried == ["lid", "part"]
    assert result.report.goals[0].aside == ["lid"]


def test_a_later_goal_that_is_impossible_is_named_and_nothing_is_planned(tmp_path) -> None:
    parts = {
        "a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02]),
        "b": box([0.05, 0.06, 0.04], [0.48, -0.15, 0.02]),
    }
    task = [goal("a", [0.6, 0.15, 0.02]), goal("b", [1.2, 0.6, 0.02])]
    for order in ("given", "any"):
        result = handey.plan(handey.load_cell(write(tmp_path, parts, task, order=order)))
        assert result.plan is None
        assert result.report.verdict == "infeasible"
        assert result.report.goals[0].status == "not tried"
        assert result.report.goals[1].status == "failed"
        assert any("goal 1 (b" in reason for reason in result.report.reasons)


def test_goals_met_at_the_start_cost_no_step(tmp_path) -> None:
    parts = {"a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02])}
    for met in ({"on": "table"}, {"on": "table", "resting": "same"}):
        result, carried = planned(write(tmp_path, parts, [{"place": "a", **met}]))
        assert carried == [] and result.report.goals[0].status == "met already"


def test_a_part_with_two_goals_reaches_them_one_after_the_other(tmp_path) -> None:
    parts = {"a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02])}
    task = [goal("a", [0.6, 0.15, 0.02]), goal("a", [0.6, -0.15, 0.02])]
    for order in ("given", "any"):
        result, carried = planned(write(tmp_path, parts, task, order=order))
        assert carried == ["a", "a"]
        assert np.allclose(result.plan.placements["a"][:3, 3], [0.6, -0.15, 0.02])


def test_a_task_may_have_many_goals(tmp_path) -> None:
    parts = {"a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02])}
    task = [goal("a", [0.5, (-1) ** i * 0.1, 0.02]) for i in range(90)]
    for order in ("given", "any"):
        result = handey.plan(handey.load_cell(write(tmp_path, parts, task, order=order)))
        assert result.plan is not None, "\n".join(result.report.reasons)
        assert sum(step.action == "grasp" for step in result.plan.steps) == 90


def test_the_order_found_is_the_same_each_time() -> None:
    cell_file = handey.load_cell(CELLS / "restack.yaml")
    once, again = (handey.plan(cell_file).plan for _ in range(2))
    assert once is not None and again is not None
    for a, b in zip(once.steps, again.steps, strict=True):
        assert a.action == b.action and np.array_equal(a.positions, b.positions)


# What load_cell refuses.


def test_a_goal_where_a_part_stands_that_may_move_is_no_bad_input(tmp_path) -> None:
    parts = {
        "a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02]),
        "b": box([0.05, 0.06, 0.04], [0.48, -0.15, 0.02]),
    }
    task = [goal("a", [0.48, -0.15, 0.02])]
    with pytest.raises(handey.InvalidInput, match="overlaps 'b'"):
        handey.load_cell(write(tmp_path, parts, task))
    parts["b"]["may_move"] = True
    _, carried = planned(write(tmp_path, parts, task))
    assert carried == ["b", "a"]


def test_with_any_order_a_first_goal_may_be_where_another_part_ends(tmp_path) -> None:
    parts = {
        "a": box([0.05, 0.06, 0.04], [0.48, 0.15, 0.02]),
        "b": box([0.05, 0.06, 0.04], [0.48, -0.15, 0.02]),
    }
    task = [
        goal("a", [0.6, 0, 0.02]),
        goal("a", [0.6, 0.2, 0.02]),
        goal("b", [0.6, 0, 0.02]),
    ]
    _, carried = planned(write(tmp_path, parts, task, order="any"))
    assert carried == ["a", "a", "b"]
    # But two parts may not end in each other.
    task[1] = goal("a", [0.61, 0, 0.02])
    with pytest.raises(handey.InvalidInput, match="overlaps"):
        handey.load_cell(write(tmp_path, parts, task, order="any"))


# Random rearrangements.


def random_cell(folder: Path, seed: int) -> Path:
    """Blocks on a small table: each to the place of another, or to a free one."""
    random = np.random.default_rng(seed)
    spots = [(x, y) for x in (0.40, 0.52, 0.64) for y in (-0.22, -0.07, 0.08, 0.23)]
    random.shuffle(spots)
    count = int(random.integers(3, 6))
    parts, task = {}, []
    for i in range(count):
        size = [0.04, 0.05, float(random.choice([0.03, 0.05]))]
        name, height = f"p{i}", size[2] / 2
        (x, y), (u, v) = spots[i], spots[(i + int(random.integers(1, 3))) % count]
        used = [entry["at"]["xyz"][:2] for entry in task]
        if [u, v] in used:
            u, v = spots[count + i]
        parts[name] = box(size, [x, y, height], float(random.uniform(0, np.pi)))
        task.append(goal(name, [u, v, height], float(random.uniform(0, np.pi))))
    return write(folder, parts, task, order="any")


@pytest.mark.parametrize("seed", range(6))
def test_random_rearrangements_are_planned_and_valid(tmp_path, seed) -> None:
    result, carried = planned(random_cell(tmp_path, seed))
    assert result.report.verdict == "plan"
    # No part is carried more often than once aside and once to its goal.
    assert all(carried.count(part) <= 2 for part in set(carried))


def cycles(order: list[int]) -> int:
    """Of a permutation, those of two and more."""
    seen: set[int] = set()
    count = 0
    for start in range(len(order)):
        length, at = 0, start
        while at not in seen:
            seen.add(at)
            at, length = order[at], length + 1
        count += length > 1
    return count


@pytest.mark.parametrize("seed", range(4))
def test_a_permutation_takes_one_place_aside_for_each_cycle(tmp_path, seed) -> None:
    spots = [(x, y, 0.02) for x in (0.42, 0.58) for y in (-0.2, 0.0, 0.2)][: 4 + seed % 2]
    order = [int(i) for i in np.random.default_rng(seed).permutation(len(spots))]
    parts = {f"p{i}": box([0.04, 0.05, 0.04], list(spot)) for i, spot in enumerate(spots)}
    task = [goal(f"p{i}", spots[to]) for i, to in enumerate(order)]
    _, carried = planned(write(tmp_path, parts, task, order="any"))
    moved = sum(i != to for i, to in enumerate(order))
    assert len(carried) == moved + cycles(order)


def test_the_plan_of_a_goal_in_a_tray_stands_within_its_walls(tmp_path) -> None:
    path = CELLS / "on_table.yaml"
    result, carried = planned(path, tmp_path)
    assert carried == ["bracket", "block"]
    cell = handey.load_cell(path).cell
    model = _core.make_collision_model(cell)
    for name, X_WP in result.plan.placements.items():
        there = cell.with_part_at(cell.part_index(name), X_WP)
        assert _core.find_overlaps(model, there, 1e-5) == []
