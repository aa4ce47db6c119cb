"""What stands in the way of a goal?

Seen without planning: what stands on the part and would fall, what stands where the part is to go,
and that nothing is there yet to stand on. Seen by a motion that was planned as if a part were not
there: whether it runs into that part.
Not seen: parts that leave a motion only where it is hard to find.
"""

from __future__ import annotations

from dataclasses import dataclass

from handey import _core
from handey.motion.carry import Carry
from handey.placement import TOUCHING, carried_by, examine_standing
from handey.reporting.reasons import Reason
from handey.task import Goal, PlaceAt

__all__ = [
    "Hindrance",
    "carries",
    "hindrance",
    "runs_into",
    "topmost",
    "unstable",
    "would_fall",
]


@dataclass(frozen=True)
class Hindrance:
    """Why a goal cannot be planned as the cell is.

    Attributes:
        parts: indices of those that must be moved first; empty where moving none of them helps.
        reasons: typed, and in words.
    """

    parts: tuple[int, ...]
    reasons: tuple[Reason, ...]


def hindrance(goal: Goal, cell: _core.Cell, model: _core.CollisionModel) -> Hindrance | None:
    """What can be seen to be in the way of a goal; None if nothing."""
    part = cell.part_index(goal.part)
    fallen = carried_by(model, cell, part)
    parts, reasons = list(fallen), []
    if fallen:
        reasons.append(would_fall([cell.parts[i].name for i in fallen], goal.part))
    if isinstance(goal, PlaceAt):
        there = cell.with_part_at(part, goal.X_WP)
        near = _core.touching_bodies(model, there, part, TOUCHING)
        # How deep bodies overlap takes long to tell: it is asked only where another part is near.
        # That no goal is inside a fixture was seen when the cell was read.
        if any(ref.kind == _core.BodyRef.Kind.Part for ref in near):
            for other in _overlapping_parts(model, there, part):
                parts.append(other)
                name = cell.parts[other].name
                text = f"{name} is where {goal.part} is to go"
                reasons.append(
                    Reason("in_the_way", "found", text, end="destination", bodies=(name,))
                )
        standing = examine_standing(cell, part, goal.X_WP, near)
        if not standing.stable:
            reasons.append(unstable(goal.part, standing.reason))
    return Hindrance(tuple(dict.fromkeys(parts)), tuple(reasons)) if reasons else None


def would_fall(carried: list[str], part: str) -> Reason:
    """Parts stand on the one that is to be moved."""
    verb = "it stands" if len(carried) == 1 else "they stand"
    text = f"{', '.join(carried)} would fall: {verb} on {part}, which is to be moved"
    return Reason("would_fall", "found", text, end="origin", bodies=tuple(carried))


def unstable(part: str, why: str) -> Reason:
    """A part would not stay where it is to go."""
    text = f"{part} would not stand at its goal: {why}"
    return Reason("unstable", "found", text, end="destination")


def _overlapping_parts(model: _core.CollisionModel, cell: _core.Cell, part: int) -> list[int]:
    """Parts that overlap this one, deeper than contact."""
    kind, found = _core.BodyRef.Kind, []
    for overlap in _core.find_overlaps(model, cell):
        pair = [ref.index for ref in (overlap.a, overlap.b) if ref.kind == kind.Part]
        if len(pair) == 2 and part in pair:
            found.append(pair[1 - pair.index(part)])
    return found


def carries(cell: _core.Cell, model: _core.CollisionModel, goal: Goal, other: int) -> bool:
    """Does the goal's part stand on another part, where it is or at its goal?"""
    part = cell.part_index(goal.part)
    poses = [cell.parts[part].X_WB]
    poses += [goal.X_WP] if isinstance(goal, PlaceAt) else []
    name = cell.parts[other].name
    for X_WP in poses:
        near = _core.touching_bodies(model, cell.with_part_at(part, X_WP), part, TOUCHING)
        if name in examine_standing(cell, part, X_WP, near).on:
            return True
    return False


def topmost(cell: _core.Cell, model: _core.CollisionModel, part: int) -> int:
    """The part itself, or what stands on what stands on it."""
    for _ in cell.parts:
        above = carried_by(model, cell, part)
        if not above:
            break
        part = above[0]
    return part


def runs_into(
    carry: Carry, target: PlaceAt, cell: _core.Cell, model: _core.CollisionModel, other: int
) -> bool:
    """Does a carry that was planned without it run into a part?

    Args:
        carry: all motions from where the arm is to where it lets go.
        target: where the part is put.
        cell: before the carry, with `other` where it really is.
        model: collision geometry of the cell.
        other: index of the part.
    """
    part, name = cell.part_index(target.part), cell.parts[other].name
    after = cell.with_part_at(part, target.X_WP)
    near = _core.touching_bodies(model, after, part, TOUCHING)
    if _core.BodyRef(_core.BodyRef.Kind.Part, other) in near:
        return True
    # All other contacts are allowed: those were looked at when the carry was planned.
    allowance = _core.Allowance(closed_on=part, held_touches=_all_but(cell, other))
    standing = cell
    for motion in carry.motions:
        X_HP = carry.X_HP if motion.X_HP is None else motion.X_HP
        there = cell.with_held(part, X_HP) if motion.held else standing
        if motion.held:
            X_WP = _core.hand_in_world(cell, motion.path[-1].q) @ X_HP
            standing = cell.with_part_at(part, X_WP)  # once the hand lets it go
        checker = _core.CollisionChecker(model, there, allowance)
        hit = _core.certify_path(checker, motion.path).hit
        if hit is not None and name in (hit.a, hit.b):
            return True
    return False


def _all_but(cell: _core.Cell, other: int) -> list[_core.BodyRef]:
    kind = _core.BodyRef.Kind
    fixtures = [_core.BodyRef(kind.Fixture, i) for i in range(len(cell.fixtures))]
    parts = [_core.BodyRef(kind.Part, i) for i in range(len(cell.parts)) if i != other]
    return fixtures + parts
