"""A plan as arrays, and the clause format: keys, kinds and shapes of what is in the file.

What cannot be replayed at all (no JSON, no file) is bad input; a plan of a wrong form is a faulty
plan.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.cell import Cell
from handey.check.report import CheckReport
from handey.check.values import Array, fault, pose
from handey.errors import InvalidInput

__all__ = ["ACTIONS", "HELD", "PlanData", "Step", "load_json", "read_plan"]

ACTIONS = ("transit", "approach", "grasp", "depart", "transfer", "deposit", "release", "withdraw")
HELD = ("depart", "transfer", "deposit")  # in these a part is in the hand
MAX_BYTES = 512 * 2**20
MOST = 1e9  # of a joint value, an opening or a time. Choice: far beyond any robot and any shift


@dataclass
class Step:
    """One step's rows."""

    index: int
    action: str
    goal: int
    part: str | None
    X_HP: Array | None
    time: Array
    q: Array
    opening: Array


@dataclass
class PlanData:
    """All steps, and where the plan says that parts end."""

    steps: list[Step]
    placements: dict[str, Array]


def load_json(source: Path | Mapping[str, Any]) -> tuple[Mapping[str, Any], str]:
    """The content of a plan file (or the mapping itself), and its name.

    Raises:
        InvalidInput: if it is no JSON object, or holds NaN or infinity.
    """
    if isinstance(source, Mapping):
        return source, "plan"

    def refuse(name: str) -> float:
        raise ValueError(f"{name} is no JSON number")

    try:
        if source.stat().st_size > MAX_BYTES:
            raise fault("E_TOO_BIG", str(source), "", f"larger than {MAX_BYTES} bytes")
        content = json.loads(source.read_text(encoding="utf-8"), parse_constant=refuse)
    except OSError as error:
        raise fault("E_PATH", str(source), "", f"cannot be read: {error}") from error
    except (ValueError, RecursionError) as error:
        if isinstance(error, InvalidInput):
            raise
        raise fault("E_JSON", str(source), "", f"is no JSON: {error}") from error
    if not isinstance(content, dict):
        raise fault("E_JSON", str(source), "", "expected an object")
    return content, str(source)


class _Form(Exception):
    pass


def read_plan(content: Mapping[str, Any], cell: Cell, report: CheckReport) -> PlanData | None:
    """The plan's arrays, or None after noting faults under `format`."""
    before = len(report.faults)
    try:
        _head(content, cell)
    except _Form as error:
        report.add("format", str(error))
        return None
    steps = []
    for i, value in enumerate(content["steps"]):
        try:
            steps.append(_step(i, value, cell))
        except (_Form, InvalidInput) as error:
            action = value.get("action", "") if isinstance(value, Mapping) else ""
            report.add("format", str(error), i, None, action if isinstance(action, str) else "")
    placements = {}
    for name, value in content["placements"].items():
        try:
            if name not in cell.part_names():
                raise _Form(f"placements: no part {name!r} in the cell")
            placements[name] = _pose(value, f"placements.{name}")
        except (_Form, InvalidInput) as error:
            report.add("format", str(error))
    return PlanData(steps, placements) if len(report.faults) == before else None


def _head(content: Mapping[str, Any], cell: Cell) -> None:
    for key in ("handey_plan", "cell", "joints", "steps", "placements"):
        if key not in content:
            raise _Form(f"the key {key!r} is missing")
    for key in content:
        if key not in ("handey_plan", "cell", "joints", "steps", "placements", "report"):
            raise _Form(f"unknown key {key!r}")
    if content["handey_plan"] != 1 or isinstance(content["handey_plan"], bool):
        raise _Form(f"handey_plan: expected 1, found {content['handey_plan']!r}")
    if content["cell"] != cell.name:
        raise _Form(f"cell: the plan is for {content['cell']!r}, the cell is {cell.name!r}")
    if content["joints"] != cell.robot.joint_names():
        raise _Form(f"joints: expected {cell.robot.joint_names()}, found {content['joints']!r}")
    if not isinstance(content.get("report", {}), Mapping):
        raise _Form("report: expected a mapping")
    if not isinstance(content["steps"], list) or not isinstance(content["placements"], Mapping):
        raise _Form("expected a list of steps and a mapping of placements")


def _step(index: int, value: Any, cell: Cell) -> Step:
    required = ("action", "goal", "part", "part_in_grasp_frame", "time", "positions", "opening")
    if not isinstance(value, Mapping):
        raise _Form("expected a mapping")
    for key in required:
        if key not in value:
            raise _Form(f"the key {key!r} is missing")
    for key in value:
        if key not in required:
            raise _Form(f"unknown key {key!r}")
    if value["action"] not in ACTIONS:
        raise _Form(f"action: expected one of {', '.join(ACTIONS)}, found {value['action']!r}")
    goal = value["goal"]
    if (
        isinstance(goal, bool)
        or not isinstance(goal, int)
        or not 0 <= goal < max(len(cell.task), 1)
    ):
        raise _Form(f"goal: expected an index of the task's {len(cell.task)} goals, found {goal!r}")
    if value["part"] is not None and value["part"] not in cell.part_names():
        raise _Form(f"part: no part {value['part']!r} in the cell")
    X_HP = value["part_in_grasp_frame"]
    X_HP = None if X_HP is None else _pose(X_HP, "part_in_grasp_frame")
    time = _array(value["time"], "time", 1)
    q = _array(value["positions"], "positions", 2)
    opening = _array(value["opening"], "opening", 1)
    if (
        len(time) == 0
        or q.shape != (len(time), len(cell.robot.joints))
        or len(opening) != len(time)
    ):
        raise _Form(
            f"time, positions, opening: expected (n,), (n, {len(cell.robot.joints)}), (n,), n > 0; "
            f"found {time.shape}, {q.shape}, {opening.shape}"
        )
    return Step(index, value["action"], goal, value["part"], X_HP, time, q, opening)


def _array(value: Any, name: str, dimensions: int) -> Array:
    try:
        raw = np.asarray(value)
    except ValueError as error:
        raise _Form(f"{name}: rows of different lengths") from error
    flat = value if dimensions == 1 else chain.from_iterable(value) if raw.ndim == 2 else ()
    if (
        raw.ndim != dimensions
        or raw.dtype.kind not in "iuf"
        or not np.isfinite(raw).all()
        or any(isinstance(number, bool) for number in flat)
    ):
        raise _Form(f"{name}: expected finite numbers in {dimensions} dimension(s)")
    if raw.size and np.abs(raw).max() > MOST:
        raise _Form(f"{name}: no motion has numbers beyond {MOST:g}")
    return raw.astype(float)


def _pose(value: Any, place: str) -> Array:
    """A pose as JSON has it: numbers written as texts, which YAML files may have, are none."""
    if not isinstance(value, Mapping):
        raise _Form(f"{place}: expected a pose, found {value!r:.60}")
    for key, numbers in value.items():
        if isinstance(numbers, list) and any(isinstance(number, str) for number in numbers):
            raise _Form(f"{place}.{key}: expected numbers, found {numbers!r:.60}")
    return pose(value, "", place)
