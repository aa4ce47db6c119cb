"""The clauses about rows and steps: order, what is held, continuity, time, limits, speed, ends."""

from __future__ import annotations

import re

import numpy as np

from handey.check.cell import Cell
from handey.check.plan_data import ACTIONS, HELD, PlanData, Step
from handey.check.report import CheckReport

__all__ = ["check_form"]

STILL = ("grasp", "release")  # in these the arm stands still
SAME = 1e-9  # row to row between steps: format
START = 1e-6  # configuration of the cell to first and last row [rad, m]


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
            text = f"time goes back to {step.time[k + 1]:.6f} s in row {k + 1}"
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
            limits = f"[{joint.lower:.6f}, {joint.upper:.6f}]"
            text = f"{joint.name} = {step.q[k, i]:.6f} rad is outside {limits}"
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
            k, i = (int(x) for x in np.unravel_index(int(moved.argmax()), moved.shape))
            text = f"joint {i + 1} moves by {moved[k, i]:.3g} rad while the arm is to stand still"
            report.add("still", text, step.index, float(step.time[k]), step.action)
        # Fingers that stay where they are neither take a part nor let it go.
        wider = float(step.opening[-1] - step.opening[0])
        if (wider if step.action == "release" else -wider) <= SAME:
            what = "open" if step.action == "release" else "close"
            text = f"the fingers do not {what}: the opening changes by {wider * 1e3:.3g} mm"
            report.add("still", text, step.index, float(step.time[-1]), step.action)
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
