"""The clauses about parts: what is carried from where to where, on what it stands, which goals are reached.

A carry is a run of steps that hold one part. Before the first and after the last of them the part stands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from handey.check.cell import Body, Cell, Goal
from handey.check.contacts import Ground, pad_fault, standing_on, unit_normals
from handey.check.kinematics import forward
from handey.check.plan_data import HELD, PlanData, Step
from handey.check.report import CheckReport
from handey.check.shapes import transformed
from handey.check.values import Array

__all__ = ["Carry", "World", "check_parts", "find_carries", "pose_error"]

NEAR = 1e-4  # of a pose [m]: format
NEAR_ANGLE = 1e-3  # of a pose [rad]: format
SAME_FACE = math.radians(1.0)  # resting: same. Choice: the tolerance of faces elsewhere


@dataclass
class Carry:
    """One part's way through the air.

    Attributes:
        first, last: indices of the steps that hold it.
        origin: where it stood before, in the world.
        taken: where the grasp holds it at the start: the same, or there is a jump.
        put: where it stands after.
        opening: of the hand that holds it [m].
    """

    part: str
    first: int
    last: int
    goal: int
    X_HP: Array
    origin: Array
    taken: Array
    put: Array
    opening: float


@dataclass
class World:
    """Where each part stands in each step; a held part is not in that step's entry."""

    standing: list[dict[str, Array]]
    end: dict[str, Array]


def pose_error(a: Array, b: Array) -> tuple[float, float]:
    """Distance [m] and angle [rad] between two poses."""
    turn = a[:3, :3].T @ b[:3, :3]
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    angle = math.atan2(float(np.linalg.norm(skew)), float(np.trace(turn) - 1))
    return float(np.linalg.norm(a[:3, 3] - b[:3, 3])), angle


def find_carries(plan: PlanData, cell: Cell) -> tuple[list[Carry], World]:
    """Replays where parts are. Only steps that name part and grip carry something."""
    places = {part.name: part.pose for part in cell.parts}
    carries: list[Carry] = []
    standing: list[dict[str, Array]] = []
    i = 0
    while i < len(plan.steps):
        step = plan.steps[i]
        if step.action not in HELD or step.part is None or step.X_HP is None:
            standing.append(dict(places))
            i += 1
            continue
        j = i
        while j + 1 < len(plan.steps) and _goes_on(step, plan.steps[j + 1]):
            j += 1
        last = plan.steps[j]
        taken = _hand(cell, step, 0) @ step.X_HP
        put = _hand(cell, last, -1) @ (step.X_HP if last.X_HP is None else last.X_HP)
        carries.append(
            Carry(
                step.part,
                i,
                j,
                step.goal,
                step.X_HP,
                places[step.part],
                taken,
                put,
                float(step.opening[0]),
            )
        )
        others = {name: place for name, place in places.items() if name != step.part}
        standing += [others] * (j - i + 1)
        places[step.part] = put
        i = j + 1
    return carries, World(standing, places)


def _goes_on(step: Step, following: Step) -> bool:
    return following.action in HELD and following.action != "depart" and following.part == step.part


def _hand(cell: Cell, step: Step, row: int) -> Array:
    frames = forward(cell.robot, cell.base, step.q[[row]], step.opening[[row]])
    return frames.matrix(cell.robot.hand, 0, cell.robot.grasp_frame)


def check_parts(
    plan: PlanData, cell: Cell, carries: list[Carry], world: World, report: CheckReport
) -> None:
    """Pads, jumps, stability, supports, which parts move, goals, placements."""
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
            text = f"{carry.part} is taken {distance * 1e3:.3f} mm, {angle:.5f} rad from where it stands"
            report.add("jump", text, *at)
        _pads(plan, cell, part, carry, report)
        _rest(plan, cell, world, carries, n, report)
    _goals(plan, cell, carries, world, report)
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


# --------------------------------------------------------------------------------------------- goals


def _goals(
    plan: PlanData, cell: Cell, carries: list[Carry], world: World, report: CheckReport
) -> None:
    order = list(range(len(cell.task)))
    served = list(dict.fromkeys(step.goal for step in plan.steps))
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
    if cell.given_order and served != sorted(served):
        report.add("goal", f"goals are served in the order {served}; the cell gives the order")
    if not cell.given_order:
        order = served + [goal for goal in order if goal not in served]
    places = {part.name: part.pose for part in cell.parts}
    start = dict(places)
    reported = set()
    for n, g in enumerate(order):
        for carry in carries:
            if carry.goal == g:
                places[carry.part] = carry.put
        text = goal_fault(cell, cell.task[g], places, start)
        if text:
            reported.add(g)
            mine = [step for step in plan.steps if step.goal == g]
            step = mine[-1] if mine else None
            report.add(
                "goal", f"goal {g} ({cell.task[g].part}) is not reached: {text}",
                step.index if step else None, float(step.time[-1]) if step else None,
                step.action if step else "",
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
        return _outside(cell, goal.inside, triangles)
    return None


def _outside(cell: Cell, name: str, triangles: Array) -> str | None:
    """Why a part is not within the walls of a fixture, or None."""
    body = next(body for body in cell.fixtures if body.name == name)
    walls = transformed(body.pose, body.triangles().reshape(-1, 3))
    low, high = walls.min(axis=0), walls.max(axis=0)
    part = triangles.reshape(-1, 3)
    if (part[:, :2].min(axis=0) < low[:2] - NEAR).any() or (
        part[:, :2].max(axis=0) > high[:2] + NEAR
    ).any():
        return f"reaches out of {name}"
    if part[:, 2].min() >= high[2] - NEAR:
        return f"lies on top of {name}, not inside"
    faces = body.triangles()
    level = unit_normals(faces) @ body.pose[2, :3]
    rim = (
        transformed(body.pose, faces[level > 0.99].reshape(-1, 3))[:, 2]
        if (level > 0.99).any()
        else walls[:, 2]
    )
    if part[:, 2].min() > rim.max() - NEAR:
        return f"lies on the rim of {name}, not inside"
    return None


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
