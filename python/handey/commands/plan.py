"""What `handey plan` and `handey check` do, and with which exit status they end.

A plan is checked by the independent replay before it is written; one that fails is not written.
Nothing heavy is imported before it is needed.
"""

from __future__ import annotations

import argparse
import math
import os
import queue
import shlex
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import handey
from handey.commands.summary import no_plan_lines, plan_lines, plan_summary
from handey.commands.terminal import ProgressLine, complain, one_line, tell, warn
from handey.errors import Fault, InvalidInput

if TYPE_CHECKING:
    from handey._core import CancelToken
    from handey.cell_file import CellFile
    from handey.check import CheckReport
    from handey.planner import PlanResult

__all__ = [
    "check_command",
    "deadline_passed",
    "keep_inputs",
    "plan_and_check",
    "plan_command",
    "within",
]

OK, NOT_VALID, BAD_INPUT, NO_PLAN, INTERNAL, DEADLINE, INTERRUPTED = 0, 1, 2, 3, 70, 124, 130
INPUT_KINDS = (".yaml", ".yml", ".urdf", ".stl", ".obj", ".ply", ".npy", ".png")
# Choice: the planner stops this long before the deadline and tells why [s]. It looks at the clock
# every few milliseconds.
TIME_TO_TELL = 0.05
# Choice: after Ctrl-C the report of a planner that is told to stop is waited for so long [s].
TIME_TO_STOP = 1.0
Result = TypeVar("Result")


class DeadlinePassedError(Exception):
    """The time given on the command line is over."""


def plan_command(options: argparse.Namespace) -> int:
    """Plans, checks the plan, and only then writes it."""
    start = time.monotonic()
    from handey._core import CancelToken
    from handey.formats.output import require_writable

    output = Path(options.output or f"{Path(options.cell).stem}.plan.json")
    require_writable(output)
    keep_inputs([options.cell], output)
    if options.report:
        require_writable(options.report)
        keep_inputs([options.cell, str(output)], Path(options.report))
    cancel, line = CancelToken(), ProgressLine(options)
    left = None if options.deadline is None else options.deadline - (time.monotonic() - start)
    try:
        work = within(left, lambda: plan_and_check(options, start, cancel, line), cancel)
    except DeadlinePassedError:
        line.end()
        _write_report(options, Path(options.cell).stem, {"deadline_passed": True})
        return deadline_passed(options, start)
    finally:
        line.end()
    cell, result, checked = work
    _write_report(options, cell.name, result.report.as_dict())
    summary = plan_summary(cell, result, checked)
    if cancel.cancelled:
        told = {"verdict": "unknown", "cancelled": True}
        lines = [] if result.plan is not None else no_plan_lines(cell, result, options.verbose)
        tell(options, summary | told, lines)
        complain("interrupted")
        return INTERRUPTED
    if result.plan is None:
        lines = [*no_plan_lines(cell, result, options.verbose), _where_to_see(options)]
        tell(options, summary, lines)
        return DEADLINE if result.report.deadline_passed else NO_PLAN
    assert checked is not None
    if not checked.ok:
        tell(options, summary | {"verdict": "unknown"}, [])
        complain("internal error: the plan found is not valid; nothing has been written")
        for fault in checked.faults:
            complain(str(fault))
        return NO_PLAN
    result.plan.save(output)
    lines = [*plan_lines(cell, result, checked, options.verbose), f"plan: {output}"]
    tell(options, summary | {"output": str(output)}, lines)
    return OK


def _write_report(options: argparse.Namespace, cell: str, report: dict[str, Any]) -> None:
    if options.report:
        from handey.reporting.report_file import write_report

        write_report(options.report, cell, report)


def _where_to_see(options: argparse.Namespace) -> str:
    told = f" {shlex.quote(options.report)}" if options.report else ""
    return f"to see it: handey view {shlex.quote(options.cell)}{told}"


