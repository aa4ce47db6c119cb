"""Which cell, and which task in it, does the cell file describe?

Reading goes in three steps: `read_cell` checks the structure and the names and needs no compiled
core; `load_cell` adds robot and meshes; then what cannot be, such as bodies that overlap at the
start, is refused (docs: formats, section 2). Each step reports all of its faults together.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from handey.cell.body_entry import read_body
from handey.cell.cell_entry import CellEntry, CellFile, RobotPlace
from handey.cell.depth_map import read_depth_map
from handey.formats.fields import Field
from handey.formats.pose import read_pose
from handey.formats.strict_yaml import Document, read_yaml
from handey.task import Task, read_goals

__all__ = [
    "CellEntry",
    "CellFile",
    "RobotPlace",
    "load_cell",
    "parse_cell",
    "read_cell",
    "read_document",
]

VERSION = 1


def read_cell(path: str | os.PathLike[str]) -> CellEntry:
    """Reads the structure and the names of a cell file.

    Raises:
        InvalidInput: with every fault of the structure.
    """
    return read_document(read_yaml(path))


def load_cell(path: str | os.PathLike[str]) -> CellFile:
    """Reads a cell file with its robot and meshes, and refuses what cannot be.

    Raises:
        InvalidInput: with every fault of the first step that finds any.
    """
    entry = read_cell(path)
    from handey.cell.assembly import assemble

    return assemble(entry)


def parse_cell(cell: Mapping[str, Any], base_folder: str | os.PathLike[str] = ".") -> CellFile:
    """Makes a cell from the values that a cell file would hold.

    Args:
        cell: as a cell file: mappings, lists or arrays, numbers and texts.
        base_folder: what relative paths are relative to.

    Raises:
        InvalidInput: as `load_cell`.
    """
    entry = read_document(Document("", Path(base_folder), _plain(cell)))
    from handey.cell.assembly import assemble

    return assemble(entry)


def _plain(value: Any) -> Any:
    """Mappings and arrays as dict and list, so that a program may pass what it has."""
    if isinstance(value, Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def read_document(document: Document) -> CellEntry:
    """Reads the structure and the names of a cell from the values of its file.

    Raises:
        InvalidInput: with every fault of the structure.
    """
    entries = Field(document, (), document.value).mapping(
        required=("handey_cell", "name", "robot", "task"),
        optional=("fixtures", "parts", "depth_maps", "order", "finish"),
    )
    entries = entries or {}
    if "handey_cell" in entries:
        entries["handey_cell"].version(VERSION)
    name = entries["name"].text() if "name" in entries else None
    robot = _read_robot(entries["robot"]) if "robot" in entries else None
    fields = {
        kind: entries[kind].named() if kind in entries else {}
        for kind in ("fixtures", "parts", "depth_maps")
    }
    _require_distinct(fields)
    fixtures = [read_body(key, field, is_part=False) for key, field in fields["fixtures"].items()]
    parts = [read_body(key, field, is_part=True) for key, field in fields["parts"].items()]
    depth_maps = [read_depth_map(key, field) for key, field in fields["depth_maps"].items()]
    task = _read_task(entries, list(fields["parts"]), list(fields["fixtures"]))
    document.raise_faults()
    assert name is not None and robot is not None
    return CellEntry(
        document,
        name,
        robot,
        tuple(body for body in fixtures if body is not None),
        tuple(body for body in parts if body is not None),
        tuple(depth_map for depth_map in depth_maps if depth_map is not None),
        task,
    )


def _read_robot(field: Field) -> RobotPlace | None:
    entries = field.mapping(required=("file",), optional=("base", "start", "start_opening"))
    if entries is None:
        return None
    path = entries["file"].file() if "file" in entries else None
    X_WR = read_pose(entries["base"]) if "base" in entries else np.eye(4)
    start = entries["start"].numbers() if "start" in entries else None
    opening = entries["start_opening"].number(least=0.0) if "start_opening" in entries else None
    return None if path is None or X_WR is None else RobotPlace(path, X_WR, start, opening, field)


def _require_distinct(fields: dict[str, dict[str, Field]]) -> None:
    """A name means one thing in the whole cell."""
    first: dict[str, Field] = {}
    for named in fields.values():
        for name, field in named.items():
            if name in first:
                field.fault("E_DUP", f"the name '{name}' is already that of {first[name]}")
            first.setdefault(name, field)


def _read_task(entries: dict[str, Field], parts: list[str], fixtures: list[str]) -> Task:
    goals = read_goals(entries["task"], parts, fixtures) if "task" in entries else []
    order = entries["order"].choice("given", "any") if "order" in entries else "given"
    finish = entries["finish"].choice("start", "anywhere") if "finish" in entries else "start"
    return Task(tuple(goals), order == "any", finish == "start")
