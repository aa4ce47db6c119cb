"""Writes a file whole or not at all.

The text goes to a temporary file in the same folder, reaches the disk, and then takes the name:
whoever reads the file finds the old or the new content, never a part. What is no regular file is
never replaced.
"""

from __future__ import annotations

import contextlib
import math
import os
import secrets
import stat
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from handey.errors import Fault, InvalidInput

__all__ = ["finite", "keep_inputs", "require_writable", "write_whole"]

INPUT_KINDS = (".yaml", ".yml", ".urdf", ".stl", ".obj", ".ply", ".npy", ".png")


def require_writable(path: str | os.PathLike[str]) -> Path:
    """The file that `path` leads to, which may be written; to be asked before long work.

    Raises:
        InvalidInput: E_OUTPUT, if the folder is missing or read-only, or no file is there.
    """
    name = os.fspath(path)
    try:
        target = Path(os.path.realpath(name))
        folder = target.parent
        if not folder.is_dir():
            raise _fault(name, f"cannot be written: there is no folder {folder}")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise _fault(name, f"cannot be written: the folder {folder} is read-only")
        if name.endswith(os.sep) or (target.exists() and not stat.S_ISREG(target.stat().st_mode)):
            raise _fault(name, "cannot be written: it is not a regular file")
    except (OSError, ValueError) as error:
        if isinstance(error, InvalidInput):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise _fault(name, f"cannot be written: {reason}") from error
    return target


def keep_inputs(inputs: Sequence[str | None], output: Path) -> None:
    """The output must not replace what is read, or may be read by way of it."""
    if output.suffix.lower() in INPUT_KINDS and output.exists():
        message = (
            f"exists, and ends with {output.suffix} as an input does; the output needs another name"
        )
        raise InvalidInput(Fault("E_OUTPUT", "", message, str(output)))
    for name in inputs:
        if name is not None and os.path.realpath(name) == os.path.realpath(output):
            raise InvalidInput(
                Fault("E_OUTPUT", "", "is read; the output needs another name", str(output))
            )


def write_whole(path: str | os.PathLike[str], text: str) -> None:
    """Writes `text` as UTF-8 to a new or existing file.

    Raises:
        InvalidInput: E_OUTPUT; then nothing has been written and an existing file is as it was.
    """
    target = require_writable(path)
    temporary = target.with_name(f".{target.name[:100]}.{secrets.token_hex(6)}.tmp")
    try:
        # os.open and not tempfile, so that the file has the rights that the user's umask gives.
        descriptor = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(text.encode("utf-8"))
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, target)
    except OSError as error:
        raise _fault(os.fspath(path), f"cannot be written: {error.strerror}") from error
    finally:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
    _sync_folder(target.parent)


def _sync_folder(folder: Path) -> None:
    """Makes the new name last; not every file system can, and the content is safe without."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _fault(name: str, message: str) -> InvalidInput:
    return InvalidInput(Fault("E_OUTPUT", "", message, name))


def finite(value: Any) -> Any:
    """JSON has no infinities: null instead."""
    if isinstance(value, dict):
        return {key: finite(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
