"""Which files a cell is made of, and whether one of them has been saved.

Read loosely: a file that is broken, or half written, must not end the watch. What a file named
before stays watched, so that the next good save is seen.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from handey.errors import InvalidInput
from handey.formats.strict_yaml import read_text, read_yaml

__all__ = ["Watch", "files_of"]

NAMING = ("file", "urdf", "mesh", "heights", "depth")  # keys whose values are paths
MOST_FILES = 2000  # Choice: more cannot be looked at several times a second
_MESH = re.compile(r"filename\s*=\s*[\"']([^\"']+)[\"']")

Signature = tuple[int, int, int] | None


def files_of(cell: Path) -> list[Path]:
    """The cell file and what it names: robot file, URDF, meshes, depth maps; existing or not."""
    found: dict[Path, None] = {}
    waiting = [cell]
    while waiting and len(found) < MOST_FILES:
        path = waiting.pop(0)
        if path in found:
            continue
        found[path] = None
        if path.suffix.lower() in (".yaml", ".yml"):
            waiting += _named_in_yaml(path)
        elif path.suffix.lower() in (".urdf", ".xml"):
            waiting += _named_in_urdf(path)
    return list(found)


def _named_in_yaml(path: Path) -> list[Path]:
    try:
        content = read_yaml(path).value
    except (InvalidInput, OSError):
        return []
    return [path.parent / name for name in _names(content)]


def _names(content: Any) -> list[str]:
    if isinstance(content, list):
        return [name for entry in content for name in _names(entry)]
    if not isinstance(content, dict):
        return []
    named = [v for k, v in content.items() if k in NAMING and isinstance(v, str) and v]
    return named + [name for value in content.values() for name in _names(value)]


def _named_in_urdf(path: Path) -> list[Path]:
    try:
        text = read_text(path)
    except (InvalidInput, OSError):
        return []
    names = []
    for name in dict.fromkeys(_MESH.findall(text)):
        plain = re.sub(r"^package://[^/]*/|^file://", "", name)
        folders = [path.parent, *list(path.parents)[1:4]]
        there = [folder / plain for folder in folders if _exists(folder / plain)]
        names += there[:1]
    return names


def _exists(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


class Watch:
    """Tells when a file of the cell, or a further one, is not what it was."""

    def __init__(self, cell: Path, *others: Path) -> None:
        self._cell, self._others = cell, others
        self._files: dict[Path, None] = {}
        self._seen: dict[Path, Signature] = {}

    def changed(self) -> bool:
        """Has anything been saved since this was last asked? True the first time."""
        if not self._files:
            self._list_files()
        now = {path: _signature(path) for path in self._files}
        if now == self._seen:
            return False
        self._list_files()  # it may name others now
        self._seen = {path: _signature(path) for path in self._files}
        return True

    def _list_files(self) -> None:
        self._files |= dict.fromkeys([*files_of(self._cell), *self._others])


def _signature(path: Path) -> Signature:
    try:
        status = path.stat()
    except (OSError, ValueError):
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
