"""What `handey view` does: a page that plays a plan, or shows why there is none.

Without a plan the task is planned now. Where planning is not possible for the robot, or is stopped,
the page shows the cell and says so. With `--serve` the page is served on the loopback address; it
comes anew whenever the cell file or one that it names is saved.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from handey.commands.ending import INTERRUPTED, OK, interrupts
from handey.commands.terminal import complain, warn
from handey.errors import Fault, InvalidInput
from handey.formats.output import keep_inputs, require_writable

__all__ = ["view_command"]


def view_command(options: argparse.Namespace) -> int:
    """Writes the page, or serves it."""
    if options.serve:
        _refuse(options.output is not None, "--output", "no file is written with --serve")
        with interrupts() as ended:
            from handey.commands.live import serve

            return serve(options, ended)
    _refuse(options.port is not None, "--port", "is used with --serve alone")

    output = Path(options.output or f"{Path(options.cell).stem}.html")
    require_writable(output)
    keep_inputs([options.cell, options.plan], output)
    from handey.commands.looking import look, require_plan_or_report
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


def _told(options: argparse.Namespace, output: Path) -> int:
    if not options.quiet:
        print(f"page: {output}")
    return OK
