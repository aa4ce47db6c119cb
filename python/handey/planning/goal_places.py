"""Where may a goal put its part, and is it there already?

A goal that gives a pose has one place. A goal `on` or `inside` a fixture has a stream of them, made
of placements: on the face that the part stands on now first, because then no regrasp is needed.
`on`: it stands stably on horizontal upward faces of the fixture alone; all that it stands on lies
in the region. `inside`: the walls of the fixture, at least 2 mm high, enclose all that it stands on
there, and no part of it reaches out over the fixture's outline.
Article: the task-level command MOVE part TO place.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

import numpy as np

from handey import _core
from handey.placement import (
    CONTACT_GAP,
    DEEPEST_CONTACT,
    TOUCHING,
    convex_hull,
    examine_standing,
)
from handey.resting import Placement, PlacementOptions, Sought, placements, same_rest
from handey.task import Goal, PlaceAt, PlaceInside, PlaceOn

__all__ = ["Places", "is_met", "places_for"]

SAME_FACE = np.cos(np.radians(1.0))  # Choice: the tolerance of faces elsewhere
SAME_REST_FIRST = 8  # Choice: so many placements without turning the part over come first
KEPT_FREE = 0.01  # Choice: room for the parts whose places are known, around these places [m]
NO_AREA = 1e-8  # less is rounding [m2]
CONTACT = 5e-4  # of the format: bodies that touch may be so deep in each other [m]


def is_met(goal: Goal, cell: _core.Cell, model: _core.CollisionModel, start: _core.Cell) -> bool:
    """Is the part where the goal wants it?

    Args:
        goal: of the task.
        cell: as it is now.
        model: collision geometry of the cell.
        start: the cell at the start, for `resting: same`.
    """
    part = cell.part_index(goal.part)
    X_WP = cell.parts[part].X_WB
    if isinstance(goal, PlaceAt):
        # Half of the tolerance of a valid plan.
        gap = np.linalg.inv(X_WP) @ goal.X_WP
        angle = np.arccos(np.clip((np.trace(gap[:3, :3]) - 1) / 2, -1.0, 1.0))
        return bool(np.linalg.norm(gap[:3, 3]) <= 5e-5 and angle <= 5e-4)
    near = _core.touching_bodies(model, cell, part, TOUCHING)
    names = [cell.body(ref).name for ref in near]
    if goal.fixture not in names:
        return False
    if isinstance(goal, PlaceOn):
        alone = [near[names.index(goal.fixture)]]
        standing = examine_standing(cell, part, X_WP, alone, level=True)
        return (
            standing.stable
            and _in_region(standing.region, goal.region)
            and (not goal.same_resting or _same(X_WP, start.parts[part].X_WB))
        )
    standing = examine_standing(cell, part, X_WP, near)
    return (
        standing.stable
        and goal.fixture in standing.on
        and _within_walls(cell, part, goal, standing.region)
    )


def _in_region(hull: np.ndarray, region: np.ndarray | None) -> bool:
    return region is None or bool(((hull >= region[0]) & (hull <= region[1])).all())


def _same(X_WP: np.ndarray, before: np.ndarray) -> bool:
    return bool(X_WP[2, :3] @ before[2, :3] >= SAME_FACE)


def _within_walls(cell: _core.Cell, part: int, goal: PlaceInside, hull: np.ndarray) -> bool:
    """Do walls enclose the hull of what the part stands on, and the outline all of the part?"""
    body = cell.parts[part]
    points = np.vstack([_core.tessellate(shape).vertices for shape in body.shapes])
    points = points @ body.X_WB[:3, :3].T + body.X_WB[:3, 3]
    lowest = points[:, 2].min()
    fixture = next(body for body in cell.fixtures if body.name == goal.fixture)
    for face in _core.support_faces(fixture):
        gap = lowest - face.X_WS[2, 3]
        if face.enclosed.empty() or not -DEEPEST_CONTACT <= gap <= CONTACT_GAP:
            continue
        foot = _seen_in(face, np.c_[hull, np.full(len(hull), face.X_WS[2, 3])])
        within = _core.offset(face.enclosed, CONTACT)
        if _spills(foot, within) or _spills(_seen_in(face, points), face.outline):
            continue
        return True
    return False


def _seen_in(face: _core.SupportFace, points: np.ndarray) -> np.ndarray:
    """Convex hull of points of the world (n, 3), in x, y of the face (k, 2)."""
    X_SW = np.linalg.inv(face.X_WS)
    return convex_hull((points @ X_SW[:3, :3].T + X_SW[:3, 3])[:, :2])


def _spills(hull: np.ndarray, region: _core.Region) -> bool:
    return bool(_core.subtract(_core.Region([hull]), region).area > NO_AREA)


@dataclass
class Places:
    """Places for a goal from one state: looked for when first asked for, the same ever after.

    Attributes:
        stream: of them.
        sought: what became of what was looked at.
        found: so far.
    """

    stream: Iterator[PlaceAt]
    sought: Sought
    found: list[PlaceAt] = field(default_factory=list)

    def at(self, index: int) -> PlaceAt | None:
        """The place of this index; None if there are not so many."""
        while len(self.found) <= index:
            target = next(self.stream, None)
            if target is None:
                return None
            self.found.append(target)
        return self.found[index]


def places_for(
    goal: Goal,
    cell: _core.Cell,
    model: _core.CollisionModel,
    solver: _core.SphericalWristSolver,
    start: _core.Cell,
    *,
    kept_free: Sequence[PlaceAt] = (),
    seed: int = 0,
    sought: Sought | None = None,
) -> Iterator[PlaceAt]:
    """The poses that a goal allows, in the order to try them.

    Args:
        goal: of the task.
        cell: as it is now.
        model: collision geometry of the cell.
        solver: inverse kinematics of the arm.
        start: the cell at the start, for `resting: same`.
        kept_free: where other parts are to go later; what would be in their way comes last.
        seed: of the sequence of samples.
        sought: is told what became of the samples.
    """
    if isinstance(goal, PlaceAt):
        yield goal
        return
    part = cell.part_index(goal.part)
    X_WP = cell.parts[part].X_WB
    body = cell.parts[part]
    only_same = isinstance(goal, PlaceOn) and goal.same_resting
    same = same_rest(body, start.parts[part].X_WB if only_same else X_WP)
    region = goal.region if isinstance(goal, PlaceOn) else None

    def stream(rests: list[_core.RestingPose] | None) -> Iterator[Placement]:
        return placements(
            cell,
            model,
            part,
            on=[goal.fixture],
            rests=rests,
            region=region,
            inside=isinstance(goal, PlaceInside),
            near=X_WP if region is None else None,
            solver=solver,
            options=PlacementOptions(seed=seed),
            sought=sought,
        )

    places = stream(same) if only_same else _same_rest_first(stream(same), stream(None), X_WP)
    waiting = []
    for place in places:
        target = PlaceAt(goal.part, place.X_WP)
        if _is_free(cell, model, target, kept_free):
            yield target
        else:
            waiting.append(target)
    yield from waiting


def _same_rest_first(
    same: Iterator[Placement], others: Iterator[Placement], X_WP: np.ndarray
) -> Iterator[Placement]:
    """Some placements in the rest that the part is in now, then others and these in turn."""
    yield from islice(same, SAME_REST_FIRST)
    for place in others:
        if not _same(place.X_WP, X_WP):
            yield place
        after = next(same, None)
        if after is not None:
            yield after
    yield from same


def _is_free(
    cell: _core.Cell,
    model: _core.CollisionModel,
    target: PlaceAt,
    kept_free: Sequence[PlaceAt],
) -> bool:
    """Is a part, at its target, clear of the others where they are to go later?"""
    part = cell.part_index(target.part)
    there = cell.with_part_at(part, target.X_WP)
    moved = {}
    for other in kept_free:
        if other.part != target.part:
            moved[cell.part_index(other.part)] = other.X_WP
    for index, X_WO in moved.items():
        there = there.with_part_at(index, X_WO)
    near = _core.touching_bodies(model, there, part, KEPT_FREE) if moved else []
    return not any(ref.kind == _core.BodyRef.Kind.Part and ref.index in moved for ref in near)
