"""What was found out about a robot, as the content of a page."""

from __future__ import annotations

import math

from handey.inspection.markup import (
    escaped,
    fact_list,
    remark,
    section,
    table,
    warning_notes,
)
from handey.inspection.reach import POINTINGS
from handey.inspection.robot import RobotReport
from handey.inspection.scene import (
    reach_figure,
)

__all__ = ["robot_page"]


def robot_page(report: RobotReport) -> str:
    """Sections of a robot: joints, gripper, reach."""
    robot, gripper = report.robot, report.robot.gripper
    rows = []
    for joint, home in zip(robot.joints, robot.home, strict=True):
        angles = [joint.limit.lower, joint.limit.upper, joint.limit.velocity, float(home)]
        shown = [f"{math.degrees(a) + 0.0:.1f}" if math.isfinite(a) else "none" for a in angles]
        rows.append(([escaped(joint.name), *shown], ""))
    inverse = (
        f'<span class="bad">not supported, no planning</span>: {escaped(report.objection)}'
        if report.objection
        else '<span class="good">closed form</span>: axes 2 and 3 parallel, spherical wrist'
    )
    jaws = "none"
    if report.has_jaws:
        opening = f"{1e3 * gripper.min_opening:g} to {1e3 * gripper.max_opening:g} mm"
        pads = f"{1e3 * gripper.pad_width:g} x {1e3 * gripper.pad_length:g} mm"
        jaws = f"open {opening}, pads {pads}"
    a, b = report.nearest
    clear = (
        f"{1e3 * report.clearance:.1f} mm ({escaped(a)}, {escaped(b)})" if a else "more than 500 mm"
    )
    if report.is_shapeless:
        clear = "no shapes were looked at"
    facts = [
        ("inverse kinematics", inverse),
        ("jaws", jaws),
        ("clear of itself at home", clear),
        ("never checked", escaped(", ".join(f"{a}/{b}" for a, b in report.ignored) or "none")),
        ("joined by a joint", escaped(", ".join(f"{a}/{b}" for a, b in report.joined))),
    ]
    if report.shapeless and not report.is_shapeless:
        facts.append(("without a shape", escaped(", ".join(report.shapeless))))
    head = ["joint", "from deg ", "to deg ", "deg/s ", "home deg "]
    return "\n".join(
        [
            warning_notes(report.warnings),
            section("Robot", fact_list(facts)),
            section("Joints", table(head, rows)),
            _reach(report),
        ]
    )


def _reach(report: RobotReport) -> str:
    reach = report.reach
    if reach is None:
        return section("Reach", remark("not known: the inverse kinematics is not supported"))
    rows = []
    for row in reversed(reach.rows):
        ranges = [
            ", ".join(f"{1e3 * low:.0f} to {1e3 * high:.0f}" for low, high in row.ranges[pointing])
            for pointing in POINTINGS
        ]
        rows.append(([f"{1e3 * row.height:.0f}", *(text or "-" for text in ranges)], ""))
    towards = f"{math.degrees(reach.azimuth):.0f} degrees from x of its root frame"
    note = f"of the grasp point, in the direction {towards}; the robot alone, clear of itself"
    head = ["height mm ", "radius mm, hand down", "radius mm, hand level"]
    return section(
        "Reach", f"<figure>{reach_figure(reach)}</figure>", remark(note), table(head, rows)
    )
