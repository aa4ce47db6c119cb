"""Does a part stand stably? The region on which it stands, by clipping triangles.

Each downward triangle of the part is cut to each upward triangle below it and to where the vertical
gap is at most 0.6 mm; both are flat, so the gap is linear and the cut is exact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from handey.check.planar import clip, convex_hull, edges, hull_margin, hull_width, unit_normals
from handey.check.values import Array

__all__ = ["Ground", "Standing", "standing_on"]

REST_GAP = 6e-4  # what is this near above a surface stands on it [m]: format
REST_WIDTH = 2e-3  # of the region stood on [m]: format
LEVEL = math.radians(1.0)  # of an upward horizontal face. Choice: the tolerance of faces elsewhere
STEEP = 0.05  # upward part of the normal: steeper faces touch by their neighbours' edges
SLACK = 1e-6  # of rounding [m]


@dataclass
class Ground:
    """A body that a part may stand on: its triangles in the world."""

    name: str
    triangles: Array
    support: bool


@dataclass
class Standing:
    """On what a part stands.

    Attributes:
        hull: of the region stood on, in the world's x, y (k, 2).
        width: of that region [m].
        margin: of the centre of mass within it; negative outside [m].
        grounds: names of the bodies stood on.
    """

    hull: Array
    width: float
    margin: float
    grounds: list[str]

    def fault(self) -> str | None:
        """Why it does not stand stably, or None."""
        if not self.grounds:
            return "stands on nothing"
        where = " and ".join(self.grounds)
        if self.width < REST_WIDTH - SLACK:
            width = f"{self.width * 1e3:.3f} mm wide (2 mm are needed)"
            return f"stands on {where} by a region only {width}"
        if self.margin < -SLACK:
            outside = f"{-self.margin * 1e3:.3f} mm outside what it stands on ({where})"
            return f"tips over: its centre of mass is {outside}"
        return None


def standing_on(
    triangles: Array, centre_of_mass: Array, grounds: list[Ground], horizontal: bool = False
) -> Standing:
    """On what a part stands.

    Args:
        triangles: of the part in the world (m, 3, 3).
        centre_of_mass: in the world (3,).
        grounds: all that it could stand on.
        horizontal: count only faces within 1 degree of upward.
    """
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    down = triangles[unit_normals(triangles)[:, 2] < -STEEP]
    points, names = [np.empty((0, 2))], []
    for ground in grounds:
        near = np.all(ground.triangles.min(axis=1) <= high + REST_GAP, axis=1)
        near &= np.all(ground.triangles.max(axis=1) >= low - REST_GAP, axis=1)
        up = ground.triangles[near]
        up = up[unit_normals(up)[:, 2] > (math.cos(LEVEL) if horizontal else STEEP)]
        found = _contact_points(down, up)
        if len(found):
            points.append(found)
            names.append(ground.name)
    hull = convex_hull(np.vstack(points))
    return Standing(hull, hull_width(hull), hull_margin(hull, centre_of_mass[:2]), names)


def _contact_points(down: Array, up: Array) -> Array:
    """Corners of where downward triangles lie at most 0.6 mm above (or in) upward ones (k, 2)."""
    result = [np.empty((0, 2))]
    if len(down) == 0 or len(up) == 0:
        return result[0]
    up_low, up_high = up.min(axis=1), up.max(axis=1)
    for a in down:
        low, high = a.min(axis=0), a.max(axis=0)
        near = np.all((up_low[:, :2] <= high[:2]) & (up_high[:, :2] >= low[:2]), axis=1)
        near &= (up_high[:, 2] >= low[2] - REST_GAP) & (up_low[:, 2] <= high[2] + REST_GAP)
        for b in up[near]:
            polygon = a[:, :2]
            for p, q in edges(b[:, :2]):  # upward triangles run counter-clockwise seen from above
                outward = np.array([q[1] - p[1], p[0] - q[0]])
                polygon = clip(polygon, outward, float(outward @ p) + 1e-15)
            slope_a, height_a = _plane(a)
            slope_b, height_b = _plane(b)
            gap, level = slope_a - slope_b, height_a - height_b
            polygon = clip(polygon, gap, REST_GAP - level + 1e-12)
            polygon = clip(polygon, -gap, REST_GAP + level + 1e-12)
            if len(polygon):
                result.append(polygon)
    return np.vstack(result)


def _plane(triangle: Array) -> tuple[Array, float]:
    """Z = slope . (x, y) + height of a triangle that is not vertical."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    slope = -normal[:2] / normal[2]
    return slope, float(triangle[0, 2] - slope @ triangle[0, :2])
