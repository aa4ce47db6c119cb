"""What was found out about a cell, as the content of a page."""

from __future__ import annotations

from typing import Any

from handey.inspection.cell import CellReport, GoalFigures, PartFigures
from handey.inspection.holding import Held
from handey.inspection.lines import span
from handey.inspection.markup import (
    escaped,
    fact_list,
    remark,
    section,
    shows,
    table,
    warning_notes,
    words_cell,
)
from handey.inspection.scene import (
    PARTS,
)

__all__ = ["cell_page"]


def cell_page(report: CellReport) -> str:
    """Sections of a cell: supports, parts, goals."""
    cell = report.file.cell
    distance, a, b = report.home_clearance
    clear = f"{1e3 * distance:.1f} mm ({escaped(a)}, {escaped(b)})" if a else "more than 500 mm"
    facts = [("robot", escaped(cell.robot.name)), ("clear of all at the start", clear)]
    if report.objection:
        facts.append(
            ("inverse kinematics", f'<span class="bad">{escaped(report.objection)}</span>')
        )
    facts += _supports(report)
    for entry in report.depth_maps:
        rows, columns = entry.shape
        share = f"{columns} x {rows}, {100 * entry.unmeasured:.1f} % not measured"
        facts.append((f"depth map {entry.name}", f"{entry.kind}, {share}"))
    if report.touching:
        touching = ", ".join(f"{a}/{b} {1e3 * depth:.2f} mm" for a, b, depth in report.touching)
        facts.append(("overlaps", escaped(touching)))
    parts = [_cell_part(i, figures) for i, figures in enumerate(report.parts)]
    head = ["part", "size mm", "on", "pairs ", "unobstructed ", "legal hand poses ", "of "]
    goals = [
        (_goal(index, goal), shows(f"goal:{index}", f"goal {index}: {goal.goal}"))
        for index, goal in enumerate(report.goals)
    ]
    return "\n".join(
        [
            warning_notes(report.warnings),
            section("Cell", fact_list(facts)),
            section(
                "Parts where they stand",
                table(head, parts) if parts else remark("none"),
                *_why(report),
            ),
            section(
                "Goals",
                table(["", "goal", "", "there ", "both ends ", "why not"], goals)
                if goals
                else remark("none"),
                remark(
                    "hand poses that are legal at the goal, and at both ends; no way is planned. "
                    "Goals that give a pose are outlined in the picture."
                ),
            ),
        ]
    )


def _supports(report: CellReport) -> list[tuple[str, str]]:
    facts = []
    for name, faces in report.supports:
        area = sum(face.area for face in faces)
        tops = span([float(face.X_WS[2, 3]) for face in faces]) if faces else "-"
        facts.append((f"support {name}", f"{1e4 * area:.0f} cm&sup2; at z {tops} mm"))
    return facts or [("supports", "none: no part can be put down between regrasps")]


def _cell_part(index: int, figures: PartFigures) -> tuple[list[str], str]:
    part, standing, held = figures.part, figures.standing, figures.held
    on = escaped(", ".join(standing.on) or "nothing")
    if not standing.stable:
        on += ' <span class="bad">not stable</span>'
    swatch = f'<span class="swatch" style="background:{PARTS[index % len(PARTS)]}"></span>'
    cells = [
        swatch + escaped(part.name), " x ".join(f"{1e3 * x:.0f}" for x in part.size), on,
        str(len(part.pairs)), str(figures.unobstructed),
        "-" if held is None else _count(held), "-" if held is None else str(held.tried),
    ]  # fmt: skip
    return cells, shows(f"body:{part.name}", part.name)


def _count(held: Held) -> str:
    return f'<span class="{"good" if held.legal else "bad"}">{held.legal}</span>'


def _why(report: CellReport) -> list[str]:
    """What keeps parts from standing and from being held."""
    told = []
    for figures in report.parts:
        name, held = figures.part.name, figures.held
        if not figures.standing.stable:
            told.append(remark(f"{name}: {figures.standing.reason}"))
        if held is not None and not held.legal and held.reason:
            told.append(remark(f"{name}: {held.reason}"))
    return told


def _goal(index: int, goal: GoalFigures) -> list[str]:
    good = goal.verdict in ("within reach", "met already")
    verdict = f'<span class="{"good" if good else "bad"}">{escaped(goal.verdict)}</span>'
    there, both = goal.there, goal.both
    why = goal.why_none
    if goal.here is not None and not goal.here.legal:
        why = f"where it stands: {goal.here.reason}"
    elif there is not None and not there.legal:
        why = there.reason
    elif both is not None and not both.legal:
        why = both.reason
    counts: list[Any] = ["-" if held is None else _count(held) for held in (there, both)]
    return [
        str(index),
        words_cell(str(goal.goal)),
        f'<div class="words">{verdict}</div>',
        *counts,
        words_cell(why),
    ]
