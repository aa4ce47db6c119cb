"""Lifts: a held part leaves what it stands on, with the hand and all that is in it kept clear.

Straight first: up, up and away from walls, up and back along the hand, back along the hand. Where
none goes far enough, from where it came clear of contact: straight on in another direction, level
ones among them; then by the planners of the approach in the grasp plane, the part being one more
body of the hand; and if asked, by sampling the whole arm. A way that ends where the gross motion
starts in a free cell is preferred. Reversed, a lift is the end of a deposit.
Every edge is certified by the core; while the part has moved less than `contact_travel` the
contacts that it stood in are allowed, if none gets deeper.
Not guaranteed: a way that exists is found; a part between walls that it touches on opposite sides
must be clear of them after that travel; the planners in the plane leave it nowhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from handey import _core

__all__ = ["PLANNERS", "Lift", "Sampler", "WaysOut", "draw_back", "lift", "roomiest"]

# A certified way for the arm from a configuration out to where there is room, empty if none is
# found: of the checker of the cell with the part in the hand, and where the arm is.
Sampler = Callable[[_core.CollisionChecker, _core.Configuration], list[_core.Configuration]]

# How the planners near obstacles are called in reports.
PLANNERS = {
    "Straight": "straight",
    "Quasipotential": "quasipotential",
    "PlaneSearch": "plane search",
    "Arm": "RRT-Connect",
}
# Choice: level directions, and how far each is tried [m], for a part that also touches walls.
DIRECTIONS_AWAY, STEP_AWAY = 16, 1.5e-3
DIRECTIONS_ON = 8  # Choice: level directions in which a lift that stops short goes on


@dataclass(frozen=True)
class WaysOut:
    """The planners of a way out, in the order in which they are asked, and their budgets.

    Attributes:
        straight: how far, and how finely.
        in_plane: in the grasp plane, where nothing straight leads out.
        roomier: the same, where something straight does, but with little room at its end; None: no.
        sample: asked for a way for the arm where nothing else leads out.
    """

    straight: _core.RetreatOptions
    in_plane: _core.DepartureOptions
    roomier: _core.DepartureOptions | None
    sample: Sampler


@dataclass(frozen=True)
class Lift:
    """A way out, of contact or round a part, or why there is none; true if found.

    Attributes:
        path: outwards, certified.
        planner: what gave it: "straight", "two straights", "quasipotential", "plane search",
            "RRT-Connect".
        has_room: it ends where the first three joints are free some way to either side.
        reason: why there is none, with names and numbers.
    """

    path: list[_core.Configuration] = field(default_factory=list)
    planner: str = "straight"
    has_room: bool = False
    reason: str = ""

    def __bool__(self) -> bool:
        return bool(self.path)


def lift(
    model: _core.CollisionModel,
    solver: _core.SphericalWristSolver,
    cell: _core.Cell,
    part: int,
    start: _core.Configuration,
    X_HP: np.ndarray,
    out: WaysOut,
) -> Lift:
    """Carry a part, held at `start`, off what it touches and out to where there is room.

    Args:
        model: collision geometry of the cell.
        solver: inverse kinematics of the arm.
        cell: with the part where it stands, and an empty hand.
        part: index of the part.
        start: the hand closed on it.
        X_HP: the part in the grasp frame (4, 4).
        out: the planners.
    """
    touches = _core.touching_bodies(model, cell, part)
    held = cell.with_held(part, X_HP)
    in_contact = _core.CollisionChecker(model, held, _core.Allowance(held_touches=touches))
    clear = _core.CollisionChecker(model, held)
    back = -_core.hand_in_world(cell, start.q)[:3, 2]
    away = _away(model, cell, part) if len(touches) > 1 else None
    best, short, reason = None, None, ""
    for direction in _directions(back, away):
        result = _core.plan_retreat(in_contact, clear, solver, start, direction, out.straight)
        rank = (result.has_room, result.travelled)
        if result.found and (best is None or rank > (best.has_room, best.travelled)):
            best = result
        if result.found and result.travelled >= 0.99 * out.straight.most:
            break
        if not result.found and len(result.path) > 1 and short is None:
            short = result
        reason = reason or result.reason
    begun = best or short
    if begun is None:
        return Lift(reason=reason)

    def ways() -> Iterator[Lift]:
        if best is not None:
            straight = Lift(list(best.path), has_room=best.has_room)
        else:
            straight = _go_on(clear, solver, begun.path, back, out.straight)
        yield straight
        in_plane = out.roomier if straight else out.in_plane
        yield from _in_plane(clear, solver, begun.path, in_plane)

    found = roomiest(ways())
    if found:
        return found
    way = out.sample(clear, begun.path[-1])
    if way:
        return Lift([*begun.path, *way[1:]], PLANNERS["Arm"])
    return Lift(reason=reason)


def draw_back(
    checker: _core.CollisionChecker,
    solver: _core.SphericalWristSolver,
    start: _core.Configuration,
    out: WaysOut,
) -> Lift:
    """Draw the open hand back from a part that stands: straight, in the grasp plane, by the arm.

    Args:
        checker: of the cell with an empty hand.
        solver: inverse kinematics of the arm.
        start: the hand open round the part.
        out: the planners.
    """
    hand = _core.hand_in_world(checker.cell, start.q)
    reason = ""

    def ways() -> Iterator[Lift]:
        nonlocal reason
        found = False
        for angle in (0.0, 0.35, -0.35, 0.8, -0.8):
            direction = np.sin(angle) * hand[:3, 0] - np.cos(angle) * hand[:3, 2]
            result = _core.plan_retreat(checker, checker, solver, start, direction, out.straight)
            reason = reason or result.reason
            if result.found:
                found = True
                yield Lift(list(result.path), has_room=result.has_room)
        in_plane = out.roomier if found else out.in_plane
        yield from _in_plane(checker, solver, [start], in_plane)

    found = roomiest(ways())
    if found:
        return found
    way = out.sample(checker, start)
    return Lift(way, PLANNERS["Arm"]) if way else Lift(reason=reason)


def roomiest(ways: Iterable[Lift]) -> Lift:
    """The first way that ends with room; if none does, the first that was found."""
    first = Lift()
    for way in ways:
        if way.has_room:
            return way
        if way and not first:
            first = way
    return first


def _in_plane(
    clear: _core.CollisionChecker,
    solver: _core.SphericalWristSolver,
    path: list[_core.Configuration],
    options: _core.DepartureOptions | None,
) -> Iterator[Lift]:
    """Out in the grasp plane, from where a straight left contact; from its end too, if off it."""
    if options is None:
        return
    ends = [min(2, len(path))]
    across = _core.hand_in_world(clear.cell, path[0].q)[:3, 1]
    moved = _at(clear, path[-1]) - _at(clear, path[0])
    if len(path) > 2 and abs(across @ moved) > 1e-3:
        ends.append(len(path))
    for end in ends:
        result = _core.plan_departure(clear, solver, path[end - 1], options)
        if result.found:
            whole = [*path[:end], *list(result.path)[1:]]
            yield Lift(whole, PLANNERS[result.planner.name], result.has_room)


def _at(checker: _core.CollisionChecker, configuration: _core.Configuration) -> np.ndarray:
    position: np.ndarray = _core.hand_in_world(checker.cell, configuration.q)[:3, 3]
    return position


def _go_on(
    clear: _core.CollisionChecker,
    solver: _core.SphericalWristSolver,
    path: list[_core.Configuration],
    back: np.ndarray,
    options: _core.RetreatOptions,
) -> Lift:
    """Straight on in other directions, from the end of a lift and from where it left contact."""
    level = [
        np.array([np.cos(angle), np.sin(angle), 0.0])
        for angle in np.linspace(0.0, 2 * np.pi, DIRECTIONS_ON, endpoint=False)
    ]
    for end in (len(path), 2) if len(path) > 2 else (2,):
        for direction in [back, *level]:
            on = _core.plan_retreat(clear, clear, solver, path[end - 1], direction, options)
            if on.found:
                return Lift([*path[:end], *list(on.path)[1:]], "two straights", on.has_room)
    return Lift()


def _away(model: _core.CollisionModel, cell: _core.Cell, part: int) -> np.ndarray | None:
    """The middle of the level directions in which a lift leaves all that the part touches."""
    X_WP = cell.parts[part].X_WB
    leaving = []
    for angle in np.linspace(0.0, 2 * np.pi, DIRECTIONS_AWAY, endpoint=False):
        aside = np.array([np.cos(angle), np.sin(angle), 0.0])
        moved = X_WP.copy()
        moved[:3, 3] += STEP_AWAY * (aside + np.array([0.0, 0.0, 1.0]))
        if not _core.touching_bodies(model, cell.with_part_at(part, moved), part):
            leaving.append(aside)
    middle = np.sum(leaving, axis=0) if leaving else np.zeros(3)
    length = np.linalg.norm(middle)
    return middle / length if length > 0.1 else None


def _directions(back: np.ndarray, away: np.ndarray | None) -> list[np.ndarray]:
    """Straight up, then up and away from a wall, then up and back, then back along the hand."""
    up = np.array([0.0, 0.0, 1.0])
    from_wall = [] if away is None else [up + share * away for share in (0.3, 1.0)]
    slanted = [up + share * back for share in (0.3, 1.0)]
    candidates = [up, *from_wall, *slanted, back]
    unit = [d / np.linalg.norm(d) for d in candidates if np.linalg.norm(d) > 0.1]
    return [d for i, d in enumerate(unit) if all(d @ other < 0.999 for other in unit[:i])]
