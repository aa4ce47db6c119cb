"""The live page: watches the files of a cell, plans anew when one is saved, shows what came of it.

One thread serves, one plans, and the main thread watches until Ctrl-C ends all of it at once. A
save while planning is under way stops that planning. A file that cannot be read is shown as its
faults, until it can.
"""

from __future__ import annotations

import argparse
import threading
from pathlib import Path

from handey._core import CancelToken
from handey.commands.ending import OK
from handey.commands.looking import look, require_plan_or_report
from handey.commands.terminal import complain, one_line
from handey.errors import InvalidInput
from handey.view import make_page
from handey.view.page import words_page
from handey.view.server import LiveServer
from handey.view.watch import Watch

__all__ = ["serve"]

LOOKED_AT_EVERY = 0.2  # Choice: a save is seen before the hand is off the key [s]


def serve(options: argparse.Namespace, ended: threading.Event) -> int:
    """Serves until it is ended.

    Args:
        options: of the command line.
        ended: set where Ctrl-C was pressed.

    Raises:
        InvalidInput: E_PORT if the port cannot be had.
    """
    cell = Path(options.cell)
    server = LiveServer(options.port or 0)
    work: _Work | None = None
    try:
        version = server.next_version()
        server.show(words_page(cell.name, "Planning\u2026", [], version), version)
        if not options.quiet:
            print(f"page: {server.address} (Ctrl-C ends)", flush=True)
        watch = Watch(cell, *([Path(options.plan)] if options.plan else []))
        while not ended.is_set():
            if watch.changed():
                if work is not None:
                    work.stop()
                work = _Work(options, server)
            ended.wait(LOOKED_AT_EVERY)
        return OK
    except KeyboardInterrupt:
        return OK
    finally:
        if work is not None:
            work.cancel.cancel()
        server.end()


class _Work:
    """One round: reads, plans, shows."""

    def __init__(self, options: argparse.Namespace, server: LiveServer) -> None:
        self.options, self.server, self.cancel = options, server, CancelToken()
        server.tell_planning()
        self._thread = threading.Thread(target=self._run, daemon=True, name="handey-view")
        self._thread.start()

    def stop(self) -> None:
        """Ends it; it shows nothing any more."""
        self.cancel.cancel()
        self._thread.join()

    def _run(self) -> None:
        version, name = self.server.next_version(), Path(self.options.cell).name
        try:
            page, told = self._look(version)
        except KeyboardInterrupt:  # stopped while the files were read
            return
        except InvalidInput as error:
            faults = [str(fault) for fault in error.faults]
            page, told = words_page(name, "This cannot be read:", faults, version), faults
        except Exception as error:  # a fault of handey: the server goes on
            told = [f"internal error: {type(error).__name__}: {error}"]
            page = words_page(name, "Something went wrong in handey:", told, version)
        if self.cancel.cancelled:
            return
        self.server.show(page, version)
        if not self.options.quiet:
            for line in told:
                complain(one_line(line))

    def _look(self, version: str) -> tuple[str, list[str]]:
        """The page, and what came of it."""
        options = self.options
        if options.plan is not None:
            require_plan_or_report(options.plan)
            return make_page(options.cell, options.plan, version=version), [
                f"{options.plan}: shown"
            ]
        seen = look(options, self.cancel)
        if self.cancel.cancelled:
            return "", []
        page = make_page(options.cell, seen.plan, seen.report, seen.notes, version)
        told = "no plan found" if seen.plan is None else "planned"
        return page, [f"{options.cell}: {told}"]
