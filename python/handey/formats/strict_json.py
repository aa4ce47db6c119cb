"""Reads a JSON file as it is written: no key twice in one object, no more than can be handled."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from handey.errors import Fault, InvalidInput
from handey.formats.strict_yaml import Document, read_text

__all__ = ["read_json"]

MOST_BYTES = 16 * 1024 * 1024  # Choice: a quarter of an hour of motion in rows of 8 ms


def read_json(path: str | os.PathLike[str]) -> Document:
    """The document; what is in it is for the caller to look at.

    Raises:
        InvalidInput: E_PATH, E_ENCODING, E_TOO_BIG, E_JSON or E_DUP.
    """
    file = os.fspath(path)
    text = read_text(path, MOST_BYTES, code="E_TOO_BIG")
    twice: list[str] = []

    def distinct(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        entries = dict(pairs)
        if len(entries) < len(pairs):
            keys = [key for key, _ in pairs]
            twice.extend(sorted({key for key in keys if keys.count(key) > 1})[:10])
        return entries

    try:
        value = json.loads(text, object_pairs_hook=distinct)
    except json.JSONDecodeError as error:
        message = f"is not JSON: {error.msg} (line {error.lineno}, column {error.colno})"
        raise InvalidInput(Fault("E_JSON", "", message, file)) from error
    except (RecursionError, ValueError) as error:
        message = f"is not JSON that can be read: {str(error)[:200]}"
        raise InvalidInput(Fault("E_JSON", "", message, file)) from error
    document = Document(file, Path(os.path.abspath(path)).parent, value)
    for key in twice:
        document.fault((), "E_DUP", f"key '{key[:60]}' is given twice in one object")
    document.raise_faults()
    return document
