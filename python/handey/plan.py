"""What the robot does: the steps of a plan, and the JSON file that holds them.

Positions, openings and times are written so that they are read back bit for bit; the same plan
gives the same bytes. Reading checks that the file says what it must, all faults at once; whether
the plan is *valid* - free of collision, within limits, steps in their order - is the question of
`handey.check`.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np

from handey.errors import Fault, InvalidInput
from handey.formats.fields import Field, nearest
from handey.formats.output import write_whole
from handey.formats.pose import read_pose, written_pose
from handey.formats.strict_json import read_json
from handey.formats.strict_yaml import Document

__all__ = ["ACTIONS", "Plan", "Step"]

VERSION = 1
ACTIONS = (
    "transit",  # gross motion, hand empty
    "approach",  # hand moves in over the part
    "grasp",  # fingers close; the arm stands still
    "depart",  # part moves away from what it stood on
    "transfer",  # gross motion, part held
    "deposit",  # part moves in to where it will stand
    "release",  # fingers open; the arm stands still
    "withdraw",  # hand moves out, empty
)


@dataclass(frozen=True, eq=False)
class Step:
    """One timed motion with one action.

    Attributes:
        action: one of `ACTIONS`.
        goal: index in the cell's task of the goal that the step serves.
        part: the held part's name, None if the hand is empty.
        part_in_grasp_frame: X_HP (4, 4), None if the hand is empty.
        time: on the clock of the whole plan, which starts at 0; never decreasing (n,) [s].
        positions: of the arm joints (n, dof) [rad].
        opening: distance between the pads (n,) [m].
    """

    action: str
    goal: int
    part: str | None
    part_in_grasp_frame: np.ndarray | None
    time: np.ndarray
    positions: np.ndarray
    opening: np.ndarray

    def __post_init__(self) -> None:
        if self.action not in ACTIONS:
            message = f"unknown action '{self.action}'; {nearest(str(self.action), ACTIONS)}"
            raise InvalidInput(Fault("E_REF", "action", message))
        for name, dimensions in (("time", 1), ("positions", 2), ("opening", 1)):
            array = np.array(getattr(self, name), dtype=np.float64)
            if array.ndim != dimensions or len(array) == 0 or len(array) != len(self.time):
                message = (
                    f"has shape {array.shape}; expected one row for each of {len(self.time)} times"
                )
                raise InvalidInput(Fault("E_TYPE", name, message))
            if not np.isfinite(array).all():
                raise InvalidInput(Fault("E_NUMBER", name, "holds a number that is not finite"))
            array.flags.writeable = False
            object.__setattr__(self, name, array)
        if (self.part is None) != (self.part_in_grasp_frame is None):
            message = "part and part_in_grasp_frame are both given or neither"
            raise InvalidInput(Fault("E_TYPE", "part_in_grasp_frame", message))

    @property
    def duration_s(self) -> float:
        """How long the step takes [s]."""
        return float(self.time[-1] - self.time[0])


@dataclass(frozen=True, eq=False)
class Plan:
    """The steps that reach all goals of a cell.

    Attributes:
        cell: the cell's name.
        joints: names of the arm joints, base to flange.
        steps: in order; none where every goal is already met.
        placements: where each moved part stands in the end, X_WP (4, 4) by name.
        report: what was tried and how long it took, as JSON has it.
    """

    cell: str
    joints: tuple[str, ...]
    steps: tuple[Step, ...]
    placements: dict[str, np.ndarray]
    report: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "joints", tuple(self.joints))
        object.__setattr__(self, "steps", tuple(self.steps))
        for index, step in enumerate(self.steps):
            if step.positions.shape[1] != len(self.joints):
                columns = step.positions.shape[1]
                message = (
                    f"has {columns} columns; expected one for each of {len(self.joints)} joints"
                )
                raise InvalidInput(Fault("E_DOF", f"steps[{index}].positions", message))

    @property
    def duration_s(self) -> float:
        """How long the plan takes from its start to its last row [s]."""
        return float(self.steps[-1].time[-1]) if self.steps else 0.0

    @property
    def regrasps(self) -> int:
        """How often a part is put down on the way to its goal."""
        goals = [step.goal for step in self.steps if step.action == "grasp"]
        return sum(earlier == later for earlier, later in pairwise(goals))

    def to_json(self) -> str:
        """The content of the plan file.

        Raises:
            InvalidInput: E_NUMBER, E_TYPE if the report holds what JSON cannot.
        """
        head: dict[str, Any] = {
            "handey_plan": VERSION,
            "cell": self.cell,
            "joints": list(self.joints),
        }
        lines = [f"  {_json(key)}: {_json(value)}" for key, value in head.items()]
        steps = ",\n".join(_written_step(step) for step in self.steps)
        lines.append(f'  "steps": [\n{steps}\n  ]' if steps else '  "steps": []')
        placements = {name: written_pose(X_WP) for name, X_WP in self.placements.items()}
        lines.append(f'  "placements": {_json(placements)}')
        try:
            lines.append(f'  "report": {_json(self.report)}')
        except (TypeError, ValueError) as error:
            raise InvalidInput(Fault("E_TYPE", "report", f"cannot be written: {error}")) from error
        return "{\n" + ",\n".join(lines) + "\n}\n"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the plan file, whole or not at all.

        Raises:
            InvalidInput: E_OUTPUT if the file cannot be written, E_TYPE for a report not of JSON.
        """
        write_whole(path, self.to_json())

    @staticmethod
    def load(path: str | os.PathLike[str]) -> Plan:
        """Reads a plan file.

        Raises:
            InvalidInput: with every fault of the file.
        """
        return _read(read_json(path))


