"""What was found out about a part, as lines for people: what fits a screen, or all of it."""

from __future__ import annotations

import math

import numpy as np

from handey import _core
from handey.inspection.lines import (
    direction,
    extent,
    folded,
    labelled,
    millimetres,
    more_line,
    span,
    warning_lines,
)
from handey.inspection.part import PartReport, kind_words
from handey.inspection.surface import Hole

__all__ = ["jaws_line", "part_lines", "why_not"]

MOST = {"faces": 6, "pairs": 3, "rejected": 3, "rests": 6, "holes": 4}  # Choice: fit a screen


def part_lines(report: PartReport, verbose: bool = False) -> list[str]:
    """What a part is."""
    scale = "" if report.scale is None else f", scale {report.scale:g}"
    lines = [f"{report.name}: part, {extent(report.size)} mm{scale}"]
    lines += warning_lines(report.warnings)
    if report.volume is not None and report.centre is not None:
        lines.append(
            labelled(
                "volume",
                f"{_volume(report.volume)}; centre of mass ({millimetres(report.centre)}) mm",
            )
        )
    lines += _surface_lines(report, verbose)
    lines += _face_lines(report, verbose)
    lines += _pair_lines(report, verbose)
    return lines + _rest_lines(report, verbose)


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
        lines.append(labelled(label, f"{surface.triangles} triangles in {pieces}, {state}"))
        shown = surface.holes if verbose else surface.holes[: MOST["holes"]]
        lines += [labelled("", _hole(hole)) for hole in shown]
        lines += more_line(len(surface.holes) - len(shown), "holes")
        if len(surface.overfull):
            at = millimetres(surface.overfull[0])
            count = len(surface.overfull)
            lines.append(
                labelled("", f"{count} edges of more than two triangles, one at ({at}) mm")
            )
        if not surface.oriented:
            lines.append(labelled("", "neighbouring triangles disagree which side is out"))
    most = 8  # Choice: lines for all shapes
    hidden = 0 if verbose else len(lines) - most
    return lines if hidden <= 0 else [*lines[:most], *more_line(hidden, "lines on surfaces")]


def _hole(hole: Hole) -> str:
    edges = f"{hole.edges} open edge{'s' if hole.edges != 1 else ''}"
    return f"{edges}, {1e3 * hole.length:.1f} mm long, about ({millimetres(hole.centre)}) mm"


def _face_lines(report: PartReport, verbose: bool) -> list[str]:
    shown = len(report.faces) if verbose else MOST["faces"]
    smaller = f", {report.smaller_faces} smaller" if report.smaller_faces else ""
    count = len(report.faces)
    lines = [
        labelled("faces", f"{count} flat one{'s' if count != 1 else ''} of 25 mm2 or more{smaller}")
    ]
    if report.faces:
        lines.append(labelled("", f"{'':<9}{'area cm2':>9}  normal"))
    for i, face in enumerate(report.faces[:shown]):
        area = 1e4 * face.area
        shown_area = f"{area:9.2f}" if area < 1e5 else f"{area:9.3g}"
        lines.append(labelled("", f"{'face ' + str(i):<9}{shown_area}  {direction(face.normal)}"))
    return lines + more_line(len(report.faces) - shown, "faces")


def _pair_lines(report: PartReport, verbose: bool) -> list[str]:
    if not report.closed:
        return [labelled("pairs", "not looked for: the surface is not closed")]
    if report.gripper is None:
        return [
            labelled("pairs", "not looked for: --robot ROBOT.yaml tells which jaws are to hold it")
        ]
    lines = [jaws_line(report.robot, report.gripper)]
    if report.features is None:
        return lines
    kept = len(report.pairs)
    beyond = sum(1 for pair in report.pairs if pair.kind != _core.PairKind.FaceFace)
    left_out = report.features.beyond_faces - beyond
    note = f"; {left_out} more with edges or vertices, worth less" if left_out > 0 else ""
    lines += folded("pairs", f"{kept} that the jaws span, {len(report.rejected)} not{note}")
    if kept:
        lines.append(labelled("", f"{'':<24}{'width mm':>9}{'on cm2':>8}  closing along"))
    for words, count in report.kinds().items():
        of_kind = [pair for pair in report.pairs if kind_words(pair.kind) == words]
        shown = of_kind if verbose else of_kind[: MOST["pairs"]]
        lines.append(labelled("", f"{words}: {count}"))
        lines += [labelled("", _pair(pair)) for pair in shown]
        if len(shown) < count:
            widths = [pair.width for pair in of_kind[len(shown) :]]
            between = f"{span(widths)} mm wide"
            lines.append(labelled("", f"  and {count - len(shown)} more, {between}"))
    shown_not = report.rejected if verbose else report.rejected[: MOST["rejected"]]
    for i, pair in enumerate(shown_not):
        lines += folded("not" if i == 0 else "", f"{pair}: {why_not(report, pair)}")
    return lines + more_line(len(report.rejected) - len(shown_not), "that they do not span")


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
    return labelled("jaws", f"{robot}: open {low:g} to {high:g} mm, pads {pads}")


def _rest_lines(report: PartReport, verbose: bool) -> list[str]:
    if not report.closed or report.volume is None:
        return [labelled("stands", "not looked for: the surface is not closed")]
    count = len(report.rests)
    if not count:
        return [labelled("stands", "on no face stably")]
    shown = report.rests if verbose else report.rests[: MOST["rests"]]
    lines = [
        labelled("stands", f"{count} way{'s' if count != 1 else ''}, when it falls on a table")
    ]
    lines.append(
        labelled(
            "", f"{'':<3}{'of 100':>7}{'tips at deg':>13}{'margin mm':>11}{'height mm':>11}  up"
        )
    )
    for i, rest in enumerate(shown):
        figures = (
            f"{i:<3}{100 * rest.probability:7.1f}{math.degrees(rest.tip_angle):13.1f}"
            f"{1e3 * rest.margin:11.1f}{1e3 * rest.top:11.1f}"
        )
        lines.append(labelled("", f"{figures}  {direction(np.asarray(rest.X_SP)[2, :3])}"))
    return lines + more_line(count - len(shown), "ways")
