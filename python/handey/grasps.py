"""Which grasps to try, and why the others fell: the article's steps 1 to 3 as one stream.

Two faces are what jaws hold best, so their pairs come first, the best of each before more of any.
Pairs with edges and vertices are looked for when those have not served: they are worth less, and
there are more of them. What is passed over is told in the report, with numbers.
Not guaranteed: that a grasp which is yielded can be reached; that is the approach's to say.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from handey import _core
from handey.pick_and_place import Workspace
from handey.plan_options import PlanOptions
from handey.report import GoalReport

__all__ = ["Grasps", "describe"]

Grasp = tuple[_core.RankedPair, _core.GraspPose]
DENSER_PAIRS = 8  # Choice: the denser passes look at so many pairs, the best
# Which pairs, and how densely if not as usual.
_Pass = tuple[_core.PairChoice, "_core.LegalityOptions | None"]
# A hand pose: its pair, place and direction in the grasp plane, half-turn.
_PoseKey = tuple[str, float, float, float, bool]


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
        # A goal may be tried again from another state of the cell: only the last try is told.
        report.funnel, report.reasons, report.attempts = {}, [], []
        self._work, self._options, self._report = work, options, report
        self._seen = _Seen()
        self._narrow: dict[_core.PairChoice, list[_core.RankedPair]] = {}
        self._passes = _passes(options)

    def first(self) -> Iterator[Grasp]:
        """All pairs, two faces first; in denser passes as long as none could be approached."""
        spared: list[_Pass] = []
        for kind, denser in self._passes:
            if denser is None:
                ranking = _rank(self._work, self._options.ranking, kind)
                _report_pairs(self._report, ranking, kind, self._options.ranking)
                yield from self._legal(ranking.ranked, self._options.legality)
            elif self._report.funnel.get("approached"):
                spared.append((kind, denser))
            else:
                yield from self._legal(self._best(kind, denser), denser)
        self._passes = spared

    def rest(self) -> Iterator[Grasp]:
        """What the denser passes give that were spared, because a grasp could be approached."""
        passes, self._passes = self._passes, []
        for kind, denser in passes:
            assert denser is not None
            yield from self._legal(self._best(kind, denser), denser)

    def _best(
        self, kind: _core.PairChoice, denser: _core.LegalityOptions
    ) -> list[_core.RankedPair]:
        """The pairs that denser passes look at."""
        if kind not in self._narrow:
            # The room that the fingers need when the jaws open as little as legality lets them.
            wanted = self._options.ranking
            least = min(wanted.open_clearance, denser.open_clearance / 4)
            self._narrow[kind] = _rank(self._work, wanted, kind, least).ranked[:DENSER_PAIRS]
        return self._narrow[kind]

    def _legal(
        self, ranked: list[_core.RankedPair], legality: _core.LegalityOptions
    ) -> Iterator[Grasp]:
        """Some poses of each pair, best pair first, then as many more; none twice."""
        size = self._options.poses_per_round
        legal: list[list[_core.GraspPose] | None] = [None] * len(ranked)
        start = 0
        while any(poses is None or start < len(poses) for poses in legal):
            for i, pair in enumerate(ranked):
                if legal[i] is None:
                    legal[i] = self._find(pair, legality)
                for aim in (legal[i] or [])[start : start + size]:
                    yield pair, aim
            start += size

    def _find(
        self, pair: _core.RankedPair, legality: _core.LegalityOptions
    ) -> list[_core.GraspPose]:
        """The legal poses of a pair that no pass before has found."""
        work, seen, name = self._work, self._seen, str(pair.pair)
        with work.clock("legal grasps"):
            found = _core.find_legal_grasps(work.scene, work.solver, pair, legality)
        fresh = [pose for pose in found.poses if _key(name, pose) not in seen.poses]
        seen.poses.update(_key(name, pose) for pose in found.poses)
        self._report.add("legal grasp poses", len(fresh))
        if found.poses:
            seen.tell(self._report, name, f"{name}: legal hand poses only in a denser pass")
        else:
            seen.tell(self._report, name, _illegal(pair, found), is_new=True)
        return fresh


def _passes(options: PlanOptions) -> list[_Pass]:
    """Two faces, once more denser; then other pairs; then the rest of the denser passes."""
    faces, beyond = _core.PairChoice.TwoFaces, _core.PairChoice.BeyondFaces
    looked_at = {faces, beyond}
    if options.ranking.pairs in looked_at:
        looked_at = {options.ranking.pairs}
    if not options.ranking.features.beyond_faces:
        looked_at -= {beyond}
    denser = options.denser
    order: list[_Pass] = [(faces, None), *((faces, d) for d in denser[:1]), (beyond, None)]
    order += [(faces, d) for d in denser[1:]] + [(beyond, d) for d in denser]
    return [(kind, legality) for kind, legality in order if kind in looked_at]


def _rank(
    work: Workspace,
    wanted: _core.RankingOptions,
    choice: _core.PairChoice,
    open_clearance: float | None = None,
) -> _core.Ranking:
    options = _core.RankingOptions(
        features=wanted.features,
        finger_clearance=wanted.finger_clearance,
        open_clearance=wanted.open_clearance if open_clearance is None else open_clearance,
        use_destination=wanted.use_destination,
        least_share=wanted.least_share,
        most_targets=wanted.most_targets,
        pairs=choice,
    )
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


def _illegal(pair: _core.RankedPair, legal: _core.LegalGrasps) -> str:
    fallen = {
        "with too little contact": legal.too_little_contact,
        "would turn in the jaws": legal.would_turn,
        "out of reach at the origin": legal.unreachable_at_origin,
        "out of reach at the destination": legal.unreachable_at_destination,
        "in collision at the origin": legal.collides_at_origin,
        "in collision at the destination": legal.collides_at_destination,
    }
    counts = ", ".join(f"{count} {where}" for where, count in fallen.items() if count)
    name = f"{pair.pair}, {1e3 * pair.pair.width:.1f} mm"
    return f"{name}: {legal.tried} hand poses: {counts}; farthest: {legal.worst_reason}"


def _report_pairs(
    report: GoalReport,
    ranking: _core.Ranking,
    kind: _core.PairChoice,
    options: _core.RankingOptions,
) -> None:
    if kind == _core.PairChoice.TwoFaces:
        _report_faces(report, ranking, options)
    else:
        _report_beyond_faces(report, ranking)


def _report_faces(
    report: GoalReport, ranking: _core.Ranking, options: _core.RankingOptions
) -> None:
    spanned = len(ranking.ranked) + len(ranking.obstructed)
    report.add("faces", ranking.faces)
    report.add("face pairs", spanned + len(ranking.rejected))
    report.add("spanned by the jaws", spanned)
    report.add("unobstructed", len(ranking.ranked))
    if not ranking.faces:
        least = 1e6 * options.features.least_face_area
        reason = f"the part has no flat face of {least:g} mm2 or more for a pad to lie on"
        report.reasons.append(reason)
    elif not spanned and not ranking.rejected:
        report.reasons.append("no two faces of the part are parallel and face away from each other")
    _report_fallen(report, ranking)


def _report_beyond_faces(report: GoalReport, ranking: _core.Ranking) -> None:
    spanned = len(ranking.ranked) + len(ranking.obstructed)
    report.add("edges", ranking.edges)
    report.add("vertices", ranking.vertices)
    report.add("pairs with edges or vertices spanned by the jaws", ranking.beyond_faces)
    report.add("of these looked at", spanned)
    report.add("of these unobstructed", len(ranking.ranked))
    if not spanned and not ranking.rejected:
        report.reasons.append(
            "no edge or vertex of the part is opposite to a face or an edge with which jaws could "
            "hold it"
        )
    _report_fallen(report, ranking)


def _report_fallen(report: GoalReport, ranking: _core.Ranking) -> None:
    fallen: dict[str, list[str]] = {}
    for pair in ranking.rejected:
        fallen.setdefault(pair.reason, []).append(str(pair))
    for ranked in ranking.obstructed:
        blocked = f"{100 * (1 - ranked.share):.0f} % obstructed by {', '.join(ranked.obstructing)}"
        fallen.setdefault(blocked, []).append(str(ranked.pair))
    report.reasons += [f"{_listed(pairs)}: {why}" for why, pairs in fallen.items()]


def _listed(pairs: list[str], most: int = 6) -> str:
    more = len(pairs) - most
    return ", ".join(pairs[:most]) + (f" and {more} more" if more > 0 else "")
