"""Where tables that depend on the robot alone are kept between runs.

`$HANDEY_CACHE` if it is set (empty: nothing is kept on disk), else `handey` in the user's cache
folder: `$XDG_CACHE_HOME`, or `~/.cache`. What is kept there can be deleted at any time: it is made
again when it is needed.
"""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["table_directory"]


def table_directory() -> str:
    """The folder of the tables; empty if nothing is to be kept on disk."""
    named = os.environ.get("HANDEY_CACHE")
    if named is not None:
        return named
    base = os.environ.get("XDG_CACHE_HOME", "")
    if not os.path.isabs(base):  # the specification: a relative path is to be ignored
        try:
            base = str(Path.home() / ".cache")
        except RuntimeError:  # a user without a home
            return ""
    return os.path.join(base, "handey")
