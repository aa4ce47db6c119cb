"""The whole arm, sampled, from where it is out to where there is room: the last resort.

For an open hand at a grasp and for one that holds a part, among obstacles that no straight motion
and no search in a plane leads past; reversed it is an approach or a deposit. Stances of the hand a
few centimetres off are proposed, on all sides, level and tilted; the free ones, those with most
room first, are the goals of a sampled motion with short edges, then with long ones. Every edge is
certified. Not guaranteed: that a way that exists is found within the budget. Article: the
"guaranteed methods" to fall back on.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from handey import _core
from handey.options import with_fields

__all__ = ["WayOutOptions", "way_out"]

ROOMS = (0.02, 5e-3, 5e-4)  # Choice: stances with so much room round the robot are taken first [m]
TURN = 0.6  # Choice: about each axis of the hand, either way [rad]


@dataclass(frozen=True)
class WayOutOptions:
    """Budgets of one attempt.

    Attributes:
        distances: of the stances from where the hand is [m].
        most_stances: goals of one sampled motion.
        edges: longest edges of the trees, one attempt each [rad].
        sampling: seed, iterations of each attempt, certificate.
    """

    distances: tuple[float, ...] = (0.05, 0.10)
    most_stances: int = 8
    edges: tuple[float, ...] = (0.1, 0.5)
    sampling: _core.SamplingOptions = field(
        default_factory=lambda: _core.SamplingOptions(max_iterations=2000)
    )


def way_out(
    solver: _core.SphericalWristSolver,
    checker: _core.CollisionChecker,
    start: _core.Configuration,
    options: WayOutOptions,
) -> list[_core.Configuration]:
    """A certified path from `start`, which is free; empty if none was found.

    Args:
        solver: inverse kinematics of the arm.
        checker: of the cell, with what is held, if anything is.
        start: where the arm is; the opening stays.
        options: budgets.
    """
    stances = _stances(solver, checker, start, options)
    for longest in options.edges if stances else ():
        sampling = with_fields(options.sampling, range=longest)
        motion = _core.plan_by_sampling(checker, start, stances, sampling)
        if motion.found:
            shortcut = _core.ShortcutOptions(seed=sampling.seed)
            return list(_core.shorten_path(checker, motion.path, shortcut))
    return []


def _stances(
    solver: _core.SphericalWristSolver,
    checker: _core.CollisionChecker,
    start: _core.Configuration,
    options: WayOutOptions,
) -> list[_core.Configuration]:
    """Free configurations near `start`: one for each pose of the hand, the arm moved least."""
    cell = checker.cell
    X_RW = np.linalg.inv(cell.X_WR)
    X_WH = _core.hand_in_world(cell, start.q)
    found: list[tuple[float, int, _core.Configuration]] = []
    for distance, toward, turn in product(options.distances, _directions(), _turns()):
        X_WS = X_WH.copy()
        X_WS[:3, 3] += distance * toward
        X_WS[:3, :3] = X_WH[:3, :3] @ turn
        solutions = solver.solve(X_RW @ X_WS, start.q).solutions
        moved = [float(np.max(np.abs(solution.q - start.q))) for solution in solutions]
        for i in sorted(range(len(moved)), key=moved.__getitem__):
            stance = _core.Configuration(q=solutions[i].q, opening=start.opening)
            if not checker.is_free(stance, ROOMS[-1]):
                continue
            rank = next(r for r, room in enumerate(ROOMS) if checker.is_free(stance, room))
            found.append((rank + moved[i] / 10.0, len(found), stance))
            break
    return [stance for *_, stance in sorted(found, key=lambda f: f[:2])[: options.most_stances]]


def _directions() -> list[np.ndarray]:
    """Up, and round about, level and slanted upwards, in the world."""
    around = np.linspace(0.0, 2 * np.pi, 8, endpoint=False)
    slanted = [np.array([np.cos(a), np.sin(a), z]) for z in (0.0, 1.0) for a in around]
    return [np.array([0.0, 0.0, 1.0]), *(d / np.linalg.norm(d) for d in slanted)]


def _turns() -> list[np.ndarray]:
    """Turns of the hand: none, and about each of its axes."""
    turns = [np.eye(3)]
    for axis, angle in product(range(3), (TURN, -TURN)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[i, i] = turn[j, j] = np.cos(angle)
        turn[j, i], turn[i, j] = np.sin(angle), -np.sin(angle)
        turns.append(turn)
    return turns
