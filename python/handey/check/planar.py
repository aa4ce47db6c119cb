"""Small geometry of triangles and of convex polygons in the plane: clip, area, hull, width."""

from __future__ import annotations

import math

import numpy as np

from handey.check.values import Array

__all__ = ["area_of", "clip", "convex_hull", "edges", "hull_margin", "hull_width", "unit_normals"]


def unit_normals(triangles: Array) -> Array:
    """Of triangles (m, 3, 3); zero for those without area (m, 3)."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.asarray(normal / np.maximum(length, 1e-300) * (length > 1e-14))


def clip(polygon: Array, normal: Array, offset: float) -> Array:
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


def area_of(polygon: Array) -> float:
    """Area of a polygon in the plane (k, 2)."""
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


def hull_margin(hull: Array, point: Array) -> float:
    """How far a point lies inside a hull; negative outside [m]."""
    if len(hull) < 3:
        return -math.inf
    edge = np.roll(hull, -1, axis=0) - hull
    inward = np.c_[-edge[:, 1], edge[:, 0]] / np.linalg.norm(edge, axis=1, keepdims=True)
    return float(np.einsum("ij,ij->i", point - hull, inward).min())


def hull_width(hull: Array) -> float:
    """Least distance between two parallel lines around a hull [m]."""
    if len(hull) < 3:
        return 0.0
    edge = np.roll(hull, -1, axis=0) - hull
    inward = np.c_[-edge[:, 1], edge[:, 0]] / np.linalg.norm(edge, axis=1, keepdims=True)
    height = hull @ inward.T - np.einsum("ij,ij->i", hull, inward)
    return float(height.max(axis=0).min())


def edges(polygon: Array) -> list[tuple[Array, Array]]:
    """The sides of a polygon, from corner to corner."""
    return [(polygon[i], polygon[(i + 1) % len(polygon)]) for i in range(len(polygon))]
