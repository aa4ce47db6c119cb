"""Distances between solids: the second collision engine, made whole.

coal answers for single pieces. It knows only the skin of a mesh, so a piece that lies wholly inside
a closed mesh is found by its winding number. How deep two pieces overlap is decided by moving one
away: they overlap by at most delta if some translation by delta parts them. Not guaranteed: that
every such translation is tried. A depth may be over-estimated, never under-estimated.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import coal
import numpy as np

from handey.check.shapes import Shape, connected_parts, transformed
from handey.check.values import Array

__all__ = ["Engine", "Piece", "Placed", "pieces_of"]

TOUCH = -1e-8  # a distance not below this counts as none [m]


@dataclass
class Piece:
    """A shape as the engine sees it, and what bounds it, in its body's frame.

    Attributes:
        geometry: the engine's object, in the shape frame. pose: shape frame in the body. centres,
        radii: spheres that cover the piece (k, 3), (k,), in the body frame. box_centre, box_half:
        box around the piece in the shape frame.
        inside: of a closed mesh, which the engine sees as a skin only: which points (n, 3) of the
        body frame lie in it; else None.
        probes: a point of each connected part of the surface (body frame).
        directions: ways to push it free (body frame).
    """

    geometry: coal.CollisionGeometry
    pose: Array
    centres: Array
    radii: Array
    box_centre: Array
    box_half: Array
    inside: Callable[[Array], np.ndarray] | None
    probes: Array
    directions: Array


@dataclass
class Placed:
    """A piece somewhere in the world: rotation and position of its body."""

    piece: Piece
    R: Array
    p: Array


def pieces_of(shapes: list[Shape]) -> list[Piece]:
    """The pieces of a body; closed meshes made of convex parts are taken apart."""
    result = []
    for shape in shapes:
        if shape.inside is not None:
            result.append(_piece(shape, None if shape.probes is None else list(shape.probes)))
        elif shape.kind == "mesh" and not shape.convex:
            parts = connected_parts(shape)
            if len(parts) > 1 and shape.closed and all(part.convex for part in parts):
                result += [_piece(part) for part in parts]
                continue
            result.append(_piece(shape, [part.vertices[0] for part in parts]))
        else:
            result.append(_piece(shape))
    return result


def _piece(shape: Shape, probes: list[Array] | None = None) -> Piece:
    low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
    if shape.kind == "sphere":
        low, high = -np.full(3, shape.size[0]), np.full(3, shape.size[0])
    elif shape.kind == "cylinder":
        radius, length = shape.size
        high = np.array([radius, radius, length / 2])
        low = -high
    centres, radii = _cover(low, high)
    skin = shape.kind == "mesh" and not shape.convex
    probe = np.array(probes if probes is not None else [shape.vertices[0]])
    return Piece(
        _geometry(shape), shape.pose, transformed(shape.pose, centres), radii, (low + high) / 2,
        (high - low) / 2, _test_of_inside(shape) if skin and shape.closed else None,
        transformed(shape.pose, probe), _directions(shape),
    )  # fmt: skip


def _test_of_inside(shape: Shape) -> Callable[[Array], np.ndarray]:
    """Which points (n, 3) of the body frame lie in a closed mesh?"""
    if shape.inside is not None:
        known, X_SB = shape.inside, np.asarray(np.linalg.inv(shape.pose), dtype=float)
        return lambda points: known(transformed(X_SB, points))
    triangles = shape.triangles()
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))

    def test(points: Array) -> np.ndarray:
        result = np.all((points >= low) & (points <= high), axis=1)
        for k in np.flatnonzero(result):
            result[k] = _inside(triangles, points[k])
        return np.asarray(result)

    return test


def _cover(low: Array, high: Array) -> tuple[Array, Array]:
    """Spheres around the slices of a box along its longest side."""
    size = high - low
    axis = int(np.argmax(size))
    across = float(np.sort(size)[1])
    count = int(np.clip(round(float(size[axis]) / max(across, 1e-6)), 1, 6))
    centres = np.repeat(((low + high) / 2)[None], count, axis=0)
    centres[:, axis] = low[axis] + size[axis] * (np.arange(count) + 0.5) / count
    half = size / 2
    half[axis] /= count
    return centres, np.full(count, float(np.linalg.norm(half)))


def _geometry(shape: Shape) -> coal.CollisionGeometry:
    if shape.kind == "box":
        return coal.Box(*shape.size)
    if shape.kind == "cylinder":
        return coal.Cylinder(*shape.size)
    if shape.kind == "sphere":
        return coal.Sphere(*shape.size)
    if shape.convex:
        points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in shape.vertices:
            points.append(vertex)
        for face in shape.faces:
            triangles.append(coal.Triangle(*map(int, face)))
        return coal.Convex(points, triangles)
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(shape.faces), len(shape.vertices))
    model.addVertices(np.asarray(shape.vertices, dtype=float))
    model.addTriangles(np.asarray(shape.faces, dtype=np.int64))
    model.endModel()
    model.computeLocalAABB()
    return model


def _directions(shape: Shape) -> Array:
    """Normals of the largest planes of the surface, at most 16, in the body frame."""
    a, b, c = (shape.vertices[shape.faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    keep = area > 1e-14
    unit, index = np.unique(
        np.round(normal[keep] / area[keep, None], 3), axis=0, return_inverse=True
    )
    weight = np.bincount(index.reshape(-1), weights=area[keep])
    best = unit[np.argsort(-weight)[:16]]
    return np.asarray((best / np.linalg.norm(best, axis=1, keepdims=True)) @ shape.pose[:3, :3].T)


class Engine:
    """Asks coal, and counts the questions."""

    def __init__(self) -> None:
        self.queries = 0
        self._request = coal.DistanceRequest()
        self._result = coal.DistanceResult()
        self._last_way: Array | None = None

    def distance(self, a: Placed, b: Placed, shift: Array | None = None) -> float:
        """Between two placed pieces, `a` moved by `shift` [m].

        Zero or less where the surfaces meet. A piece wholly inside a mesh is not seen here: see
        `contains`.
        """
        self.queries += 1
        X_a, X_b = a.piece.pose, b.piece.pose
        p_a = a.R @ X_a[:3, 3] + a.p
        if shift is not None:
            p_a = p_a + shift
        self._result.clear()
        found = coal.distance(
            a.piece.geometry, coal.Transform3s(a.R @ X_a[:3, :3], p_a),
            b.piece.geometry, coal.Transform3s(b.R @ X_b[:3, :3], b.R @ X_b[:3, 3] + b.p),
            self._request, self._result,
        )  # fmt: skip
        return float(found)

    def contains(self, a: Placed, b: Placed, shift: Array | None = None) -> bool:
        """Is one of them inside the other's mesh, though the surfaces need not meet?"""
        move = np.zeros(3) if shift is None else shift
        for outer, inner, sign in ((a, b, -1.0), (b, a, 1.0)):
            if outer.piece.inside is None:
                continue
            world = inner.piece.probes @ inner.R.T + inner.p + sign * move
            points = (world - outer.p) @ outer.R
            if outer.piece.inside(points).any():
                return True
        return False

    def signed(self, a: Placed, b: Placed, tolerance: float, ways: Array | None = None) -> float:
        """A lower bound of the distance [m].

        Their distance where they are apart; where they overlap by less than `tolerance`, how far
        they are apart once moved by it, less `tolerance`; else minus infinity.
        """
        found = self.distance(a, b)
        if found > 0 and not self.contains(a, b):
            return found
        room = self._room(a, b, tolerance, ways)
        return -math.inf if room is None else room - tolerance

    def _room(self, a: Placed, b: Placed, delta: float, ways: Array | None) -> float | None:
        """The distance after moving `a` by `delta` a way that parts them; None if none does."""
        normal = np.array(self._result.normal)
        tries: list[Array] = [] if self._last_way is None else [self._last_way]
        if np.isfinite(normal).all() and abs(np.linalg.norm(normal) - 1) < 1e-6:
            tries += [-normal, normal]
        if ways is not None:
            tries += [*ways, *-ways]
        tries += [-(a.R @ d) for d in a.piece.directions] + [b.R @ d for d in b.piece.directions]
        tries += [*np.eye(3), *-np.eye(3)]
        for way in tries:
            room = self.distance(a, b, delta * way)
            if room >= TOUCH and not self.contains(a, b, delta * way):
                self._last_way = way
                return max(room, 0.0)
        return None

    def depth(self, a: Placed, b: Placed) -> float:
        """How deep they overlap, found by doubling: not more than this [m]."""
        if self.distance(a, b) > 0 and not self.contains(a, b):
            return 0.0
        delta = 1e-5
        while delta < 1.0 and self._room(a, b, delta, None) is None:
            delta *= 1.25
        return delta


def _inside(triangles: Array, point: Array) -> bool:
    """Does a closed surface wind about a point? Solid angles: Van Oosterom and Strackee."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    numerator = np.einsum("ij,ij->i", a, np.cross(b, c))
    denominator = (
        la * lb * lc
        + np.einsum("ij,ij->i", a, b) * lc
        + np.einsum("ij,ij->i", b, c) * la
        + np.einsum("ij,ij->i", c, a) * lb
    )
    return bool(np.arctan2(numerator, denominator).sum() > math.pi)  # half a turn of 2 pi
