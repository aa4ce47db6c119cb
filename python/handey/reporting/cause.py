"""Which of all reasons explains best that a goal failed?

What most hand poses fell by is often not it: half of all hands come from below the table anyway.
Where no grasp was legal, a diagnosis looks for the obstacle that alone keeps most hand poses from
being legal; of obstacles that keep about as many, the one that would have to give way least. What
the part stands on is taken for the cause only where nothing else explains much. Where grasps were
legal, what they fell by later is the cause.
Not guaranteed: that with the cause away there is a plan.
"""

from __future__ import annotations

from dataclasses import replace

from handey import _core
from handey.reporting.funnel import Funnel
from handey.reporting.reasons import Reason, Stage
from handey.reporting.wording import ENDS, Names, of_obstacle

__all__ = ["find_cause", "is_by_nearest", "with_depths"]

# Choice: so much more way to give halves what an obstacle explains [m], [rad].
SHIFT, TURN = 0.1, 0.6
PART = 6.0  # Choice: a part is more easily moved than a fixture
CARRYING = 0.05  # Choice: as much less does what the part stands on explain
MOST_OTHERS = 3  # Choice: bodies that are named beside the first
SMALL_SHARE = 0.03  # Choice: of the hand poses; less does not explain why no regrasp was found


def find_cause(
    stages: list[Stage],
    refusals: list[Reason],
    looked: Funnel,
    proof: str = "",
) -> Reason | None:
    """The cause of a failure.

    Args:
        stages: the funnel.
        refusals: what was in the way without a look at any grasp.
        looked: what was looked at, with the diagnosis of hand poses, if there is one.
        proof: why there is certainly no plan; empty where that is not known.
    """
    if refusals:
        return refusals[0]
    by_name = {stage.name: stage for stage in stages}
    if not by_name["found"].entered:
        return next(iter(by_name["found"].reasons), None)
    for name in ("connected", "approached"):
        if by_name[name].entered and not by_name[name].passed:
            return _met_most(by_name[name])
    if looked.diagnosis is not None and looked.diagnosis.looked_at:
        cause = _of_diagnosis(by_name, looked, looked.diagnosis, proof)
        if cause is not None:
            return cause
    for stage in stages:
        if stage.reasons and not stage.passed:
            return stage.reasons[0]
    return None


def _met_most(stage: Stage) -> Reason:
    """The reason with the bodies that most of a stage met."""
    named = [reason for reason in stage.reasons if reason.bodies]
    return max(named or stage.reasons, key=lambda reason: reason.count)


def _of_diagnosis(
    stages: dict[str, Stage], looked: Funnel, diagnosis: _core.Diagnosis, proof: str
) -> Reason | None:
    if not diagnosis.obstacles:
        return None
    best = _best(diagnosis, looked)
    assert best is not None
    no_regrasp = [r for r in stages["connected"].reasons if r.kind == "no_regrasp"]
    joins = diagnosis.free_at_origin and diagnosis.free_at_destination
    small = best.carries or best.alone < SMALL_SHARE * diagnosis.looked_at
    if proof and not no_regrasp:  # that neither any grasp nor a regrasp joins the ends
        no_regrasp = [Reason("no_regrasp", "connected", proof, proved=True)]
        if joins and small:
            stages["connected"].reasons += no_regrasp
    if no_regrasp and joins and small:
        return no_regrasp[0]
    cause = of_obstacle(_nearest(best, looked.closer), looked.names)
    if cause.kind in ("too_wide", "slips"):  # the funnel has their numbers
        told = [r for stage in stages.values() for r in stage.reasons if r.kind == cause.kind]
        return next(iter(told), cause)
    share = f"it is in the way of {best.met} of {diagnosis.looked_at} hand poses"
    if best.alone:
        share = f"it alone keeps {best.alone} of {diagnosis.looked_at} hand poses from being legal"
    others = [] if best.alone else _others(best, diagnosis, looked)
    if others:
        share += f", and {', '.join(others)} of others"
        cause = replace(cause, bodies=(*cause.bodies, *others))
    cause = replace(cause, text=f"{cause.text}; {share}")
    if cause.kind == "collision" and not stages["unobstructed"].passed:
        return replace(cause, kind="obstructed", stage="unobstructed", by=None)
    return cause


def _others(best: _core.GraspObstacle, diagnosis: _core.Diagnosis, looked: Funnel) -> list[str]:
    """Bodies of the cell that are in the way beside one that is so nowhere alone."""
    same = [
        it
        for it in diagnosis.obstacles
        if it.kind == best.kind == _core.FallKind.Collision
        and it.end == best.end
        and not it.carries
        and it.body != best.body
        and it.body not in looked.names.links
    ]
    same.sort(key=lambda it: -it.in_fewest)
    return list(dict.fromkeys(it.body for it in same))[:MOST_OTHERS]


def is_by_nearest(diagnosis: _core.Diagnosis, looked: Funnel) -> bool:
    """Is the cause one of which the nearest miss is told, for which many poses must be seen?"""
    best = _best(diagnosis, looked)
    return best is not None and best.kind in _BY_NEAREST


def _nearest(obstacle: _core.GraspObstacle, closer: _core.Diagnosis | None) -> _core.GraspObstacle:
    """The same with the nearest miss of many more hand poses."""
    same = [
        other
        for other in ([] if closer is None else closer.obstacles)
        if (other.kind, other.end, other.joint) == (obstacle.kind, obstacle.end, obstacle.joint)
        and other.alone > 0
        and other.least < obstacle.least
    ]
    return same[0] if same and obstacle.kind in _BY_NEAREST else obstacle


_BY_NEAREST = (_core.FallKind.OutOfReach, _core.FallKind.JointLimit, _core.FallKind.Turns)


def _best(diagnosis: _core.Diagnosis, looked: Funnel) -> _core.GraspObstacle | None:
    parts = {body.name for body in looked.parts}
    return max(diagnosis.obstacles, key=lambda it: _explains(it, it.body in parts), default=None)


def _explains(obstacle: _core.GraspObstacle, is_part: bool) -> tuple[float, float]:
    """How well an obstacle explains that there is no legal grasp: alone, or else with others."""
    scale = TURN if obstacle.kind == _core.FallKind.JointLimit else SHIFT
    weight = 1.0 / (1.0 + max(obstacle.least, 0.0) / scale)
    weight *= CARRYING if obstacle.carries else PART if is_part else 1.0
    return weight * obstacle.alone, weight * obstacle.in_fewest


def with_depths(stage: Stage, diagnosis: _core.Diagnosis, names: Names) -> None:
    """Tell how deep the least collisions of a stage are, where the diagnosis has measured it."""
    depths = {
        (ENDS[o.end.name], names.mover(o.body)): o.least
        for o in diagnosis.obstacles
        if o.kind == _core.FallKind.Collision and o.least >= 0.0
    }
    for index, reason in enumerate(stage.reasons):
        depth = depths.get((reason.end, reason.bodies[0])) if reason.bodies else None
        if reason.kind == "collision" and reason.by is None and depth is not None:
            text = f"{reason.text}, {1e3 * depth:.1f} mm deep at least"
            stage.reasons[index] = replace(reason, text=text, by=depth)
