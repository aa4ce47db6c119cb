"""A report as lines for people: what fits a screen, or all of it.

Lengths in millimetres, areas in square centimetres, angles in degrees; lines are at most 80 wide
but for names and reasons. `verbose` leaves nothing out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from handey import _core
from handey.inspection.cell import CellReport, GoalFigures, PartFigures
from handey.inspection.holding import Held
from handey.inspection.part import PartReport, kind_words
from handey.inspection.reach import POINTINGS, ReachRow
from handey.inspection.robot import RobotReport
from handey.inspection.surface import Hole

__all__ = [
    "cell_lines",
    "direction",
    "listed",
    "millimetres",
    "part_lines",
    "robot_lines",
    "span",
    "why_not",
]

MOST = {"faces": 6, "pairs": 3, "rejected": 3, "rests": 6, "holes": 4}  # Choice: fit a screen
WIDTH = 80


def millimetres(lengths: Iterable[float]) -> str:
    """Lengths in mm, with one digit after the point."""
    return ", ".join(f"{1e3 * value + 0.0:.1f}".replace("-0.0", "0.0") for value in lengths)


def span(lengths: Sequence[float]) -> str:
    """From the least to the greatest length in mm, once where they are the same."""
    low, high = millimetres([min(lengths)]), millimetres([max(lengths)])
    return low if low == high else f"{low} to {high}"


def direction(vector: np.ndarray) -> str:
    """A unit vector: an axis by its name, else three numbers."""
    vector = np.asarray(vector, dtype=float)
    axis = int(np.argmax(np.abs(vector)))
    if abs(vector[axis]) > 1 - 1e-6:
        return f"{'+' if vector[axis] > 0 else '-'}{'xyz'[axis]}"
    return "(" + ", ".join(f"{0.0 if abs(x) < 0.005 else x:.2f}" for x in vector) + ")"


def listed(names: Sequence[str], width: int, first: str) -> list[str]:
    """Names after a heading, folded; further lines are indented as far."""
    lines, rest = [], list(names) or ["none"]
    line = first
    for i, name in enumerate(rest):
        word = name + ("," if i + 1 < len(rest) else "")
        if len(line) > len(first) and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = " " * len(first)
        line += (" " if line.strip() and line != first else "") + word
    return [*lines, line]


def _row(label: str, text: str) -> str:
    return f"  {label:<10}{text}"


def _folded(label: str, words: str) -> list[str]:
    """Running text beside a label."""
    lines = [""]
    for word in words.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > WIDTH - 12:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return [_row(label if i == 0 else "", line) for i, line in enumerate(lines)]


def _warnings(warnings: Iterable[str]) -> list[str]:
    return [line for warning in warnings for line in _folded("warning", warning)]


def _more(hidden: int, what: str) -> list[str]:
    return [_row("", f"and {hidden} more {what} (--verbose)")] if hidden > 0 else []


# -------------------------------------------------------------------------------------------- part


def part_lines(report: PartReport, verbose: bool = False) -> list[str]:
    """What a part is."""
    scale = "" if report.scale is None else f", scale {report.scale:g}"
    lines = [f"{report.name}: part, {_size(report.size)} mm{scale}"]
    lines += _warnings(report.warnings)
    if report.volume is not None and report.centre is not None:
        lines.append(
            _row(
                "volume",
                f"{_volume(report.volume)}; centre of mass ({millimetres(report.centre)}) mm",
            )
        )
    lines += _surface_lines(report, verbose)
    lines += _face_lines(report, verbose)
    lines += _pair_lines(report, verbose)
    return lines + _rest_lines(report, verbose)


def _size(size: np.ndarray) -> str:
    return " x ".join(f"{1e3 * x:.1f}" for x in size)


def _volume(volume: float) -> str:
    if volume >= 1.0:
        return f"{volume:.4g} m3"
    return f"{1e6 * volume:.4g} cm3" if volume < 1e-3 else f"{1e3 * volume:.4g} litres"


def _surface_lines(report: PartReport, verbose: bool) -> list[str]:
    lines = []
    for index, surface in enumerate(report.surfaces):
        several = len(report.surfaces) > 1
        label = "surface" if not several else f"shape {index}"
        pieces = f"{surface.pieces} piece" + ("s" if surface.pieces != 1 else "")
        state = "closed" if surface.closed else f"NOT closed: {surface.open_edges} open edges"
        lines.append(_row(label, f"{surface.triangles} triangles in {pieces}, {state}"))
        shown = surface.holes if verbose else surface.holes[: MOST["holes"]]
        lines += [_row("", _hole(hole)) for hole in shown]
        lines += _more(len(surface.holes) - len(shown), "holes")
        if len(surface.overfull):
            at = millimetres(surface.overfull[0])
            count = len(surface.overfull)
            lines.append(_row("", f"{count} edges of more than two triangles, one at ({at}) mm"))
        if not surface.oriented:
            lines.append(_row("", "neighbouring triangles disagree which side is out"))
    most = 8  # Choice: lines for all shapes
    hidden = 0 if verbose else len(lines) - most
    return lines if hidden <= 0 else [*lines[:most], *_more(hidden, "lines on surfaces")]


def _hole(hole: Hole) -> str:
    edges = f"{hole.edges} open edge{'s' if hole.edges != 1 else ''}"
    return f"{edges}, {1e3 * hole.length:.1f} mm long, about ({millimetres(hole.centre)}) mm"


def _face_lines(report: PartReport, verbose: bool) -> list[str]:
    shown = len(report.faces) if verbose else MOST["faces"]
    smaller = f", {report.smaller_faces} smaller" if report.smaller_faces else ""
    count = len(report.faces)
    lines = [
        _row("faces", f"{count} flat one{'s' if count != 1 else ''} of 25 mm2 or more{smaller}")
    ]
    if report.faces:
        lines.append(_row("", f"{'':<9}{'area cm2':>9}  normal"))
    for i, face in enumerate(report.faces[:shown]):
        area = 1e4 * face.area
        shown_area = f"{area:9.2f}" if area < 1e5 else f"{area:9.3g}"
        lines.append(_row("", f"{'face ' + str(i):<9}{shown_area}  {direction(face.normal)}"))
    return lines + _more(len(report.faces) - shown, "faces")


def _pair_lines(report: PartReport, verbose: bool) -> list[str]:
    if not report.closed:
        return [_row("pairs", "not looked for: the surface is not closed")]
    if report.gripper is None:
        return [_row("pairs", "not looked for: --robot ROBOT.yaml tells which jaws are to hold it")]
    lines = [jaws_line(report.robot, report.gripper)]
    if report.features is None:
        return lines
    kept = len(report.pairs)
    beyond = sum(1 for pair in report.pairs if pair.kind != _core.PairKind.FaceFace)
    left_out = report.features.beyond_faces - beyond
    note = f"; {left_out} more with edges or vertices, worth less" if left_out > 0 else ""
    lines += _folded("pairs", f"{kept} that the jaws span, {len(report.rejected)} not{note}")
    if kept:
        lines.append(_row("", f"{'':<24}{'width mm':>9}{'on cm2':>8}  closing along"))
    for words, count in report.kinds().items():
        of_kind = [pair for pair in report.pairs if kind_words(pair.kind) == words]
        shown = of_kind if verbose else of_kind[: MOST["pairs"]]
        lines.append(_row("", f"{words}: {count}"))
        lines += [_row("", _pair(pair)) for pair in shown]
        if len(shown) < count:
            widths = [pair.width for pair in of_kind[len(shown) :]]
            between = f"{span(widths)} mm wide"
            lines.append(_row("", f"  and {count - len(shown)} more, {between}"))
    shown_not = report.rejected if verbose else report.rejected[: MOST["rejected"]]
    for i, pair in enumerate(shown_not):
        lines += _folded("not" if i == 0 else "", f"{pair}: {why_not(report, pair)}")
    return lines + _more(len(report.rejected) - len(shown_not), "that they do not span")


def why_not(report: PartReport, pair: _core.RejectedPair) -> str:
    """Why the jaws do not span a pair, in short."""
    short = report.short(pair)
    if short is None:
        return str(pair.reason)
    return f"{1e3 * pair.width:.1f} mm wide, the jaws open {1e3 * short:.1f} mm too little"


def _pair(pair: _core.FeaturePair) -> str:
    axis = direction(np.asarray(pair.X_PG)[:3, 2])
    return f"  {pair!s:<22}{1e3 * pair.width:9.1f}{1e4 * pair.area:8.2f}  {axis}"


def jaws_line(robot: str, gripper: _core.Gripper) -> str:
    """What jaws there are."""
    low, high = 1e3 * gripper.min_opening, 1e3 * gripper.max_opening
    pads = f"{1e3 * gripper.pad_width:g} x {1e3 * gripper.pad_length:g} mm"
    return _row("jaws", f"{robot}: open {low:g} to {high:g} mm, pads {pads}")


def _rest_lines(report: PartReport, verbose: bool) -> list[str]:
    if not report.closed or report.volume is None:
        return [_row("stands", "not looked for: the surface is not closed")]
    count = len(report.rests)
    if not count:
        return [_row("stands", "on no face stably")]
    shown = report.rests if verbose else report.rests[: MOST["rests"]]
    lines = [_row("stands", f"{count} way{'s' if count != 1 else ''}, when it falls on a table")]
    lines.append(
        _row("", f"{'':<3}{'of 100':>7}{'tips at deg':>13}{'margin mm':>11}{'height mm':>11}  up")
    )
    for i, rest in enumerate(shown):
        figures = (
            f"{i:<3}{100 * rest.probability:7.1f}{math.degrees(rest.tip_angle):13.1f}"
            f"{1e3 * rest.margin:11.1f}{1e3 * rest.top:11.1f}"
        )
        lines.append(_row("", f"{figures}  {direction(np.asarray(rest.X_SP)[2, :3])}"))
    return lines + _more(count - len(shown), "ways")


# ------------------------------------------------------------------------------------------- robot


def robot_lines(report: RobotReport, verbose: bool = False) -> list[str]:
    """What a robot is."""
    robot = report.robot
    lines = [f"{report.name}: robot, {robot.dof} joints"]
    lines += _warnings(report.warnings)
    lines.append(_row("joints", f"{'':<16}{'from deg':>9}{'to deg':>9}{'deg/s':>8}{'home':>8}"))
    for joint, home in zip(robot.joints, robot.home, strict=True):
        limit = joint.limit
        bounds = (
            f"{_degrees(limit.lower):>9}{_degrees(limit.upper):>9}{_degrees(limit.velocity):>8}"
        )
        lines.append(_row("", f"{joint.name:<16}{bounds}{_degrees(float(home)):>8}"))
    if report.objection:
        lines += _folded("inverse", f"NOT supported, no planning: {report.objection}")
    else:
        lines.append(_row("inverse", "closed form: axes 2 and 3 parallel, spherical wrist"))
    if report.has_jaws:
        lines.append(jaws_line(robot.name, robot.gripper))
    else:
        lines.append(_row("jaws", "none"))
    lines += _reach_lines(report)
    if report.is_shapeless:
        return [*lines, _row("home", "no shapes were looked at")]
    if report.nearest[0]:
        a, b = report.nearest
        lines.append(_row("home", f"clear of itself by {1e3 * report.clearance:.1f} mm: {a}, {b}"))
    else:
        lines.append(_row("home", "clear of itself by more than 500 mm"))
    lines += listed([f"{a}/{b}" for a, b in report.ignored], WIDTH, _row("unchecked", "").ljust(12))
    joined = [f"{a}/{b}" for a, b in report.joined]
    if verbose:
        lines += listed(joined, WIDTH, _row("", "joined by a joint: "))
    else:
        lines.append(_row("", f"and the {len(joined)} pairs that a joint joins (--verbose)"))
    if report.shapeless:
        lines += _folded("shapeless", "collide with nothing: " + ", ".join(report.shapeless))
    return lines


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle) + 0.0:.1f}" if math.isfinite(angle) else "none"


def _reach_lines(report: RobotReport) -> list[str]:
    if report.reach is None:
        return []
    lines = [_row("reach", f"of the grasp point, mm from axis 1, {_towards(report.reach.azimuth)}")]
    lines.append(_row("", f"{'height mm':>9}  {'hand down':<22}hand level, pointing out"))
    for row in reversed(report.reach.rows):
        down, level = (_ranges(row, pointing) for pointing in POINTINGS)
        lines.append(_row("", f"{1e3 * row.height:9.0f}  {down:<22}{level}"))
    return lines


def _towards(azimuth: float) -> str:
    return "along +x" if azimuth == 0 else f"{math.degrees(azimuth):.0f} deg from +x"


def _ranges(row: ReachRow, pointing: str) -> str:
    found = row.ranges[pointing]
    return ", ".join(f"{1e3 * low:.0f} to {1e3 * high:.0f}" for low, high in found) or "-"


# -------------------------------------------------------------------------------------------- cell


def cell_lines(report: CellReport, verbose: bool = False) -> list[str]:
    """What is in a cell."""
    cell = report.file.cell
    lines = [f"{report.name}: cell, robot {cell.robot.name}"]
    lines += _warnings(report.warnings)
    if report.objection:
        lines += _folded("inverse", f"NOT supported, no planning: {report.objection}")
    distance, a, b = report.home_clearance
    near = f"{1e3 * distance:.1f} mm: {a}, {b}" if a else "more than 500 mm"
    lines.append(_row("start", f"the robot is clear of all by {near}"))
    lines += listed([f.name for f in cell.fixtures], WIDTH, _row("fixtures", ""))
    lines += _support_lines(report)
    for entry in report.depth_maps:
        rows, columns = entry.shape
        share = f"{100 * entry.unmeasured:.1f} % not measured"
        lines.append(_row("depth map", f"{entry.name}: {entry.kind}, {columns} x {rows}, {share}"))
    if not report.parts:
        lines.append(_row("parts", "none"))
    shown = report.parts if verbose else report.parts[:6]
    for figures in shown:
        lines += _standing_part(figures)
    lines += _more(len(report.parts) - len(shown), "parts")
    goals = report.goals if verbose else report.goals[:6]
    for index, goal in enumerate(goals):
        lines += _goal_lines(index, goal)
    lines += _more(len(report.goals) - len(goals), "goals")
    if report.touching:
        touching = [f"{a}/{b} {1e3 * depth:.2f} mm" for a, b, depth in report.touching]
        lines += listed(touching, WIDTH, _row("overlap", ""))
    if verbose:
        for figures in report.parts:
            lines += ["", *part_lines(figures.part, verbose)]
    return lines


def _support_lines(report: CellReport) -> list[str]:
    if not report.supports:
        return [_row("supports", "none: no part can be put down between regrasps")]
    told = []
    for name, faces in report.supports:
        area = sum(face.area for face in faces)
        tops = sorted({round(1e3 * float(face.X_WS[2, 3]), 1) + 0.0 for face in faces})
        heights = (
            f"{tops[0]:g}" if len(tops) == 1 else f"{tops[0]:g} to {tops[-1]:g}" if tops else "-"
        )
        told.append(f"{name} {1e4 * area:.0f} cm2 at z {heights} mm")
    return listed(told, WIDTH, _row("supports", ""))


def _standing_part(figures: PartFigures) -> list[str]:
    part, standing = figures.part, figures.standing
    on = "on " + ", ".join(standing.on) if standing.on else "on nothing"
    movable = ", may move" if figures.may_move else ""
    stable = "" if standing.stable else f", NOT stable: {standing.reason}"
    lines = _folded("part", f"{part.name}: {_size(part.size)} mm, {on}{stable}{movable}")
    kinds = ", ".join(f"{words} {count}" for words, count in part.kinds().items()) or "none"
    clear = f"; {figures.unobstructed} unobstructed here" if part.pairs else ""
    lines += _folded("", f"pairs: {kinds}{clear}")
    if not part.pairs and part.rejected:
        lines += _folded("", f"{part.rejected[0]}: {why_not(part, part.rejected[0])}")
    if figures.held is not None and (figures.held.tried or part.pairs):
        lines += _folded("", f"hand poses: {_held(figures.held)}")
    return lines


def _held(held: Held) -> str:
    if not held.tried:
        return held.reason or "none to try"
    if held.legal:
        return f"{held.legal} of {held.tried} legal here"
    return f"none of {held.tried} legal: {held.reason}"


def _goal_lines(index: int, goal: GoalFigures) -> list[str]:
    lines = _folded("goal", f"{index}: {goal.goal}: {goal.verdict}")
    if goal.why_none:
        return lines + _folded("", goal.why_none)
    if goal.there is None or goal.both is None:
        return lines
    if goal.here is not None and not goal.here.legal:
        lines += _folded("", f"where it stands: {_held(goal.here)}")
    if not goal.there.legal:
        same = goal.here is not None and goal.here == goal.there
        return lines + ([] if same else _folded("", f"there: {_held(goal.there)}"))
    both = f"{goal.both.legal or 'none'} at both ends"
    lines += _folded("", f"{goal.there.legal} hand poses legal there, {both}")
    if not goal.both.legal and goal.here is not None and goal.here.legal:
        lines += _folded("", goal.both.reason)
    return lines
