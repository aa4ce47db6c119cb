"""Which shapes, and where, does the cell file give a fixture or a part?

A body has exactly one of `box`, `cylinder`, `sphere`, `mesh`, `shapes`; shapes do not nest. What is
read here is data; mesh files are only looked for, not opened.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from handey.formats.fields import Field
from handey.formats.pose import read_pose

__all__ = ["BodyEntry", "Box", "Cylinder", "Mesh", "ShapeEntry", "Sphere", "read_body"]

FRICTION = 0.4  # default of the format, between part and pads
LARGEST = 100.0  # Choice: a larger box, cylinder or sphere is a wrong unit [m]
_KINDS = ("box", "cylinder", "sphere", "mesh")


@dataclass(frozen=True)
class Box:
    """Full edge lengths, centred [m]."""

    size: np.ndarray


@dataclass(frozen=True)
class Cylinder:
    """Along z, centred [m]."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """Centred [m]."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A mesh file; `scale` is metres per unit of the file."""

    file: Path
    scale: float


@dataclass(frozen=True)
class ShapeEntry:
    """A geometry at its pose (4, 4) in the body; `place` is where the file gives it."""

    geometry: Box | Cylinder | Sphere | Mesh
    X_BS: np.ndarray
    field: Field


@dataclass(frozen=True)
class BodyEntry:
    """A fixture or a part as the cell file gives it.

    Attributes:
        name: in the cell.
        is_part: can be picked up.
        shapes: at least one.
        X_WB: the body in the world (4, 4).
        support: parts may be put down on it between regrasps.
        friction: between part and pads.
        mass: [kg].
        density: [kg/m3].
        may_move: may be moved although no goal names it.
        field: where the file gives it.
    """

    name: str
    is_part: bool
    shapes: tuple[ShapeEntry, ...]
    X_WB: np.ndarray
    support: bool
    friction: float
    mass: float | None
    density: float | None
    may_move: bool
    field: Field


def read_body(name: str, field: Field, is_part: bool) -> BodyEntry | None:
    """Reads one fixture or part; None and faults if it is wrong."""
    optional = [*_KINDS, "scale", "shapes", "pose", "support", "mass", "density"]
    optional += ["friction", "may_move"] if is_part else []
    entries = field.mapping(optional=optional)
    if entries is None:
        return None
    faults_before = len(field.document.faults)
    X_WB = read_pose(entries["pose"]) if "pose" in entries else np.eye(4)
    shapes = _read_shapes(field, entries)
    flags = {key: key in entries and entries[key].flag() for key in ("support", "may_move")}
    friction = (
        entries["friction"].number(above=0.0, most=10.0) if "friction" in entries else FRICTION
    )
    mass = entries["mass"].number(above=0.0) if "mass" in entries else None
    density = entries["density"].number(above=0.0) if "density" in entries else None
    if len(field.document.faults) > faults_before or X_WB is None or friction is None:
        return None
    return BodyEntry(
        name, is_part, tuple(shapes), X_WB, bool(flags["support"]), friction, mass, density,
        bool(flags["may_move"]), field,
    )  # fmt: skip


def _read_shapes(field: Field, entries: dict[str, Field]) -> list[ShapeEntry]:
    kind = field.one_of((*_KINDS, "shapes"))
    if kind is None:
        return []
    if kind != "shapes":
        shape = _read_geometry(kind, entries, np.eye(4))
        return [shape] if shape else []
    if "scale" in entries:
        entries["scale"].fault("E_UNKNOWN_KEY", "scale belongs to the mesh among the shapes")
    items = entries["shapes"].items() or []
    if isinstance(entries["shapes"].value, list) and not items:
        entries["shapes"].fault("E_TYPE", "expected at least one shape, found none")
    shapes = [_read_shape(item) for item in items]
    return [shape for shape in shapes if shape is not None]


def _read_shape(field: Field) -> ShapeEntry | None:
    """One of several shapes in a body."""
    entries = field.mapping(optional=(*_KINDS, "scale", "pose"))
    if entries is None:
        return None
    X_BS = read_pose(entries["pose"]) if "pose" in entries else np.eye(4)
    kind = field.one_of(_KINDS)
    return None if kind is None else _read_geometry(kind, entries, X_BS)


def _read_geometry(
    kind: str, entries: dict[str, Field], X_BS: np.ndarray | None
) -> ShapeEntry | None:
    entry = entries[kind]
    scale: float | None = 1.0
    if "scale" in entries:
        scale = entries["scale"].number()
        if scale is not None and scale <= 0:
            entries["scale"].fault("E_SCALE", f"expected a scale greater than 0, found {scale:g}")
        if kind != "mesh":
            entries["scale"].fault("E_UNKNOWN_KEY", f"scale belongs to a mesh, not to a {kind}")
    geometry: Box | Cylinder | Sphere | Mesh | None = None
    if kind == "box":
        size = entry.numbers(3, above=0.0, most=LARGEST)
        geometry = None if size is None else Box(size)
    elif kind == "mesh":
        path = entry.file()
        geometry = None if path is None or scale is None else Mesh(path, scale)
    else:
        keys = ("radius", "length") if kind == "cylinder" else ("radius",)
        sizes = entry.mapping(required=keys) or {}
        read = [sizes[key].number(above=0.0, most=LARGEST) for key in keys if key in sizes]
        values = [value for value in read if value is not None]
        if len(values) == len(keys):
            geometry = Cylinder(*values) if kind == "cylinder" else Sphere(*values)
    return None if geometry is None or X_BS is None else ShapeEntry(geometry, X_BS, entry)
