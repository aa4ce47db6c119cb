"""A plan as arrays, and the clauses that concern its form: keys, kinds, shapes, order, continuity.

What cannot be replayed at all (no JSON, no file) is bad input; a plan of a wrong form is a faulty plan.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.cell import Cell
from handey.check.report import CheckReport
from handey.check.values import Array, fault, pose
from handey.errors import InvalidInput

__all__ = ["HELD", "PlanData", "Step", "check_form", "load_json", "read_plan"]

ACTIONS = ("transit", "approach", "grasp", "depart", "transfer", "deposit", "release", "withdraw")
HELD = ("depart", "transfer", "deposit")  # in these a part is in the hand
STILL = ("grasp", "release")  # in these the arm stands still
SAME = 1e-9  # row to row between steps: format
START = 1e-6  # configuration of the cell to first and last row [rad, m]
MAX_BYTES = 512 * 2**20


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
            placements[name] = pose(value, "", f"placements.{name}")
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
    X_HP = None if X_HP is None else pose(X_HP, "", "part_in_grasp_frame")
    time = _array(value["time"], "time", 1)
    q = _array(value["positions"], "positions", 2)
    opening = _array(value["opening"], "opening", 1)
    if (
        len(time) == 0
        or q.shape != (len(time), len(cell.robot.joints))
        or len(opening) != len(time)
    ):
        raise _Form(
            f"time, positions and opening: expected (n,), (n, {len(cell.robot.joints)}), (n,), n > 0; "
            f"found {time.shape}, {q.shape}, {opening.shape}"
        )
    return Step(index, value["action"], goal, value["part"], X_HP, time, q, opening)


def _array(value: Any, name: str, dimensions: int) -> Array:
    try:
        raw = np.asarray(value)
    except ValueError as error:
        raise _Form(f"{name}: rows of different lengths") from error
    if raw.ndim != dimensions or raw.dtype.kind not in "iuf" or not np.isfinite(raw).all():
        raise _Form(f"{name}: expected finite numbers in {dimensions} dimension(s)")
    return raw.astype(float)


# ------------------------------------------------------------------------------------------- clauses


def check_form(plan: PlanData, cell: Cell, report: CheckReport) -> None:
    """Order of the steps, what is held, continuity, time, limits, velocities, start and end."""
    _grammar(plan, report)
    _held(plan, report)
    _continuity(plan, report)
    for step in plan.steps:
        _limits(step, cell, report)
        _velocity(step, cell, report)
        _still(step, report)
    _ends(plan, cell, report)


def _grammar(plan: PlanData, report: CheckReport) -> None:
    word = "".join("tagdxprw"[ACTIONS.index(step.action)] for step in plan.steps)
    match = re.match(r"(t*agdx*prw)*t*", word)
    end = match.end() if match else 0
    if end == len(word):
        return
    # The longest prefix that can still be completed ends at the step that does not fit.
    prefix = re.compile(r"(t*agdx*prw)*(t*(a(g(d(x*(p(rw?)?)?)?)?)?)?)?$")
    good = max(i for i in range(len(word) + 1) if prefix.match(word[:i]))
    if good == len(word):
        report.add("grammar", "the plan ends in the middle of a carry", len(word) - 1,
                   float(plan.steps[-1].time[-1]), plan.steps[-1].action)  # fmt: skip
        return
    step = plan.steps[good]
    before = f"after {plan.steps[good - 1].action}" if good else "as the first step"
    report.add(
        "grammar", f"{step.action} cannot come {before}", good, float(step.time[0]), step.action
    )


def _held(plan: PlanData, report: CheckReport) -> None:
    before: Step | None = None
    for step in plan.steps:
        at = (step.index, float(step.time[0]), step.action)
        given = step.part is not None, step.X_HP is not None
        if step.action in HELD and not all(given):
            report.add("held", "part and part_in_grasp_frame are null, but a part is held", *at)
        elif step.action not in HELD and any(given):
            report.add("held", "part and part_in_grasp_frame are set, but no part is held", *at)
        elif step.action in HELD and step.action != "depart" and before is not None and all(given):
            if before.part != step.part:
                report.add(
                    "held", f"{step.part} is held, but {before.part} was in the step before", *at
                )
            elif before.X_HP is not None and step.X_HP is not None:
                off = float(np.abs(before.X_HP - step.X_HP).max())
                if off > SAME:
                    report.add("held", f"{step.part} moved in the hand by {off:.3g} (m or -)", *at)
        before = step


def _continuity(plan: PlanData, report: CheckReport) -> None:
    for step, following in zip(plan.steps, plan.steps[1:], strict=False):
        at = (following.index, float(following.time[0]), following.action)
        off = np.abs(following.q[0] - step.q[-1])
        if off.max() > SAME:
            i = int(off.argmax())
            report.add(
                "continuity", f"joint {i + 1} jumps by {off[i]:.3g} rad between the steps", *at
            )
        jump = abs(float(following.opening[0] - step.opening[-1]))
        if jump > SAME:
            report.add("continuity", f"the opening jumps by {jump:.3g} m between the steps", *at)
        if following.time[0] < step.time[-1]:
            text = f"time goes back from {step.time[-1]:.6f} s to {following.time[0]:.6f} s"
            report.add("time", text, *at)
    for step in plan.steps:
        back = np.flatnonzero(np.diff(step.time) < 0)
        if len(back):
            k = int(back[0])
            text = f"time goes back from {step.time[k]:.6f} s to {step.time[k + 1]:.6f} s in row {k + 1}"
            report.add("time", text, step.index, float(step.time[k]), step.action)
    if plan.steps and plan.steps[0].time[0] != 0:
        report.add(
            "time",
            f"starts at {plan.steps[0].time[0]:.6g} s, not at 0",
            0,
            None,
            plan.steps[0].action,
        )


def _limits(step: Step, cell: Cell, report: CheckReport) -> None:
    for i, joint in enumerate(cell.robot.joints):
        over = np.maximum(step.q[:, i] - joint.upper, joint.lower - step.q[:, i])
        k = int(over.argmax())
        if over[k] > SAME:
            text = f"{joint.name} = {step.q[k, i]:.6f} rad is outside [{joint.lower:.6f}, {joint.upper:.6f}]"
            report.add("joint-limits", text, step.index, float(step.time[k]), step.action)
    low, high = cell.robot.opening
    over = np.maximum(step.opening - high, low - step.opening)
    k = int(over.argmax())
    if over[k] > SAME:
        text = f"opening = {step.opening[k]:.6f} m is outside [{low:.6f}, {high:.6f}]"
        report.add("joint-limits", text, step.index, float(step.time[k]), step.action)


def _velocity(step: Step, cell: Cell, report: CheckReport) -> None:
    dt = np.maximum(np.diff(step.time), 0.0)
    if len(dt) == 0:
        return
    turns = [
        (j.name, j.velocity, np.abs(np.diff(step.q[:, i])), "rad")
        for i, j in enumerate(cell.robot.joints)
    ]
    slide = np.abs(np.diff(step.opening)) / 2
    for name, limit, moved, unit in [
        *turns,
        *((f.name, f.velocity, slide, "m") for f in cell.robot.fingers),
    ]:
        over = moved - limit * dt * (1 + 1e-6) - SAME
        k = int(over.argmax())
        if over[k] > 0:
            speed = "no time" if dt[k] == 0 else f"{moved[k] / dt[k]:.4f} {unit}/s"
            text = (
                f"{name} moves {moved[k]:.5g} {unit} at {speed}; its limit is {limit:.4f} {unit}/s"
            )
            report.add("velocity", text, step.index, float(step.time[k]), step.action)


def _still(step: Step, report: CheckReport) -> None:
    if step.action in STILL:
        moved = np.abs(step.q - step.q[0])
        if moved.max() > SAME:
            k, i = np.unravel_index(int(moved.argmax()), moved.shape)
            text = f"joint {i + 1} moves by {moved[k, i]:.3g} rad while the arm is to stand still"
            report.add("still", text, step.index, float(step.time[k]), step.action)
    if step.action in HELD:
        moved = np.abs(step.opening - step.opening[0])
        k = int(moved.argmax())
        if moved[k] > SAME:
            text = f"the opening changes by {moved[k] * 1e3:.3g} mm while a part is held"
            report.add("still", text, step.index, float(step.time[k]), step.action)


def _ends(plan: PlanData, cell: Cell, report: CheckReport) -> None:
    if not plan.steps:
        return
    first, last = plan.steps[0], plan.steps[-1]
    off = float(np.abs(first.q[0] - cell.start).max())
    if off > START:
        report.add(
            "start", f"the first row is {off:.3g} rad from the cell's start", 0, 0.0, first.action
        )
    off = abs(float(first.opening[0]) - cell.start_opening)
    if off > START:
        report.add(
            "start",
            f"the first opening is {off:.3g} m from the cell's start_opening",
            0,
            0.0,
            first.action,
        )
    off = float(np.abs(last.q[-1] - cell.start).max())
    if cell.finish_at_start and off > START:
        text = f"the last row is {off:.3g} rad from the cell's start"
        report.add("finish", text, last.index, float(last.time[-1]), last.action)
