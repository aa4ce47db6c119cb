"""What the report of a goal tells of its feature pairs: how many there are, and why others fell."""

from __future__ import annotations

from handey import _core
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason

__all__ = ["illegal", "report_pairs"]


def illegal(pair: _core.RankedPair, legal: _core.LegalGrasps) -> str:
    """Where the hand poses of a pair fell."""
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


def report_pairs(
    report: GoalReport,
    ranking: _core.Ranking,
    kind: _core.PairChoice,
    options: _core.RankingOptions,
) -> None:
    """Tell how many pairs of a kind there are, and why others are none."""
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
        _no_pair(report, f"the part has no flat face of {least:g} mm2 or more for a pad to lie on")
    elif not spanned and not ranking.rejected:
        _no_pair(report, "no two faces of the part are parallel and face away from each other")
    _report_fallen(report, ranking)


def _report_beyond_faces(report: GoalReport, ranking: _core.Ranking) -> None:
    spanned = len(ranking.ranked) + len(ranking.obstructed)
    report.add("edges", ranking.edges)
    report.add("vertices", ranking.vertices)
    report.add("pairs with edges or vertices spanned by the jaws", ranking.beyond_faces)
    report.add("of these looked at", spanned)
    report.add("of these unobstructed", len(ranking.ranked))
    if not spanned and not ranking.rejected:
        _no_pair(
            report,
            "no edge or vertex of the part is opposite to a face or an edge with which jaws could "
            "hold it",
        )
    _report_fallen(report, ranking)


def _no_pair(report: GoalReport, text: str) -> None:
    report.reasons.append(text)
    if report.looked is not None:
        report.looked.no_features.append(Reason("no_features", "found", text))


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
