"""How planning went, in a few lines for people or as one JSON object.

Goal by goal: the grasp, the steps, the planner and the CPU time of each gross motion; then the
motion, the CPU time by stage and the least clearance that the check found.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from handey.cell_file import CellFile
    from handey.check import CheckReport
    from handey.plan import Plan
    from handey.planner import PlanResult
    from handey.reporting.report import GrossMotion, LocalMotion, Report

__all__ = ["no_plan_lines", "plan_lines", "plan_summary"]


def plan_summary(cell: CellFile, result: PlanResult, checked: CheckReport | None) -> dict[str, Any]:
    """The figures, for programs."""
    report, plan = result.report, result.plan
    summary = {
        "verdict": report.verdict,
        "cell": cell.name,
        "cpu_s": report.cpu_s,
        "wall_s": report.wall_s,
        "duration_s": None if plan is None else plan.duration_s,
        "regrasps": None if plan is None else report.regrasps,
        "stages": dict(report.stages),
        "steps": None if plan is None else len(plan.steps),
        "least_clearance": None if checked is None else checked.least_clearance,
        "reasons": list(report.reasons),
        "warnings": list(cell.warnings),
    }
    return dict(report.as_dict()) | summary


def no_plan_lines(cell: CellFile, result: PlanResult, verbose: bool) -> list[str]:
    """Why there is no plan."""
    lines = [f"{cell.name}: no plan found ({result.report.verdict})"]
    lines += [f"  {reason}" for reason in result.report.reasons]
    advised = [f"  advice: {goal.advice.text}" for goal in result.report.goals if goal.advice]
    if not advised and "advice" in result.report.stages:
        advised = ["  advice: no single change was found in time with which it plans"]
    lines += advised
    lines += _planner_lines(result.report)
    return lines + (_attempts(result) if verbose else [])


def plan_lines(
    cell: CellFile, result: PlanResult, checked: CheckReport, verbose: bool
) -> list[str]:
    """What was planned."""
    plan, report = result.plan, result.report
    assert plan is not None
    lines = [f"{cell.name}: planned"]
    if not plan.steps:
        lines.append("  every goal is already met: nothing to do")
    for index, goal in enumerate(cell.goals):
        lines += _goal_lines(plan, index, str(goal), report.goals[index].grasp)
        lines += _aside_lines(report.goals[index].aside)
        lines += _local_lines([m for m in report.local_motions if m.goal == index])
        lines += _gross_lines([m for m in report.gross_motions if m.goal == index])
    seconds = f"{plan.duration_s:.2f} s in {len(plan.steps)} steps"
    lines.append(f"  motion: {seconds}, regrasps: {report.regrasps}")
    stages = ", ".join(f"{stage} {1e3 * s:.1f}" for stage, s in report.stages.items())
    clock = f"{1e3 * report.wall_s:.0f} ms on the clock"
    lines.append(f"  planning: {1e3 * report.cpu_s:.0f} ms CPU ({stages}), {clock}")
    lines += _planner_lines(report)
    if math.isfinite(checked.least_clearance):
        lines.append(f"  least clearance: {checked.least_clearance * 1e3:.2f} mm")
    return lines + (_attempts(result) if verbose else [])


def _goal_lines(plan: Plan, index: int, goal: str, grasp: str) -> list[str]:
    steps = [step for step in plan.steps if step.goal == index]
    if not steps:
        return [f"  goal {index}: {goal}: met already"]
    widths = [f"{step.opening[-1] * 1e3:.1f} mm" for step in steps if step.action == "grasp"]
    closed = f"jaws closed to {', then '.join(widths)}"
    times = ", ".join(f"{step.action} {step.duration_s:.2f} s" for step in steps)
    return [
        f"  goal {index}: {goal}",
        f"    grasp: {grasp}; {closed}" if grasp else f"    grasp: {closed}",
        f"    steps: {times}",
    ]


def _aside_lines(parts: list[str]) -> list[str]:
    """What was moved aside for the sake of a goal."""
    return [f"    moved aside first: {', '.join(parts)}"] if parts else []


def _planner_lines(report: Report) -> list[str]:
    """How often each planner gave a motion near obstacles, attempts that fell later included."""
    given = [
        f"{action} {', '.join(f'{planner} {count}' for planner, count in counts.items())}"
        for action, counts in report.planners.items()
    ]
    return [f"  planners: {'; '.join(given)}"] if given else []


def _local_lines(motions: list[LocalMotion]) -> list[str]:
    """Which planner gave each motion near obstacles."""
    found = ", ".join(f"{motion.action} {motion.planner}" for motion in motions)
    return [f"    motions near obstacles: {found}"] if found else []


def _gross_lines(motions: list[GrossMotion]) -> list[str]:
    """Which planner gave each gross motion, how quickly, and why it was not the slices."""
    if not motions:
        return []
    found = [
        f"step {m.step} {m.action} {m.search.planner} {1e3 * m.search.cpu_s:.1f} ms"
        for m in motions
    ]
    fallbacks = [(m.step, m.search.fallback_reason) for m in motions if m.search.fallback_reason]
    return [
        f"    gross motions: {', '.join(found)}",
        *(f"    step {step}: not through slices: {reason}" for step, reason in fallbacks),
    ]


def _attempts(result: PlanResult) -> list[str]:
    """Every pair that fell, and every grasp that was tried, with where it fell."""
    lines = []
    for goal in result.report.goals:
        lines += [f"  goal {goal.goal}: {reason}" for reason in goal.reasons]
        for number, attempt in enumerate(goal.attempts):
            why = f": {attempt.reason}" if attempt.reason else ""
            lines.append(f"  goal {goal.goal}, try {number}: {attempt.grasp}: {attempt.stage}{why}")
    return lines
