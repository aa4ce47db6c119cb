"""What `handey check` does: the independent replay of a plan, fault by fault."""

from __future__ import annotations

import argparse
import math

import handey
from handey.commands.ending import NOT_VALID, OK, within
from handey.commands.terminal import one_line, tell

__all__ = ["check_command"]


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
