"""Every way out of a contact: straight lines in many directions, and a flood of the grasp plane.

Used by the exhaustive search. A way leads from the grasp outwards, certified edge by edge; driven
backwards it is an approach or a deposit.
"""

from __future__ import annotations

import heapq
import itertools
import math

import numpy as np
from exhaustive_grasps import Ends, Grasp, Stopwatch

from handey import _core

AWAY = 0.10  # so far from the grasp the hand is in the open [m]
LEAST_OUT = 0.003  # a straight way out that is shorter is none [m]
STEP, TURN, MOST_NODES = 0.006, math.radians(5.0), 6000  # of the flood [m, rad]
LARGEST_JUMP = 0.3  # of a joint from node to node [rad]

Way = list[_core.Configuration]


def sphere_directions() -> list[np.ndarray]:
    """The 26 directions to the faces, edges and corners of a cube, and up tilted by a little."""
    cube = [np.array(d, dtype=float) for d in itertools.product((-1, 0, 1), repeat=3) if any(d)]
    tilted = [np.array([math.cos(a), math.sin(a), 2.5]) for a in np.arange(8) * math.pi / 4]
    return [d / np.linalg.norm(d) for d in cube + tilted]


class WaysOut:
    """Ways out of a contact in one cell, for the empty hand and for the hand with its part."""

    def __init__(self, ends: Ends, watch: Stopwatch) -> None:
        self.ends, self.watch = ends, watch

    def empty_hand_out(
        self, checker: _core.CollisionChecker, grasp: Grasp, q: np.ndarray
    ) -> tuple[Way, str]:
        start = _core.Configuration(q=q, opening=grasp.opening)
        X_WH = _core.hand_in_world(self.ends.cell, q)
        back = [X_WH[:3, :3] @ d for d in sphere_directions() if d[2] < 0]
        solver, options = self.ends.solver, _core.RetreatOptions(least=LEAST_OUT, most=AWAY)
        best: Way = []
        longest = 0.0
        for direction in [-X_WH[:3, 2], *back]:
            result = _core.plan_retreat(checker, checker, solver, start, direction, options)
            if result.found and result.travelled > longest:
                best, longest = list(result.path), result.travelled
                if longest >= 0.99 * AWAY:
                    return best, "straight"
        flooded = self.flood(checker, grasp, start, X_WH)
        return (flooded, "flood") if flooded else (best, f"straight, {1e3 * longest:.0f} mm")

    def flood(
        self,
        checker: _core.CollisionChecker,
        grasp: Grasp,
        start: _core.Configuration,
        X_WH: np.ndarray,
    ) -> Way:
        """Flood the grasp plane from the grasp until the hand is in the open; farthest first."""
        parents: dict[tuple[int, int, int], tuple[int, int, int] | None] = {(0, 0, 0): None}
        reached = {(0, 0, 0): start}
        queue: list[tuple[float, tuple[int, int, int]]] = [(0.0, (0, 0, 0))]
        steps = [s for s in itertools.product((-1, 0, 1), repeat=3) if sum(map(abs, s)) == 1]
        while queue and len(parents) < MOST_NODES:
            _, node = heapq.heappop(queue)
            if math.hypot(node[0], node[1]) * STEP >= AWAY:
                way = [node]
                while parents[way[-1]] is not None:
                    way.append(parents[way[-1]])
                return [reached[n] for n in way[::-1]]
            self.watch.respect()
            for step in steps:
                there = (node[0] + step[0], node[1] + step[1], node[2] + step[2])
                if there in parents:
                    continue
                # In the hand's frame at the grasp: z and x span the grasp plane.
                move = np.eye(4)
                c, s = math.cos(there[2] * TURN), math.sin(there[2] * TURN)
                move[:3, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
                move[0, 3], move[2, 3] = there[1] * STEP, -there[0] * STEP
                q = self.nearest(X_WH @ move, reached[node].q)
                if q is None:
                    continue
                here = _core.Configuration(q=q, opening=grasp.opening)
                if not _core.certify_edge(checker, reached[node], here).is_free:
                    continue
                parents[there], reached[there] = node, here
                rank = -math.hypot(there[0], there[1]) + 0.2 * abs(there[2])
                heapq.heappush(queue, (rank, there))
        return []

    def nearest(self, X_WH: np.ndarray, q: np.ndarray) -> np.ndarray | None:
        solver, X_RH = self.ends.solver, self.ends.X_RW @ X_WH
        solutions = [s.q for s in solver.solve(X_RH, q).solutions]
        if not solutions:
            return None
        best = min(solutions, key=lambda other: float(np.abs(other - q).max()))
        return best if np.abs(best - q).max() < LARGEST_JUMP else None

    def lift(self, cell: _core.Cell, grasp: Grasp, q: np.ndarray) -> Way:
        """The longest straight way of the held part out of its contacts."""
        touches = _core.touching_bodies(self.ends.model, cell, self.ends.part)
        X_HP = np.linalg.inv(grasp.X_PH)
        held = cell.with_held(self.ends.part, X_HP)
        allowed = _core.Allowance(held_touches=touches)
        in_contact = _core.CollisionChecker(self.ends.model, held, allowed)
        clear = _core.CollisionChecker(self.ends.model, held)
        start = _core.Configuration(q=q, opening=grasp.width)
        options = _core.RetreatOptions(least=LEAST_OUT, most=AWAY)
        best: Way = []
        longest = 0.0
        directions = sorted((d for d in sphere_directions() if d[2] > -0.01), key=lambda d: -d[2])
        for direction in directions:
            result = _core.plan_retreat(
                in_contact, clear, self.ends.solver, start, direction, options
            )
            if result.found and result.travelled > longest:
                best, longest = list(result.path), result.travelled
                if longest >= 0.99 * AWAY:
                    break
        return best
