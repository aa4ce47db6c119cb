"""Do the pads lie on the part? Its triangles are cut to the slab of 0.5 mm about each pad.

Friction is looked at where a pad holds an edge or a vertex only: the closing axis must lie in the
cone of the contact's normals widened by the friction angle, and so must the line between the two
contacts.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from handey.check.planar import area_of, clip, convex_hull, edges, hull_margin, unit_normals
from handey.check.values import Array

__all__ = ["pad_fault"]

SLAB = 5e-4  # pad to surface [m]: format
SAME_NORMAL = math.radians(1.0)  # pad to face: format
ENOUGH_AREA = 25e-6  # of a face on a pad [m2]: format
ENOUGH_SHARE = 0.1  # or of the pad: format
AWAY = -0.5  # faces turned further away belong to the other side of a thin part. Choice
SLACK = 1e-6  # of rounding [m]


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
            where = f"{side} pad (opening {opening * 1e3:.3f} mm)"
            return f"nothing of the part is within 0.5 mm of the {where}"
        if contact.area >= need * (1 - 1e-6):
            continue
        if contact.face_area >= need:
            return (
                f"the {side} pad lies on {contact.area * 1e6:.2f} mm2 of a face; "
                f"at least {need * 1e6:.2f} mm2 are needed"
            )
        axis = np.array([0.0, 1.0 if side == "+y" else -1.0, 0.0])
        askew = contact.normals @ contact.normals[0] >= math.cos(SAME_NORMAL)
        angle, most = _cone_angle(contact.normals, axis), math.atan(friction)
        if askew.all():  # one face only: no edge or vertex of it is inside the pad
            return f"the {side} pad is on a face that is {math.degrees(angle):.2f} deg askew"
        if angle > most + 1e-9:
            return (
                f"the {side} pad is on an edge or vertex; its normals are "
                f"{math.degrees(angle):.2f} deg from the closing axis, "
                f"friction allows {math.degrees(most):.2f} deg"
            )
    if any(contact.area < need * (1 - 1e-6) for contact in sides):
        shift = _hull_distance(*(convex_hull(contact.points[:, [0, 2]]) for contact in sides))
        if shift > friction * max(opening, 1e-6) + SLACK:
            return (
                f"the pads' contacts are {shift * 1e3:.2f} mm apart across the closing axis; "
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
    facing = normals[:, 1] * sign > AWAY
    near = np.all((low <= centre + half) & (high >= centre - half), axis=1) & facing
    points, area, face_area, kept = [np.empty((0, 3))], 0.0, 0.0, [np.empty((0, 3))]
    for i in np.flatnonzero(near):
        polygon = triangles[i]
        for axis in range(3):
            for way in (1.0, -1.0):
                direction = way * np.eye(3)[axis]
                polygon = clip(polygon, direction, float(direction @ centre + half[axis]))
        if len(polygon) == 0:
            continue
        points.append(polygon)
        kept.append(normals[i : i + 1])
        if normals[i, 1] * sign >= math.cos(SAME_NORMAL) - 1e-12:
            area += area_of(polygon[:, [0, 2]])
            face_area += area_of(triangles[i][:, [0, 2]])
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
    if len(a) >= 3 and max(hull_margin(a, p) for p in b) >= 0:
        return 0.0
    if len(b) >= 3 and max(hull_margin(b, p) for p in a) >= 0:
        return 0.0
    best = math.inf
    for p, q in itertools.product(edges(a), edges(b)):
        best = min(best, _segment_distance(p, q))
    return best


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
