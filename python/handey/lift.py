"""Lifts: a held part leaves what it stands on, with the hand and all that is in it kept clear.

Straight first: up, up and away from walls, up and back along the hand, back along the hand. Where
none goes far enough, from where it came clear of contact: straight on in another direction, level
ones among them; and if asked, by sampling the whole arm. Reversed, a lift is the end of a deposit.
Every edge is certified by the core; while the part has moved less than `contact_travel` the
contacts that it stood in are allowed, if none gets deeper.
Not guaranteed: a way that exists is found; a part between walls that it touches on opposite sides
must be clear of them after that travel.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from handey import _core

__all__ = ["Lift", "Sampler", "lift"]

# A certified way for the arm from a configuration out to where there is room, empty if none is
# found: of the checker of the cell with the part in the hand, and where the arm is.
Sampler = Callable[[_core.CollisionChecker, _core.Configuration], list[_core.Configuration]]

# Choice: level directions, and how far each is tried [m], for a part that also touches walls.
DIRECTIONS_AWAY, STEP_AWAY = 16, 1.5e-3
DIRECTIONS_ON = 8  # Choice: level directions in which a lift that stops short goes on


@dataclass(frozen=True)
class Lift:
    """A way out of contact, or why there is none; true if found.

    Attributes:
        path: from the contact outwards, certified.
        planner: what gave it: "straight", "two straights" or "RRT-Connect".
        reason: why there is none, with names and numbers.
    """

    path: list[_core.Configuration] = field(default_factory=list)
    planner: str = "straight"
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
    options: _core.RetreatOptions,
    sample: Sampler,
) -> Lift:
    """The longest of a few lifts of a part, held at `start`, off what it touches.

    Args:
        model: collision geometry of the cell.
        solver: inverse kinematics of the arm.
        cell: with the part where it stands, and an empty hand.
        part: index of the part.
        start: the hand closed on it.
        X_HP: the part in the grasp frame (4, 4).
        options: how far, and how finely.
        sample: asked for a way on for the arm where nothing straight leads out.
    """
    touches = _core.touching_bodies(model, cell, part)
    held = cell.with_held(part, X_HP)
    in_contact = _core.CollisionChecker(model, held, _core.Allowance(held_touches=touches))
    clear = _core.CollisionChecker(model, held)
    back = -_core.hand_in_world(cell, start.q)[:3, 2]
    away = _away(model, cell, part) if len(touches) > 1 else None
    best, short, reason = None, None, ""
    for direction in _directions(back, away):
        result = _core.plan_retreat(in_contact, clear, solver, start, direction, options)
        if result.found and (best is None or result.travelled > best.travelled):
            best = result
        if result.found and result.travelled >= 0.99 * options.most:
            break
        if not result.found and len(result.path) > 1 and short is None:
            short = result
        reason = reason or result.reason
    if best is not None:
        return Lift(list(best.path))
    if short is None:
        return Lift(reason=reason)
    path = _go_on(clear, solver, short.path, back, options)
    if path:
        return Lift(path, "two straights")
    way = sample(clear, short.path[-1])
    if way:
        return Lift([*short.path, *way[1:]], "RRT-Connect")
    return Lift(reason=reason)


def _go_on(
    clear: _core.CollisionChecker,
    solver: _core.SphericalWristSolver,
    path: list[_core.Configuration],
    back: np.ndarray,
    options: _core.RetreatOptions,
) -> list[_core.Configuration]:
    """Straight on in other directions, from the end of a lift and from where it left contact."""
    level = [
        np.array([np.cos(angle), np.sin(angle), 0.0])
        for angle in np.linspace(0.0, 2 * np.pi, DIRECTIONS_ON, endpoint=False)
    ]
    for end in (len(path), 2) if len(path) > 2 else (2,):
        for direction in [back, *level]:
            on = _core.plan_retreat(clear, clear, solver, path[end - 1], direction, options)
            if on.found:
                return [*path[:end], *list(on.path)[1:]]
    return []


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
