"""The clauses about how parts are handled: pads, jump, stability, support, moved, placements."""

from __future__ import annotations

from handey.check.carries import NEAR, NEAR_ANGLE, Carry, World, pose_error
from handey.check.cell import Body, Cell
from handey.check.goals import grounds_for
from handey.check.pads import pad_fault
from handey.check.plan_data import HELD, PlanData
from handey.check.report import CheckReport
from handey.check.shapes import transformed
from handey.check.standing import standing_on

__all__ = ["check_handling"]


def check_handling(
    plan: PlanData, cell: Cell, carries: list[Carry], world: World, report: CheckReport
) -> None:
    """Pads, jumps, stability, supports, which parts move, placements."""
    parts = {part.name: part for part in cell.parts}
    allowed = {goal.part for goal in cell.task} | {
        part.name for part in cell.parts if part.may_move
    }
    for n, carry in enumerate(carries):
        step, part = plan.steps[carry.first], parts[carry.part]
        at = (step.index, float(step.time[0]), step.action)
        if carry.part not in allowed:
            report.add("moved", f"{carry.part} has no goal and may not be moved", *at)
        distance, angle = pose_error(carry.origin, carry.taken)
        if distance > NEAR or angle > NEAR_ANGLE:
            off = f"{distance * 1e3:.3f} mm, {angle:.5f} rad"
            text = f"{carry.part} is taken {off} from where it stands"
            report.add("jump", text, *at)
        _pads(plan, cell, part, carry, report)
        _rest(plan, cell, world, carries, n, report)
        _others_stand(plan, cell, world, carry, report)
    _placements(plan, carries, world, report)


def _pads(plan: PlanData, cell: Cell, part: Body, carry: Carry, report: CheckReport) -> None:
    triangles = transformed(carry.X_HP, part.triangles().reshape(-1, 3)).reshape(-1, 3, 3)
    before: float | None = None
    for step in plan.steps[max(carry.first - 1, 0) : carry.last + 1]:
        rows = [len(step.opening) - 1]
        if step.action in HELD:
            rows = [int(step.opening.argmin()), int(step.opening.argmax())]
        for row in rows:
            opening = float(step.opening[row])
            if before is not None and abs(opening - before) < 1e-9:
                continue
            before = opening
            text = pad_fault(triangles, opening, cell.robot.pad, part.friction)
            if text:
                report.add(
                    "pads", f"{part.name}: {text}", step.index, float(step.time[row]), step.action
                )
                return


def _rest(
    plan: PlanData, cell: Cell, world: World, carries: list[Carry], n: int, report: CheckReport
) -> None:
    carry = carries[n]
    part = next(part for part in cell.parts if part.name == carry.part)
    step = plan.steps[min(carry.last + 1, len(plan.steps) - 1)]
    at = (step.index, float(step.time[-1]), step.action)
    triangles = transformed(carry.put, part.triangles().reshape(-1, 3)).reshape(-1, 3, 3)
    centre = transformed(carry.put, part.centre_of_mass())
    grounds = grounds_for(cell, part.name, world.standing[carry.last])
    text = standing_on(triangles, centre, grounds).fault()
    if text:
        report.add("stability", f"{part.name} {text}", *at)
    later = [c for c in carries[n + 1 :] if c.part == carry.part]
    final = (
        not (later and later[0].goal == carry.goal)
        and cell.task
        and cell.task[carry.goal].part == part.name
    )
    distance, angle = pose_error(carry.put, part.pose)
    if not text and not final and (distance > NEAR or angle > NEAR_ANGLE):
        supports = [ground for ground in grounds if ground.support]
        text = standing_on(triangles, centre, supports, horizontal=True).fault()
        if text:
            report.add(
                "support", f"{part.name}, put down on the way: on supports alone it {text}", *at
            )


def _others_stand(
    plan: PlanData, cell: Cell, world: World, carry: Carry, report: CheckReport
) -> None:
    """Nothing else moves: what stood on the part must not fall when it is taken away."""
    without = world.standing[carry.first]
    step = plan.steps[carry.first]
    for other in (part for part in cell.parts if part.name in without):
        X = without[other.name]
        triangles = transformed(X, other.triangles().reshape(-1, 3)).reshape(-1, 3, 3)
        centre = transformed(X, other.centre_of_mass())
        before = grounds_for(cell, other.name, {**without, carry.part: carry.origin})
        with_it = standing_on(triangles, centre, before)
        if carry.part not in with_it.grounds or with_it.fault():
            continue
        after = [ground for ground in before if ground.name != carry.part]
        text = standing_on(triangles, centre, after).fault()
        if text:
            text = f"without {carry.part}, {other.name} {text}"
            report.add("stability", text, step.index, float(step.time[0]), step.action)


def _placements(plan: PlanData, carries: list[Carry], world: World, report: CheckReport) -> None:
    moved = {carry.part for carry in carries}
    for name in sorted(moved - set(plan.placements)):
        report.add("placements", f"{name} was moved, but has no placement")
    for name in sorted(set(plan.placements) - moved):
        report.add("placements", f"{name} has a placement, but was not moved")
    for name in sorted(moved & set(plan.placements)):
        distance, angle = pose_error(plan.placements[name], world.end[name])
        if distance > NEAR or angle > NEAR_ANGLE:
            text = f"{name} stands {distance * 1e3:.3f} mm, {angle:.5f} rad from its placement"
            report.add("placements", text)
