"""Why a goal failed, in words that fit a screen: the cause, then the funnel stage by stage."""

from __future__ import annotations

import textwrap

from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import STAGES, Reason, Stage

__all__ = ["failure_lines"]

WIDTH = 96  # columns; with indents no more than 100
MOST_REASONS = 3  # of a stage
MOST_NOTES = 3
LABELS = {
    "found": "feature pairs found",
    "spanned": "spanned by the jaws",
    "unobstructed": "unobstructed at both ends",
    "reachable": "reachable at both ends",
    "approached": "approached and left",
    "connected": "connected by gross motions",
}


def failure_lines(goal: GoalReport) -> list[str]:
    """At most 20 lines of at most 98 columns, the first telling the goal and its status."""
    lines = _wrapped(f"goal {goal.goal} ({goal.text}): {goal.status}", 1, "")
    if goal.cause is not None:
        lines += _wrapped(f"cause: {goal.cause.text}", 4)
    if goal.proof and (goal.cause is None or not _says(goal.proof, goal.cause.text)):
        lines += _wrapped(f"proof: {goal.proof}", 2)
    for stage in goal.stages:
        if stage.entered or stage.reasons:
            lines += _stage_lines(stage, goal.cause)
    told = {reason.text for stage in goal.stages for reason in stage.reasons}
    if goal.cause is not None:
        told.add(goal.cause.text)
    notes = [] if _has_grasps(goal) else [text for text in goal.reasons if text not in told]
    for note in notes[:MOST_NOTES]:
        lines += _wrapped(note, 1)
    return lines


def _has_grasps(goal: GoalReport) -> bool:
    """Do the stages tell more than a refusal? Then the long list of pairs is not told again."""
    return any(stage.entered for stage in goal.stages)


def _says(proof: str, cause: str) -> bool:
    """Would the proof tell the cause once more?"""
    return cause.split("; without")[0] in proof


def _is_like(reason: Reason, cause: Reason | None) -> bool:
    """Does a reason of many tell what the cause tells?"""
    if cause is None:
        return False
    same = (reason.kind, reason.end, reason.joint) == (cause.kind, cause.end, cause.joint)
    return same and reason.bodies[:1] == cause.bodies[:1]


def _stage_lines(stage: Stage, cause: Reason | None) -> list[str]:
    counts = f"{stage.passed} of {stage.entered} {STAGES[stage.name]}"
    if stage.name == "found":
        counts = f"{stage.entered}"
    told = [r for r in stage.reasons if not (r == cause and r.count == 1)]
    told = sorted(told, key=lambda r: not _is_like(r, cause))[:MOST_REASONS]
    if not stage.entered and not told:
        return []
    is_moot = stage.name == "connected" and not stage.entered
    if is_moot and cause is not None and cause.kind != "no_regrasp":
        return []  # why no regrasp was found tells nothing more
    more = len(stage.reasons) - MOST_REASONS
    if not stage.entered and stage.name == "found":  # nothing of the funnel was looked at
        return [line for reason in told for line in _wrapped(reason.text, 2)]
    words = [_counted(reason, stage) for reason in told]
    words += [f"{more} reasons more"] if more > 0 else []
    why = f"; {'; '.join(words)}" if words else ""
    return _wrapped(f"{LABELS[stage.name]}: {counts}{why}", 2)


def _counted(reason: Reason, stage: Stage) -> str:
    text = textwrap.shorten(reason.text, 90, placeholder=" ...")
    if not stage.entered or (reason.count == 1 and STAGES[stage.name] == "feature pairs"):
        return text
    like = " like" if STAGES[stage.name] == "feature pairs" else ":"
    return f"{reason.count}{like} {text}"


def _wrapped(text: str, most: int, indent: str = "  ") -> list[str]:
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=indent,
        subsequent_indent=indent + "  ",
        max_lines=most,
        placeholder=" ...",
        break_on_hyphens=False,
    )
