"""Does a part stand within the walls of an open box or tray?

It does if the walls enclose all that it stands on, and if no part of it reaches out over the
fixture seen from above. Enclosed: from each corner of what it stands on, a wall that rises at least
2 mm over its lowest point is met in every horizontal direction. The section of the walls at that
height, seen from the corner, covers the whole circle.
"""

from __future__ import annotations

import math

import numpy as np

from handey.check.planar import convex_hull, hull_margin
from handey.check.values import Array

__all__ = ["walls_fault"]

LEAST_WALL = 2e-3  # Choice: a lip that holds a part [m]
WITHIN = 1e-4  # corners may touch the walls; overhang by rounding [m]
GAP = 1e-3  # walls that leave less than this open are closed [rad]


def walls_fault(name: str, walls: Array, triangles: Array, stood_on: Array) -> str | None:
    """Why a part is not within the walls of a fixture, or None.

    Args:
        name: of the fixture.
        walls: its triangles in the world (m, 3, 3).
        triangles: of the part in the world (n, 3, 3).
        stood_on: hull of what the part stands on, in the world's x, y (k, 2).
    """
    outline = convex_hull(walls.reshape(-1, 3)[:, :2])
    over = -min(hull_margin(outline, corner[:2]) for corner in triangles.reshape(-1, 3))
    if over > WITHIN:
        return f"reaches {over * 1e3:.1f} mm out of {name}"
    level = float(triangles[..., 2].min()) + LEAST_WALL
    section = _section(walls, level)
    middle = stood_on.mean(axis=0)
    for corner in stood_on:
        inward = middle - corner
        length = float(np.linalg.norm(inward))
        point = corner + inward * min(1.0, WITHIN / max(length, 1e-12))
        if not _is_enclosed(point, section):
            return f"stands where no walls of {name} enclose it, {LEAST_WALL * 1e3:g} mm higher"
    return None


def _section(triangles: Array, level: float) -> Array:
    """Where triangles cross a height: segments in the plane (k, 2, 2)."""
    segments = []
    above = triangles[..., 2] > level
    for triangle, high in zip(triangles, above, strict=True):
        if high.all() or not high.any():
            continue
        ends = []
        for i in range(3):
            a, b = triangle[i], triangle[(i + 1) % 3]
            if (a[2] > level) != (b[2] > level):
                ends.append((a + (level - a[2]) / (b[2] - a[2]) * (b - a))[:2])
        segments.append(ends)
    return np.array(segments, dtype=float).reshape(-1, 2, 2)


def _is_enclosed(point: Array, section: Array) -> bool:
    """Is a segment met in every direction?"""
    if not len(section):
        return False
    start, end = (np.arctan2(*(section[:, i] - point).T[::-1]) for i in (0, 1))
    turn = (end - start + math.pi) % (2 * math.pi) - math.pi
    first = np.where(turn >= 0, start, end) % (2 * math.pi)
    spans = sorted(zip(first, first + np.abs(turn), strict=True))
    # Once round, from the first span on; those that begin before the end of the circle go on.
    reached = spans[0][0]
    for low, high in [*spans, *((low + 2 * math.pi, high + 2 * math.pi) for low, high in spans)]:
        if low > reached + GAP:
            return False
        reached = max(reached, high)
        if reached >= spans[0][0] + 2 * math.pi:
            return True
    return False
