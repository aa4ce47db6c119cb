"""Why a goal failed: its funnel and the one cause that explains the failure best.

Asked for once, when planning has ended: what was tried on the way is told of the last try only.
"""

from __future__ import annotations

from dataclasses import replace

from handey.reasons import STAGES, Reason, Stage
from handey.report import GoalReport, Report

__all__ = ["explain"]


def explain(report: Report) -> None:
    """Fill in the stages, the poses for pictures and the cause of every goal."""
    for goal in report.goals:
        if goal.looked is None and not goal.refusals:
            continue
        stages = [Stage(name) for name in STAGES]
        if goal.looked is not None:
            stages, goal.tried = goal.looked.stages(), goal.looked.poses()
        stages[0].reasons += goal.refusals
        goal.stages = stages
        if goal.status in ("failed", "stopped") and goal.cause is None:
            cause = _cause(goal)
            goal.cause = replace(cause, proved=True) if cause and goal.proof else cause
        goal.refusals, goal.looked = [], None


def _cause(goal: GoalReport) -> Reason | None:
    """A refusal, or the most frequent reason of the stage that nothing passed."""
    if goal.refusals:
        return goal.refusals[0]
    for stage in goal.stages:
        if stage.reasons and not stage.passed:
            return stage.reasons[0]
    return None
