"""What was found out about a cell, as lines for people: its supports, parts and goals."""

from __future__ import annotations

from handey.inspection.cell import CellReport, GoalFigures, PartFigures
from handey.inspection.holding import Held
from handey.inspection.lines import (
    WIDTH,
    extent,
    folded,
    labelled,
    listed,
    more_line,
    warning_lines,
)
from handey.inspection.part_text import part_lines, why_not

__all__ = ["cell_lines"]


def cell_lines(report: CellReport, verbose: bool = False) -> list[str]:
    """What is in a cell."""
    cell = report.file.cell
    lines = [f"{report.name}: cell, robot {cell.robot.name}"]
    lines += warning_lines(report.warnings)
    if report.objection:
        lines += folded("inverse", f"NOT supported, no planning: {report.objection}")
    distance, a, b = report.home_clearance
    near = f"{1e3 * distance:.1f} mm: {a}, {b}" if a else "more than 500 mm"
    lines.append(labelled("start", f"the robot is clear of all by {near}"))
    lines += listed([f.name for f in cell.fixtures], WIDTH, labelled("fixtures", ""))
    lines += _support_lines(report)
    for entry in report.depth_maps:
        rows, columns = entry.shape
        share = f"{100 * entry.unmeasured:.1f} % not measured"
        lines.append(
            labelled("depth map", f"{entry.name}: {entry.kind}, {columns} x {rows}, {share}")
        )
    if not report.parts:
        lines.append(labelled("parts", "none"))
    shown = report.parts if verbose else report.parts[:6]
    for figures in shown:
        lines += _standing_part(figures)
    lines += more_line(len(report.parts) - len(shown), "parts")
    goals = report.goals if verbose else report.goals[:6]
    for index, goal in enumerate(goals):
        lines += _goal_lines(index, goal)
    lines += more_line(len(report.goals) - len(goals), "goals")
    if report.touching:
        touching = [f"{a}/{b} {1e3 * depth:.2f} mm" for a, b, depth in report.touching]
        lines += listed(touching, WIDTH, labelled("overlap", ""))
    if verbose:
        for figures in report.parts:
            lines += ["", *part_lines(figures.part, verbose)]
    return lines


def _support_lines(report: CellReport) -> list[str]:
    if not report.supports:
        return [labelled("supports", "none: no part can be put down between regrasps")]
    told = []
    for name, faces in report.supports:
        area = sum(face.area for face in faces)
        tops = sorted({round(1e3 * float(face.X_WS[2, 3]), 1) + 0.0 for face in faces})
        heights = (
            f"{tops[0]:g}" if len(tops) == 1 else f"{tops[0]:g} to {tops[-1]:g}" if tops else "-"
        )
        told.append(f"{name} {1e4 * area:.0f} cm2 at z {heights} mm")
    return listed(told, WIDTH, labelled("supports", ""))


def _standing_part(figures: PartFigures) -> list[str]:
    part, standing = figures.part, figures.standing
    on = "on " + ", ".join(standing.on) if standing.on else "on nothing"
    movable = ", may move" if figures.may_move else ""
    stable = "" if standing.stable else f", NOT stable: {standing.reason}"
    lines = folded("part", f"{part.name}: {extent(part.size)} mm, {on}{stable}{movable}")
    kinds = ", ".join(f"{words} {count}" for words, count in part.kinds().items()) or "none"
    clear = f"; {figures.unobstructed} unobstructed here" if part.pairs else ""
    lines += folded("", f"pairs: {kinds}{clear}")
    if not part.pairs and part.rejected:
        lines += folded("", f"{part.rejected[0]}: {why_not(part, part.rejected[0])}")
    if figures.held is not None and (figures.held.tried or part.pairs):
        lines += folded("", f"hand poses: {_held(figures.held)}")
    return lines


def _held(held: Held) -> str:
    if not held.tried:
        return held.reason or "none to try"
    if held.legal:
        return f"{held.legal} of {held.tried} legal here"
    return f"none of {held.tried} legal: {held.reason}"


def _goal_lines(index: int, goal: GoalFigures) -> list[str]:
    lines = folded("goal", f"{index}: {goal.goal}: {goal.verdict}")
    if goal.why_none:
        return lines + folded("", goal.why_none)
    if goal.there is None or goal.both is None:
        return lines
    if goal.here is not None and not goal.here.legal:
        lines += folded("", f"where it stands: {_held(goal.here)}")
    if not goal.there.legal:
        same = goal.here is not None and goal.here == goal.there
        return lines + ([] if same else folded("", f"there: {_held(goal.there)}"))
    both = f"{goal.both.legal or 'none'} at both ends"
    lines += folded("", f"{goal.there.legal} hand poses legal there, {both}")
    if not goal.both.legal and goal.here is not None and goal.here.legal:
        lines += folded("", goal.both.reason)
    return lines
