"""Where every body of the robot is, for all samples at once, and bounds on how far points move.

Method: a product of joint transforms, arrays over the samples. A point that is at most r from a
joint's axis moves at most |dq| r while the joint moves by dq; bounds add over the joints between
two bodies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey.check.robot import Joint, Robot
from handey.check.values import Array

__all__ = ["Frames", "forward", "joint_path"]


@dataclass
class Frames:
    """Poses of the bodies at n samples: rotations (bodies, n, 3, 3), positions (bodies, n, 3)."""

    R: Array
    p: Array
    axis_point: Array  # of the arm joints (joints, n, 3)
    axis: Array  # of the arm joints (joints, n, 3)

    def matrix(self, body: int, sample: int, local: Array | None = None) -> Array:
        """Pose of a body, or of a frame in it, at a sample (4, 4)."""
        result = np.eye(4)
        result[:3, :3], result[:3, 3] = self.R[body, sample], self.p[body, sample]
        return result if local is None else np.asarray(result @ local)


def forward(robot: Robot, base: Array, q: Array, opening: Array) -> Frames:
    """All bodies in the world.

    Args:
        robot: its bodies and joints.
        base: pose of the root link in the world (4, 4).
        q: (n, joints) [rad].
        opening: (n,) [m].
    """
    n = len(q)
    R = np.empty((len(robot.bodies), n, 3, 3))
    p = np.empty((len(robot.bodies), n, 3))
    R[0], p[0] = base[:3, :3], base[:3, 3]
    points, axes = np.empty((len(robot.joints), n, 3)), np.empty((len(robot.joints), n, 3))
    arm = {joint.child: i for i, joint in enumerate(robot.joints)}
    for joint in sorted(
        [*robot.joints, *robot.fingers], key=lambda j: j.child
    ):  # parents come first
        R_J = R[joint.parent] @ joint.origin[:3, :3]
        p_J = R[joint.parent] @ joint.origin[:3, 3] + p[joint.parent]
        axis = R_J @ joint.axis
        if joint.prismatic:
            R[joint.child], p[joint.child] = R_J, p_J + axis * (opening / 2)[:, None]
        else:
            i = arm[joint.child]
            R[joint.child], p[joint.child] = R_J @ _turns(joint.axis, q[:, i]), p_J
            points[i], axes[i] = p_J, axis
    return Frames(R, p, points, axes)


def _turns(axis: Array, angle: Array) -> Array:
    """Rotations about a unit axis (n, 3, 3)."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sine, rest = np.sin(angle)[:, None, None], (1 - np.cos(angle))[:, None, None]
    return np.asarray(np.eye(3) + sine * K + rest * (K @ K))


def joint_path(robot: Robot, body: int) -> list[Joint]:
    """The joints between the base and a body, base first."""
    above = {joint.child: joint for joint in [*robot.joints, *robot.fingers]}
    path: list[Joint] = []
    while body in above:
        path.insert(0, above[body])
        body = above[body].parent
    return path
