"""What the command line says, and in which form.

Results go to standard output as lines for people or as one JSON object; faults and warnings go to
standard error, one line each, whatever a file may have put into a name.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import threading
import time
from collections.abc import Sequence
from typing import Any

from handey.formats.output import finite

__all__ = ["ProgressLine", "complain", "one_line", "tell", "warn"]

REDRAWN_EVERY = 0.1  # Choice: faster than this nobody reads [s]


def complain(text: str) -> None:
    """One line on standard error."""
    print(f"handey: {one_line(text)}", file=sys.stderr)


def one_line(text: str) -> str:
    """The text without line breaks and with control characters made visible."""
    shown = " ".join(text.split())
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in shown)


def tell(options: argparse.Namespace, summary: dict[str, Any], lines: list[str]) -> None:
    """The result, as one JSON object or as lines, on standard output."""
    if options.json:
        print(json.dumps(finite(summary), default=str))
    elif not options.quiet:
        for line in lines:
            print(line)


def warn(options: argparse.Namespace, warnings: Sequence[str]) -> None:
    """The warnings, on standard error."""
    if not options.quiet:
        for warning in warnings:
            complain(f"warning: {warning}")


class ProgressLine:
    """One line on the terminal that tells how far planning is; wiped in the end.

    Attributes:
        shown: standard error is a terminal, and neither quiet nor JSON is asked for.
    """

    def __init__(self, options: argparse.Namespace) -> None:
        able = sys.stderr.isatty() and os.environ.get("TERM") != "dumb"
        self.shown = able and not (options.quiet or options.json)
        self._lock = threading.Lock()
        self._drawn: float | None = None
        self._ended = False

    def show(self, stage: str, detail: str = "") -> None:
        """Tell where planning is, unless that has just been told."""
        now = time.monotonic()
        with self._lock:
            fresh = self._drawn is None or now - self._drawn >= REDRAWN_EVERY
            if not self.shown or self._ended or not fresh:
                return
            self._drawn = now
            text = one_line(f"{stage}: {detail}" if detail else stage)
            width = shutil.get_terminal_size().columns - 1
            sys.stderr.write(f"\r\033[K{text[:width]}")
            sys.stderr.flush()

    def end(self) -> None:
        """Wipe the line; nothing is shown after that."""
        with self._lock:
            if self._drawn is not None and not self._ended:
                sys.stderr.write("\r\033[K")
                sys.stderr.flush()
            self._ended = True
