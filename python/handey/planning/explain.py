"""Why goals failed: of each the funnel, and the one cause that explains the failure best.

Asked for once, when planning has ended: what was tried on the way is told of the last try only.
"""

from __future__ import annotations

from dataclasses import replace

from handey import _core
from handey.motion.stage_clock import StageClock
from handey.planning.plan_options import PlanOptions
from handey.reporting.cause import find_cause, is_by_nearest, with_depths
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import STAGES, Reason, Stage
from handey.reporting.report import Report

__all__ = ["diagnose", "explain"]


MOST_WHEN_STOPPED = 2  # Choice: grasps that are looked round when the time is up
# Where no hand pose is legal by one of these, there often is no way either: that follows from it.
BEFORE_WAYS = ("unobstructed", "reachable")
# Choice: what falls by less is found legal by a denser look [rad], [m].
LEAST_MISSED = {"joint_limit": 0.01, "out_of_reach": 0.001}
NEAREST = 8000  # Choice: hand poses among which the nearest miss is looked for


def diagnose(report: Report, options: PlanOptions, clock: StageClock) -> None:
    """Look closer at goals that failed: at grasps that were tried, or at hand poses if none was."""
    for goal in report.goals:
        looked = goal.looked
        if goal.status != "failed" or looked is None or looked.work is None or goal.refusals:
            continue
        with clock("diagnosis"):
            if looked.grasps:
                looked.look_round()
                continue
            scene = looked.work.scene
            looked.diagnosis = _core.diagnose_grasps(
                scene, ranking=options.ranking, legality=options.legality
            )
            if options.denser and is_by_nearest(looked.diagnosis, looked):
                looked.closer = _core.diagnose_grasps(
                    scene,
                    ranking=options.ranking,
                    legality=options.denser[-1],
                    most_poses=NEAREST,
                )


def explain(report: Report) -> None:
    """Fill in the stages, the poses for pictures and the cause of every goal."""
    for goal in report.goals:
        if goal.looked is not None or goal.refusals:
            _explain(goal)
            goal.refusals, goal.looked = [], None


def _explain(goal: GoalReport) -> None:
    looked, has_failed = goal.looked, goal.status in ("failed", "stopped")
    if looked is None:
        goal.stages = [Stage(name) for name in STAGES]
        goal.stages[0].reasons += goal.refusals
        if has_failed:
            goal.cause = _of_both(goal.cause, next(iter(goal.refusals), None), bool(goal.proof))
        return
    if goal.status == "stopped":
        looked.look_round(MOST_WHEN_STOPPED)
    goal.stages, goal.tried = looked.stages(), looked.poses()
    goal.stages[0].reasons += goal.refusals
    if looked.diagnosis is not None:
        with_depths(goal.stages[3], looked.diagnosis, looked.names)
    if has_failed:
        cause = find_cause(goal.stages, goal.refusals, looked, goal.proof)
        obstacles = [] if looked.diagnosis is None else looked.diagnosis.obstacles
        is_single = any(obstacle.alone for obstacle in obstacles)
        goal.cause = _of_both(goal.cause, cause, bool(goal.proof), is_single)


def _of_both(
    proof: Reason | None, found: Reason | None, proved: bool, is_single: bool = False
) -> Reason | None:
    """The cause by a proof, which knows a bound for all hand poses, or what the nearest misses.

    Args:
        proof: the proof's.
        found: what explains best where the hand poses looked at fell.
        proved: there is a proof.
        is_single: with that alone away, some of them would be legal.
    """
    if proof is not None and found is not None and is_single and proof.stage == "connected":
        is_first = found.stage in BEFORE_WAYS and found.end == proof.end
        is_first = is_first and (found.by or 0.0) >= LEAST_MISSED.get(found.kind, 0.0)
    else:
        is_first = False
    if is_first:
        return found
    if found is None or (proof is not None and (proof.kind, proof.end) != (found.kind, found.end)):
        return proof
    return replace(found, proved=True) if proved else found
