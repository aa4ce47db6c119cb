"""Does a part, put down at a pose, stay there?

It stands stably if what lies within 0.6 mm above a surface below it spans a region at least 2 mm
wide that holds the centre of mass (docs: formats, 'a valid plan'). The region is the convex hull of
the places, seen from above, where a downward triangle of the part and an upward triangle of what is
below are that near; each pair of triangles is cut exactly. Not looked at: friction, and whether
what it stands on stays. Round shapes are polyhedra of 128 sides here. Article: "Regrasping", the
placements of a part on a table.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from handey import _core

__all__ = ["TOUCHING", "Standing", "carried_by", "examine_standing"]

CONTACT_GAP = 6e-4  # of the format: what is this near above a surface stands on it [m]
DEEPEST_CONTACT = (
    6e-4  # bodies may overlap by 0.5 mm where they touch; a little more for rounding [m]
)
TOUCHING = CONTACT_GAP + 1e-5  # what can carry a part is as near to it [m]
LEAST_WIDTH = 2e-3  # of the format [m]
STEEPEST = (
    0.1  # Choice: least vertical share of a normal; steeper than 84 degrees is a wall, not a ground
)
LEVEL = np.cos(np.radians(1.0))  # least of a horizontal face. Choice: the tolerance of faces
SEGMENTS = 128  # Choice: sides of a round shape; a 50 mm radius is met within 0.02 mm
PAIRS_AT_ONCE = 4000  # bounds one pass to some 10 MB and 30 ms


@dataclass(frozen=True)
class Standing:
    """How a part stands at a pose.

    Attributes:
        stable: it stays.
        on: names of what it stands on.
        width: least width of the region that carries it [m]; 0 if nothing does.
        reason: why it does not stay; empty if it does.
        region: convex hull of what it stands on, in x, y of the world (k, 2) [m].
    """

    stable: bool
    on: tuple[str, ...]
    width: float
    reason: str
    region: np.ndarray = field(default_factory=lambda: np.zeros((0, 2)))


def examine_standing(
    cell: _core.Cell,
    part: int,
    X_WP: np.ndarray,
    near: Sequence[_core.BodyRef] | None = None,
    level: bool = False,
) -> Standing:
    """How a part stands at a pose, on the fixtures and the other parts where they are in the cell.

    Args:
        cell: fixtures and parts; a held part carries nothing.
        part: index in the cell's parts.
        X_WP: the part in the world (4, 4).
        near: bodies that can carry it there, with all within TOUCHING of it; None: all are looked
            at, which is slow where there are many or round ones.
        level: only horizontal faces carry it.

    Raises:
        InvalidInput: if the part has no shape.
    """
    from handey import _core

    body = cell.parts[part]
    centre = (X_WP @ np.append(_core.centre_of_mass(body), 1.0))[:3]
    _core.throw_if_stopped()
    downward = _facing(_triangles(body, X_WP), up=False)
    held = None if cell.held is None else cell.held.part
    points, on = [], []
    for name, triangles in _grounds(cell, {part, held}, near):
        found = contact_points(downward, _level(triangles) if level else triangles)
        if len(found):
            points.append(found)
            on.append(name)
    if not points:
        return Standing(False, (), 0.0, f"nothing is within {CONTACT_GAP * 1e3:g} mm below it")
    _core.throw_if_stopped()
    hull = convex_hull(np.concatenate(points))
    _core.throw_if_stopped()
    width = least_width(hull)
    if width < LEAST_WIDTH - 1e-9:
        reason = f"it would stand on a region {width * 1e3:.2f} mm wide; 2 mm are needed"
        return Standing(False, tuple(on), width, reason, hull)
    outside = distance_outside(hull, centre[:2])
    if outside > 1e-6:
        reason = f"its centre of mass lies {outside * 1e3:.1f} mm beside what it would stand on"
        return Standing(False, tuple(on), width, reason, hull)
    return Standing(True, tuple(on), width, "", hull)


def carried_by(model: _core.CollisionModel, cell: _core.Cell, part: int) -> list[int]:
    """Indices of the parts that stand stably with `part` in place, and not without it."""
    from handey import _core

    without = cell.with_held(part, np.eye(4))
    fallen = []
    for touched in _core.touching_bodies(model, cell, part):
        if touched.kind != _core.BodyRef.Kind.Part:
            continue
        X_WO = cell.parts[touched.index].X_WB
        near = _core.touching_bodies(model, cell, touched.index, TOUCHING)
        before = examine_standing(cell, touched.index, X_WO, near)
        carried = cell.parts[part].name in before.on and before.stable
        if carried and not examine_standing(without, touched.index, X_WO, near).stable:
            fallen.append(touched.index)
    return fallen


def _grounds(
    cell: _core.Cell, left_out: set[int | None], near: Sequence[_core.BodyRef] | None
) -> Iterator[tuple[str, np.ndarray]]:
    """Name and upward triangles (n, 3, 3) of each body that can carry a part."""
    from handey import _core

    def is_near(kind: _core.BodyRef.Kind, index: int) -> bool:
        return near is None or any(ref.kind == kind and ref.index == index for ref in near)

    for index, fixture in enumerate(cell.fixtures):
        if is_near(_core.BodyRef.Kind.Fixture, index):
            yield fixture.name, _facing(_triangles(fixture, fixture.X_WB), up=True)
    for index, other in enumerate(cell.parts):
        if index not in left_out and is_near(_core.BodyRef.Kind.Part, index):
            yield other.name, _facing(_triangles(other, other.X_WB), up=True)


def _triangles(body: _core.Body, X_WB: np.ndarray) -> np.ndarray:
    """Corners of the triangles in the world (n, 3, 3); those of an open skin face both ways."""
    from handey import _core

    found = [np.zeros((0, 3, 3))]
    for shape in body.shapes:
        mesh = _core.tessellate(shape, SEGMENTS)
        corners = np.asarray(mesh.vertices, dtype=float)[np.asarray(mesh.triangles, dtype=int)]
        found.append(corners)
        if not getattr(shape.geometry, "solid", True):
            found.append(corners[:, ::-1])
    return np.asarray(np.concatenate(found) @ X_WB[:3, :3].T + X_WB[:3, 3])


def _facing(triangles: np.ndarray, up: bool) -> np.ndarray:
    """The triangles whose normal points up, or down, and not much aside."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    vertical = normals[:, 2] if up else -normals[:, 2]
    return np.asarray(triangles[(lengths > 0) & (vertical > STEEPEST * lengths)])


