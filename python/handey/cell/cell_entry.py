"""What a cell file says, before and after its robot and meshes are read."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from handey.cell.body_entry import BodyEntry
from handey.cell.depth_map import DepthMapEntry
from handey.formats.fields import Field
from handey.formats.strict_yaml import Document
from handey.task import Goal, Task

if TYPE_CHECKING:
    from handey import _core

__all__ = ["CellEntry", "CellFile", "RobotPlace"]


@dataclass(frozen=True)
class RobotPlace:
    """The robot of a cell: its file, where it stands and how it starts."""

    file: Path
    X_WR: np.ndarray  # the URDF's root link in the world, (4, 4)
    start: np.ndarray | None  # arm joints [rad]; None: the robot file's home
    start_opening: float | None  # [m]; None: the greatest
    field: Field


@dataclass(frozen=True)
class CellEntry:
    """The content of a cell file; no mesh and no robot is read yet.

    Attributes:
        document: the file's values, for messages.
        name: of the cell.
        robot: where it is described and how it stands.
        fixtures, parts: the bodies, in the order of the file.
        depth_maps: obstacles known by measurement.
        task: what is to be done.
    """

    document: Document
    name: str
    robot: RobotPlace
    fixtures: tuple[BodyEntry, ...]
    parts: tuple[BodyEntry, ...]
    depth_maps: tuple[DepthMapEntry, ...]
    task: Task


@dataclass(frozen=True)
class CellFile:
    """A cell and its task, ready to plan.

    Attributes:
        file: the cell file; None for a cell made in a program.
        cell: robot, fixtures and parts; depth maps are fixtures, after those of the file.
        task: goals, order and finish.
        depth_maps: as the file gives them.
        warnings: for people.
        entry: the content of the file as it was read.
        model: collision geometry of the cell as it was read; planning takes over what still fits.
    """

    file: Path | None
    cell: _core.Cell
    task: Task
    depth_maps: tuple[DepthMapEntry, ...]
    warnings: tuple[str, ...]
    entry: CellEntry
    model: _core.CollisionModel | None = dataclasses.field(default=None, repr=False, compare=False)

    @property
    def name(self) -> str:
        """Of the cell."""
        return self.entry.name

    @property
    def goals(self) -> tuple[Goal, ...]:
        """In the order of the file."""
        return self.task.goals
