"""Is the value at this place what it must be?

Reads structured values and notes every fault with its place. A `Field` is a value and where it
stands in its document. A method that finds something wrong notes the fault and returns None, so
that one pass over a file finds all of its faults; the caller raises them together at the end.
"""

from __future__ import annotations

import difflib
import math
import os
import re
import stat
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from handey.formats.strict_yaml import Document, Place, dotted

__all__ = ["Field", "nearest"]

_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*://")


def nearest(name: str, legal: Iterable[str]) -> str:
    """For a message: the legal names, the most similar one first named."""
    names = sorted(legal)
    if not names:
        return "there are none"
    close = difflib.get_close_matches(name[:100], names, n=1, cutoff=0.5)
    shown = ", ".join(names[:12]) + (f", ... ({len(names)} in all)" if len(names) > 12 else "")
    return (f"did you mean '{close[0]}'? " if close else "") + f"legal: {shown}"


def kind_of(value: Any) -> str:
    """What a value is, for people."""
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"the truth value {str(value).lower()}"
    if isinstance(value, (int, float)):
        return f"the number {value}"
    if isinstance(value, str):
        return f"the text '{value[:60]}'"
    if isinstance(value, (list, tuple, np.ndarray)):
        return f"a list of {len(value)}"
    return "a mapping" if isinstance(value, dict) else f"a {type(value).__name__}"


