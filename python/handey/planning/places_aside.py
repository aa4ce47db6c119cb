"""Where may a part stand aside, out of the way of what is still to be moved?

On the face that it stands on now, first with room for the jaws between it and where others are to
go, then with any. Not guaranteed: that the arm can put it there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from handey import _core
from handey.resting import PlacementOptions, Sought, placements, same_rest
from handey.task import PlaceAt

__all__ = ["places_aside"]

# Choice: between a part moved aside and where others go: first room for the jaws, then any [m].
ROOMY, TIGHT = 0.04, 0.005


def places_aside(
    cell: _core.Cell,
    model: _core.CollisionModel,
    part: int,
    *,
    on: list[str],
    kept_free: Sequence[PlaceAt],
    solver: _core.SphericalWristSolver,
    seed: int,
    sought: Sought,
) -> Iterator[PlaceAt]:
    """Places for a part, those with room for the jaws beside it before the others.

    Args:
        cell: as it is.
        model: its collision geometry.
        part: index of the part.
        on: names of bodies that it may be put on.
        kept_free: where other parts are to go.
        solver: inverse kinematics of the arm.
        seed: of the places looked at.
        sought: is told what was looked at.
    """
    X_WP = cell.parts[part].X_WB
    tight = []
    for place in placements(
        cell,
        model,
        part,
        on=on,
        rests=same_rest(cell.parts[part], X_WP),
        near=X_WP,
        solver=solver,
        options=PlacementOptions(seed=seed),
        sought=sought,
    ):
        gap = _room(cell, model, part, place.X_WP, kept_free)
        target = PlaceAt(cell.parts[part].name, place.X_WP)
        if gap == ROOMY:
            yield target
        elif gap == TIGHT:
            tight.append(target)
    yield from tight


def _room(
    cell: _core.Cell,
    model: _core.CollisionModel,
    part: int,
    X_WP: np.ndarray,
    kept_free: Sequence[PlaceAt],
) -> float:
    """Which of the distances a part has from where the others are to go; 0 for none."""
    there = cell.with_part_at(part, X_WP)
    gaps = [ROOMY, TIGHT]
    for goal in kept_free:
        later = there.with_part_at(cell.part_index(goal.part), goal.X_WP)
        ref = _core.BodyRef(_core.BodyRef.Kind.Part, cell.part_index(goal.part))
        while gaps and ref in _core.touching_bodies(model, later, part, gaps[0]):
            gaps.pop(0)
    return gaps[0] if gaps else 0.0
