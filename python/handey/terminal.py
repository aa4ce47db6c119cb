"""What the command line says, and in which form.

Results go to standard output as lines for people or as one JSON object; faults and warnings go to
standard error, one line each, whatever a file may have put into a name.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Sequence
from typing import Any

__all__ = ["complain", "one_line", "tell", "warn"]


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
        print(json.dumps(_finite(summary), default=str))
    elif not options.quiet:
        for line in lines:
            print(line)


def _finite(value: Any) -> Any:
    """JSON has no infinities: null instead."""
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def warn(options: argparse.Namespace, warnings: Sequence[str]) -> None:
    """The warnings, on standard error."""
    if not options.quiet:
        for warning in warnings:
            complain(f"warning: {warning}")
