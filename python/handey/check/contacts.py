"""Do the pads lie on the part, and does a part stand stably? Contact areas by clipping triangles.

Pads: the part's triangles are cut to the slab of 0.5 mm about each pad. Standing: each downward triangle is
cut to each upward triangle below it and to where the vertical gap is at most 0.6 mm; both are flat, so the
gap is linear and the cut is exact. Friction is looked at where a pad holds an edge or a vertex only.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from handey.check.values import Array

__all__ = ["Ground", "Standing", "convex_hull", "pad_fault", "standing_on", "unit_normals"]

SLAB = 5e-4  # pad to surface [m]: format
SAME_NORMAL = math.radians(1.0)  # pad to face: format
ENOUGH_AREA = 25e-6  # of a face on a pad [m2]: format
ENOUGH_SHARE = 0.1  # or of the pad: format
REST_GAP = 6e-4  # what is this near above a surface stands on it [m]: format
REST_WIDTH = 2e-3  # of the region stood on [m]: format
STEEP = 0.05  # sine of the steepest slope whose contact is looked at. Its foot belongs to its neighbours
SLACK = 1e-6  # of rounding [m]


def unit_normals(triangles: Array) -> Array:
    """Of triangles (m, 3, 3); zero for those without area (m, 3)."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.asarray(normal / np.maximum(length, 1e-300) * (length > 1e-14))


def _clip(polygon: Array, normal: Array, offset: float) -> Array:
    """The part of a convex polygon (k, d) where normal . x <= offset."""
    if len(polygon) == 0:
        return polygon
    height = polygon @ normal - offset
    if (height <= 0).all():
        return polygon
    result = []
    for i in range(len(polygon)):
        j = (i + 1) % len(polygon)
        if height[i] <= 0:
            result.append(polygon[i])
        if (height[i] <= 0) != (height[j] <= 0):
            share = height[i] / (height[i] - height[j])
            result.append(polygon[i] + share * (polygon[j] - polygon[i]))
    return np.array(result).reshape(-1, polygon.shape[1])


def _area(polygon: Array) -> float:
    if len(polygon) < 3:
        return 0.0
    x, y = polygon[:, 0], polygon[:, 1]
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def convex_hull(points: Array) -> Array:
    """Hull of points in the plane, counter-clockwise (k, 2)."""
    ordered = sorted(set(map(tuple, np.round(points, 10))))
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)

    def half(sequence: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
        chain: list[tuple[float, ...]] = []
        for p in sequence:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2], chain[-1]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0:
                    break
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


def _hull_margin(hull: Array, point: Array) -> float:
    """How far a point lies inside a hull; negative outside [m]."""
    if len(hull) < 3:
        return -math.inf
    edge = np.roll(hull, -1, axis=0) - hull
    inward = np.c_[-edge[:, 1], edge[:, 0]] / np.linalg.norm(edge, axis=1, keepdims=True)
    return float(np.einsum("ij,ij->i", point - hull, inward).min())


def _hull_width(hull: Array) -> float:
    """Least distance between two parallel lines around a hull [m]."""
    if len(hull) < 3:
        return 0.0
    edge = np.roll(hull, -1, axis=0) - hull
    inward = np.c_[-edge[:, 1], edge[:, 0]] / np.linalg.norm(edge, axis=1, keepdims=True)
    height = hull @ inward.T - np.einsum("ij,ij->i", hull, inward)
    return float(height.max(axis=0).min())


# ---------------------------------------------------------------------------------------------- pads