def _json(value: Any) -> str:
    return json.dumps(value, allow_nan=False)


def _written_step(step: Step) -> str:
    X_HP = step.part_in_grasp_frame
    entries = {
        "action": step.action,
        "goal": int(step.goal),
        "part": step.part,
        "part_in_grasp_frame": None if X_HP is None else written_pose(X_HP),
        "time": step.time.tolist(),
        "positions": step.positions.tolist(),
        "opening": step.opening.tolist(),
    }
    lines = ",\n".join(f"      {_json(key)}: {_json(value)}" for key, value in entries.items())
    return "    {\n" + lines + "\n    }"


def _read(document: Document) -> Plan:
    entries = Field(document, (), document.value).mapping(
        required=("handey_plan", "cell", "joints", "steps", "placements"), optional=("report",)
    )
    entries = entries or {}
    if "handey_plan" in entries:
        entries["handey_plan"].version(VERSION)
    cell = entries["cell"].text() if "cell" in entries else None
    joints = entries["joints"].texts() if "joints" in entries else None
    steps = entries["steps"].items() or [] if "steps" in entries else []
    read = [_read_step(step, joints) for step in steps]
    placed = entries["placements"].named() if "placements" in entries else {}
    placements = {name: read_pose(pose) for name, pose in placed.items()}
    report = entries["report"].mapping_of_anything() if "report" in entries else {}
    document.raise_faults()
    assert cell is not None and joints is not None
    return Plan(
        cell,
        tuple(joints),
        tuple(step for step in read if step is not None),
        {name: X_WP for name, X_WP in placements.items() if X_WP is not None},
        report,
    )


def _read_step(step: Field, joints: list[str] | None) -> Step | None:
    keys = ("action", "goal", "part", "part_in_grasp_frame", "time", "positions", "opening")
    entries = step.mapping(required=keys)
    if entries is None or len(entries) < len(keys):
        return None
    action = entries["action"].choice(*ACTIONS)
    goal = entries["goal"].count()
    held = entries["part"].value is not None
    part = entries["part"].text() if held else None
    frame = entries["part_in_grasp_frame"]
    if held != (frame.value is not None):
        frame.fault("E_TYPE", "part and part_in_grasp_frame are both given or both null")
        return None
    X_HP = read_pose(frame) if held else None
    time = _table(entries["time"])
    positions = _table(entries["positions"], None if joints is None else len(joints))
    opening = _table(entries["opening"])
    if action is None or goal is None or (held and (part is None or X_HP is None)):
        return None
    if time is None or positions is None or opening is None:
        return None
    for name, rows in (("positions", positions), ("opening", opening)):
        if len(rows) != len(time):
            entries[name].fault("E_TYPE", f"has {len(rows)} rows; `time` has {len(time)}")
            return None
    return Step(action, goal, part, X_HP, time, positions, opening)


def _table(field: Field, columns: int | None = None) -> np.ndarray | None:
    """A list of numbers (n,), or of rows (n, columns); only its first fault is noted."""
    rows = field.items()
    if rows is None:
        return None
    if not rows:
        field.fault("E_TYPE", "expected at least one row, found none")
        return None
    is_flat = field.place[-1] != "positions"
    for row in rows:
        good = _is_number(row.value) if is_flat else _is_row(row.value, columns)
        if not good and (row.number() if is_flat else row.numbers(columns, code="E_DOF")) is None:
            return None
    try:
        array = np.array(field.value, dtype=np.float64)
    except (ValueError, OverflowError):  # rows of different lengths, where `joints` is wrong
        return None
    return array


def _is_number(value: Any) -> bool:
    return type(value) in (float, int) and abs(value) < 1e300


def _is_row(value: Any, columns: int | None) -> bool:
    right = isinstance(value, list) and (columns is None or len(value) == columns)
    return right and all(_is_number(entry) for entry in value)
