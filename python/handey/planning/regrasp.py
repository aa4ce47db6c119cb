"""Step 7: when no grasp serves both ends, the part is put down on the way and taken again.

Asked for when a first look at the faces finds no grasp that is legal at both ends. A table of many
more grasps, with edges and vertices, then tells whether any is: if so, the direct search goes on.
If not, the search for sequences begins: fewest regrasps first, at each number with grasps on faces
before the others; densely sampled grasps come last.
Not guaranteed: the number of regrasps is least over the grasps and places looked at. Article:
"Regrasping".
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property

import numpy as np

from handey import _core
from handey.motion.carry import Carry, Workspace
from handey.options import with_fields
from handey.planning.budgets import with_budget
from handey.planning.plan_options import PlanOptions
from handey.regrasp.grasp_table import (
    GraspTable,
    GraspTableOptions,
    grasp_table,
    joined,
)
from handey.regrasp.legal_grasps import clears_ground, compatible
from handey.regrasp.search import NO_SUPPORT, RegraspSearch
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason

__all__ = ["Regrasp"]

# Choice: grasps of the tables: on faces, on faces more densely, with edges and vertices.
MOST, MOST_DENSE, MOST_BEYOND = 6000, 8000, 12000
# Where the options ask for no denser passes: 5 degrees and 8 mm.
DENSE = _core.LegalityOptions(directions=72, spacing=0.008)
TRIED = ("placements looked at", "regrasp sequences tried", "approached")  # counts of all searches
# How far a carry got, for what is told of those that fell.
STAGES = ("approach", "depart", "deposit", "withdraw", "transit", "transfer", "home", "done")


class _Tier(Enum):
    """Which grasps are searched with: on faces, with edges and vertices too, on faces densely."""

    Faces = 0
    Beyond = 1
    Dense = 2


@dataclass
class Regrasp:
    """Step 7 for one goal; its tables are read when they are asked for.

    Attributes:
        work: the goal, and where the arm is.
        options: of planning.
        words: the sequence that was planned.
    """

    work: Workspace
    options: PlanOptions
    words: str = ""
    _searches: dict[_Tier, RegraspSearch] = field(default_factory=dict)
    _needed: bool | None = None
    _next: int = 0  # round that was not run yet

    @property
    def was_needed(self) -> bool:
        """Was it asked whether step 7 is needed, and found so?"""
        return bool(self._needed)

    def is_needed(self) -> bool:
        """Is there no grasp, of many, that is legal at both ends?"""
        if self._needed is None:
            self._needed = bool(self.options.regrasp.most_regrasps) and self._find_need()
        return self._needed

    def _find_need(self) -> bool:
        choice, kinds = self.options.ranking.pairs, _core.PairChoice
        faces = choice != kinds.BeyondFaces and self._has_common(self._dense)
        return not faces and not (choice != kinds.TwoFaces and self._has_common(self._beyond))

    def run(self, round_: int, most: int | None = None) -> Carry | None:
        """A carry with regrasps, planned with the budgets of a round, or None; once per round.

        Args:
            round_: of attempts.
            most: sequences whose motions are planned; None: as the options say.
        """
        if round_ < self._next:
            return None
        self._next = round_ + 1
        direct = with_budget(self.options, round_)
        for search in self._searches.values():
            search.forgive()
        sequences = self.options.regrasp.sequences
        left = sequences[min(round_, len(sequences) - 1)]
        left = left if most is None else min(left, most)
        for tiers in self._tiers:
            for regrasps in range(1, self.options.regrasp.most_regrasps + 1):
                for tier in tiers:
                    search = self._search(tier)
                    before = search.tried
                    carry = search.run(regrasps, direct, left)
                    left -= search.tried - before
                    if carry is not None:
                        self.words = search.words
                        return carry
        return None

    def tell(self, report: GoalReport) -> None:
        """Add to the report what was looked at, if anything was."""
        searches = list(self._searches.values())
        if not searches:
            return
        # With edges and vertices all grasps are looked at again: the last search tells of the most.
        told: dict[str, int] = {}
        for search in searches:
            tried = {what: told.get(what, 0) for what in TRIED}
            told |= search.told.counts
            told |= {what: n + search.told.counts.get(what, 0) for what, n in tried.items()}
        for what, count in told.items():
            report.counts[what] = report.counts.get(what, 0) + count
        for search in searches:
            report.attempts += search.told.attempts
        if not self.words:
            why = [*self._best(), *searches[-1].told.reasons]
            report.reasons = [*why, *report.reasons]
            if why and report.looked is not None:
                text = why[0] if searches[-1].finder.has_support else NO_SUPPORT
                report.looked.regrasping = [Reason("no_regrasp", "connected", text)]

    def _best(self) -> list[str]:
        """What the sequence that got farthest fell at."""
        attempts = [a for search in self._searches.values() for a in search.told.attempts]
        if attempts:
            best = max(attempts, key=lambda attempt: STAGES.index(attempt.stage))
            return [f"regrasping, {best.grasp}: fell at {best.stage}: {best.reason}"]
        last = list(self._searches.values())[-1]
        if not last.joins_ends:
            return []
        most = self.options.regrasp.most_regrasps
        return [f"no place on the way joins the grasps of both ends by up to {most} regrasps"]

    @property
    def _tiers(self) -> tuple[tuple[_Tier, ...], ...]:
        """Grasps to search with, by turns for each number of regrasps, then the next of these."""
        choice, kinds = self.options.ranking.pairs, _core.PairChoice
        if choice == kinds.BeyondFaces:
            return ((_Tier.Beyond,),)
        first = (_Tier.Faces,) if choice == kinds.TwoFaces else (_Tier.Faces, _Tier.Beyond)
        return (first, (_Tier.Dense,)) if self.options.denser else (first,)

    def _search(self, tier: _Tier) -> RegraspSearch:
        if tier not in self._searches:
            self._searches[tier] = RegraspSearch(
                self.work,
                self._table_of(tier),
                self.options.regrasp,
                self.options.seed,
            )
        return self._searches[tier]

    def _table_of(self, tier: _Tier) -> GraspTable:
        choice, kinds = self.options.ranking.pairs, _core.PairChoice
        if choice == kinds.BeyondFaces:
            return self._beyond
        if tier == _Tier.Faces:
            return self._faces
        faces = self._faces
        if tier == _Tier.Dense:
            faces = self._table(kinds.TwoFaces, self.options.denser[-1], MOST_DENSE)
        return faces if choice == kinds.TwoFaces else joined(faces, self._beyond)

    def _has_common(self, table: GraspTable) -> bool:
        """Is a grasp of the table legal at both ends?"""
        scene = self.work.scene
        ends = [scene.cell.parts[scene.part].X_WB, scene.X_WP_goal]
        with self.work.clock("regrasp"):
            clear = np.all([clears_ground(self.work, table, X_WP) for X_WP in ends], axis=0)
            group = np.flatnonzero(clear).tolist()
            for most, X_WP in zip((0, 1), ends, strict=True):
                found = compatible(self.work, table, [group], X_WP[None], most)[0]
                group = [item.grasp for item in found.legal]
        return bool(group)

    @cached_property
    def _faces(self) -> GraspTable:
        return self._table(_core.PairChoice.TwoFaces, self.options.legality, MOST)

    @cached_property
    def _dense(self) -> GraspTable:
        dense = self.options.denser[0] if self.options.denser else DENSE
        return self._table(_core.PairChoice.TwoFaces, dense, MOST_DENSE)

    @cached_property
    def _beyond(self) -> GraspTable:
        return self._table(_core.PairChoice.BeyondFaces, self.options.legality, MOST_BEYOND)

    def _table(
        self, pairs: _core.PairChoice, legality: _core.LegalityOptions, most: int
    ) -> GraspTable:
        cell = self.work.scene.cell
        options = GraspTableOptions(with_fields(self.options.ranking, pairs=pairs), legality, most)
        with self.work.clock("grasp table"):
            return grasp_table(cell.parts[self.work.scene.part], cell.robot, options)
