"""The cell as the checker knows it: robot, fixtures, parts, measured obstacles, task."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey.check.robot import Robot
from handey.check.shapes import Shape
from handey.check.values import Array

__all__ = ["Body", "Cell", "Goal"]


@dataclass
class Body:
    """A fixture or a part."""

    name: str
    shapes: list[Shape]
    pose: Array
    support: bool = False
    friction: float = 0.4
    may_move: bool = False

    def points(self) -> Array:
        """All vertices in the body frame (n, 3)."""
        return np.vstack([shape.points() for shape in self.shapes])

    def triangles(self) -> Array:
        """All triangles in the body frame (m, 3, 3)."""
        return np.vstack([shape.triangles() for shape in self.shapes])

    def centre_of_mass(self) -> Array:
        """Of the shapes at uniform density, in the body frame (3,)."""
        a, b, c = np.moveaxis(self.triangles(), 1, 0)
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        return np.asarray((a + b + c).T @ volume / (4 * volume.sum()))


@dataclass
class Goal:
    """Where a part is to go: a pose, or standing on or inside a fixture."""

    part: str
    at: Array | None = None
    on: str | None = None
    inside: str | None = None
    region: Array | None = None  # [[x0, y0], [x1, y1]] in the world
    same_rest: bool = False


@dataclass
class Cell:
    """A cell file's content; names are unique over fixtures, parts and depth maps."""

    name: str
    file: str
    robot: Robot
    base: Array
    start: Array
    start_opening: float
    fixtures: list[Body]
    parts: list[Body]
    task: list[Goal]
    given_order: bool
    finish_at_start: bool

    def part_names(self) -> list[str]:
        """In the order of the file."""
        return [part.name for part in self.parts]
