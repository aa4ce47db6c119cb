"""Maps of heights as obstacles: closed surfaces.

A map of heights stands for one square column per entry; what was not measured is as high as the
highest. The surface of all columns is one mesh: tops, bottoms and the walls where neighbours
differ.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

from handey.check.shapes import Shape
from handey.check.values import Array, fault

__all__ = [
    "column_surface",
    "group_for",
    "heights_solid",
    "joined",
    "pooled",
    "probes_of",
    "read_heights",
    "surface_of",
]

PICTURE_COLUMNS = 8000  # Choice: a page of about 3 MB


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


def heights_solid(heights: Array, side: float) -> Shape:
    """The columns as one solid: entry [0, 0] centred on the origin, rows along +y."""
    high = np.where(heights > 0, heights, np.nan)
    where = probes_of(np.zeros_like(heights), high)
    probes = np.stack([where[1] - 0.5, where[0] - 0.5, np.zeros(len(where[0]))], axis=-1) * side

    def inside(points: Array) -> np.ndarray:
        i, j = (np.floor(points[:, k] / side + 0.5) for k in (1, 0))
        result = (i >= 0) & (i < heights.shape[0]) & (j >= 0) & (j < heights.shape[1])
        z = points[result, 2]
        result[result] = (z >= 0) & (z <= heights[i[result].astype(int), j[result].astype(int)])
        return np.asarray(result)

    group = group_for(heights.size)
    picture = column_surface(-pooled(-heights, group), side * group)
    first = np.array([(group - 1) / 2 * side, (group - 1) / 2 * side, 0.0])
    picture = replace(picture, vertices=picture.vertices + first)
    return replace(column_surface(heights, side), inside=inside, probes=probes, picture=picture)


def group_for(count: int) -> int:
    """How many columns to a side become one in pictures."""
    return max(1, math.ceil(math.sqrt(count / PICTURE_COLUMNS)))


def pooled(values: Array, group: int) -> Array:
    """The least of each square of `group` x `group` values; NaN where all are."""
    rows, columns = (-(-n // group) for n in values.shape)
    whole = np.full((rows * group, columns * group), np.inf)
    whole[: values.shape[0], : values.shape[1]] = np.where(np.isnan(values), np.inf, values)
    least = whole.reshape(rows, group, columns, group).min(axis=(1, 3))
    return np.asarray(np.where(np.isinf(least), np.nan, least))


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


def probes_of(low: Array, high: Array) -> tuple[np.ndarray, ...]:
    """One column of each group of columns that touch; NaN is no column. Rows and columns."""
    full = np.isfinite(low) & np.isfinite(high)
    index = np.arange(low.size).reshape(low.shape)
    pairs = []
    for a, b in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        meet = full[a] & full[b]
        meet &= (np.maximum(low[a], low[b]) <= np.minimum(high[a], high[b])) & meet
        pairs.append(np.stack([index[a][meet], index[b][meet]]))
    label = joined(low.size, np.hstack(pairs))
    first = np.unique(label[full.ravel()])
    return np.unravel_index(first, low.shape)


def joined(count: int, pairs: np.ndarray) -> np.ndarray:
    """For each of `count` things the least thing that pairs (2, n) join it to (count,)."""
    label = np.arange(count)
    while True:
        a, b = label[pairs[0]], label[pairs[1]]
        apart = a != b
        if not apart.any():
            return label
        pairs, a, b = pairs[:, apart], a[apart], b[apart]
        np.minimum.at(label, np.maximum(a, b), np.minimum(a, b))
        while True:
            further = label[label]
            if np.array_equal(further, label):
                break
            label = further


def surface_of(quads: Array) -> Shape:
    """Quads (n, 4, 3) as one closed surface; equal vertices are made one."""
    n = len(quads)
    corners = np.arange(4 * n).reshape(n, 4)
    faces = np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    points = np.round(quads.reshape(-1, 3), 9)
    # Equal points have equal sums; different ones with equal sums are left as they are.
    sums = points[:, 0] + np.sqrt(2.0) * points[:, 1] + np.sqrt(3.0) * points[:, 2]
    _, first, index = np.unique(sums, return_index=True, return_inverse=True)
    apart = np.any(points[first][index.reshape(-1)] != points, axis=1)
    index = index.reshape(-1)
    index[apart] = len(first) + np.arange(apart.sum())
    points = np.vstack([points[first], points[apart]])
    return Shape(
        "mesh", (), np.eye(4), points, index.reshape(-1)[faces], True, False, is_measured=True
    )
