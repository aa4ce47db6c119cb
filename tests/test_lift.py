"""Parts among obstacles where no single straight lift leads out, and parts that fit too closely."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import handey
from handey import _core
from handey.motion.carry import DirectOptions
from handey.motion.lift import Lift, WaysOut, lift
from handey.motion.way_out import WayOutOptions, way_out

ROBOT = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560" / "robot.yaml"
TABLE = "table: {box: [1.6, 1.4, 0.05], pose: {xyz: [0.55, 0, -0.025]}}"
STAND = "stand: {box: [0.10, 0.12, 0.30], pose: {xyz: [0.50, 0.0, 0.15]}}"


def load(folder: Path, *fixtures: str, part: str, goal: str) -> handey.CellFile:
    lines = ["handey_cell: 1", "name: lift", f"robot: {{file: {ROBOT}}}", "fixtures:"]
    lines += [f"  {each}" for each in (TABLE, *fixtures)]
    lines += ["parts:", f"  block: {part}", "task:", f"  - {{place: block, at: {goal}}}"]
    path = folder / "cell.yaml"
    path.write_text("\n".join(lines) + "\n")
    return handey.load_cell(path)


def under_a_roof(folder: Path, gap: float) -> handey.CellFile:
    """A tall block on a stand under a plate that is held from behind."""
    under = 0.38 + gap
    return load(
        folder,
        STAND,
        f"roof: {{box: [0.07, 0.06, 0.01], pose: {{xyz: [0.505, 0, {under + 0.005}]}}}}",
        "post: {box: [0.02, 0.06, 0.20], pose: {xyz: [0.55, 0, 0.40]}}",
        part="{box: [0.03, 0.04, 0.08], pose: {xyz: [0.485, 0, 0.34]}}",
        goal="{xyz: [0.45, -0.35, 0.04]}",
    )


def test_a_part_under_a_low_roof_is_raised_a_little_and_drawn_out(tmp_path: Path) -> None:
    cell = under_a_roof(tmp_path, gap=0.006)
    straight_only = _core.DepartureOptions(most_slides=0, search_levels=0)
    result = handey.plan(cell, handey.PlanOptions(direct=DirectOptions(roomier=straight_only)))
    assert result.plan is not None, result.report.reasons
    departs = [m for m in result.plan.report["local_motions"] if m["action"] == "depart"]
    assert [motion["planner"] for motion in departs] == ["two straights"]
    out = tmp_path / "plan.json"
    result.plan.save(out)
    checked = handey.check(tmp_path / "cell.yaml", out)
    assert checked.ok, checked.faults


def test_a_part_that_fits_exactly_is_refused_with_the_plain_reason(tmp_path: Path) -> None:
    cell = load(
        tmp_path,
        "left: {box: [0.2, 0.02, 0.02], pose: {xyz: [0.5, 0.24, 0.01]}}",
        "right: {box: [0.2, 0.02, 0.02], pose: {xyz: [0.5, 0.16, 0.01]}}",
        part="{box: [0.04, 0.06, 0.03], pose: {xyz: [0.5, 0.2, 0.015]}}",
        goal="{xyz: [0.45, -0.25, 0.015]}",
    )
    reasons = " ".join(" ".join(handey.plan(cell).report.reasons).split())  # lines are broken
    assert "still touches" in reasons and "fits too closely to be moved out" in reasons


POCKET = (
    "near_{0}: {{box: [0.10, 0.01, 0.04], pose: {{xyz: [0.5, {1}, 0.02]}}}}",
    "far_{0}: {{box: [0.10, 0.01, 0.085], pose: {{xyz: [0.5, {2}, 0.0425]}}}}",
    "ledge_{0}: {{box: [0.10, 0.03, 0.02], pose: {{xyz: [0.5, {3}, 0.075]}}}}",
    "left_{0}: {{box: [0.02, 0.10, 0.05], pose: {{xyz: [0.446, {4}, 0.025]}}}}",
    "right_{0}: {{box: [0.02, 0.10, 0.05], pose: {{xyz: [0.554, {4}, 0.025]}}}}",
)


def pocket(name: str, y: float) -> list[str]:
    """Room for a block of 120 mm: to leave, up 13 mm, 11 to 15 mm from under the ledge, up."""
    return [line.format(name, y - 0.081, y + 0.075, y + 0.065, y) for line in POCKET]


def planners(result: handey.PlanResult, action: str) -> list[str]:
    return [m.planner for m in result.report.local_motions if m.action == action]


@pytest.mark.parametrize("most_slides", [3, 0])
def test_a_part_leaves_a_pocket_in_the_grasp_plane_and_enters_another(
    tmp_path: Path, most_slides: int
) -> None:
    cell = load(
        tmp_path,
        *pocket("from", 0.25),
        *pocket("to", -0.25),
        part="{box: [0.04, 0.12, 0.05], pose: {xyz: [0.5, 0.25, 0.025]}}",
        goal="{xyz: [0.5, -0.25, 0.025]}",
    )
    departure = _core.DepartureOptions(most_slides=most_slides)
    options = handey.PlanOptions(direct=DirectOptions(departure=departure))
    result = handey.plan(cell, options)
    assert result.plan is not None, result.report.reasons
    given = planners(result, "depart") + planners(result, "deposit")
    assert set(given) <= {"quasipotential", "plane search"}
    if most_slides == 0:
        assert given == ["plane search", "plane search"]
    out = tmp_path / "plan.json"
    result.plan.save(out)
    checked = handey.check(tmp_path / "cell.yaml", out)
    assert checked.ok, checked.faults


@pytest.mark.parametrize("depth", [0.0012, 0.02])
def test_a_part_leaves_a_close_pocket_only_if_it_is_as_shallow_as_contact_lasts(
    tmp_path: Path, depth: float
) -> None:
    """Two walls that it touches on opposite sides: it slides up between them, in contact."""
    z = depth / 2
    cell = load(
        tmp_path,
        f"left: {{box: [0.2, 0.02, {depth}], pose: {{xyz: [0.5, 0.24, {z}]}}}}",
        f"right: {{box: [0.2, 0.02, {depth}], pose: {{xyz: [0.5, 0.16, {z}]}}}}",
        part="{box: [0.04, 0.06, 0.05], pose: {xyz: [0.5, 0.2, 0.025]}}",
        goal="{xyz: [0.45, -0.25, 0.025]}",
    )
    result = handey.plan(cell)
    assert (result.plan is not None) == (depth < 0.0015), result.report.reasons
    if result.plan is not None:
        out = tmp_path / "plan.json"
        result.plan.save(out)
        checked = handey.check(tmp_path / "cell.yaml", out)
        assert checked.ok, checked.faults


def test_the_arm_is_sampled_only_where_nothing_straight_leads_out(tmp_path: Path) -> None:
    loaded = under_a_roof(tmp_path, gap=0.006)
    cell, plan = loaded.cell, handey.plan(loaded).plan
    assert plan is not None
    depart = next(step for step in plan.steps if step.action == "depart")
    X_HP = depart.part_in_grasp_frame
    assert X_HP is not None
    start = _core.Configuration(q=depart.positions[0], opening=depart.opening[0])
    model = _core.make_collision_model(cell)
    solver = _core.SphericalWristSolver(cell.robot)
    asked: list[_core.Configuration] = []
    on = _core.Configuration(q=depart.positions[-1], opening=start.opening)

    def sample(
        checker: _core.CollisionChecker, stop: _core.Configuration
    ) -> list[_core.Configuration]:
        assert checker.cell.held is not None and checker.is_free(stop)
        asked.append(stop)
        return [stop, on] if len(asked) == 1 else []

    def leave(straight: _core.RetreatOptions) -> Lift:
        none = _core.DepartureOptions(most_slides=0, search_levels=0)
        return lift(model, solver, cell, 0, start, X_HP, WaysOut(straight, none, none, sample))

    usual = leave(_core.RetreatOptions())
    assert usual and usual.planner == "two straights" and not asked
    beyond_reach = _core.RetreatOptions(least=0.9, most=1.0, step=0.05)
    sampled = leave(beyond_reach)
    assert sampled.planner == "RRT-Connect" and len(asked) == 1
    assert np.array_equal(sampled.path[0].q, start.q) and np.array_equal(sampled.path[-1].q, on.q)
    none = leave(beyond_reach)
    assert not none and len(asked) == 2 and "900.0 mm are needed" in none.reason


def test_the_way_out_of_a_pocket_is_found_by_the_whole_arm(tmp_path: Path) -> None:
    loaded = under_a_roof(tmp_path, gap=0.006)
    cell, plan = loaded.cell, handey.plan(loaded).plan
    assert plan is not None
    depart = next(step for step in plan.steps if step.action == "depart")
    assert depart.part_in_grasp_frame is not None
    model = _core.make_collision_model(cell)
    held = cell.with_held(0, depart.part_in_grasp_frame)
    checker = _core.CollisionChecker(model, held)
    solver = _core.SphericalWristSolver(cell.robot)
    row = next(i for i, q in enumerate(depart.positions) if checker.is_free(
        _core.Configuration(q=q, opening=depart.opening[i])))  # fmt: skip
    start = _core.Configuration(q=depart.positions[row], opening=depart.opening[row])
    way = way_out(solver, checker, start, WayOutOptions())
    assert way and np.array_equal(way[0].q, start.q)
    assert _core.certify_path(checker, way).is_free
    moved = _core.hand_in_world(cell, way[-1].q)[:3, 3] - _core.hand_in_world(cell, start.q)[:3, 3]
    assert np.linalg.norm(moved) > 0.04
    assert len(way_out(solver, checker, start, WayOutOptions())) == len(way)
