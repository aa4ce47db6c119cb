"""What the hand carries from where to where, and where each part stands in each step.

A carry is a run of steps that hold one part. Before the first and after the last of them the part
stands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from handey.check.cell import Cell
from handey.check.kinematics import forward
from handey.check.plan_data import HELD, PlanData, Step
from handey.check.values import Array

__all__ = ["NEAR", "NEAR_ANGLE", "Carry", "World", "find_carries", "pose_error"]

NEAR = 1e-4  # of a pose [m]: format
NEAR_ANGLE = 1e-3  # of a pose [rad]: format


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
