"""What there is to show of a cell: a plan or report file, or what planning gives now."""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import dataclass, field
from typing import Any

from handey._core import CancelToken
from handey.commands.ending import DeadlinePassedError
from handey.commands.plan import plan_and_check
from handey.commands.terminal import ProgressLine, complain
from handey.errors import InvalidInput
from handey.formats.strict_json import read_json
from handey.plan import Plan
from handey.reporting.report import Report
from handey.reporting.report_file import is_report, read_report_file

__all__ = ["Seen", "look", "require_plan_or_report"]


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


def require_plan_or_report(path: str) -> None:
    """What is neither is bad input, with every fault of it.

    Raises:
        InvalidInput: all faults found.
    """
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
        _, result, checked = plan_and_check(options, start, cancel, line)
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
