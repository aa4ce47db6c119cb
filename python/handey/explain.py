"""Why goals failed: of each the funnel, and the one cause that explains the failure best.

Asked for once, when planning has ended: what was tried on the way is told of the last try only.
"""

from __future__ import annotations

from dataclasses import replace

from handey import _core
from handey.cause import find_cause, with_depths
from handey.plan_options import PlanOptions
from handey.reasons import STAGES, Stage
from handey.report import GoalReport, Report, StageClock

__all__ = ["diagnose", "explain"]


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
            looked.diagnosis = _core.diagnose_grasps(
                looked.work.scene, ranking=options.ranking, legality=options.legality
            )


def explain(report: Report) -> None:
    """Fill in the stages, the poses for pictures and the cause of every goal."""
    for goal in report.goals:
        if goal.looked is not None or goal.refusals:
            _explain(goal)
            goal.refusals, goal.looked = [], None


def _explain(goal: GoalReport) -> None:
    looked = goal.looked
    goal.stages = [Stage(name) for name in STAGES] if looked is None else looked.stages()
    goal.stages[0].reasons += goal.refusals
    if looked is not None:
        goal.tried = looked.poses()
        if looked.diagnosis is not None:
            with_depths(goal.stages[3], looked.diagnosis, looked.names)
    if goal.status not in ("failed", "stopped") or goal.cause is not None:
        return
    if looked is None:
        cause = next(iter(goal.refusals), None)
    else:
        cause = find_cause(goal.stages, goal.refusals, looked.diagnosis, looked.names)
    goal.cause = replace(cause, proved=True) if cause and goal.proof else cause
