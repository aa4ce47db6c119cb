"""What `handey view` does: a page that plays a plan, or shows why there is none.

Without a plan the task is planned now. Where planning is not possible for the robot, or is stopped,
the page shows the cell and says so.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

from handey.commands import (
    INTERRUPTED,
    OK,
    DeadlinePassedError,
    keep_inputs,
    plan_and_check,
    within,
)
from handey.errors import InvalidInput
from handey.terminal import ProgressLine, complain, warn

__all__ = ["view_command"]


def view_command(options: argparse.Namespace) -> int:
    """Writes the page."""
    from handey.output import require_writable

    output = Path(options.output or f"{Path(options.cell).stem}.html")
    require_writable(output)
    keep_inputs([options.cell, options.plan], output)
    if options.plan is None:
        return _plan_and_view(options, output)
    from handey.cell_file import load_cell

    warn(options, load_cell(options.cell).warnings)
    _require_plan_or_report(options.plan)
    from handey.view import write_page

    write_page(options.cell, options.plan, output)
    return _told(options, output)


def _require_plan_or_report(path: str) -> None:
    """What is neither is bad input, with every fault of it."""
    from handey.plan import Plan
    from handey.report_file import is_report, read_report_file
    from handey.strict_json import read_json

    if is_report(read_json(path).value):
        read_report_file(path)
    else:
        Plan.load(path)


def _plan_and_view(options: argparse.Namespace, output: Path) -> int:
    from handey._core import CancelToken
    from handey.view import write_page

    start, cancel, line = time.monotonic(), CancelToken(), ProgressLine(options)
    plan, report, notes = None, None, []
    try:
        work = within(
            options.deadline, lambda: plan_and_check(options, start, cancel, line), cancel
        )
        _, result, checked = work
        report = result.report
        plan = None if result.plan is None else json.loads(result.plan.to_json())
        if checked is not None and not checked.ok:
            notes = ["The plan found is not valid:", *map(str, checked.faults)]
    except DeadlinePassedError:
        notes = [f"the deadline of {options.deadline:g} s passed before anything was tried"]
    except InvalidInput as error:
        if not all(fault.code == "E_KINEMATICS" for fault in error.faults):
            raise
        notes = [f"No planning for this robot: {fault.message}" for fault in error.faults]
    finally:
        line.end()
    for note in notes:
        complain(f"{options.cell}: {note}")
    write_page(options.cell, plan, output, report, notes)
    _told(options, output)
    if cancel.cancelled:
        complain("interrupted")
        return INTERRUPTED
    return OK


def _told(options: argparse.Namespace, output: Path) -> int:
    if not options.quiet:
        print(f"page: {output}")
    return OK
