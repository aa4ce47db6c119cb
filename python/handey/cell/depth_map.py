"""Is this depth map one that can be read, and what does it say of itself?

A depth map is an obstacle known only by measurement: heights above a plane, or distances from a
camera. Its file is checked here as far as its header, size, kind of number and, for arrays, its
values go; nothing is decoded before its size is known. What becomes of it: `handey.cell.measured`.
"""

from __future__ import annotations

import math
import os
import struct
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from handey.formats.fields import Field
from handey.formats.pose import read_pose

__all__ = ["DepthMapEntry", "Intrinsics", "read_depth_map"]

MOST_PIXELS = 1 << 24
MOST_BYTES = 1 << 26
EXPLAINED = 0.005  # default of the format: a pixel this near to a known body belongs to it [m]
FAR = 0.3  # default of the format: space is solid this far behind a pixel [m]
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Intrinsics:
    """A pinhole camera [pixels]."""

    fx: float
    fy: float
    cx: float
    cy: float


@dataclass(frozen=True)
class DepthMapEntry:
    """A depth map as the cell file gives it.

    Attributes:
        name: in the cell.
        kind: ``heights`` or ``depth``.
        file: the array or image.
        shape: rows, columns.
        X_WD: the map, or the camera, in the world (4, 4).
        cell: distance between heights [m]; 0 for depths.
        scale: metres per unit of a depth image.
        intrinsics: of the camera; None for heights.
        explained, far: see the format [m].
        content: the array as it was read, or the unpacked but still filtered rows of an image.
        place: where the file gives it.
    """

    name: str
    kind: str
    file: Path
    shape: tuple[int, int]
    X_WD: np.ndarray
    cell: float = 0.0
    scale: float = 1.0
    intrinsics: Intrinsics | None = None
    explained: float = EXPLAINED
    far: float = FAR
    content: np.ndarray | bytes = field(default=b"", repr=False, compare=False)
    place: Field | None = field(default=None, repr=False, compare=False)


def read_depth_map(name: str, field: Field) -> DepthMapEntry | None:
    """Reads one entry of ``depth_maps``; None and faults if it is wrong."""
    if not isinstance(field.value, dict):
        field.mapping()
        return None
    is_depth = "depth" in field.value
    if is_depth and "heights" in field.value:
        field.fault("E_TYPE", "has both heights and depth; expected one of them")
        return None
    return _read_depth(name, field) if is_depth else _read_heights(name, field)


def _read_heights(name: str, field: Field) -> DepthMapEntry | None:
    entries = field.mapping(required=("heights", "cell"), optional=("pose",))
    if entries is None:
        return None
    cell = entries["cell"].number(above=0.0, most=1.0) if "cell" in entries else None
    X_WD = read_pose(entries["pose"]) if "pose" in entries else np.eye(4)
    path = entries["heights"].file() if "heights" in entries else None
    array = None if path is None else _read_array(entries["heights"], path)
    if array is None:
        return None
    if array.dtype.kind != "f":
        message = f"holds {array.dtype} numbers of unknown unit; expected floating-point metres"
        entries["heights"].fault("E_UNITS", message)
        return None
    _require_measured(entries["heights"], array)
    if cell is None or X_WD is None or path is None:
        return None
    return DepthMapEntry(
        name, "heights", path, (array.shape[0], array.shape[1]), X_WD, cell, content=array,
        place=entries["heights"],
    )  # fmt: skip


