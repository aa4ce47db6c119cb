"""What became of the feature pairs, hand poses and grasps of one goal, stage by stage.

Filled while planning, at next to no cost: results of the core are kept as they are, and counted
when the report is asked for. A pair that several passes look at counts once, with the pass that
looked at most of its hand poses; a grasp that was tried again counts where it fell last.
Not told: pairs with edges and vertices beyond the best of them, which are not looked at.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import zip_longest

from handey import _core
from handey.motion.carry import Carry, Workspace
from handey.reporting.reasons import STAGES, Reason, Stage, Tried, merged
from handey.reporting.wording import Names, of_carry, of_fallen, of_obstructed, of_rejected

__all__ = ["Funnel"]

MOST_TRIED = 200  # Choice: hand poses that are kept for pictures
MOST_LOOKED_ROUND = 12  # Choice: grasps round which is looked what stands in their way


@dataclass
class _Pair:
    """A feature pair that the jaws span.

    Attributes:
        ranked: with what of it is free.
        is_free: enough of it is for a pad, in one of the passes.
        found: what came of its hand poses, of finished passes.
        searches: passes that are not finished.
        legal: hand poses that are, of all passes.
    """

    ranked: _core.RankedPair
    is_free: bool
    found: list[_core.LegalGrasps] = field(default_factory=list)
    searches: dict[int, _core.LegalGraspSearch] = field(default_factory=dict)
    legal: int = 0

    def best_look(self) -> _core.LegalGrasps | None:
        """Of the pass that looked at most."""
        looks = [*self.found, *(search.result() for search in self.searches.values())]
        return max(looks, key=lambda found: found.tried, default=None)


@dataclass
class _Grasp:
    """A grasp that was taken up, and how far it got; what it met, if that was asked."""

    aim: _core.GraspPose
    carry: Carry
    approached: bool = False
    hit: _core.Hit | None = None

    def reason(self, names: Names) -> Reason | None:
        """Why it fell; None if it was planned with."""
        return None if self.carry.stage == "done" else of_carry(self.carry, self.hit, names)


@dataclass
class Funnel:
    """Counts of one goal.

    Attributes:
        work: the goal.
        rejected: pairs that the jaws cannot take.
        pairs: that they span, by name.
        grasps: that were taken up, by number.
        regrasping: why step 7 found nothing.
        no_features: that there is no pair at all, by the features looked for.
        diagnosis: a look at what is in the way of hand poses, if no grasp was legal.
        closer: the same of many more, for the nearest miss; None where that was not asked for.
    """

    work: Workspace | None = None
    rejected: list[_core.RejectedPair] = field(default_factory=list)
    pairs: dict[str, _Pair] = field(default_factory=dict)
    grasps: dict[int, _Grasp] = field(default_factory=dict)
    regrasping: list[Reason] = field(default_factory=list)
    no_features: list[Reason] = field(default_factory=list)
    diagnosis: _core.Diagnosis | None = None
    closer: _core.Diagnosis | None = None

    # While planning.

    def rank(self, ranking: _core.Ranking) -> None:
        """The pairs of a kind, for the first time."""
        self.rejected += ranking.rejected
        for is_free, pairs in ((True, ranking.ranked), (False, ranking.obstructed)):
            for ranked in pairs:
                self.pairs[str(ranked.pair)] = _Pair(ranked, is_free)

    def take_up(self, pair: _core.RankedPair) -> _Pair:
        """A pair whose hand poses are looked at."""
        known = self.pairs.setdefault(str(pair.pair), _Pair(pair, True))
        known.is_free = True
        return known

    def searching(self, pair: _core.RankedPair, search: _core.LegalGraspSearch) -> None:
        """A search among the hand poses of a pair that goes on by turns."""
        self.take_up(pair).searches[id(search)] = search

    def looked(self, pair: _core.RankedPair, found: _core.LegalGrasps, search: object = 0) -> None:
        """What came of a pair's hand poses."""
        known = self.take_up(pair)
        known.searches.pop(id(search), None)
        known.found.append(found)

    def tried(self, grasp: int, aim: _core.GraspPose, carry: Carry, approached: bool) -> None:
        """How far a grasp got, last."""
        known = self.grasps.setdefault(grasp, _Grasp(aim, carry))
        if approached or not known.approached:
            known.aim, known.carry = aim, carry
        known.approached |= approached

    def look_round(self, most: int = MOST_LOOKED_ROUND) -> None:
        """Ask what stood in the way of the grasps that got farthest."""
        farthest = sorted(self.grasps.values(), key=lambda grasp: not grasp.approached)
        for grasp in farthest[:most]:
            grasp.hit = next(iter(grasp.carry.met()), None)

    # When the report is asked for.

    def stages(self) -> list[Stage]:
        """The six stages in their order; what is passed over is not counted."""
        stages = {name: Stage(name) for name in STAGES}
        spanned = list(self.pairs.values())
        pairs = len(spanned) + len(self.rejected)
        free = [pair for pair in spanned if pair.is_free]
        legal = sum(pair.legal for pair in free)
        stages["found"] = Stage("found", pairs, pairs, list(self.no_features))
        fell = merged(of_rejected(pair) for pair in self.rejected)
        stages["spanned"] = Stage("spanned", pairs, len(spanned), fell)
        fell = merged(of_obstructed(pair.ranked) for pair in spanned if not pair.is_free)
        stages["unobstructed"] = Stage("unobstructed", len(spanned), len(free), fell)
        fallen = merged(self._fallen(free))
        looked = legal + sum(reason.count for reason in fallen)
        stages["reachable"] = Stage("reachable", looked, legal, fallen)
        for name in ("approached", "connected"):
            stages[name] = self._grasps_at(name)
        stages["connected"].reasons += merged(self.regrasping)
        return list(stages.values())

    def _fallen(self, pairs: Iterable[_Pair]) -> Iterator[Reason]:
        for pair in pairs:
            look = pair.best_look()
            for fallen in [] if look is None else look.fallen:
                yield of_fallen(fallen, self.names)

    def _grasps_at(self, stage: str) -> Stage:
        came = [g for g in self.grasps.values() if g.approached or stage == "approached"]
        reasons = [grasp.reason(self.names) for grasp in came]
        fell = [reason for reason in reasons if reason is not None and reason.stage == stage]
        return Stage(stage, len(came), len(came) - len(fell), merged(fell))

    @property
    def parts(self) -> list[_core.Body]:
        """Of the cell."""
        return [] if self.work is None else list(self.work.scene.cell.parts)

    @cached_property
    def names(self) -> Names:
        """Of the robot."""
        assert self.work is not None
        return Names(self.work.scene.cell.robot)

    def poses(self, most: int = MOST_TRIED) -> list[Tried]:
        """Hand poses for pictures: grasps that were taken up; of each pair the nearest misses."""
        taken = []
        for grasp in list(self.grasps.values())[-most // 2 :]:
            reason = grasp.reason(self.names)
            stage, text = (reason.stage, reason.text) if reason else ("", "")
            taken.append(_tried(grasp.aim, stage, text))
        looks = [pair.best_look() for pair in self.pairs.values() if pair.is_free]
        by_pair = [look.fallen for look in looks if look is not None]
        for turn in zip_longest(*by_pair):
            for fallen in turn:
                if fallen is None:
                    continue
                if len(taken) == most:
                    return taken
                taken.append(_tried(fallen, "reachable", of_fallen(fallen, self.names).text))
        return taken


def _tried(pose: _core.GraspPose | _core.Fallen, stage: str, text: str) -> Tried:
    X_PH = [[float(value) for value in row] for row in pose.X_PH]
    return Tried(X_PH, float(pose.opening), float(pose.width), stage, text)
