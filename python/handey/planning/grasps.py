"""Which grasps to try, and why the others fell: the article's steps 1 to 3 as one stream.

Two faces are what jaws hold best, so their pairs come first, the best of each before more of any.
Pairs with edges and vertices are looked for when those have not served: they are worth less, and
there are more of them. What is passed over is told in the report, with numbers.
Not guaranteed: that a grasp which is yielded can be reached; that is the approach's to say.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from handey import _core
from handey.motion.carry import Workspace
from handey.options import with_fields
from handey.planning.pairs_told import illegal, report_pairs
from handey.planning.plan_options import PlanOptions
from handey.reporting.funnel import Funnel
from handey.reporting.goal_report import GoalReport

__all__ = ["Grasps", "describe"]

Grasp = tuple[_core.RankedPair, _core.GraspPose]
DENSER_PAIRS = 8  # Choice: the denser passes look at so many pairs of a kind, the best
PORTION = 400  # Choice: candidates of one pair looked at before the next pair has its turn
QUICK = 2  # Choice: turns of each pair in the quick look before anything costlier is asked
# A hand pose: its pair, place and direction in the grasp plane, half-turn.
_PoseKey = tuple[str, float, float, float, bool]


@dataclass
class _Turn:
    """A pair that is looked at by turns with others; its candidates are made when first asked."""

    pair: _core.RankedPair
    legality: _core.LegalityOptions
    search: _core.LegalGraspSearch | None = None


@dataclass
class _Seen:
    """What the passes before have looked at.

    Attributes:
        poses: that were legal.
        told: per pair that has none, where in the report's reasons that is told.
    """

    poses: set[_PoseKey] = field(default_factory=set)
    told: dict[str, int] = field(default_factory=dict)

    def tell(self, report: GoalReport, pair: str, reason: str, is_new: bool = False) -> None:
        """Why a pair has no legal pose; what the last pass says counts."""
        if pair in self.told:
            report.reasons[self.told[pair]] = reason
        elif is_new:
            self.told[pair] = len(report.reasons)
            report.reasons.append(reason)


class Grasps:
    """The grasp poses of one goal that are legal at both ends, in the order to try them.

    Tells the report what fell.
    """

    def __init__(self, work: Workspace, options: PlanOptions, report: GoalReport) -> None:
        self._looked = Funnel(work)
        report.begin(self._looked)
        self._work, self._options, self._report = work, options, report
        self._seen = _Seen()
        self._narrow: dict[_core.PairChoice, list[_core.RankedPair]] = {}
        self._kinds = _kinds(options)  # not looked at yet
        self._denser = _denser_passes(options)
        self._turns: deque[_Turn] = deque()
        self._blocked: _core.BlockedPoses | None = None

    def first(
        self,
        elsewhere: Callable[[], bool] = lambda: False,
        give_up: Callable[[], None] = lambda: None,
    ) -> Iterator[Grasp]:
        """All pairs, two faces first; in denser passes as long as none could be approached.

        Args:
            elsewhere: asked where a quick look, a denser one too, finds no legal pose; the stream
                ends there if true.
            give_up: called once if the first look finds no legal pose; raises if it is proved that
                there is none.
        """
        asked = False
        while self._kinds:
            kind = self._kinds.pop(0)
            yield from self._of_kind(kind)
            if not asked and not self._report.counts.get("legal grasp poses"):
                asked = True
                give_up()
            # Faces once more, before others are looked at.
            if self._denser and self._denser[0][0] == kind and not self._approached():
                self._begin(*self._denser.pop(0))
                yield from self._by_turns(self._approached, 1)
        if not self._approached():
            while self._denser:
                self._begin(*self._denser.pop(0))
            yield from self._by_turns(self._approached, QUICK)
        if not self._report.counts.get("legal grasp poses") and elsewhere():
            return
        yield from self.remaining()

    def remaining(self) -> Iterator[Grasp]:
        """What `first` left because of `elsewhere`, as if it had not been asked."""
        yield from self._by_turns(self._approached)

    def rest(self) -> Iterator[Grasp]:
        """What was spared, because a grasp could be approached or the first stream ended early."""
        while self._kinds:
            yield from self._of_kind(self._kinds.pop(0))
        yield from self._by_turns(lambda: False)
        while self._denser:
            self._begin(*self._denser.pop(0))
            yield from self._by_turns(lambda: False)

    def _of_kind(self, kind: _core.PairChoice) -> Iterator[Grasp]:
        ranking = _rank(self._work, self._options.ranking, kind)
        self._looked.rank(ranking)
        report_pairs(self._report, ranking, kind, self._options.ranking)
        yield from self._legal(ranking.ranked)

    def _approached(self) -> bool:
        return bool(self._report.counts.get("approached"))

    def _begin(self, kind: _core.PairChoice, legality: _core.LegalityOptions) -> None:
        """Look denser at the best pairs from now on."""
        if kind not in self._narrow:
            # The room that the fingers need when the jaws open as little as legality lets them.
            wanted = self._options.ranking
            least = min(wanted.open_clearance, legality.open_clearance / 4)
            self._narrow[kind] = _rank(self._work, wanted, kind, least).ranked[:DENSER_PAIRS]
        self._turns += [_Turn(pair, legality) for pair in self._narrow[kind]]

    def _by_turns(self, enough: Callable[[], bool], most: int | None = None) -> Iterator[Grasp]:
        """Go on with what was begun, some candidates of each pair in turn, `most` times at most."""
        left = None if most is None else most * len(self._turns)
        while self._turns and left != 0 and not enough():
            left = None if left is None else left - 1
            turn, work = self._turns.popleft(), self._work
            with work.clock("legal grasps"):
                if turn.search is None:
                    if self._blocked is None:
                        self._blocked = _core.BlockedPoses(work.scene)
                    turn.search = _core.LegalGraspSearch(
                        work.scene, work.solver, turn.pair, turn.legality, self._blocked
                    )
                    self._looked.searching(turn.pair, turn.search)
                found = turn.search.next(PORTION)
            if turn.search.is_done:
                self._tell(turn.pair, turn.search.result(), turn.search)
            else:
                self._turns.append(turn)
            for aim in self._fresh(turn.pair, found):
                yield turn.pair, aim

    def _legal(self, ranked: list[_core.RankedPair]) -> Iterator[Grasp]:
        """Some poses of each pair, best pair first, then as many more."""
        work, size = self._work, self._options.poses_per_round
        legal: list[list[_core.GraspPose] | None] = [None] * len(ranked)
        start = 0
        while any(poses is None or start < len(poses) for poses in legal):
            for i, pair in enumerate(ranked):
                if legal[i] is None:
                    with work.clock("legal grasps"):
                        found = _core.find_legal_grasps(
                            work.scene, work.solver, pair, self._options.legality
                        )
                    legal[i] = self._fresh(pair, found.poses)
                    self._tell(pair, found)
                for aim in (legal[i] or [])[start : start + size]:
                    yield pair, aim
            start += size

    def _fresh(self, pair: _core.RankedPair, poses: list[_core.GraspPose]) -> list[_core.GraspPose]:
        """Those that no pass before has found."""
        known, name = self._seen.poses, str(pair.pair)
        fresh = [pose for pose in poses if _key(name, pose) not in known]
        known.update(_key(name, pose) for pose in poses)
        self._report.add("legal grasp poses", len(fresh))
        self._looked.take_up(pair).legal += len(fresh)
        return fresh

    def _tell(
        self, pair: _core.RankedPair, found: _core.LegalGrasps, search: object = None
    ) -> None:
        """What came of a pair, for the reasons."""
        self._looked.looked(pair, found, search)
        name = str(pair.pair)
        if found.poses:
            self._seen.tell(self._report, name, f"{name}: legal hand poses only in a denser pass")
        else:
            self._seen.tell(self._report, name, illegal(pair, found), is_new=True)


def _kinds(options: PlanOptions) -> list[_core.PairChoice]:
    """The pairs that are looked at, two faces first."""
    kinds = [_core.PairChoice.TwoFaces, _core.PairChoice.BeyondFaces]
    if not options.ranking.features.beyond_faces:
        kinds.pop()
    return [kind for kind in kinds if options.ranking.pairs in (kind, _core.PairChoice.All)]


def _denser_passes(
    options: PlanOptions,
) -> list[tuple[_core.PairChoice, _core.LegalityOptions]]:
    return [(kind, legality) for legality in options.denser for kind in _kinds(options)]


def _rank(
    work: Workspace,
    wanted: _core.RankingOptions,
    choice: _core.PairChoice,
    open_clearance: float | None = None,
) -> _core.Ranking:
    options = with_fields(wanted, pairs=choice)
    if open_clearance is not None:
        options.open_clearance = open_clearance
    scene = work.scene
    with work.clock("rank grasps"):
        return _core.rank_grasps(scene.cell, scene.part, scene.X_WP_goal, options)


def _key(pair: str, pose: _core.GraspPose) -> _PoseKey:
    at = pose.in_plane
    return pair, round(at.x, 6), round(at.y, 6), round(at.theta, 6), pose.flipped


def describe(pair: _core.RankedPair, aim: _core.GraspPose) -> str:
    """The grasp in words; the hand's direction is told in the part's frame."""
    z = aim.X_PH[:3, 2]
    return (
        f"{pair.pair}, {1e3 * aim.width:.1f} mm apart, "
        f"hand along ({z[0]:+.2f}, {z[1]:+.2f}, {z[2]:+.2f}) of the part"
    )
