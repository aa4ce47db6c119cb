"""Maps of heights as obstacles: closed surfaces.

A map of heights stands for one square column per entry; what was not measured is as high as the
highest. The surface of all columns is one mesh: tops, bottoms and the walls where neighbours
differ.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from handey.check.shapes import Shape
from handey.check.values import Array, fault

__all__ = ["column_surface", "read_heights", "surface_of"]


def read_heights(path: Path, file: str, place: str) -> Array:
    """A map of heights (rows, columns) [m]; NaN becomes the highest measured entry."""
    try:
        heights = np.load(path, allow_pickle=False)
    except (OSError, ValueError, TypeError) as error:
        raise fault("E_NPY", file, place, f"{path} cannot be read: {error}") from error
    if heights.ndim != 2 or heights.size == 0 or not np.issubdtype(heights.dtype, np.number):
        raise fault("E_NPY", file, place, f"{path}: expected a 2-D array of numbers")
    heights = heights.astype(float)
    if np.isinf(heights).any() or np.isnan(heights).all():
        raise fault("E_NPY", file, place, f"{path}: infinite heights, or nothing measured")
    return np.asarray(np.where(np.isnan(heights), np.nanmax(heights), heights))


def column_surface(heights: Array, side: float) -> Shape:
    """The surface of the columns: entry [0, 0] centred on the origin, rows along +y."""
    h = np.pad(np.maximum(heights, 0.0), 1)
    quads: list[Array] = []
    rows, columns = np.nonzero(h)
    x, y, top = (columns - 1) * side, (rows - 1) * side, h[rows, columns]
    d = side / 2
    for z, order in ((top, (0, 1, 2, 3)), (np.zeros_like(top), (0, 3, 2, 1))):
        corners = [(x - d, y - d, z), (x + d, y - d, z), (x + d, y + d, z), (x - d, y + d, z)]
        quads.append(np.stack([np.stack(corners[i], axis=-1) for i in order], axis=1))
    for axis in (0, 1):
        a = h[:-1, 1:-1] if axis == 0 else h[1:-1, :-1]
        b = h[1:, 1:-1] if axis == 0 else h[1:-1, 1:]
        rows, columns = np.nonzero(a != b)
        za, zb = a[rows, columns], b[rows, columns]
        if axis == 0:  # the wall stands between row `rows` and the next, seen along +y
            edge = (rows - 1) * side + d
            left, right = ((columns * side) + d, (columns * side) - d)
            ends = [(left, edge), (right, edge)]
        else:
            edge = (columns - 1) * side + d
            ends = [(edge, rows * side - d), (edge, rows * side + d)]
        (x0, y0), (x1, y1) = [(p[0], p[1]) for p in ends]
        # Seen from b's side when a is the higher: counter-clockwise; the other way round it turns
        # by itself.
        corners = [(x0, y0, zb), (x1, y1, zb), (x1, y1, za), (x0, y0, za)]
        quads.append(np.stack([np.stack(corner, axis=-1) for corner in corners], axis=1))
    return surface_of(np.vstack(quads))


def surface_of(quads: Array) -> Shape:
    """Quads (n, 4, 3) as one closed surface; equal vertices are made one."""
    n = len(quads)
    corners = np.arange(4 * n).reshape(n, 4)
    faces = np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    points, index = np.unique(np.round(quads.reshape(-1, 3), 9), axis=0, return_inverse=True)
    return Shape("mesh", (), np.eye(4), points, index.reshape(-1)[faces], closed=True, convex=False)