@dataclass(frozen=True)
class Field:
    """A value and its place in a document."""

    document: Document
    place: Place
    value: Any

    def __str__(self) -> str:
        return dotted(self.place)

    def fault(self, code: str, message: str) -> None:
        """Notes that something is wrong here."""
        self.document.fault(self.place, code, message)

    def child(self, step: str | int, value: Any) -> Field:
        """A value in this one."""
        return Field(self.document, (*self.place, step), value)

    def mapping(
        self, required: Iterable[str] = (), optional: Iterable[str] = ()
    ) -> dict[str, Field] | None:
        """The entries of a mapping that has these keys and no others."""
        if not isinstance(self.value, dict):
            self.fault("E_TYPE", f"expected a mapping, found {kind_of(self.value)}")
            return None
        legal = [*required, *optional]
        entries = {}
        for key, value in self.value.items():
            entry = self.child(str(key), value)
            if key in legal:
                entries[key] = entry
            else:
                entry.fault("E_UNKNOWN_KEY", f"unknown key '{key}'; {nearest(str(key), legal)}")
        for key in required:
            if key not in self.value:
                self.child(key, None).fault("E_MISSING", f"key '{key}' is missing")
        return entries

    def mapping_of_anything(self) -> dict[str, Any]:
        """A mapping whose content is not looked at."""
        if not isinstance(self.value, dict):
            self.fault("E_TYPE", f"expected a mapping, found {kind_of(self.value)}")
            return {}
        return self.value

    def named(self) -> dict[str, Field]:
        """The entries of a mapping from names to anything; empty where nothing is written."""
        if self.value is None:
            return {}
        if not isinstance(self.value, dict):
            self.fault("E_TYPE", f"expected a mapping of names, found {kind_of(self.value)}")
            return {}
        entries = {}
        for name, value in self.value.items():
            entry = self.child(str(name), value)
            if not isinstance(name, str) or not name.strip() or not name.isprintable():
                entry.fault("E_NAME", f"{kind_of(name)} is no name: expected a printable text")
            else:
                entries[name] = entry
        return entries

    def one_of(self, legal: tuple[str, ...]) -> str | None:
        """The only key of a mapping that is one of `legal`; a fault if there are more or none."""
        if not isinstance(self.value, dict):
            return None  # noted by `mapping`
        given = [key for key in legal if key in self.value]
        if len(given) == 1:
            return given[0]
        if given:
            self.fault("E_TYPE", f"has {' and '.join(given)}; expected one of them")
        else:
            self.fault("E_MISSING", f"expected one of {', '.join(legal)}; found none of them")
        return None

    def items(self, count: int | None = None) -> list[Field] | None:
        """The entries of a list, `count` of them if given."""
        if not isinstance(self.value, (list, tuple)):
            self.fault("E_TYPE", f"expected a list, found {kind_of(self.value)}")
            return None
        if count is not None and len(self.value) != count:
            self.fault("E_TYPE", f"expected {count} entries, found {len(self.value)}")
            return None
        return list(self._entries())

    def _entries(self) -> Iterator[Field]:
        return (self.child(index, value) for index, value in enumerate(self.value))

    def number(
        self, above: float | None = None, least: float | None = None, most: float | None = None
    ) -> float | None:
        """A finite number within limits."""
        value = self.value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self.fault("E_TYPE", f"expected a number, found {kind_of(value)}")
            return None
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            self.fault("E_NUMBER", f"expected a finite number, found {number}")
            return None
        if above is not None and not number > above:
            self.fault("E_RANGE", f"expected a number greater than {above:g}, found {number:g}")
            return None
        if (least is not None and number < least) or (most is not None and number > most):
            low = "" if least is None else f" at least {least:g}"
            high = "" if most is None else f" at most {most:g}"
            self.fault(
                "E_RANGE",
                f"expected a number{low}{' and' if low and high else ''}{high}, found {number:g}",
            )
            return None
        return number

    def numbers(
        self, count: int | None = None, code: str = "E_TYPE", **limits: float
    ) -> np.ndarray | None:
        """A list of finite numbers; `code` is the fault if there are not `count`."""
        if not isinstance(self.value, (list, tuple)):
            expected = "a list of numbers" if count is None else f"a list of {count} numbers"
            self.fault("E_TYPE", f"expected {expected}, found {kind_of(self.value)}")
            return None
        if count is not None and len(self.value) != count:
            self.fault(code, f"expected {count} numbers, found {len(self.value)}")
            return None
        numbers = [entry.number(**limits) for entry in self._entries()]
        return None if None in numbers else np.array(numbers, dtype=float)

    def text(self) -> str | None:
        """A text that is not empty and can be printed."""
        if not isinstance(self.value, str):
            self.fault("E_TYPE", f"expected a text, found {kind_of(self.value)}")
            return None
        if not self.value.strip() or not self.value.isprintable():
            self.fault(
                "E_NAME", f"expected a printable text that is not empty, found {self.value[:60]!r}"
            )
            return None
        return self.value

    def texts(self, count: int | None = None) -> list[str] | None:
        """A list of texts, `count` of them if given."""
        entries = self.items(count)
        if entries is None:
            return None
        texts = [entry.text() for entry in entries]
        return None if None in texts else [text for text in texts if text is not None]

    def flag(self) -> bool | None:
        """True or false."""
        if not isinstance(self.value, bool):
            self.fault("E_TYPE", f"expected true or false, found {kind_of(self.value)}")
            return None
        return self.value

    def count(self) -> int | None:
        """A whole number, not negative."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            self.fault("E_TYPE", f"expected a whole number, found {kind_of(self.value)}")
            return None
        if self.value < 0:
            self.fault("E_RANGE", f"expected 0 or more, found {self.value}")
            return None
        return self.value

    def choice(self, *legal: str) -> str | None:
        """One of a few words."""
        if self.value not in legal or not isinstance(self.value, str):
            self.fault("E_TYPE", f"expected {' or '.join(legal)}, found {kind_of(self.value)}")
            return None
        return self.value

    def version(self, expected: int) -> None:
        """The version of the format."""
        if (
            isinstance(self.value, bool)
            or not isinstance(self.value, int)
            or self.value != expected
        ):
            self.fault("E_VERSION", f"expected version {expected}, found {kind_of(self.value)}")

    def reference(self, kind: str, legal: Iterable[str]) -> str | None:
        """The name of something that exists."""
        name = self.text()
        names = list(legal)
        if name is None or name in names:
            return name
        self.fault("E_REF", f"there is no {kind} '{name}'; {nearest(name, names)}")
        return None

    def file(self) -> Path | None:
        """The path of an existing regular file, relative to the document's folder."""
        name = self.text()
        if name is None:
            return None
        if _URL.match(name):
            self.fault("E_PATH", f"'{name}' is a URL; only files are read")
            return None
        path = self.document.folder / name
        try:
            mode = os.stat(path).st_mode
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            self.fault("E_PATH", f"'{name}' cannot be read: {reason} (looked at {path})")
            return None
        if not stat.S_ISREG(mode):
            what = "a folder" if stat.S_ISDIR(mode) else "not a regular file"
            self.fault("E_PATH", f"'{name}' is {what}; a file is expected")
            return None
        return path
