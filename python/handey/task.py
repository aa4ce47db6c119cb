"""What is to be done: the goals of a cell, in the order in which they are to be reached.

A goal puts one part somewhere: at a pose, on a fixture, or inside one. Article: the task-level
command MOVE part TO place, which names no grasp and no motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey.formats.fields import Field
from handey.formats.pose import FARTHEST, read_pose

__all__ = ["Goal", "PlaceAt", "PlaceInside", "PlaceOn", "Task", "read_goals"]


@dataclass(frozen=True)
class PlaceAt:
    """The part's own frame is to be at a pose in the world."""

    part: str
    X_WP: np.ndarray  # (4, 4)

    def __str__(self) -> str:
        x, y, z = self.X_WP[:3, 3]
        return f"{self.part} at ({x:.3f}, {y:.3f}, {z:.3f})"


@dataclass(frozen=True)
class PlaceOn:
    """The part is to stand stably somewhere on the upward faces of a fixture."""

    part: str
    fixture: str
    region: np.ndarray | None = None  # (2, 2): least x, y; greatest x, y in the world [m]
    same_resting: bool = False  # on the face that it stands on now

    def __str__(self) -> str:
        return f"{self.part} on {self.fixture}"


@dataclass(frozen=True)
class PlaceInside:
    """The part is to stand stably within the walls of an open box or tray."""

    part: str
    fixture: str

    def __str__(self) -> str:
        return f"{self.part} inside {self.fixture}"


Goal = PlaceAt | PlaceOn | PlaceInside


@dataclass(frozen=True)
class Task:
    """The goals, whether their order may be chosen, and where the arm is to end.

    Attributes:
        goals: in the order of the cell file.
        any_order: handey may choose the order of the goals.
        return_to_start: the arm ends in its start configuration.
    """

    goals: tuple[Goal, ...]
    any_order: bool = False
    return_to_start: bool = True


def read_goals(field: Field, parts: list[str], fixtures: list[str]) -> list[Goal]:
    """Reads the list of goals; a wrong one is left out and noted.

    Args:
        field: the list.
        parts: names that `place` may give.
        fixtures: names that `on` and `inside` may give.
    """
    goals = [_read_goal(item, parts, fixtures) for item in field.items() or []]
    return [goal for goal in goals if goal is not None]


def _read_goal(field: Field, parts: list[str], fixtures: list[str]) -> Goal | None:
    kind = field.one_of(("at", "on", "inside"))
    optional = ("region", "resting") if kind == "on" else ()
    entries = field.mapping(required=("place",), optional=("at", "on", "inside", *optional))
    if entries is None:
        return None
    part = entries["place"].reference("part", parts) if "place" in entries else None
    if kind is None:
        return None
    target = entries[kind]
    if kind == "at":
        X_WP = read_pose(target)
        return None if part is None or X_WP is None else PlaceAt(part, X_WP)
    fixture = _fixture(target, parts, fixtures)
    if kind == "inside":
        return None if part is None or fixture is None else PlaceInside(part, fixture)
    region = _region(entries["region"]) if "region" in entries else None
    same = "resting" in entries and entries["resting"].choice("same") is not None
    return None if part is None or fixture is None else PlaceOn(part, fixture, region, same)


def _fixture(field: Field, parts: list[str], fixtures: list[str]) -> str | None:
    if isinstance(field.value, str) and field.value in parts:
        field.fault("E_REF", f"'{field.value}' is a part; expected a fixture")
        return None
    return field.reference("fixture", fixtures)


def _region(field: Field) -> np.ndarray | None:
    corners = [item.numbers(2, least=-FARTHEST, most=FARTHEST) for item in field.items(2) or []]
    if len(corners) != 2 or corners[0] is None or corners[1] is None:
        return None
    if not (corners[0] < corners[1]).all():
        field.fault("E_RANGE", "expected the least x, y, then a greater x, y")
        return None
    return np.array(corners)
