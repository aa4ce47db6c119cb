"""Where to put a part down between two grasps: positions and turns that the arm reaches well.

For a resting pose, places on all supports are sampled where the part stands stably and clear of
everything; those at which the best of the needed grasps have most room at their joint limits come
first, a few of them, apart from each other. Not guaranteed: that a place that exists is found.
Article: "Regrasping", the choice of placements.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey import _core
from handey.resting import PlacementOptions, Sought, placements

__all__ = ["Candidate", "PlaceFinder", "comfortable"]

# Choice: places this near to each other, turned by no more, count as the same [m], [cos].
APART, TURNED = 0.05, 0.94
ROOM = 0.03  # Choice: more room than this round the part is worth no more [m]
COMFORT = (0.40, 0.60)  # Choice: distance from the base about which places are looked for [m]
WITHIN = 0.35  # Choice: half of the samples are this near to there [m]


@dataclass(frozen=True, eq=False)
class Candidate:
    """A place for a part.

    Attributes:
        X_WP: the part in the world (4, 4).
        on: name of what it stands on.
        score: room at the joint limits for the worse of the needed groups of grasps, and a little
            for room round the part.
    """

    X_WP: np.ndarray
    on: str
    score: float


@dataclass(frozen=True)
class PlaceFinder:
    """Finds places for one part in one cell.

    Attributes:
        model: collision geometry of the cell.
        cell: where the other bodies are.
        part: index of the part.
        solver: inverse kinematics of the arm.
        grasps: of the part.
        rests: its resting poses.
        middle: half of the samples are around this point of the world (2,).
        seed: of the samples.
    """

    model: _core.CollisionModel
    cell: _core.Cell
    part: int
    solver: _core.SphericalWristSolver
    grasps: _core.PartGrasps
    rests: list[_core.RestingPose]
    middle: np.ndarray
    seed: int

    @property
    def has_support(self) -> bool:
        """Is there a body on which the part may be put down on the way?"""
        others = [body for i, body in enumerate(self.cell.parts) if i != self.part]
        return any(body.support for body in [*self.cell.fixtures, *others])

    def best(
        self, rest: int, groups: list[list[int]], samples: int, most: int
    ) -> tuple[list[Candidate], str]:
        """The best places for a resting pose, best first; without any, why.

        Args:
            rest: index of the resting pose.
            groups: a place must have a grasp of each within reach.
            samples: that are looked at.
            most: that are returned.
        """
        sought = Sought()
        options = PlacementOptions(
            seed=self.seed, first_round=samples, rounds=1, within=WITHIN, enough_room=ROOM
        )
        found = list(
            placements(
                self.cell,
                self.model,
                self.part,
                rests=self.rests,
                only=[rest],
                near=self.middle,
                options=options,
                sought=sought,
            )
        )
        if not found:
            return [], sought.reason()
        X_WP = np.array([place.X_WP for place in found])
        margins = _core.reach_margins(self.cell, self.solver, self.grasps, groups, X_WP)
        least = margins.min(axis=1)
        rooms = np.array([min(place.room, ROOM) / ROOM for place in found])
        scores = np.where(least < 0, -1.0, least + 0.3 * rooms)
        chosen: list[Candidate] = []
        for i in np.argsort(-scores, kind="stable"):
            if scores[i] < 0 or len(chosen) == most:
                break
            if all(_apart(X_WP[i], other.X_WP) for other in chosen):
                chosen.append(Candidate(X_WP[i], found[i].on, float(scores[i])))
        reached = int(np.sum(least >= 0))
        return chosen, f"{len(found)} places with room, {reached} of them within reach"


def comfortable(cell: _core.Cell, X_WP: np.ndarray, X_WP_goal: np.ndarray) -> np.ndarray:
    """A point (2,) between two places, as far from the base as the arm likes best."""
    base = cell.X_WR[:2, 3]
    middle = (X_WP[:2, 3] + X_WP_goal[:2, 3]) / 2 - base
    distance = float(np.linalg.norm(middle))
    away = middle / distance if distance > 1e-3 else np.array([1.0, 0.0])
    point: np.ndarray = base + np.clip(distance, *COMFORT) * away
    return point


def _apart(a: np.ndarray, b: np.ndarray) -> bool:
    near = np.linalg.norm(a[:3, 3] - b[:3, 3]) < APART
    return not (near and (np.trace(a[:3, :3].T @ b[:3, :3]) - 1) / 2 > TURNED)