def _read_depth(name: str, field: Field) -> DepthMapEntry | None:
    entries = field.mapping(
        required=("depth", "intrinsics"), optional=("scale", "pose", "explained", "far")
    )
    assert entries is not None
    scale = entries["scale"].number(above=0.0, most=100.0) if "scale" in entries else 1.0
    X_WD = read_pose(entries["pose"]) if "pose" in entries else np.eye(4)
    explained = (
        entries["explained"].number(least=0.0, most=0.5) if "explained" in entries else EXPLAINED
    )
    far = entries["far"].number(above=0.0, most=100.0) if "far" in entries else FAR
    path = entries["depth"].file()
    content = None if path is None else _depth_content(entries["depth"], path, "scale" in entries)
    shape = None if content is None else content[0]
    intrinsics = _read_intrinsics(entries["intrinsics"], shape) if "intrinsics" in entries else None
    if path is None or content is None or intrinsics is None or X_WD is None:
        return None
    if scale is None or explained is None or far is None:
        return None
    return DepthMapEntry(
        name, "depth", path, content[0], X_WD, 0.0, scale, intrinsics, explained, far, content[1],
        entries["depth"],
    )  # fmt: skip


def _read_intrinsics(field: Field, shape: tuple[int, int] | None) -> Intrinsics | None:
    entries = field.mapping(required=("fx", "fy", "cx", "cy"))
    if entries is None or len(entries) < 4:
        return None
    values = {}
    for key, entry in entries.items():
        value = entry.value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            entry.number()  # notes the fault
        elif not np.isfinite(value) or (key in ("fx", "fy") and value <= 0):
            expected = (
                "a finite number greater than 0" if key in ("fx", "fy") else "a finite number"
            )
            entry.fault("E_CAMERA", f"expected {expected} [pixels], found {value}")
        else:
            values[key] = float(value)
    if shape is not None:
        for key, size, what in (("cx", shape[1], "columns"), ("cy", shape[0], "rows")):
            if key in values and not 0 <= values[key] <= size:
                message = f"{values[key]:g} lies outside the image, which has {size} {what}"
                entries[key].fault("E_CAMERA", message)
                return None
    return Intrinsics(**values) if len(values) == 4 else None


def _depth_content(
    field: Field, path: Path, has_scale: bool
) -> tuple[tuple[int, int], np.ndarray | bytes] | None:
    """Rows and columns of a depth image, and what it holds, checked."""
    content: np.ndarray | bytes
    if path.suffix.lower() == ".png":
        found = _read_png(field, path)
        if found is None:
            return None
        shape, content = found
        whole = True
    else:
        array = _read_array(field, path)
        if array is None:
            return None
        shape, content, whole = (array.shape[0], array.shape[1]), array, array.dtype.kind != "f"
        _require_measured(field, array)
        _require_not_negative(field, array)
    if whole and not has_scale:
        field.fault(
            "E_UNITS", "holds whole numbers of unknown unit; expected `scale`, the metres per unit"
        )
        return None
    return shape, content


def _read_array(field: Field, path: Path) -> np.ndarray | None:
    """A 2-D array of real numbers; its header is looked at before memory is taken."""
    if path.suffix.lower() != ".npy":
        expected = ".npy or .png" if "depth" in field.place[-1:] else ".npy"
        field.fault("E_UNSUPPORTED", f"'{path.name}' has an unknown kind; expected {expected}")
        return None
    try:
        with open(path, "rb") as stream:
            version = np.lib.format.read_magic(stream)
            old = version == (1, 0)
            header = (
                np.lib.format.read_array_header_1_0 if old else np.lib.format.read_array_header_2_0
            )
            shape, _, dtype = header(stream)
        problem = _array_problem(shape, dtype)
        if problem:
            field.fault(problem[0], f"'{path.name}' has {problem[1]}")
            return None
        return np.asarray(np.load(path, mmap_mode="r", allow_pickle=False))
    except Exception as error:  # numpy raises many kinds for a broken file
        reason = (str(error).splitlines() or [type(error).__name__])[0][:200]
        field.fault("E_NPY", f"'{path.name}' is no array of numbers: {reason}")
        return None


