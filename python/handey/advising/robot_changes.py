"""Changes of the robot itself: joints that turn farther, and where it is mounted.

Joint limits are in the URDF: "joint[@name='joint5']/limit/@upper". Not guaranteed: that the arm can
be built or mounted so.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator

import numpy as np

from handey.advising.change import Change, Family
from handey.advising.situation import Situation
from handey.reporting.advice import Edit
from handey.robot_file import read_robot

__all__ = ["farther_joints", "mounts"]

MOST_JOINTS = 2
DEGREE = math.radians(1.0)
FARTHER = (0.0, 0.1, 0.3)  # than what is missing [rad]
MOST_FARTHER = 1.6  # Choice: more would be another arm [rad]
BASE_MOVES = (0.1, 0.25, 0.5)  # Choice: where it is not known how much is missing [m]
BEYOND = (0.1, 0.25, 0.0, 0.5)  # than what is missing: towards one end is away from the other [m]
STEP = 0.01


def farther_joints(here: Situation) -> Iterator[Family]:
    """Joints that are past their limits turn farther, to either side."""
    told = [r for r in here.reasons if r.kind == "joint_limit" and r.by is not None]
    names = list(dict.fromkeys(reason.joint for reason in told))[:MOST_JOINTS]
    urdf = read_robot(here.cell_file.entry.robot.file).urdf if names else None
    robot = here.cell.robot
    for order, name in enumerate(names):
        index = [joint.name for joint in robot.joints].index(name)
        limit = robot.joints[index].limit
        missing = next(reason.by for reason in told if reason.joint == name) or 0.0
        sizes = tuple(DEGREE * math.ceil(missing / DEGREE + 0.5) + more for more in FARTHER)
        for side in ("upper", "lower"):

            def make(
                size: float, name: str = name, index: int = index, side: str = side
            ) -> Change | None:
                limit = robot.joints[index].limit
                sign = 1.0 if side == "upper" else -1.0
                value = round(getattr(limit, side) + sign * size, 4)
                if size > MOST_FARTHER or abs(value) > 2 * math.pi:
                    return None
                both = {"lower": limit.lower, "upper": limit.upper, side: value}
                place = f"joint[@name='{name}']/limit/@{side}"
                words = (
                    f"let {name} turn {math.degrees(size):.0f} degrees farther, "
                    f"to {math.degrees(value):.0f} degrees"
                )
                other = robot.with_limit(index, both["lower"], both["upper"])
                edit = Edit(os.fspath(urdf or ""), place, value)
                return Change("joint limit", words, (edit,), size, robot=other)

            if math.isfinite(limit.lower) and math.isfinite(limit.upper):
                yield Family("joint limit", make, sizes, rank=order, wave=1.0, step=DEGREE)


def mounts(here: Situation) -> Iterator[Family]:
    """The robot's base nearer to the part and its goal, level; then lower or higher."""
    cause = here.reasons[0] if here.reasons else None
    missing = cause.by if cause is not None and cause.kind == "out_of_reach" else None
    middle = np.mean([here.middle(end) for end in here.ends], axis=0) - here.robot_at
    rise, level = float(middle[2]), np.array([middle[0], middle[1], 0.0])
    ways: list[tuple[str, np.ndarray]] = []
    if np.linalg.norm(level) > 0.1:
        axis = int(np.argmax(np.abs(level)))
        along = np.zeros(3)
        along[axis] = np.sign(level[axis])
        ways.append((f"along {'+' if along[axis] > 0 else '-'}{'xyz'[axis]}", along))
    ways.append((f"along {'+' if rise > 0 else '-'}z", np.array([0, 0, 1.0 if rise > 0 else -1.0])))
    sizes: tuple[float, ...] = BASE_MOVES
    if missing is not None:
        first = STEP * math.ceil(missing / STEP)
        sizes = tuple(round(first + more, 3) for more in BEYOND)
    for order, (words, direction) in enumerate(ways):

        def make(size: float, words: str = words, direction: np.ndarray = direction) -> Change:
            xyz = [round(float(v), 6) + 0.0 for v in here.robot_at + size * direction]
            edit = Edit(here.file, "robot.base.xyz", xyz)
            return Change(
                "robot moved", f"mount the robot {1e3 * size:.0f} mm {words}", (edit,), size
            )

        yield Family("robot moved", make, sizes, rank=0.7 * order, wave=1.0, step=STEP)
