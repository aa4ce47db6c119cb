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

__all__ = ["describe", "grasps"]

Grasp = tuple[_core.RankedPair, _core.GraspPose]
DENSER_PAIRS = 8  # Choice: the denser passes look at so many pairs, the best
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


def grasps(work: Workspace, options: PlanOptions, report: GoalReport) -> Iterator[Grasp]:
    """Grasp poses legal at both ends, in the order to try them; tells the report what fell."""
    # A goal may be tried again from another state of the cell: only the last try is told.
    report.funnel, report.reasons, report.attempts = {}, [], []
    choice = options.ranking.pairs
    if choice != _core.PairChoice.BeyondFaces:
        ranking = _rank(work, options.ranking, _core.PairChoice.TwoFaces)
        _report_faces(report, ranking, options.ranking)
        yield from _of_faces(work, ranking, options, report)
    if choice != _core.PairChoice.TwoFaces and options.ranking.features.beyond_faces:
        ranking = _rank(work, options.ranking, _core.PairChoice.BeyondFaces)
        _report_beyond_faces(report, ranking)
        yield from _legal(work, ranking.ranked, options.legality, options.poses_per_round, report)


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


def _of_faces(
    work: Workspace, ranking: _core.Ranking, options: PlanOptions, report: GoalReport
) -> Iterator[Grasp]:
    """Legal poses of all pairs; denser ones of the best as long as no grasp could be approached."""
    size, seen = options.poses_per_round, _Seen()
    yield from _legal(work, ranking.ranked, options.legality, size, report, seen)
    narrow = None
    for legality in options.denser:
        if report.funnel.get("approached"):
            return
        if narrow is None:
            # The room that the fingers need when the jaws open as little as legality lets them.
            least = min(options.ranking.open_clearance, legality.open_clearance / 4)
            narrow = _rank(work, options.ranking, _core.PairChoice.TwoFaces, least)
        yield from _legal(work, narrow.ranked[:DENSER_PAIRS], legality, size, report, seen)


def _legal(
    work: Workspace,
    ranked: list[_core.RankedPair],
    legality: _core.LegalityOptions,
    size: int,
    report: GoalReport,
    seen: _Seen | None = None,
) -> Iterator[Grasp]:
    """`size` poses of each pair, best pair first, then as many more; none that was tried before."""
    seen = seen or _Seen()
    legal: list[list[_core.GraspPose] | None] = [None] * len(ranked)
    start = 0
    while any(poses is None or start < len(poses) for poses in legal):
        for i, pair in enumerate(ranked):
            if legal[i] is None:
                with work.clock("legal grasps"):
                    found = _core.find_legal_grasps(work.scene, work.solver, pair, legality)
                name = str(pair.pair)
                legal[i] = [pose for pose in found.poses if _key(name, pose) not in seen.poses]
                seen.poses.update(_key(name, pose) for pose in found.poses)
                report.add("legal grasp poses", len(legal[i] or []))
                if found.poses:
                    seen.tell(report, name, f"{name}: legal hand poses only in a denser pass")
                else:
                    seen.tell(report, name, _illegal(pair, found), is_new=True)
            for aim in (legal[i] or [])[start : start + size]:
                yield pair, aim
        start += size


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
