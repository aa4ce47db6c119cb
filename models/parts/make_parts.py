"""Makes the parts of this folder, and the fixtures in ../cells/meshes, as STL files in millimetres.

Each solid is a set of cells of a rectilinear grid (blocks with steps, slots, windows, engravings)
or the hull of a few points. The part's frame stands at the middle of the underside: z = 0 is the
plane that the part stands on.
Run: python make_parts.py
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent


def write_stl(path: Path, triangles: np.ndarray) -> None:
    """Write triangles of shape (n, 3, 3) [mm], counter-clockwise from outside."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    with path.open("wb") as file:
        file.write(b"handey part, millimetres".ljust(80, b" "))
        file.write(struct.pack("<I", len(triangles)))
        for normal, triangle in zip(normals, triangles, strict=True):
            file.write(struct.pack("<12fH", *normal, *triangle.ravel(), 0))


def grid_solid(
    xs: Sequence[float],
    ys: Sequence[float],
    zs: Sequence[float],
    is_solid: Callable[[float, float, float], bool],
) -> np.ndarray:
    """Surface of the grid cells whose middle `is_solid` accepts: triangles (n, 3, 3) [mm]."""
    edges = [np.asarray(axis, dtype=float) for axis in (xs, ys, zs)]
    middles = [(axis[:-1] + axis[1:]) / 2 for axis in edges]
    filled = np.zeros([len(m) + 2 for m in middles], dtype=bool)
    for i, x in enumerate(middles[0]):
        for j, y in enumerate(middles[1]):
            for k, z in enumerate(middles[2]):
                filled[i + 1, j + 1, k + 1] = is_solid(x, y, z)
    triangles = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for index in np.argwhere(filled):
            for side in (0, 1):
                beyond = index.copy()
                beyond[axis] += 2 * side - 1
                if filled[tuple(beyond)]:
                    continue
                cell = index - 1
                corners = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    point = np.zeros(3)
                    point[axis] = edges[axis][cell[axis] + side]
                    point[u] = edges[u][cell[u] + du]
                    point[v] = edges[v][cell[v] + dv]
                    corners.append(point)
                if side == 0:
                    corners.reverse()
                triangles += [
                    [corners[0], corners[1], corners[2]],
                    [corners[0], corners[2], corners[3]],
                ]
    return np.array(triangles)


def hull_solid(points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]]) -> np.ndarray:
    """A convex solid from its corners and faces (any winding): triangles (n, 3, 3) [mm]."""
    corners = np.asarray(points, dtype=float)
    middle = corners.mean(axis=0)
    triangles = []
    for face in faces:
        loop = corners[list(face)]
        normal = np.cross(loop[1] - loop[0], loop[2] - loop[0])
        if normal @ (loop.mean(axis=0) - middle) < 0:
            loop = loop[::-1]
        triangles += [[loop[0], loop[i], loop[i + 1]] for i in range(1, len(loop) - 1)]
    return np.array(triangles)


def prism(outline: Sequence[Sequence[float]], height: float) -> np.ndarray:
    """A convex outline (x, y) pulled up from z = 0 to `height`."""
    n = len(outline)
    points = [[x, y, 0.0] for x, y in outline] + [[x, y, height] for x, y in outline]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return hull_solid(points, faces)


def toothed(teeth: int, root: float, tip: float, height: float) -> np.ndarray:
    """A wheel with straight-flanked teeth, pulled up from z = 0 to `height`."""
    outline = []
    for tooth in range(teeth):
        for share, radius in ((0.0, root), (0.3, root), (0.42, tip), (0.58, tip), (0.7, root)):
            angle = 2 * np.pi * (tooth + share) / teeth
            outline.append([radius * np.cos(angle), radius * np.sin(angle)])
    n = len(outline)
    triangles = []
    for i in range(n):
        a, b = outline[i], outline[(i + 1) % n]
        low, high = [[*p, 0.0] for p in (a, b)], [[*p, height] for p in (a, b)]
        triangles += [[low[0], low[1], high[1]], [low[0], high[1], high[0]]]
        triangles += [[[0, 0, 0.0], low[1], low[0]], [[0, 0, height], high[0], high[1]]]
    return np.array(triangles, dtype=float)


