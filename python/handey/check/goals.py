"""The clause goal: each is reached in its turn, and holds in the end but for later goals."""

from __future__ import annotations

import math

import numpy as np

from handey.check.carries import NEAR, NEAR_ANGLE, Carry, World, pose_error
from handey.check.cell import Cell, Goal
from handey.check.plan_data import PlanData
from handey.check.report import CheckReport
from handey.check.shapes import transformed
from handey.check.standing import Ground, standing_on
from handey.check.values import Array
from handey.check.walls import walls_fault

__all__ = ["check_goals", "goal_fault", "grounds_for"]

SAME_FACE = math.radians(1.0)  # resting: same. Choice: the tolerance of faces elsewhere


def grounds_for(cell: Cell, name: str, places: dict[str, Array]) -> list[Ground]:
    """All that a part could stand on."""
    bodies = [(body, body.pose) for body in cell.fixtures]
    bodies += [
        (body, places[body.name])
        for body in cell.parts
        if body.name != name and body.name in places
    ]
    return [
        Ground(
            body.name,
            transformed(place, body.triangles().reshape(-1, 3)).reshape(-1, 3, 3),
            body.support,
        )
        for body, place in bodies
    ]


def check_goals(
    plan: PlanData, cell: Cell, carries: list[Carry], world: World, report: CheckReport
) -> None:
    """Each goal of the task, in its turn and in the end."""
    order = list(range(len(cell.task)))
    served = list(dict.fromkeys(step.goal for step in plan.steps))
    # A goal changes between two turns of the loop only.
    changes = [
        step for step, old in zip(plan.steps[1:], plan.steps, strict=False) if step.goal != old.goal
    ]
    if len(changes) != max(len(served) - 1, 0):
        step = changes[-1]
        report.add(
            "goal",
            f"goal {step.goal} is taken up twice",
            step.index,
            float(step.time[0]),
            step.action,
        )
    for old, step in zip(plan.steps, plan.steps[1:], strict=False):
        if step.goal != old.goal and step.action not in ("transit", "approach"):
            change = f"serves goal {step.goal}, but the {old.action} before it goal {old.goal}"
            report.add("goal", change, step.index, float(step.time[0]), step.action)
    if cell.given_order and served != sorted(served):
        report.add("goal", f"goals are served in the order {served}; the cell gives the order")
    if not cell.given_order:
        order = served + [goal for goal in order if goal not in served]
    places = {part.name: part.pose for part in cell.parts}
    start = dict(places)
    reported = set()
    for g in order:
        for carry in carries:
            if carry.goal == g:
                places[carry.part] = carry.put
        text = goal_fault(cell, cell.task[g], places, start)
        if text:
            reported.add(g)
            mine = [step for step in plan.steps if step.goal == g]
            last = mine[-1] if mine else None
            report.add(
                "goal", f"goal {g} ({cell.task[g].part}) is not reached: {text}",
                last.index if last else None, float(last.time[-1]) if last else None,
                last.action if last else "",
            )  # fmt: skip
    for n, g in enumerate(order):
        later = {cell.task[h].part for h in order[n + 1 :]}
        if cell.task[g].part not in later and g not in reported:
            text = goal_fault(cell, cell.task[g], world.end, start)
            if text:
                report.add(
                    "goal", f"goal {g} ({cell.task[g].part}) does not hold in the end: {text}"
                )


def goal_fault(
    cell: Cell, goal: Goal, places: dict[str, Array], start: dict[str, Array]
) -> str | None:
    """Why a goal is not met with the parts at `places`, or None."""
    here = places[goal.part]
    if goal.at is not None:
        distance, angle = pose_error(here, goal.at)
        if distance <= NEAR and angle <= NEAR_ANGLE:
            return None
        return f"off by {distance * 1e3:.3f} mm, {angle:.5f} rad (0.1 mm, 0.001 rad are allowed)"
    part = next(part for part in cell.parts if part.name == goal.part)
    target = goal.on or goal.inside
    triangles = transformed(here, part.triangles().reshape(-1, 3)).reshape(-1, 3, 3)
    grounds = grounds_for(cell, goal.part, places)
    if goal.on is not None:
        grounds = [ground for ground in grounds if ground.name == goal.on]
    standing = standing_on(
        triangles, transformed(here, part.centre_of_mass()), grounds, goal.on is not None
    )
    text = standing.fault()
    if text:
        return text
    if target not in standing.grounds:
        return f"does not stand on {target}"
    if goal.region is not None:
        low, high = goal.region.min(axis=0) - NEAR, goal.region.max(axis=0) + NEAR
        if (standing.hull < low).any() or (standing.hull > high).any():
            return "what it stands on lies outside the region"
    if goal.same_rest:
        turn = (
            here[:3, :3].T @ np.array([0, 0, 1.0]),
            start[goal.part][:3, :3].T @ np.array([0, 0, 1.0]),
        )
        angle = math.acos(float(np.clip(turn[0] @ turn[1], -1, 1)))
        if angle > SAME_FACE:
            return f"stands on another face: turned over by {angle:.4f} rad"
    if goal.inside is not None:
        body = next(body for body in cell.fixtures if body.name == goal.inside)
        walls = transformed(body.pose, body.triangles().reshape(-1, 3)).reshape(-1, 3, 3)
        return walls_fault(goal.inside, walls, triangles, standing.hull)
    return None
