"""What was found out about a robot, as lines for people."""

from __future__ import annotations

import math

from handey.inspection.lines import (
    WIDTH,
    folded,
    labelled,
    listed,
    warning_lines,
)
from handey.inspection.part_text import jaws_line
from handey.inspection.reach import POINTINGS, ReachRow
from handey.inspection.robot import RobotReport

__all__ = ["robot_lines"]


def robot_lines(report: RobotReport, verbose: bool = False) -> list[str]:
    """What a robot is."""
    robot = report.robot
    lines = [f"{report.name}: robot, {robot.dof} joints"]
    lines += warning_lines(report.warnings)
    lines.append(labelled("joints", f"{'':<16}{'from deg':>9}{'to deg':>9}{'deg/s':>8}{'home':>8}"))
    for joint, home in zip(robot.joints, robot.home, strict=True):
        limit = joint.limit
        bounds = (
            f"{_degrees(limit.lower):>9}{_degrees(limit.upper):>9}{_degrees(limit.velocity):>8}"
        )
        lines.append(labelled("", f"{joint.name:<16}{bounds}{_degrees(float(home)):>8}"))
    if report.objection:
        lines += folded("inverse", f"NOT supported, no planning: {report.objection}")
    else:
        lines.append(labelled("inverse", "closed form: axes 2 and 3 parallel, spherical wrist"))
    if report.has_jaws:
        lines.append(jaws_line(robot.name, robot.gripper))
    else:
        lines.append(labelled("jaws", "none"))
    lines += _reach_lines(report)
    if report.is_shapeless:
        return [*lines, labelled("home", "no shapes were looked at")]
    if report.nearest[0]:
        a, b = report.nearest
        lines.append(
            labelled("home", f"clear of itself by {1e3 * report.clearance:.1f} mm: {a}, {b}")
        )
    else:
        lines.append(labelled("home", "clear of itself by more than 500 mm"))
    lines += listed(
        [f"{a}/{b}" for a, b in report.ignored], WIDTH, labelled("unchecked", "").ljust(12)
    )
    joined = [f"{a}/{b}" for a, b in report.joined]
    if verbose:
        lines += listed(joined, WIDTH, labelled("", "joined by a joint: "))
    else:
        lines.append(labelled("", f"and the {len(joined)} pairs that a joint joins (--verbose)"))
    if report.shapeless:
        lines += folded("shapeless", "collide with nothing: " + ", ".join(report.shapeless))
    return lines


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle) + 0.0:.1f}" if math.isfinite(angle) else "none"


def _reach_lines(report: RobotReport) -> list[str]:
    if report.reach is None:
        return []
    lines = [
        labelled("reach", f"of the grasp point, mm from axis 1, {_towards(report.reach.azimuth)}")
    ]
    lines.append(labelled("", f"{'height mm':>9}  {'hand down':<22}hand level, pointing out"))
    for row in reversed(report.reach.rows):
        down, level = (_ranges(row, pointing) for pointing in POINTINGS)
        lines.append(labelled("", f"{1e3 * row.height:9.0f}  {down:<22}{level}"))
    return lines


def _towards(azimuth: float) -> str:
    return "along +x" if azimuth == 0 else f"{math.degrees(azimuth):.0f} deg from +x"


def _ranges(row: ReachRow, pointing: str) -> str:
    found = row.ranges[pointing]
    return ", ".join(f"{1e3 * low:.0f} to {1e3 * high:.0f}" for low, high in found) or "-"