def pad_fault(
    triangles: Array, opening: float, pad: tuple[float, float], friction: float
) -> str | None:
    """Why the pads do not hold a part, or None.

    Args:
        triangles: of the part in the grasp frame (m, 3, 3).
        opening: distance between the pads [m].
        pad: width (x) and length (z) [m].
        friction: between pad and part.
    """
    normals = unit_normals(triangles)
    sides = [_pad_contact(triangles, normals, sign, opening, pad) for sign in (1.0, -1.0)]
    need = min(ENOUGH_SHARE * pad[0] * pad[1], ENOUGH_AREA)
    for side, contact in zip(("+y", "-y"), sides, strict=True):
        if len(contact.points) == 0:
            return f"nothing of the part within 0.5 mm of the {side} pad (opening {opening * 1e3:.3f} mm)"
        if contact.area >= need * (1 - 1e-6):
            continue
        if contact.face_area >= need:
            return (
                f"the {side} pad lies on {contact.area * 1e6:.2f} mm2 of a face; "
                f"at least {need * 1e6:.2f} mm2 are needed"
            )
        angle = _cone_angle(contact.normals, np.array([0.0, 1.0 if side == "+y" else -1.0, 0.0]))
        if angle > math.atan(friction) + 1e-9:
            return (
                f"the {side} pad holds an edge or vertex whose normals are {math.degrees(angle):.2f} deg "
                f"from the closing axis; friction allows {math.degrees(math.atan(friction)):.2f} deg"
            )
    if any(contact.area < need * (1 - 1e-6) for contact in sides):
        shift = _hull_distance(*(convex_hull(contact.points[:, [0, 2]]) for contact in sides))
        if shift > friction * max(opening, 1e-6) + SLACK:
            return (
                f"the contacts of the two pads are {shift * 1e3:.2f} mm apart across the closing axis; "
                f"friction allows {friction * opening * 1e3:.2f} mm"
            )
    return None


@dataclass
class _PadContact:
    points: Array  # (k, 3) of the part's surface in the pad's slab
    area: float  # of faces parallel to the pad, within it
    face_area: float  # of the same triangles, uncut
    normals: Array  # of all triangles in the slab


def _pad_contact(
    triangles: Array, normals: Array, sign: float, opening: float, pad: tuple[float, float]
) -> _PadContact:
    half = np.array([pad[0] / 2, SLAB, pad[1] / 2])
    centre = np.array([0.0, sign * opening / 2, 0.0])
    low, high = triangles.min(axis=1), triangles.max(axis=1)
    facing = normals[:, 1] * sign > -1e-9
    near = np.all((low <= centre + half) & (high >= centre - half), axis=1) & facing
    points, area, face_area, kept = [np.empty((0, 3))], 0.0, 0.0, [np.empty((0, 3))]
    for i in np.flatnonzero(near):
        polygon = triangles[i]
        for axis in range(3):
            for way in (1.0, -1.0):
                direction = way * np.eye(3)[axis]
                polygon = _clip(polygon, direction, float(direction @ centre + half[axis]))
        if len(polygon) == 0:
            continue
        points.append(polygon)
        kept.append(normals[i : i + 1])
        if normals[i, 1] * sign >= math.cos(SAME_NORMAL) - 1e-12:
            area += _area(polygon[:, [0, 2]])
            face_area += _area(triangles[i][:, [0, 2]])
    return _PadContact(np.vstack(points), area, face_area, np.vstack(kept))


def _cone_angle(normals: Array, axis: Array) -> float:
    """Least angle between an axis and the convex cone of some normals [rad]."""
    unit = np.unique(np.round(normals, 6), axis=0)
    unit = unit[np.argsort(-(unit @ axis))[:24]]  # those that lean most to the axis
    best = float((unit @ axis).max(initial=-1.0))
    for a, b in itertools.combinations(unit, 2):  # the arc between two normals
        across = np.cross(a, b)
        length = float(np.linalg.norm(across))
        if length < 1e-9:
            continue
        foot = axis - across * (across @ axis) / length**2
        size = float(np.linalg.norm(foot))
        if size > 1e-12 and np.cross(a, foot) @ across >= 0 and np.cross(foot, b) @ across >= 0:
            best = max(best, size)
    for three in itertools.combinations(unit, 3):
        matrix = np.array(three).T
        if abs(np.linalg.det(matrix)) > 1e-12 and (np.linalg.solve(matrix, axis) >= -1e-12).all():
            return 0.0
    return math.acos(min(best, 1.0))


