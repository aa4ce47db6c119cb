"""The shapes bodies are made of, as triangles: what checker and viewer need to know of them.

Boxes are exact; cylinders and spheres keep their radius for distances (the engine knows them) and
have inscribed triangles for areas and pictures. A mesh is read with trimesh, welded, scaled, and
sorted into convex, closed or open. Not guaranteed: that a closed mesh does not cut itself.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.values import Array, fault

__all__ = [
    "Shape",
    "box",
    "connected_parts",
    "cylinder",
    "mesh",
    "read_mesh",
    "sphere",
    "transformed",
]

logging.getLogger("trimesh").setLevel(logging.ERROR)
MAX_BYTES = 64 * 2**20
SEGMENTS = 96  # of a circle. Choice: 20 mm radius is met within 0.011 mm


@dataclass(frozen=True)
class Shape:
    """A solid (or an open skin) in its own frame.

    Attributes:
        kind: box, cylinder, sphere or mesh.
        size: edge lengths; (radius, length); (radius,); empty for meshes [m].
        pose: in the body (4, 4).
        vertices: (n, 3) in its own frame [m].
        faces: (m, 3) indices, outward counter-clockwise.
        closed: the inside belongs to it.
        convex: it equals its convex hull (to 1e-7 m).
        inside: of a measured solid: which points (n, 3) of its own frame lie in it (n,); None: the
            triangles tell.
        probes: of a measured solid: a vertex of each part of it that does not touch another (k, 3).
        picture: of a measured solid: a coarser one, to be looked at.
        is_measured: made of columns.
    """

    kind: str
    size: tuple[float, ...]
    pose: Array
    vertices: Array
    faces: np.ndarray
    closed: bool = True
    convex: bool = True
    inside: Callable[[Array], np.ndarray] | None = None
    probes: Array | None = None
    picture: Shape | None = None
    is_measured: bool = False

    def points(self) -> Array:
        """The vertices in the body frame (n, 3)."""
        return transformed(self.pose, self.vertices)

    def triangles(self) -> Array:
        """The triangles in the body frame (m, 3, 3)."""
        return np.asarray(self.points()[self.faces])


def transformed(matrix: Array, points: Array) -> Array:
    """Points (..., 3) moved by a homogeneous matrix (4, 4)."""
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])


def box(size: Array, pose: Array) -> Shape:
    """A box of full edge lengths `size`, centred."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * size / 2
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = np.array([[q[0], q[i], q[i + 1]] for q in quads for i in (1, 2)])
    return Shape("box", tuple(map(float, size)), pose, corners, faces)


def cylinder(radius: float, length: float, pose: Array, segments: int = SEGMENTS) -> Shape:
    """A cylinder along z, centred."""
    angle = np.arange(segments) * 2 * np.pi / segments
    ring = np.c_[radius * np.cos(angle), radius * np.sin(angle)]
    half = np.full(segments, length / 2)
    vertices = np.r_[
        np.c_[ring, -half], np.c_[ring, half], [[0, 0, -length / 2], [0, 0, length / 2]]
    ]
    i = np.arange(segments)
    j = (i + 1) % segments
    n = segments
    low, high = np.full(n, 2 * n), np.full(n, 2 * n + 1)
    faces = np.r_[
        np.c_[i, j, j + n], np.c_[i, j + n, i + n], np.c_[low, j, i], np.c_[high, i + n, j + n]
    ]
    return Shape("cylinder", (radius, length), pose, vertices, faces)


def sphere(radius: float, pose: Array) -> Shape:
    """A sphere, centred."""
    import trimesh  # here, because it takes its time

    ball = trimesh.creation.icosphere(subdivisions=4, radius=radius)
    return Shape("sphere", (radius,), pose, np.array(ball.vertices), np.array(ball.faces))


