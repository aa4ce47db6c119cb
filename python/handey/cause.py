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
from handey.reasons import Reason, Stage
from handey.wording import ENDS, Names, of_obstacle

__all__ = ["find_cause", "with_depths"]

# Choice: so much more way to give halves what an obstacle explains [m], [rad].
SHIFT, TURN = 0.1, 0.6
CARRYING = 0.05  # Choice: as much less does what the part stands on explain
SMALL_SHARE = 0.03  # Choice: of the hand poses; less does not explain why no regrasp was found


def find_cause(
    stages: list[Stage], refusals: list[Reason], diagnosis: _core.Diagnosis | None, names: Names
) -> Reason | None:
    """The cause of a failure.

    Args:
        stages: the funnel.
        refusals: what was in the way without a look at any grasp.
        diagnosis: of the hand poses; None if it was not asked for.
        names: of the robot.
    """
    if refusals:
        return refusals[0]
    by_name = {stage.name: stage for stage in stages}
    if not by_name["found"].entered:
        return next(iter(by_name["found"].reasons), None)
    for name in ("connected", "approached"):
        if by_name[name].entered and not by_name[name].passed:
            return _met_most(by_name[name])
    if diagnosis is not None and diagnosis.looked_at:
        cause = _of_diagnosis(by_name, diagnosis, names)
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
    stages: dict[str, Stage], diagnosis: _core.Diagnosis, names: Names
) -> Reason | None:
    if not diagnosis.obstacles:
        return None
    best = max(diagnosis.obstacles, key=_explains)
    no_regrasp = [r for r in stages["connected"].reasons if r.kind == "no_regrasp"]
    joins = diagnosis.free_at_origin and diagnosis.free_at_destination
    small = best.carries or best.alone < SMALL_SHARE * diagnosis.looked_at
    if no_regrasp and joins and small:
        return no_regrasp[0]
    cause = of_obstacle(best, names)
    if cause.kind in ("too_wide", "slips"):  # the funnel has their numbers
        told = [r for stage in stages.values() for r in stage.reasons if r.kind == cause.kind]
        return next(iter(told), cause)
    share = f"in the way of {best.met} of {diagnosis.looked_at} hand poses"
    if best.alone:
        share = f"alone keeps {best.alone} of {diagnosis.looked_at} hand poses from being legal"
    cause = replace(cause, text=f"{cause.text}; it {share}")
    if cause.kind == "collision" and not stages["unobstructed"].passed:
        return replace(cause, kind="obstructed", stage="unobstructed", by=None)
    return cause


def _explains(obstacle: _core.GraspObstacle) -> tuple[float, float]:
    """How well an obstacle explains that there is no legal grasp: alone, or else with others."""
    scale = TURN if obstacle.kind == _core.FallKind.JointLimit else SHIFT
    weight = 1.0 / (1.0 + max(obstacle.least, 0.0) / scale)
    weight *= CARRYING if obstacle.carries else 1.0
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
