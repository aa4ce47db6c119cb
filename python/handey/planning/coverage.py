"""What of a goal was looked at, in lines for people: what "unknown" stands for.

A goal without a plan and without a proof was not found to be infeasible; the lines tell over what
the search went, at which spacing, and which budgets it used up.
"""

from __future__ import annotations

from handey.planning.plan_options import PlanOptions
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Stage
from handey.reporting.report import Report

__all__ = ["tell_coverage"]


def tell_coverage(report: Report, options: PlanOptions) -> None:
    """Fill in `covered` of the goals that failed or were stopped; after they were explained."""
    for goal in report.goals:
        if goal.status in ("failed", "stopped"):
            goal.covered = _lines(goal, options, report)


def _lines(goal: GoalReport, options: PlanOptions, report: Report) -> list[str]:
    stages = {stage.name: stage for stage in goal.stages}
    lines = [*_of_grasps(stages, options), *_of_tries(stages, goal, options), *_of_regrasps(goal)]
    if report.deadline_passed:
        lines.append("the deadline passed before all of it was tried")
    elif report.cancelled:
        lines.append("planning was cancelled before all of it was tried")
    elif not goal.proof and lines:
        lines.append("all budgets are spent; nothing is proved")
    return lines


def _of_grasps(stages: dict[str, Stage], options: PlanOptions) -> list[str]:
    found, poses = stages.get("found"), stages.get("reachable")
    lines = []
    if found is not None and found.entered:
        free = stages["unobstructed"].passed
        lines.append(f"{found.entered} feature pairs found, hand poses on {free} of them")
    if poses is not None and poses.entered:
        passes = [options.legality, *options.denser]
        told = ", ".join(
            f"{360 / legality.directions:.3g} degrees"
            + (f" and {1e3 * legality.spacing:g} mm" if legality.spacing else "")
            for legality in passes
        )
        lines.append(f"{poses.entered} hand poses looked at, in passes of {told} at the finest")
    return lines


def _of_tries(stages: dict[str, Stage], goal: GoalReport, options: PlanOptions) -> list[str]:
    tried = stages.get("approached")
    if tried is None or not tried.entered:
        return []
    most = max(options.sampling_rounds)
    connected = stages["connected"].entered
    return [
        f"{tried.entered} grasps tried in {len(goal.attempts)} attempts, {connected} approached; "
        f"gross motions of up to {most} iterations"
    ]


def _of_regrasps(goal: GoalReport) -> list[str]:
    counts = {
        "grasps of the part": goal.counts.get("grasps of the part", 0),
        "resting poses": goal.counts.get("resting poses", 0),
        "placements": goal.counts.get("placements looked at", 0),
        "sequences": goal.counts.get("regrasp sequences tried", 0),
    }
    if not counts["grasps of the part"]:
        return []
    return ["for regrasps: " + ", ".join(f"{count} {what}" for what, count in counts.items())]
