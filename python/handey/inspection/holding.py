"""How many grasps of a part are legal where it stands, where it is to stand, and at both?

The grasps are those that planning keeps of each part, hand poses in the part frame; which of them
are legal at a place is asked of all at once, so what serves two places is what both have in common.
Where none is left, the direct search for pairs and hand poses at these places has the last word,
and says what stood in the way. Not guaranteed: that a grasp which no search looks at is not legal.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np

from handey import _core

__all__ = ["Held", "Holding", "rank"]

MOST_POSES = 1000  # Choice: of a pair


@dataclass(frozen=True)
class Held:
    """How many hand poses hold a part legally.

    Attributes:
        legal: of them.
        tried: all that were looked at.
        reason: what the others met most often; empty where some are legal.
    """

    legal: int
    tried: int
    reason: str

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {"legal": self.legal, "tried": self.tried, "reason": self.reason}


def rank(
    cell: _core.Cell,
    part: int,
    X_WP: np.ndarray,
    both: bool,
    features: _core.FeaturePairs | None = None,
) -> _core.Ranking:
    """A part's pairs by what is unobstructed where it is and, if `both`, at X_WP (4, 4)."""
    options = _core.RankingOptions(use_destination=both)
    return _core.rank_grasps(cell, part, X_WP, options, features=features)


class Holding:
    """Looks at places of parts; keeps the grasps of each part."""

    def __init__(self, robot: _core.Robot, solver: _core.SphericalWristSolver) -> None:
        self._robot, self._solver = robot, solver
        self._grasps: dict[str, _core.PartGrasps] = {}

    def at(
        self, cell: _core.Cell, model: _core.CollisionModel, part: int, X_WP: np.ndarray
    ) -> tuple[set[int], Held]:
        """Which of the part's grasps are legal at X_WP (4, 4), and how many hand poses.

        Args:
            cell: where all else is.
            model: collision geometry of the cell.
            part: index in the cell's parts.
            X_WP: the part in the world.
        """
        grasps = self._grasps_of(cell.parts[part])
        everything = [list(range(len(grasps)))]
        legal: set[int] = set()
        if len(grasps):
            (found,) = _core.find_compatible_grasps(
                model, cell, part, self._solver, grasps, everything, [X_WP], configurations=1
            )
            legal = {entry.grasp for entry in found.legal}
        if legal:
            return legal, Held(len(legal), len(grasps), "")
        there = cell.with_part_at(part, X_WP)
        return legal, self._search(there, model, part, X_WP, rank(there, part, X_WP, False))

    def at_both(
        self,
        cell: _core.Cell,
        model: _core.CollisionModel,
        part: int,
        X_WP: np.ndarray,
        common: set[int],
    ) -> Held:
        """How many hand poses are legal where the part is and at X_WP (4, 4).

        Args:
            cell: with the part where it is.
            model: collision geometry of the cell.
            part: index in the cell's parts.
            X_WP: the part in the world, at the other place.
            common: grasps that `at` found legal at both places.
        """
        if common:
            return Held(len(common), len(self._grasps_of(cell.parts[part])), "")
        return self._search(cell, model, part, X_WP, rank(cell, part, X_WP, True))

    def _grasps_of(self, part: _core.Body) -> _core.PartGrasps:
        if part.name not in self._grasps:
            self._grasps[part.name] = _core.sample_part_grasps(part, self._robot)
        return self._grasps[part.name]

    def _search(
        self,
        cell: _core.Cell,
        model: _core.CollisionModel,
        part: int,
        X_WP: np.ndarray,
        ranking: _core.Ranking,
    ) -> Held:
        """The hand poses that the direct search finds for where the part is and X_WP (4, 4)."""
        if not ranking.ranked:
            return Held(0, 0, _no_pair(ranking))
        one_place = np.allclose(np.asarray(cell.parts[part].X_WB), X_WP, atol=1e-9)
        scene = _core.GraspScene(model=model, cell=cell, part=part, X_WP_goal=X_WP)
        options = _core.LegalityOptions(most_poses=MOST_POSES)
        legal = tried = 0
        reasons: Counter[str] = Counter()
        for pair in ranking.ranked:
            found = _core.find_legal_grasps(scene, self._solver, pair, options)
            legal += len(found.poses)
            tried += found.tried
            if found.worst_reason:
                fallen = found.tried - len(found.poses)
                reasons[_kind_of(found.worst_reason, one_place)] += fallen
        most = reasons.most_common(1)
        return Held(legal, tried, most[0][0] if most and not legal else "")


def _kind_of(reason: str, one_place: bool) -> str:
    """A reason without the counts of its pair, and at one place without that place."""
    kind = reason.rsplit(": ", 1)[0]
    return kind.replace(" (origin)", "").replace(" (destination)", "") if one_place else kind


def _no_pair(ranking: _core.Ranking) -> str:
    """Why no pair of features is left."""
    met = Counter(name for pair in ranking.obstructed for name in pair.obstructing)
    if met:
        names = ", ".join(name for name, _ in met.most_common(3))
        count = len(ranking.obstructed)
        spanned = "the one pair that the jaws span is" if count == 1 else f"all {count} pairs are"
        return f"{spanned} obstructed by {names}"
    if ranking.rejected:
        least = min(ranking.rejected, key=lambda pair: pair.width)
        return f"the jaws span no pair; {least}: {least.reason}"
    return "no two features are opposite to each other"