def _array_problem(shape: tuple[int, ...], dtype: np.dtype[Any]) -> tuple[str, str] | None:
    """Kind and text of what is wrong with an array of this header, before memory is taken."""
    if dtype.kind not in "fiu":
        return "E_NPY", f"entries of kind {dtype}; expected real numbers"
    if len(shape) != 2:
        return "E_NPY", f"{len(shape)} dimensions; expected 2"
    if 0 in shape:
        return "E_IMAGE", f"{shape[0]} rows and {shape[1]} columns"
    if math.prod(shape) > MOST_PIXELS:
        return "E_TOO_BIG", f"{shape[0]} x {shape[1]} entries; at most {MOST_PIXELS} are read"
    return None


def _require_measured(field: Field, array: np.ndarray) -> None:
    """NaN is 'not measured'; an infinite value is a fault, and so is a map of nothing."""
    if np.isinf(array).any():
        row, column = np.argwhere(np.isinf(array))[0]
        field.fault(
            "E_NUMBER", f"entry [{row}, {column}] is infinite; expected a finite number or NaN"
        )
    elif np.isnan(array).all():
        field.fault("E_IMAGE", "has no measured entry: all are NaN")


def _require_not_negative(field: Field, array: np.ndarray) -> None:
    if array.dtype.kind != "u" and (array < 0).any():
        row, column = np.argwhere(array < 0)[0]
        found = f"entry [{row}, {column}] is {array[row, column]}"
        field.fault("E_NUMBER", f"{found}; expected a depth, or 0 or NaN for not measured")


def _read_png(field: Field, path: Path) -> tuple[tuple[int, int], bytes] | None:
    """Size and rows, still filtered, of a 16-bit grey PNG; its size is checked before unpacking."""
    try:
        if os.path.getsize(path) > MOST_BYTES:
            field.fault("E_TOO_BIG", f"'{path.name}' has more than {MOST_BYTES} bytes")
            return None
        content = path.read_bytes()
    except OSError as error:
        field.fault("E_PATH", f"'{path.name}' cannot be read: {error.strerror}")
        return None
    if not content.startswith(_PNG_SIGNATURE) or content[12:16] != b"IHDR" or len(content) < 33:
        field.fault("E_IMAGE", f"'{path.name}' is no PNG image")
        return None
    columns, rows, bits, colour, _, _, interlace = struct.unpack(">IIBBBBB", content[16:29])
    if rows == 0 or columns == 0:
        field.fault("E_IMAGE", f"'{path.name}' has {rows} rows and {columns} columns")
        return None
    if rows * columns > MOST_PIXELS:
        message = f"'{path.name}' has {rows} x {columns} pixels; at most {MOST_PIXELS} are read"
        field.fault("E_TOO_BIG", message)
        return None
    if (bits, colour, interlace) != (16, 0, 0):
        field.fault("E_IMAGE", f"'{path.name}' is not a 16-bit grey image without interlace")
        return None
    try:
        return (rows, columns), _unpacked(content, rows * (1 + 2 * columns))
    except (ValueError, zlib.error) as error:
        field.fault("E_IMAGE", f"'{path.name}' is damaged: {error}")
        return None


def _unpacked(content: bytes, expected: int) -> bytes:
    """The rows in the chunks of a PNG, which unpack to `expected` bytes.

    Raises:
        ValueError: if the chunks are not whole, or the bytes not as many.
    """
    packed, at = [], len(_PNG_SIGNATURE)
    while at + 12 <= len(content):
        length, kind = struct.unpack(">I4s", content[at : at + 8])
        body, check = content[at + 8 : at + 8 + length], content[at + 8 + length : at + 12 + length]
        if len(check) < 4:
            raise ValueError("it is cut off")
        if zlib.crc32(kind + body) != struct.unpack(">I", check)[0]:
            raise ValueError(f"the checksum of chunk {kind!r} is wrong")
        if kind == b"IDAT":
            packed.append(body)
        if kind == b"IEND":
            break
        at += 12 + length
    else:
        raise ValueError("it is cut off")
    unpacked = zlib.decompressobj().decompress(b"".join(packed), expected + 1)
    if len(unpacked) != expected:
        raise ValueError(f"{len(unpacked)} bytes of pixels, expected {expected}")
    return unpacked
