"""Rigid poses as 4 x 4 arrays, and how the formats write them.

Roll, pitch, yaw turn about the fixed x, y, z axes in that order, as in URDF; a quaternion is x, y,
z, w. Lengths in metres, angles in radians. Plain numpy: the formats are read and plans are checked
without the compiled core.
"""

from __future__ import annotations

import numpy as np

from handey.formats.fields import Field

__all__ = [
    "pose_from_xyz_quat",
    "pose_from_xyz_rpy",
    "quaternion_xyzw",
    "read_pose",
    "written_pose",
]

QUATERNION_TOLERANCE = 1e-3  # most that the norm of a written quaternion differs from 1
FARTHEST = 1000.0  # Choice: a coordinate beyond is a wrong unit [m]


def pose_from_xyz_rpy(xyz: np.ndarray, rpy: np.ndarray) -> np.ndarray:
    """The pose (4, 4) at `xyz` (3,) [m] with R = Rz(yaw) Ry(pitch) Rx(roll) of `rpy` (3,) [rad]."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    pose = np.eye(4)
    pose[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    pose[:3, 3] = xyz
    return pose


def pose_from_xyz_quat(xyz: np.ndarray, quat_xyzw: np.ndarray) -> np.ndarray:
    """The pose (4, 4) at `xyz` (3,) [m] with the rotation of `quat_xyzw` (4,), of any length."""
    x, y, z, w = np.asarray(quat_xyzw, dtype=float) / np.linalg.norm(quat_xyzw)
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    pose[:3, 3] = xyz
    return pose


def quaternion_xyzw(pose: np.ndarray) -> np.ndarray:
    """The rotation of a pose (4, 4) as a unit quaternion (4,), w >= 0."""
    r = np.asarray(pose, dtype=float)[:3, :3]
    # Each row is the quaternion times 4 x, 4 y, 4 z, 4 w; the longest row is the most exact.
    rows = np.array(
        [
            [
                1 + r[0, 0] - r[1, 1] - r[2, 2],
                r[0, 1] + r[1, 0],
                r[0, 2] + r[2, 0],
                r[2, 1] - r[1, 2],
            ],
            [
                r[0, 1] + r[1, 0],
                1 - r[0, 0] + r[1, 1] - r[2, 2],
                r[1, 2] + r[2, 1],
                r[0, 2] - r[2, 0],
            ],
            [
                r[0, 2] + r[2, 0],
                r[1, 2] + r[2, 1],
                1 - r[0, 0] - r[1, 1] + r[2, 2],
                r[1, 0] - r[0, 1],
            ],
            [
                r[2, 1] - r[1, 2],
                r[0, 2] - r[2, 0],
                r[1, 0] - r[0, 1],
                1 + r[0, 0] + r[1, 1] + r[2, 2],
            ],
        ]
    )
    quaternion = rows[int(np.argmax(np.diag(rows)))]
    quaternion = quaternion / np.linalg.norm(quaternion)
    return np.array(-quaternion if quaternion[3] < 0 else quaternion)


def written_pose(pose: np.ndarray) -> dict[str, list[float]]:
    """The pose (4, 4) as the formats write it: ``{"xyz": [...], "quat_xyzw": [...]}``."""
    # + 0.0 turns -0.0 into 0.0
    return {
        "xyz": [float(value) + 0.0 for value in pose[:3, 3]],
        "quat_xyzw": [float(value) + 0.0 for value in quaternion_xyzw(pose)],
    }


def read_pose(field: Field) -> np.ndarray | None:
    """The pose (4, 4) given as ``{xyz, rpy}`` or ``{xyz, quat_xyzw}``; None if it is wrong."""
    entries = field.mapping(optional=("xyz", "rpy", "quat_xyzw"))
    if entries is None:
        return None
    xyz = (
        entries["xyz"].numbers(3, least=-FARTHEST, most=FARTHEST)
        if "xyz" in entries
        else np.zeros(3)
    )
    if "rpy" in entries and "quat_xyzw" in entries:
        field.fault("E_TYPE", "has both rpy and quat_xyzw; expected one rotation")
        return None
    if "quat_xyzw" in entries:
        quaternion = entries["quat_xyzw"].numbers(4)
        if quaternion is None or xyz is None:
            return None
        norm = float(np.linalg.norm(quaternion))
        if abs(norm - 1) > QUATERNION_TOLERANCE:
            message = f"has norm {norm:.6g}; expected 1 within {QUATERNION_TOLERANCE:g}"
            entries["quat_xyzw"].fault("E_QUATERNION", message)
            return None
        return pose_from_xyz_quat(xyz, quaternion)
    rpy = entries["rpy"].numbers(3) if "rpy" in entries else np.zeros(3)
    return None if xyz is None or rpy is None else pose_from_xyz_rpy(xyz, rpy)