def _level(triangles: np.ndarray) -> np.ndarray:
    """Those of the triangles that are horizontal."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.asarray(triangles[normals[:, 2] >= LEVEL * np.linalg.norm(normals, axis=1)])


def contact_points(downward: np.ndarray, upward: np.ndarray) -> np.ndarray:
    """Corners, seen from above, of the regions where one surface is near above another.

    Args:
        downward: triangles of what stands (n, 3, 3).
        upward: triangles of what may carry it (m, 3, 3).

    Returns:
        Points (k, 2) [m]; their convex hull is that of the regions.
    """
    from handey import _core

    if not len(downward) or not len(upward):
        return np.zeros((0, 2))
    upward = upward[_boxes_meet(upward, downward.min(axis=(0, 1)), downward.max(axis=(0, 1)))]
    found = [np.zeros((0, 2))]
    rows = max(1, PAIRS_AT_ONCE * 100 // max(1, len(upward)))
    for start in range(0, len(downward), rows):
        _core.throw_if_stopped()
        some = downward[start : start + rows]
        lower, higher = some.min(axis=1), some.max(axis=1)
        meet = _boxes_meet(upward[None], lower[:, None], higher[:, None])
        i, j = np.nonzero(meet)
        for first in range(0, len(i), PAIRS_AT_ONCE):
            _core.throw_if_stopped()
            chosen = slice(first, first + PAIRS_AT_ONCE)
            found.append(_cut(some[i[chosen]], upward[j[chosen]]))
    return np.concatenate(found)


def _boxes_meet(triangles: np.ndarray, lower: np.ndarray, higher: np.ndarray) -> np.ndarray:
    """Which of the triangles have a box that meets the boxes between `lower` and `higher`?"""
    slack = np.array([1e-9, 1e-9, max(CONTACT_GAP, DEEPEST_CONTACT)])
    least, most = triangles.min(axis=-2), triangles.max(axis=-2)
    return np.asarray(np.all((least <= higher + slack) & (most >= lower - slack), axis=-1))


def _cut(above: np.ndarray, below: np.ndarray) -> np.ndarray:
    """Corners of the regions where each triangle (n, 3, 3) of `above` is near the one of `below`.

    A region is convex, bounded by eight lines: the six sides, and the two along which the gap is
    the least and the greatest. Its corners are the crossings on the inner side of all eight.
    """
    lines = np.concatenate([_sides(above), _sides(below), _gap_lines(above, below)], axis=1)
    lines = lines / np.maximum(np.linalg.norm(lines[..., :2], axis=-1, keepdims=True), 1e-9)
    first, second = np.array(list(combinations(range(lines.shape[1]), 2))).T
    a, b = lines[:, first], lines[:, second]
    determinant = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    crossing = np.abs(determinant) > 1e-9
    safe = np.where(crossing, determinant, 1.0)
    x = (a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1]) / safe
    y = (a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2]) / safe
    corners = np.stack([x, y, np.ones_like(x)], axis=-1)
    inside = np.all(np.einsum("npc,nlc->npl", corners, lines) >= -1e-8, axis=2)
    return np.asarray(corners[crossing & inside][:, :2])


def _sides(triangles: np.ndarray) -> np.ndarray:
    """Lines (n, 3, 3) a x + b y + c of the sides seen from above, positive inside."""
    corners = triangles[..., :2]
    turned = np.roll(corners, -1, axis=1)
    along = turned - corners
    a, b = -along[..., 1], along[..., 0]
    lines = np.stack([a, b, -(a * corners[..., 0] + b * corners[..., 1])], axis=-1)
    area = along[:, 0, 0] * along[:, 1, 1] - along[:, 0, 1] * along[:, 1, 0]
    return np.asarray(lines * np.where(area < 0, -1.0, 1.0)[:, None, None])


def _gap_lines(above: np.ndarray, below: np.ndarray) -> np.ndarray:
    """Lines (n, 2, 3), positive where the gap is above the least and below the greatest."""
    gap = _heights(above) - _heights(below)
    least, most = gap.copy(), -gap
    least[:, 2] += DEEPEST_CONTACT
    most[:, 2] += CONTACT_GAP
    return np.stack([least, most], axis=1)


def _heights(triangles: np.ndarray) -> np.ndarray:
    """The planes z = a x + b y + c of triangles (n, 3, 3) that are not upright: (n, 3)."""
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    slopes = -normals[:, :2] / normals[:, 2:]
    height = triangles[:, 0, 2] - np.sum(slopes * triangles[:, 0, :2], axis=1)
    return np.concatenate([slopes, height[:, None]], axis=1)


def convex_hull(points: np.ndarray) -> np.ndarray:
    """Corners of the convex hull of points (n, 2), counter-clockwise (k, 2)."""
    order = np.unique(np.round(points, 9), axis=0)  # sorted by x, then y
    halves = []
    for run in (order, order[::-1]):
        half: list[np.ndarray] = []
        for point in run:
            while len(half) > 1 and _turn(half[-2], half[-1], point) <= 0:
                half.pop()
            half.append(point)
        halves += half[:-1]
    return np.array(halves) if halves else order


def _turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _normals_and_offsets(hull: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inward unit normals of the hull's edges, and where the edges lie along them."""
    along = np.roll(hull, -1, axis=0) - hull
    normals = np.stack([-along[:, 1], along[:, 0]], axis=1)
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return normals, np.sum(normals * hull, axis=1)


def least_width(hull: np.ndarray) -> float:
    """The least distance between two parallel lines that hold the hull between them [m]."""
    if len(hull) < 3:
        return 0.0
    normals, offsets = _normals_and_offsets(hull)
    return float(np.min(np.max(normals @ hull.T - offsets[:, None], axis=1)))


def distance_outside(hull: np.ndarray, point: np.ndarray) -> float:
    """How far a point lies outside of the hull's nearest side, at least [m]; negative inside."""
    normals, offsets = _normals_and_offsets(hull)
    return float(np.max(offsets - normals @ point))