def mesh(vertices: Array, faces: np.ndarray, pose: Array) -> Shape:
    """A mesh: found to be closed or open, convex or not, and turned outward if it is inside out."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    closed = bool(np.all(counts % 2 == 0))
    if closed and _volume(vertices, faces) < 0:
        faces = faces[:, ::-1]
    return Shape("mesh", (), pose, vertices, faces, closed, closed and _is_convex(vertices, faces))


def _volume(vertices: Array, faces: np.ndarray) -> float:
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def _is_convex(vertices: Array, faces: np.ndarray) -> bool:
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    good = length > 1e-14
    if not good.any():
        return False
    normal, offset = normal[good] / length[good, None], a[good]
    for start in range(0, len(normal), 256):
        part = slice(start, start + 256)
        height = vertices @ normal[part].T - np.einsum("ij,ij->i", offset[part], normal[part])
        if height.max() > 1e-7:
            return False
    return True


def connected_parts(shape: Shape) -> list[Shape]:
    """A mesh shape's connected pieces; pieces hold whole triangles."""
    label = np.arange(len(shape.vertices))
    while True:  # each vertex takes the least label of its triangles until nothing changes
        least = label[shape.faces].min(axis=1)
        new = label.copy()
        np.minimum.at(new, shape.faces.ravel(), np.repeat(least, 3))
        new = new[new]
        if np.array_equal(new, label):
            break
        label = new
    parts = []
    for root in np.unique(label[shape.faces[:, 0]]):
        faces = shape.faces[label[shape.faces[:, 0]] == root]
        used, index = np.unique(faces, return_inverse=True)
        parts.append(mesh(shape.vertices[used], index.reshape(-1, 3), shape.pose))
    return parts


def read_mesh(path: Path, scale: Array, pose: Array, file: str, place: str) -> Shape:
    """The mesh in a file, multiplied by `scale` (3,).

    Raises:
        InvalidInput: if there is no such file, or no triangles in it.
    """
    if not path.is_file():
        raise fault("E_PATH", file, place, f"no file {path}")
    if path.stat().st_size > MAX_BYTES:
        raise fault("E_TOO_BIG", file, place, f"{path} is larger than {MAX_BYTES} bytes")
    import trimesh

    try:
        with path.open("rb") as opened:
            loaded: Any = trimesh.load(
                opened, file_type=_kind_of_mesh(path), force="mesh", process=False
            )
        vertices = np.asarray(loaded.vertices, dtype=float) * scale
        faces = np.asarray(loaded.faces, dtype=np.int64)
    except Exception as error:  # the reader raises whatever its formats' readers raise
        raise fault("E_MESH_FORMAT", file, place, f"{path} cannot be read: {error}") from error
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise fault(
            "E_MESH_EMPTY", file, place, f"{path} has no triangles, or vertices that are not finite"
        )
    vertices, faces = _welded(vertices, faces)
    if len(faces) == 0:
        raise fault("E_MESH_DEGENERATE", file, place, f"{path} has only triangles without area")
    return mesh(vertices, faces, pose)


def _kind_of_mesh(path: Path) -> str:
    """The kind of a mesh file as its content shows it, whatever its name ends with."""
    with path.open("rb") as opened:
        start = opened.read(4096)
    text = start.lstrip()
    if text[:4] in (b"ply\n", b"ply\r"):
        return "ply"
    triangles = int.from_bytes(start[80:84], "little") if len(start) >= 84 else 0
    if path.stat().st_size == 84 + 50 * triangles or text[:5].lower() == b"solid":
        return "stl"
    return "obj"


def _welded(vertices: Array, faces: np.ndarray) -> tuple[Array, np.ndarray]:
    """Equal vertices made one (to 1e-8 of the size); triangles that vanish are left out."""
    grain = max(float(np.ptp(vertices, axis=0).max()), 1e-9) * 1e-8
    _, first, index = np.unique(
        np.round(vertices / grain), axis=0, return_index=True, return_inverse=True
    )
    faces = index.reshape(-1)[faces]
    whole = (
        (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    )
    return np.asarray(vertices[first]), faces[whole]
