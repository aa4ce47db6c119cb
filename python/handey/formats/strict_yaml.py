"""Which values does this YAML text hold, and on which line is each?

A strict subset of YAML: one document of mappings, sequences and scalars. Refused, because each has
been taken for something else by somebody: anchors and aliases, tags, duplicate keys, several
documents, tabs that indent, keys that are not plain scalars. Numbers are decimal only: `1e-3` is
one, `010`, `1:30` and `0x1F` are texts; `true` and `false` are the only truth values. The text is
read event by event, so neither deep nesting nor great size costs more than the limits below.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from handey.errors import Fault, InvalidInput

__all__ = ["Document", "Place", "dotted", "read_text", "read_yaml"]

MOST_BYTES = 10 * 1024 * 1024
MOST_DEPTH = 64
MOST_VALUES = 100_000  # Choice: a cell of a thousand bodies has about 20 000

Place = tuple[str | int, ...]

_INTEGER = re.compile(r"[-+]?(0|[1-9][0-9]*)\Z")
_DECIMAL = re.compile(r"[-+]?([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=[eE]))([eE][-+]?[0-9]+)?\Z")
_SPECIAL = re.compile(r"[-+]?\.(inf|Inf|INF)\Z|\.(nan|NaN|NAN)\Z")
_INDENTING_TAB = re.compile(r"^ *\t", re.MULTILINE)
_PARSER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass
class Document:
    """The values of one file.

    Attributes:
        file: the file's name, as messages give it; empty for values passed in a program.
        folder: what relative paths in it are relative to.
        value: mappings, lists, str, int, float, bool, None.
        lines: line of the value at each place, from 1.
        faults: filled by whoever reads the values; each with its line, 0 if not known.
    """

    file: str
    folder: Path
    value: Any
    lines: dict[Place, int] = field(default_factory=dict)
    faults: list[tuple[int, Fault]] = field(default_factory=list)

    def fault(self, place: Place, code: str, message: str) -> None:
        """Notes a fault, with the line of the place or of what it is in."""
        line = next(
            (self.lines[place[:n]] for n in range(len(place), -1, -1) if place[:n] in self.lines), 0
        )
        self.fault_on_line(line, place, code, message)

    def fault_on_line(self, line: int, place: Place, code: str, message: str) -> None:
        """Notes a fault of a known line."""
        where = f" (line {line})" if line else ""
        self.faults.append((line, Fault(code, dotted(place), message + where, self.file)))

    def raise_faults(self) -> None:
        """Raises InvalidInput with the faults noted, if any, in the order of the lines."""
        if self.faults:
            raise InvalidInput(
                [fault for _, fault in sorted(self.faults, key=lambda noted: noted[0])]
            )


def dotted(place: Place) -> str:
    """The place for people: ``task[0].at.xyz``."""
    text = ""
    for step in place:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def read_text(
    path: str | os.PathLike[str], most_bytes: int = MOST_BYTES, code: str = "E_YAML"
) -> str:
    """The text of a regular UTF-8 file that is not too large.

    Args:
        path: the file.
        most_bytes: a larger file is refused before it is read.
        code: of the fault for a file that is too large.

    Raises:
        InvalidInput: E_PATH, E_ENCODING or `code`.
    """
    file = os.fspath(path)
    try:
        status = os.stat(file)
        if not stat.S_ISREG(status.st_mode):
            raise InvalidInput(Fault("E_PATH", "", "is not a regular file", file))
        if status.st_size > most_bytes:
            message = f"has {status.st_size} bytes; at most {most_bytes} are read"
            raise InvalidInput(Fault(code, "", message, file))
        with open(file, "rb") as stream:
            content = stream.read(most_bytes + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        if isinstance(error, InvalidInput):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise InvalidInput(Fault("E_PATH", "", f"cannot be read: {reason}", file)) from error
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = f"is not UTF-8 text: byte 0x{content[error.start]:02x} on line {line}"
        raise InvalidInput(Fault("E_ENCODING", "", message, file)) from error


def read_yaml(path: str | os.PathLike[str]) -> Document:
    """Reads a YAML file strictly.

    Raises:
        InvalidInput: E_PATH, E_ENCODING, E_YAML, E_YAML_ALIAS, E_YAML_TAG, E_DUP.
    """
    text = read_text(path)
    document = Document(os.fspath(path), Path(os.path.abspath(path)).parent, None)
    _Composer(document).compose(text)
    document.raise_faults()
    return document


class _Composer:
    """Builds the values from the parser's events, without recursion."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.open: list[tuple[Place, Any]] = []  # the collections that have not ended
        self.keys: list[str | None] = []  # of each: the key whose value comes next
        self.count = 0

    def refuse(self, code: str, message: str, line: int, place: Place = ()) -> InvalidInput:
        self.document.fault_on_line(line, place, code, message)
        return InvalidInput([fault for _, fault in self.document.faults])

    def compose(self, text: str) -> None:
        tab = _INDENTING_TAB.search(text)
        if tab:
            raise self.refuse(
                "E_YAML", "a tab indents; use spaces", text.count("\n", 0, tab.end()) + 1
            )
        documents = 0
        for event in self.events(text):
            if isinstance(event, yaml.DocumentStartEvent):
                documents += 1
                if documents > 1:
                    line = _line(event)
                    raise self.refuse("E_YAML", "a second document starts; one is expected", line)
            else:
                self.take(event)
        if documents == 0 or self.document.value is None:
            raise InvalidInput(Fault("E_YAML", "", "is empty", self.document.file))

    def events(self, text: str) -> Iterator[yaml.Event]:
        try:
            parser = _PARSER(text)
            try:
                while parser.check_event():
                    yield parser.get_event()
            finally:
                parser.dispose()
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            problem = " ".join(filter(None, (error.context, error.problem))) or "cannot be parsed"
            raise self.refuse(
                "E_YAML", f"is not YAML: {problem}", mark.line + 1 if mark else 1
            ) from error
        except yaml.reader.ReaderError as error:
            line = text.count("\n", 0, error.position) + 1
            raise self.refuse("E_YAML", f"is not YAML: {error.reason}", line) from error
        except (yaml.YAMLError, RecursionError, UnicodeError) as error:
            raise self.refuse("E_YAML", f"is not YAML: {error}", 1) from error

    def take(self, event: yaml.Event) -> None:
        if isinstance(event, (yaml.MappingEndEvent, yaml.SequenceEndEvent)):
            self.open.pop()
            self.keys.pop()
            return
        if not isinstance(event, yaml.NodeEvent):
            return
        line = _line(event)
        self.refuse_what_is_not_plain(event, line)
        if self.open and isinstance(self.open[-1][1], dict) and self.keys[-1] is None:
            self.take_key(event, line)
            return
        place = self.next_place()
        self.document.lines[place] = line
        if isinstance(event, yaml.ScalarEvent):
            self.put(scalar(event.value, event.style))
            return
        if len(self.open) >= MOST_DEPTH:
            raise self.refuse("E_YAML", f"is nested deeper than {MOST_DEPTH} levels", line)
        collection: Any = {} if isinstance(event, yaml.MappingStartEvent) else []
        self.put(collection)
        self.open.append((place, collection))
        self.keys.append(None)

    def refuse_what_is_not_plain(self, event: yaml.NodeEvent, line: int) -> None:
        self.count += 1
        if self.count > MOST_VALUES:
            raise self.refuse("E_YAML", f"has more than {MOST_VALUES} values", line)
        place = self.open[-1][0] if self.open else ()
        if isinstance(event, yaml.AliasEvent):
            raise self.refuse(
                "E_YAML_ALIAS", f"alias '*{event.anchor}': write the value out", line, place
            )
        if event.anchor is not None:
            raise self.refuse(
                "E_YAML_ALIAS", f"anchor '&{event.anchor}': anchors are refused", line, place
            )
        tag = getattr(event, "tag", None)
        if tag is not None:
            raise self.refuse("E_YAML_TAG", f"tag '{tag}': tags are refused", line, place)

    def take_key(self, event: yaml.NodeEvent, line: int) -> None:
        place, mapping = self.open[-1]
        if not isinstance(event, yaml.ScalarEvent):
            raise self.refuse("E_YAML", "a key must be a plain text", line, place)
        key = event.value
        if key in mapping:
            first = self.document.lines.get((*place, key), 0)
            message = f"key '{key}' is given twice, first on line {first}"
            self.document.fault_on_line(line, (*place, key), "E_DUP", message)
        self.keys[-1] = key

    def next_place(self) -> Place:
        if not self.open:
            return ()
        place, collection = self.open[-1]
        step = self.keys[-1] if isinstance(collection, dict) else len(collection)
        assert step is not None
        return (*place, step)

    def put(self, value: Any) -> None:
        if not self.open:
            self.document.value = value
            return
        collection = self.open[-1][1]
        if isinstance(collection, dict):
            collection[self.keys[-1]] = value
            self.keys[-1] = None
        else:
            collection.append(value)


def _line(event: yaml.Event) -> int:
    return event.start_mark.line + 1 if event.start_mark else 0


def scalar(text: str, style: str | None) -> Any:
    """The value of a scalar; one in quotes or in a block is always a text."""
    if style in ("'", '"', "|", ">"):
        return text
    if text in ("", "~", "null"):
        return None
    if text in ("true", "True", "TRUE"):
        return True
    if text in ("false", "False", "FALSE"):
        return False
    if _INTEGER.match(text) and len(text) < 20:  # a longer one is a number, not a count
        return int(text)
    if _INTEGER.match(text) or _DECIMAL.match(text):
        return float(text)
    if _SPECIAL.match(text):
        return float(text.replace(".", "", 1))
    return text
