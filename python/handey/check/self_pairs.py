"""Which bodies of the robot are checked against each other.

Left out as the format says: bodies joined by a joint, listed pairs, and those that overlap at home
and nearly always. The random configurations have a fixed seed.
"""

from __future__ import annotations

import numpy as np

from handey.check.kinematics import Frames, forward
from handey.check.robot import Robot
from handey.check.solids import Engine, Placed
from handey.check.sweep import Actor
from handey.check.values import Array

__all__ = ["checked_pairs"]


def checked_pairs(
    robot: Robot, links: list[Actor | None], base: Array, engine: Engine, count: int = 1000
) -> list[tuple[Actor, Actor]]:
    """Pairs of robot bodies that are checked.

    Left out: pairs joined by a joint; listed pairs; pairs that overlap at home and in more than
    95 % of 1000 random configurations.
    """
    joined = {frozenset((j.parent, j.child)) for j in [*robot.joints, *robot.fingers]}
    joined |= {frozenset(pair) for pair in robot.ignored}
    random = np.random.default_rng(0)
    low = np.array([max(j.lower, -np.pi) if j.lower == -np.inf else j.lower for j in robot.joints])
    high = np.array([min(j.upper, np.pi) if j.upper == np.inf else j.upper for j in robot.joints])
    q = np.vstack([robot.home, random.uniform(low, high, (count, len(low)))])
    opening = np.append(robot.opening[1], random.uniform(robot.opening[0], robot.opening[1], count))
    frames = None
    result = []
    for i, a in enumerate(links):
        for b in links[i + 1 :]:
            if a is None or b is None or frozenset((a.body, b.body)) in joined:
                continue
            if frames is None:
                frames = forward(robot, base, q, opening)
            if not _always_overlap(engine, a, b, frames, count):
                result.append((a, b))
    return result


def _always_overlap(engine: Engine, a: Actor, b: Actor, frames: Frames, count: int) -> bool:
    R_a, p_a = a.poses(frames)
    R_b, p_b = b.poses(frames)
    apart = 0
    for k in range(count + 1):
        overlap = False
        for i in a.pieces:
            for j in b.pieces:
                first, second = Placed(i, R_a[k], p_a[k]), Placed(j, R_b[k], p_b[k])
                overlap = (
                    overlap or engine.distance(first, second) <= 0 or engine.contains(first, second)
                )
        if not overlap:
            if k == 0:
                return False
            apart += 1
            if apart > 0.05 * count:
                return False
    return True
