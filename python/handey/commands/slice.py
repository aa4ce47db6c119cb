"""What `handey slice` does: a picture of the slices through which a gross motion goes.

The motion is one of a plan that is read, or of the plan that is found for the cell's task. Nothing
heavy is imported before it is needed.
"""

from __future__ import annotations

import argparse
import math
import time
from pathlib import Path
from typing import TYPE_CHECKING

from handey.commands.ending import (
    DEADLINE,
    NO_PLAN,
    OK,
    DeadlinePassedError,
    deadline_passed,
    within,
)
from handey.commands.summary import no_plan_lines, plan_summary
from handey.commands.terminal import tell, warn
from handey.errors import Fault, InvalidInput
from handey.formats.output import keep_inputs, require_writable

if TYPE_CHECKING:
    from handey.cell_file import CellFile
    from handey.plan import Plan
    from handey.planner import PlanResult
    from handey.slices.layers import Layer
    from handey.slices.legs import Leg

__all__ = ["slice_command"]


def slice_command(options: argparse.Namespace) -> int:
    """Draws slices of the configuration space, with a path through them."""
    start = time.monotonic()
    output = Path(options.output or f"{Path(options.cell).stem}.slice.svg")
    require_writable(output)
    keep_inputs([options.cell, options.plan], output)
    from handey.cell_file import load_cell

    cell = load_cell(options.cell)
    warn(options, cell.warnings)
    try:
        plan, result = _plan(options, cell, start)
        if plan is None:
            assert result is not None
            tell(options, plan_summary(cell, result, None), no_plan_lines(cell, result, False))
            return DEADLINE if result.report.deadline_passed else NO_PLAN
        leg = _leg(options, cell, plan)
        angles = _angles(options, leg)
        left = None if options.deadline is None else options.deadline - (time.monotonic() - start)
        layers = within(left, lambda: _layers(options, leg, angles))
    except DeadlinePassedError:
        return deadline_passed(options, start)
    from handey.slices.picture import slice_figure

    slice_figure(leg, layers, cell.name).save(output)
    tell(options, _summary(leg, layers, output), _lines(cell, leg, layers, output))
    return OK


def _plan(
    options: argparse.Namespace, cell: CellFile, start: float
) -> tuple[Plan | None, PlanResult | None]:
    """The plan that is given, or one that is found."""
    from handey.plan import Plan

    if options.plan is not None:
        return Plan.load(options.plan), None
    from handey import planner

    left = None if options.deadline is None else options.deadline - (time.monotonic() - start)
    if left is not None and left <= 0:
        raise DeadlinePassedError
    wanted = planner.PlanOptions(seed=options.seed, deadline=left, advice=False)
    result = within(left, lambda: planner.plan(cell, wanted))
    return result.plan, result


def _leg(options: argparse.Namespace, cell: CellFile, plan: Plan) -> Leg:
    """The gross motion that is asked for; the start where the plan has none."""
    from handey.slices.legs import legs_of, standing

    legs = {leg.step: leg for leg in legs_of(cell, plan, options.plan or "")}
    if options.step is None:
        return next(iter(legs.values()), None) or standing(cell)
    if options.step not in legs:
        there = ", ".join(map(str, legs)) or "none"
        message = f"step {options.step} is no gross motion of the plan; those are: {there}"
        raise InvalidInput(Fault("E_RANGE", "--step", message))
    return legs[options.step]


def _angles(options: argparse.Namespace, leg: Leg) -> list[float]:
    """The waist angles [rad], within the joint's limits."""
    from handey.slices.picture import default_angles

    if options.theta1 is None:
        return default_angles(leg)
    limit = leg.cell.robot.joints[0].limit
    angles = [math.radians(degrees) for degrees in dict.fromkeys(options.theta1)]
    for angle in angles:
        if not limit.lower <= angle <= limit.upper:
            bounds = f"{math.degrees(limit.lower):g} to {math.degrees(limit.upper):g} degrees"
            message = f"{math.degrees(angle):g} is outside the limits of joint 1, {bounds}"
            raise InvalidInput(Fault("E_LIMIT", "--theta1", message))
    return angles


def _layers(options: argparse.Namespace, leg: Leg, angles: list[float]) -> list[Layer]:
    from handey.slices.layers import SLICES, make_layers

    slices: tuple[str, ...] = SLICES if leg.step >= 0 else SLICES[:1]
    if options.wrist is not None:
        slices = tuple(name for name in SLICES if name in options.wrist)
    return make_layers(leg, angles, slices)


def _summary(leg: Leg, layers: list[Layer], output: Path) -> dict[str, object]:
    """The figures, for programs."""
    told = [
        {"slice": layer.slice, "theta1_deg": round(math.degrees(layer.theta1), 6)} | layer.counts()
        for layer in layers
    ]
    step = None if leg.step < 0 else leg.step
    head = {"step": step, "action": leg.action, "layers": told}
    return head | {"reasons": _reasons(layers), "output": str(output)}


def _lines(cell: CellFile, leg: Leg, layers: list[Layer], output: Path) -> list[str]:
    motion = "at the start" if leg.step < 0 else f"{leg.action} of step {leg.step}"
    lines = [f"{cell.name}: slices of the {motion}" if leg.step >= 0 else f"{cell.name}: {motion}"]
    for layer in layers:
        total = layer.kinds.size
        shares = ", ".join(
            f"{100 * count / total:.1f} % {name.replace('_', ' ')}"
            for name, count in layer.counts().items()
        )
        lines.append(f"  {layer.slice} at {math.degrees(layer.theta1):.1f} degrees: {shares}")
    lines += [f"  no cell of the range is free: {r}" for r in _reasons(layers)]
    return [*lines, f"picture: {output}"]


def _reasons(layers: list[Layer]) -> list[str]:
    """Why no cell of a slice can be free, each once."""
    return list(dict.fromkeys(layer.reason for layer in layers if layer.reason))
