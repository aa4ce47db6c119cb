"""What is this robot: joints, inverse kinematics, hand, reach, and what is never checked?

The reach is that of the robot alone. Bodies that a joint joins, and pairs that the robot file
names, are never checked against each other: what they do to each other is nobody's to see.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from handey import _core
from handey.errors import InvalidInput
from handey.inspection.part import jaws_dict
from handey.inspection.reach import Reach, sample_reach

__all__ = ["RobotReport", "inspect_robot"]

HORIZON = 0.5  # Choice: what is farther apart is not worth telling [m]
LEAST_CLEARANCE = 5e-3  # Choice: a robot nearer to itself at home gets a warning [m]


@dataclass(frozen=True)
class RobotReport:
    """What was found out about a robot.

    Attributes:
        robot: as it was read.
        objection: why planning does not support its kinematics; empty if it does.
        reach: of its hand; None where the kinematics is not supported.
        joined: pairs of bodies that a joint joins.
        ignored: further pairs that are never checked, from the robot file.
        has_jaws: the description has fingers; else its gripper means nothing.
        clearance: of the robot from itself at home, up to HORIZON [m].
        nearest: the two bodies that are so near to each other; empty if none is within HORIZON.
        warnings: for people.
    """

    robot: _core.Robot
    objection: str
    reach: Reach | None
    joined: tuple[tuple[str, str], ...]
    ignored: tuple[tuple[str, str], ...]
    has_jaws: bool
    clearance: float
    nearest: tuple[str, str]
    warnings: tuple[str, ...]

    @property
    def name(self) -> str:
        """Of the robot."""
        return self.robot.name

    def as_dict(self) -> dict[str, Any]:
        """For JSON: metres, radians, seconds; an unbounded joint has null limits."""
        robot = self.robot
        return {
            "kind": "robot",
            "name": robot.name,
            "joints": [
                {
                    "name": joint.name,
                    "lower_rad": joint.limit.lower,
                    "upper_rad": joint.limit.upper,
                    "velocity_rad_s": joint.limit.velocity,
                    "acceleration_rad_s2": joint.limit.acceleration,
                    "home_rad": float(home),
                }
                for joint, home in zip(robot.joints, robot.home, strict=True)
            ],
            "inverse_kinematics": {"supported": not self.objection, "reason": self.objection},
            "jaws": jaws_dict(robot.name, robot.gripper) if self.has_jaws else None,
            "reach": None if self.reach is None else self.reach.as_dict(),
            "bodies": self.bodies,
            "bodies_without_shape": self.shapeless,
            "never_checked": {
                "joined": [list(pair) for pair in self.joined],
                "ignored": [list(pair) for pair in self.ignored],
            },
            "home_clearance_m": self.clearance if self.nearest[0] else None,
            "home_nearest": list(self.nearest) if self.nearest[0] else None,
            "warnings": list(self.warnings),
        }

    @property
    def is_shapeless(self) -> bool:
        """No body has a shape: nothing can be said of collisions."""
        return len(self.shapeless) == len(self.bodies)

    @property
    def shapeless(self) -> list[str]:
        """Bodies that collide with nothing because they have no collision geometry."""
        with_shape = {body.name for body in self.robot.bodies if body.shapes}
        return [name for name in self.bodies if name not in with_shape]

    @property
    def bodies(self) -> list[str]:
        """Names, base first; without fingers that were made up."""
        fingers = {finger.child for finger in self.robot.gripper.fingers}
        kept = enumerate(self.robot.bodies)
        return [body.name for i, body in kept if self.has_jaws or i not in fingers]


def inspect_robot(
    robot: _core.Robot,
    said: Sequence[str] = (),
    picture: bool = False,
    has_jaws: bool = True,
) -> RobotReport:
    """What a robot is.

    Args:
        robot: from `handey.robot_file.load_robot`.
        said: warnings from reading it.
        picture: sample the reach for a picture too, which takes longer.
        has_jaws: False where fingers were only made up to read it.
    """
    objection, reach = "", None
    try:
        solver = _core.SphericalWristSolver(robot)
        reach = sample_reach(robot, solver, picture)
    except InvalidInput as error:
        objection = error.faults[0].message
    cell = _core.Cell(robot=robot, start=_core.Configuration(robot.home, robot.gripper.max_opening))
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    hit = checker.closest(cell.start, HORIZON)
    warnings = list(said)
    if hit.a and hit.distance <= 0:
        warnings.append(f"{hit.a} and {hit.b} overlap at home by {-1e3 * hit.distance:.1f} mm")
    elif hit.a and hit.distance < LEAST_CLEARANCE:
        warnings.append(f"{hit.a} and {hit.b} are {1e3 * hit.distance:.1f} mm apart at home")
    return RobotReport(
        robot, objection, reach, _joined(robot, has_jaws), _named(robot, robot.ignored_pairs),
        has_jaws, hit.distance, (hit.a, hit.b), tuple(warnings),
    )  # fmt: skip


def _joined(robot: _core.Robot, has_jaws: bool) -> tuple[tuple[str, str], ...]:
    ends = [(joint.parent, joint.child) for joint in robot.joints]
    if has_jaws:
        ends += [(finger.parent, finger.child) for finger in robot.gripper.fingers]
    return _named(robot, ends)


def _named(robot: _core.Robot, pairs: Sequence[tuple[int, int]]) -> tuple[tuple[str, str], ...]:
    names = [body.name for body in robot.bodies]
    return tuple((names[a], names[b]) for a, b in pairs)