def _hull_distance(a: Array, b: Array) -> float:
    """Distance between two convex polygons, points or segments in the plane."""
    if len(a) >= 3 and max(_hull_margin(a, p) for p in b) >= 0:
        return 0.0
    if len(b) >= 3 and max(_hull_margin(b, p) for p in a) >= 0:
        return 0.0
    best = math.inf
    for p, q in itertools.product(_edges(a), _edges(b)):
        best = min(best, _segment_distance(p, q))
    return best


def _edges(polygon: Array) -> list[tuple[Array, Array]]:
    return [(polygon[i], polygon[(i + 1) % len(polygon)]) for i in range(len(polygon))]


def _segment_distance(p: tuple[Array, Array], q: tuple[Array, Array]) -> float:
    def cross(u: Array, v: Array) -> float:
        return float(u[0] * v[1] - u[1] * v[0])

    d, e = p[1] - p[0], q[1] - q[0]
    if (
        cross(d, q[0] - p[0]) * cross(d, q[1] - p[0]) < 0
        and cross(e, p[0] - q[0]) * cross(e, p[1] - q[0]) < 0
    ):
        return 0.0

    def to(point: Array, start: Array, end: Array) -> float:
        span = end - start
        share = (
            0.0 if not span.any() else float(np.clip((point - start) @ span / (span @ span), 0, 1))
        )
        return float(np.linalg.norm(point - start - share * span))

    return min(to(p[0], *q), to(p[1], *q), to(q[0], *p), to(q[1], *p))


# ------------------------------------------------------------------------------------------ standing


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
            return f"stands on {where} by a region only {self.width * 1e3:.3f} mm wide (2 mm are needed)"
        if self.margin < -SLACK:
            return f"tips over: its centre of mass is {-self.margin * 1e3:.3f} mm outside what it stands on ({where})"
        return None


def standing_on(
    triangles: Array, centre_of_mass: Array, grounds: list[Ground], horizontal: bool = False
) -> Standing:
    """On what a part stands.

    Args:
        triangles: of the part in the world (m, 3, 3).
        centre_of_mass: in the world (3,).
        horizontal: count only faces within 1 degree of upward.
    """
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    down = triangles[unit_normals(triangles)[:, 2] < -STEEP]
    points, names = [np.empty((0, 2))], []
    for ground in grounds:
        near = np.all(ground.triangles.min(axis=1) <= high + REST_GAP, axis=1)
        near &= np.all(ground.triangles.max(axis=1) >= low - REST_GAP, axis=1)
        up = ground.triangles[near]
        up = up[unit_normals(up)[:, 2] > (math.cos(SAME_NORMAL) if horizontal else STEEP)]
        found = _contact_points(down, up)
        if len(found):
            points.append(found)
            names.append(ground.name)
    hull = convex_hull(np.vstack(points))
    return Standing(hull, _hull_width(hull), _hull_margin(hull, centre_of_mass[:2]), names)


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
            for p, q in _edges(b[:, :2]):  # upward triangles run counter-clockwise seen from above
                outward = np.array([q[1] - p[1], p[0] - q[0]])
                polygon = _clip(polygon, outward, float(outward @ p) + 1e-15)
            slope_a, height_a = _plane(a)
            slope_b, height_b = _plane(b)
            gap, level = slope_a - slope_b, height_a - height_b
            polygon = _clip(polygon, gap, REST_GAP - level + 1e-12)
            polygon = _clip(polygon, -gap, REST_GAP + level + 1e-12)
            if len(polygon):
                result.append(polygon)
    return np.vstack(result)


def _plane(triangle: Array) -> tuple[Array, float]:
    """z = slope . (x, y) + height of a triangle that is not vertical."""
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    slope = -normal[:2] / normal[2]
    return slope, float(triangle[0, 2] - slope @ triangle[0, :2])