def make_parts() -> dict[str, np.ndarray]:
    """All parts by name."""
    parts = {}
    parts["block"] = grid_solid([-20, 20], [-30, 30], [0, 50], lambda x, y, z: True)
    parts["l_block"] = grid_solid(
        [-40, -10, 40], [-20, 20], [0, 30, 80], lambda x, y, z: z < 30 or x < -10
    )
    parts["t_block"] = grid_solid(
        [-45, -12, 12, 45], [-20, 20], [0, 60, 85], lambda x, y, z: z > 60 or abs(x) < 12
    )
    parts["u_block"] = grid_solid(
        [-40, -25, 25, 40], [-25, 25], [0, 20, 60], lambda x, y, z: z < 20 or abs(x) > 25
    )
    # An angle bracket with a square window in its upright leg.
    parts["bracket"] = grid_solid(
        [-35, -25, 35],
        [-30, -12, 12, 30],
        [0, 10, 25, 55, 70],
        lambda x, y, z: z < 10 or (x < -25 and not (abs(y) < 12 and 25 < z < 55)),
    )
    parts["stepped_block"] = grid_solid(
        [-45, -15, 15, 45],
        [-22, 22],
        [0, 20, 40, 60],
        lambda x, y, z: z < 20 or (z < 40 and x < 15) or x < -15,
    )
    # Two triangular ends face away from each other; no other pair of faces is parallel.
    parts["wedge"] = hull_solid(
        [[-40, -20, 0], [45, -20, 0], [-10, -20, 55], [-40, 20, 0], [45, 20, 0], [-10, 20, 55]],
        [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    )
    # No two faces are parallel: no parallel jaw can hold it by its faces.
    parts["tetrahedron"] = hull_solid(
        [[-35, -20, 0], [35, -20, 0], [0, 40, 0], [0, 0, 57]],
        [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    )
    # Faces enough, but all wider than a jaw of 100 mm opens.
    parts["big_cube"] = grid_solid([-60, 60], [-60, 60], [0, 120], lambda x, y, z: True)
    angles = np.radians(np.arange(30, 390, 60))
    parts["hex_peg"] = prism([[23 * np.cos(a), 23 * np.sin(a)] for a in angles], 90)
    # No two sides of a pentagon are parallel: each is opposite to an edge.
    angles = np.radians(np.arange(90, 450, 72))
    parts["pentagon"] = prism([[18 * np.cos(a), 18 * np.sin(a)] for a in angles], 40)
    # An odd number of teeth whose tips are too narrow for faces: opposite to a tip is a gap.
    parts["gear"] = toothed(17, 19, 23, 12)
    # A block whose two long sides carry engraved bars, 0.5 mm deep.
    bars = [-22, -18, -10, -6, 2, 6, 14, 18]
    parts["engraved_block"] = grid_solid(
        [-18, -17.5, 17.5, 18],
        [-30, *bars, 30],
        [0, 12, 38, 50],
        lambda x, y, z: (
            not (abs(x) > 17.5 and 12 < z < 38 and any(a < y < a + 4 for a in bars[::2]))
        ),
    )
    parts["cross"] = grid_solid(
        [-40, -12, 12, 40],
        [-40, -12, 12, 40],
        [0, 40],
        lambda x, y, z: abs(x) < 12 or abs(y) < 12,
    )
    return parts


def make_fixtures() -> dict[str, np.ndarray]:
    """Fixtures that need a mesh, by name."""
    tray = grid_solid(
        [-150, -144, 144, 150],
        [-110, -104, 104, 110],
        [0, 5, 35],
        lambda x, y, z: z < 5 or abs(x) > 144 or abs(y) > 104,
    )
    # Hills: 9 800 triangles of one height field over a flat underside; closed and not convex.
    n = 49
    axis = np.linspace(-120, 120, n + 1)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    z = 12 + 8 * np.cos(x / 22) * np.cos(y / 19)
    top = np.stack([x, y, z], axis=-1)
    bottom = np.stack([x, y, np.zeros_like(z)], axis=-1)
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
            triangles += [[top[a], top[b], top[c]], [top[a], top[c], top[d]]]
            triangles += [[bottom[a], bottom[c], bottom[b]], [bottom[a], bottom[d], bottom[c]]]
    ring = [(i, 0) for i in range(n)] + [(n, j) for j in range(n)]
    ring += [(i, n) for i in range(n, 0, -1)] + [(0, j) for j in range(n, 0, -1)]
    for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
        triangles += [[bottom[a], bottom[b], top[b]], [bottom[a], top[b], top[a]]]
    return {"tray": tray, "hills": np.array(triangles)}


def main() -> None:
    """Write all files."""
    for name, triangles in make_parts().items():
        write_stl(HERE / f"{name}.stl", triangles)
    meshes = HERE.parent / "cells" / "meshes"
    meshes.mkdir(parents=True, exist_ok=True)
    for name, triangles in make_fixtures().items():
        write_stl(meshes / f"{name}.stl", triangles)


if __name__ == "__main__":
    main()
