"""The Puma 560 of models/robots/puma560 and a table before it, as all the examples use them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from handey import _core
from handey.robot_file import load_robot


def at(x: float, y: float, z: float, yaw: float = 0.0) -> np.ndarray:
    """A pose from a position [m] and a turn about z [rad]."""
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    pose[:3, 3] = x, y, z
    return pose


def box(name: str, size: list[float], X_WB: np.ndarray) -> _core.Body:
    """A body of one box, full edge lengths [m]."""
    return _core.Body(name=name, shapes=[_core.Shape(geometry=_core.Box(size))], X_WB=X_WB)


def table_cell(
    models: Path, fixtures: list[_core.Body] | None = None, parts: list[_core.Body] | None = None
) -> _core.Cell:
    """The robot at home beside a table whose top is z = 0."""
    robot, _ = load_robot(models / "robots/puma560/robot.yaml")
    start = _core.Configuration(q=robot.home, opening=robot.gripper.max_opening)
    table = box("table", [1.6, 1.4, 0.05], at(0.55, 0, -0.025))
    return _core.Cell(
        name="table",
        robot=robot,
        start=start,
        fixtures=[table, *(fixtures or [])],
        parts=parts or [],
    )
