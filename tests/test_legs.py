"""The gross motions of a plan and the world in which each takes place."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import handey
from handey import _core
from handey.errors import InvalidInput
from handey.slices.legs import legs_of, standing

CELLS = Path(__file__).resolve().parent.parent / "models/cells"


@pytest.fixture(scope="module")
def planned() -> tuple[handey.CellFile, handey.Plan]:
    cell_file = handey.load_cell(CELLS / "two_goals.yaml")
    plan = handey.plan(cell_file).plan
    assert plan is not None
    return cell_file, plan


def test_each_gross_motion_is_free_in_its_world(
    planned: tuple[handey.CellFile, handey.Plan],
) -> None:
    cell_file, plan = planned
    legs = legs_of(cell_file, plan)
    gross = [i for i, step in enumerate(plan.steps) if step.action in ("transit", "transfer")]
    assert [leg.step for leg in legs] == gross and len(gross) >= 4
    for leg in legs:
        step = plan.steps[leg.step]
        assert leg.action == step.action and leg.held == (step.part or "")
        assert step.opening.min() <= leg.opening <= step.opening.max()
        checker = _core.CollisionChecker(_core.make_collision_model(leg.cell), leg.cell)
        for q, opening in zip(leg.positions, step.opening, strict=True):
            assert checker.is_free(_core.Configuration(q=q, opening=opening))


def test_what_was_put_down_stands_where_the_plan_says(
    planned: tuple[handey.CellFile, handey.Plan],
) -> None:
    cell_file, plan = planned
    last = legs_of(cell_file, plan)[-1].cell
    assert len(plan.placements) == 2 and last.held is None
    for name, X_WP in plan.placements.items():
        before = cell_file.cell.parts[cell_file.cell.part_index(name)].X_WB
        after = last.parts[last.part_index(name)].X_WB
        assert np.allclose(after, X_WP, atol=1e-4) and not np.allclose(after, before, atol=1e-3)


def test_a_plan_of_another_cell_is_refused_with_all_faults(
    planned: tuple[handey.CellFile, handey.Plan],
) -> None:
    cell_file, plan = planned
    steps = tuple(replace(s, part=s.part and "ghost") for s in plan.steps)
    other = replace(plan, joints=tuple("abcdef"), steps=steps)
    with pytest.raises(InvalidInput) as caught:
        legs_of(cell_file, other, "p.json")
    faults = caught.value.faults
    assert {fault.code for fault in faults} == {"E_REF"} and {f.file for f in faults} == {"p.json"}
    assert faults[0].place == "joints" and "no part 'ghost'" in faults[1].message
    held = [i for i, step in enumerate(plan.steps) if step.part is not None]
    assert [fault.place for fault in faults[1:]] == [f"steps[{i}].part" for i in held]


def test_a_task_without_motion_leaves_the_robot_at_its_start(
    planned: tuple[handey.CellFile, handey.Plan],
) -> None:
    cell_file, plan = planned
    assert legs_of(cell_file, replace(plan, steps=())) == []
    leg = standing(cell_file)
    assert leg.step == -1 and leg.held == ""
    assert leg.positions.tolist() == [cell_file.cell.start.q.tolist()]
