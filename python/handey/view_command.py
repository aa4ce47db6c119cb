"""What `handey view` does: a page that plays a plan, or shows why there is none.

Without a plan the task is planned now. Where planning is not possible for the robot, or is stopped,
the page shows the cell and says so. With `--serve` the page is served on the loopback address; it
comes anew whenever the cell file or one that it names is saved.
"""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from handey.commands import (
    INTERRUPTED,
    OK,
    DeadlinePassedError,
    keep_inputs,
    plan_and_check,
    within,
)
from handey.errors import Fault, InvalidInput
from handey.terminal import ProgressLine, complain, warn

if TYPE_CHECKING:
    from handey._core import CancelToken
    from handey.report import Report

__all__ = ["Seen", "look", "require_plan_or_report", "view_command"]


@dataclass
class Seen:
    """What there is to show.

    Attributes:
        plan: content of a plan file, or None.
        report: how planning went, if it was.
        notes: what there is to say besides.
    """

    plan: dict[str, Any] | None = None
    report: Report | None = None
    notes: list[str] = field(default_factory=list)


def view_command(options: argparse.Namespace) -> int:
    """Writes the page, or serves it."""
    if options.serve:
        from handey.view.live import serve

        _refuse(options.output is not None, "--output", "no file is written with --serve")
        return serve(options)
    _refuse(options.port is not None, "--port", "is used with --serve alone")
    from handey.output import require_writable

    output = Path(options.output or f"{Path(options.cell).stem}.html")
    require_writable(output)
    keep_inputs([options.cell, options.plan], output)
    from handey.view import write_page

    if options.plan is not None:
        from handey.cell_file import load_cell

        warn(options, load_cell(options.cell).warnings)
        require_plan_or_report(options.plan)
        write_page(options.cell, options.plan, output)
        return _told(options, output)
    from handey._core import CancelToken

    cancel = CancelToken()
    seen = look(options, cancel)
    write_page(options.cell, seen.plan, output, seen.report, seen.notes)
    _told(options, output)
    if cancel.cancelled:
        complain("interrupted")
        return INTERRUPTED
    return OK


def _refuse(is_wrong: bool, option: str, message: str) -> None:
    if is_wrong:
        raise InvalidInput(Fault("E_OPTION", option, message))


def require_plan_or_report(path: str) -> None:
    """What is neither is bad input, with every fault of it.

    Raises:
        InvalidInput: all faults found.
    """
    from handey.plan import Plan
    from handey.report_file import is_report, read_report_file
    from handey.strict_json import read_json

    if is_report(read_json(path).value):
        read_report_file(path)
    else:
        Plan.load(path)


def look(options: argparse.Namespace, cancel: CancelToken) -> Seen:
    """Plans the task now, until the deadline or Ctrl-C.

    Raises:
        InvalidInput: if the cell cannot be read.
    """
    start, line = time.monotonic(), ProgressLine(options)
    seen = Seen()
    try:
        work = within(
            options.deadline, lambda: plan_and_check(options, start, cancel, line), cancel
        )
        _, result, checked = work
        seen.report = result.report
        seen.plan = None if result.plan is None else json.loads(result.plan.to_json())
        if checked is not None and not checked.ok:
            seen.notes = ["The plan found is not valid:", *map(str, checked.faults)]
    except DeadlinePassedError:
        seen.notes = [f"the deadline of {options.deadline:g} s passed before anything was tried"]
    except InvalidInput as error:
        if not all(fault.code == "E_KINEMATICS" for fault in error.faults):
            raise
        seen.notes = [f"No planning for this robot: {fault.message}" for fault in error.faults]
    finally:
        line.end()
    for note in seen.notes:
        complain(f"{options.cell}: {note}")
    return seen


def _told(options: argparse.Namespace, output: Path) -> int:
    if not options.quiet:
        print(f"page: {output}")
    return OK
