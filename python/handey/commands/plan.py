"""What `handey plan` does.

A plan is checked by the independent replay before it is written; one that fails is not written.
Nothing heavy is imported before it is needed.
"""

from __future__ import annotations

import argparse
import shlex
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import handey
from handey.commands.ending import (
    DEADLINE,
    INTERRUPTED,
    NO_PLAN,
    OK,
    DeadlinePassedError,
    deadline_passed,
    within,
)
from handey.commands.summary import no_plan_lines, plan_lines, plan_summary
from handey.commands.terminal import ProgressLine, complain, tell, warn
from handey.formats.output import keep_inputs, require_writable

if TYPE_CHECKING:
    from handey._core import CancelToken
    from handey.cell_file import CellFile
    from handey.check import CheckReport
    from handey.planner import PlanResult

__all__ = ["plan_and_check", "plan_command"]

# Choice: the planner stops this long before the deadline and tells why [s]. It looks at the clock
# every few milliseconds.
TIME_TO_TELL = 0.05


def plan_command(options: argparse.Namespace) -> int:
    """Plans, checks the plan, and only then writes it."""
    start = time.monotonic()
    from handey._core import CancelToken

    output = Path(options.output or f"{Path(options.cell).stem}.plan.json")
    require_writable(output)
    keep_inputs([options.cell], output)
    if options.report:
        require_writable(options.report)
        keep_inputs([options.cell, str(output)], Path(options.report))
    cancel, line = CancelToken(), ProgressLine(options)
    try:
        work = plan_and_check(options, start, cancel, line)
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
    """Reads the cell, plans its task and checks the plan; the check is None without one.

    Raises:
        DeadlinePassedError: if there is not even a report in time.
        KeyboardInterrupt: on Ctrl-C while there is none yet, or while the plan is checked.
    """
    cell, result = within(
        _left(options, start), lambda: _read_and_plan(options, start, cancel, line), cancel
    )
    checked = None
    if result.plan is not None and not cancel.cancelled:
        line.show("check")
        plan = result.plan
        # A check has no report so far: on Ctrl-C it is not waited for.
        checked = within(_left(options, start), lambda: handey.check(options.cell, plan))
    return cell, result, checked


def _left(options: argparse.Namespace, start: float) -> float | None:
    """Until the deadline [s]."""
    return None if options.deadline is None else options.deadline - (time.monotonic() - start)


def _read_and_plan(
    options: argparse.Namespace, start: float, cancel: CancelToken, line: ProgressLine
) -> tuple[CellFile, PlanResult]:
    from handey import _core
    from handey.cell_file import load_cell
    from handey.errors import Stopped

    left = _left(options, start)
    if left is not None and left <= 0:
        raise DeadlinePassedError
    try:
        cell = _core.run_within(lambda: load_cell(options.cell), cancel=cancel, deadline=left)
    except Stopped as stopped:
        raise (DeadlinePassedError if stopped.cause == "deadline" else KeyboardInterrupt) from None
    warn(options, cell.warnings)
    from handey import planner

    left = _left(options, start)
    if left is not None:
        left -= min(TIME_TO_TELL, 0.1 * left)
        if left <= 0:
            raise DeadlinePassedError
    wanted = planner.PlanOptions(seed=options.seed, deadline=left, advice=not options.no_advice)
    result = planner.plan(cell, wanted, cancel=cancel, progress=line.show if line.shown else None)
    return cell, result