def plan_and_check(
    options: argparse.Namespace, start: float, cancel: CancelToken, line: ProgressLine
) -> tuple[CellFile, PlanResult, CheckReport | None]:
    """Reads the cell, plans its task and checks the plan; the check is None without one."""
    from handey.cell_file import load_cell

    cell = load_cell(options.cell)
    warn(options, cell.warnings)
    from handey import planner

    left = None
    if options.deadline is not None:
        left = options.deadline - (time.monotonic() - start)
        left -= min(TIME_TO_TELL, 0.1 * left)
        if left <= 0:
            raise DeadlinePassedError
    wanted = planner.PlanOptions(seed=options.seed, deadline=left, advice=not options.no_advice)
    result = planner.plan(cell, wanted, cancel=cancel, progress=line.show if line.shown else None)
    checked = None
    if result.plan is not None and not cancel.cancelled:
        line.show("check")
        checked = handey.check(options.cell, result.plan)
    return cell, result, checked


def within(
    seconds: float | None, work: Callable[[], Result], cancel: CancelToken | None = None
) -> Result:
    """The result of `work`, done in a thread so that a deadline and Ctrl-C end the wait at once.

    Args:
        seconds: how long it is waited for.
        work: what is to be done.
        cancel: cancelled on Ctrl-C; then the work is given a moment to come to its end. The second
            Ctrl-C is not waited for.

    Raises:
        DeadlinePassedError: after `seconds`.
        Exception: whatever `work` raises.
    """
    answers: queue.SimpleQueue[tuple[Result | None, BaseException | None]] = queue.SimpleQueue()

    def answer() -> None:
        try:
            answers.put((work(), None))
        except BaseException as error:
            answers.put((None, error))

    threading.Thread(target=answer, daemon=True, name="handey-plan").start()
    try:
        result, error = answers.get(timeout=None if seconds is None else max(0.0, seconds))
    except queue.Empty:
        raise DeadlinePassedError from None
    except KeyboardInterrupt:
        if cancel is None:
            raise
        cancel.cancel()
        try:
            result, error = answers.get(timeout=TIME_TO_STOP)
        except queue.Empty:
            raise KeyboardInterrupt from None
    if error is not None:
        raise error
    return result  # type: ignore[return-value]


def deadline_passed(options: argparse.Namespace, start: float) -> int:
    """Tells that the time given on the command line is over."""
    summary = {
        "verdict": "unknown",
        "cpu_s": time.process_time(),
        "wall_s": time.monotonic() - start,
        "duration_s": None,
        "regrasps": None,
        "stages": {},
        "reasons": [f"the deadline of {options.deadline:g} s passed"],
    }
    tell(options, summary, [])
    complain(f"{options.cell}: the deadline of {options.deadline:g} s passed")
    return DEADLINE


def check_command(options: argparse.Namespace) -> int:
    """Replays a plan and tells each fault."""
    from handey.plan import Plan

    Plan.load(options.plan)  # a file that is no plan is bad input, not a plan that is not valid
    checked = within(None, lambda: handey.check(options.cell, options.plan))
    faults = [one_line(str(fault)) for fault in checked.faults]
    clearance = checked.least_clearance
    summary = checked.to_json() | {"valid": checked.ok}
    count = f"{len(faults)} fault{'' if len(faults) == 1 else 's'}"
    lines = [f"{options.plan}: {'valid' if checked.ok else f'not valid, {count}'}", *faults]
    if clearance is not None and math.isfinite(clearance) and checked.ok:
        lines.append(f"  least clearance: {clearance * 1e3:.2f} mm")
    tell(options, summary, lines)
    return OK if checked.ok else NOT_VALID


def keep_inputs(inputs: Sequence[str | None], output: Path) -> None:
    """The output must not replace what is read, or may be read by way of it."""
    if output.suffix.lower() in INPUT_KINDS and output.exists():
        message = (
            f"exists, and ends with {output.suffix} as an input does; the output needs another name"
        )
        raise InvalidInput(Fault("E_OUTPUT", "", message, str(output)))
    for name in inputs:
        if name is not None and os.path.realpath(name) == os.path.realpath(output):
            raise InvalidInput(
                Fault("E_OUTPUT", "", "is read; the output needs another name", str(output))
            )
