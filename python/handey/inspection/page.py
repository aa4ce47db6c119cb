"""A report as a page: one HTML file that needs no network and no server.

Tables that tell all without a script, beside a picture that can be turned (inspect.js: WebGL, plain
JavaScript). A row that is chosen is shown in the picture: a face, what the pads touch and how they
close, a way to rest, a part of the cell.
"""

from __future__ import annotations

import html
import json
import math
import os
from collections.abc import Iterable, Sequence
from importlib import resources
from typing import Any

import numpy as np

from handey.inspection.cell import CellReport, GoalFigures, PartFigures
from handey.inspection.holding import Held
from handey.inspection.part import PartReport, kind_words
from handey.inspection.reach import POINTINGS
from handey.inspection.robot import RobotReport
from handey.inspection.scene import (
    MOST_PAIRS,
    MOST_RESTS,
    PARTS,
    cell_scene,
    part_scene,
    reach_figure,
    robot_scene,
)
from handey.inspection.text import direction, millimetres, span, why_not
from handey.output import write_whole

__all__ = ["write_page"]

MOST_FACES, MOST_REJECTED = 300, 200  # Choice: more are in the JSON


def write_page(report: PartReport | RobotReport | CellReport, path: str | os.PathLike[str]) -> None:
    """Writes the page, whole or not at all.

    Raises:
        InvalidInput: E_OUTPUT if it cannot be written.
    """
    if isinstance(report, PartReport):
        kind, content, scene = "part", _part(report), part_scene(report)
    elif isinstance(report, RobotReport):
        kind, content, scene = "robot", _robot(report), robot_scene(report)
    else:
        kind, content, scene = "cell", _cell(report), cell_scene(report)
    assets = resources.files(__package__)
    written = json.dumps(scene, separators=(",", ":"), allow_nan=False)
    parts = {
        "title": _text(report.name),
        "kind": kind,
        "style": assets.joinpath("style.css").read_text(encoding="utf-8"),
        "script": assets.joinpath("inspect.js").read_text(encoding="utf-8"),
        "content": content,
        "scene": written.replace("<", "\\u003c"),
    }
    page = assets.joinpath("page.html").read_text(encoding="utf-8")
    # In one pass, so that a name with braces in it stays what it is.
    pieces = page.split("{{")
    filled = [pieces[0]]
    for piece in pieces[1:]:
        key, _, rest = piece.partition("}}")
        filled += [parts[key], rest]
    write_whole(path, "".join(filled))


def _text(words: object) -> str:
    return html.escape(str(words))


def _section(title: str, *content: str) -> str:
    return f"<section><h2>{_text(title)}</h2>\n" + "\n".join(content) + "\n</section>"


def _facts(rows: Iterable[tuple[str, str]]) -> str:
    """Names and what they are; the second is HTML already."""
    return "<dl>" + "".join(f"<dt>{_text(a)}</dt><dd>{b}</dd>" for a, b in rows) + "</dl>"


def _warnings(warnings: Iterable[str]) -> str:
    return "".join(f'<p class="warning">{_text(warning)}</p>' for warning in warnings)


def _note(words: str) -> str:
    return f'<p class="note">{_text(words)}</p>'


def _table(head: Sequence[str], rows: Sequence[tuple[Sequence[str], str]]) -> str:
    """A table; a heading that ends in a space is of numbers; each row has further attributes."""
    number = [' class="number"' if name.endswith(" ") else "" for name in head]
    titles = "".join(f"<th{n}>{_text(t.strip())}</th>" for t, n in zip(head, number, strict=True))
    body = []
    for cells, more in rows:
        told = "".join(f"<td{n}>{cell}</td>" for cell, n in zip(cells, number, strict=True))
        body.append(f"<tr{' ' + more if more else ''}>{told}</tr>")
    return (
        f'<div class="scroll"><table><thead><tr>{titles}</tr></thead><tbody>'
        + "\n".join(body)
        + "</tbody></table></div>"
    )


def _words(text: str) -> str:
    """Running text in a cell of a table."""
    return f'<div class="words">{_text(text)}</div>' if text else ""


def _shows(what: str, words: str, first: bool = False) -> str:
    """Attributes of a row that the picture can show."""
    mark = ' data-first="1"' if first else ""
    return f'data-show="{_text(what)}" data-words="{_text(words)}"{mark}'


# -------------------------------------------------------------------------------------------- part


def _part(report: PartReport) -> str:
    facts = [("size", f"{' x '.join(f'{1e3 * x:.1f}' for x in report.size)} mm")]
    if report.scale is not None:
        facts.append(("scale", f"{report.scale:g} m per unit of the file"))
    if report.volume is not None and report.centre is not None:
        facts.append(("volume", f"{1e6 * report.volume:.4g} cm&sup3;"))
        facts.append(("centre of mass", f"({millimetres(report.centre)}) mm"))
    if report.mass is not None:
        facts.append(("mass", f"{report.mass:g} kg"))
    triangles = sum(surface.triangles for surface in report.surfaces)
    facts.append(("triangles", str(triangles)))
    state = (
        '<span class="good">closed</span>'
        if report.closed
        else '<span class="bad">not closed</span>'
    )
    facts.append(("surface", state))
    return "\n".join(
        [
            _warnings(report.warnings),
            _section("Part", _facts(facts), *_holes(report)),
            _pairs(report),
            _rests(report),
            _faces(report),
        ]
    )


def _holes(report: PartReport) -> list[str]:
    rows = []
    for index, surface in enumerate(report.surfaces):
        for hole in surface.holes:
            cells = [
                str(index), str(hole.edges), f"{1e3 * hole.length:.1f}",
                f"({millimetres(hole.centre)})",
            ]  # fmt: skip
            rows.append((cells, ""))
    overfull = sum(len(surface.overfull) for surface in report.surfaces)
    told = []
    if rows:
        told.append("<h3>Open edges, red in the picture</h3>")
        told.append(_table(["shape ", "edges ", "length mm ", "about, mm"], rows))
    if overfull:
        told.append(_note(f"{overfull} edges have more than two triangles"))
    return told


def _pairs(report: PartReport) -> str:
    title = "What jaws can hold"
    if not report.closed:
        return _section(title, _note("not looked for: the surface is not closed"))
    gripper = report.gripper
    if gripper is None or report.features is None:
        return _section(title, _note("not looked for: --robot ROBOT.yaml tells which jaws"))
    jaws = (
        f"jaws of {report.robot}: open {1e3 * gripper.min_opening:g} to "
        f"{1e3 * gripper.max_opening:g} mm, pads {1e3 * gripper.pad_width:g} x "
        f"{1e3 * gripper.pad_length:g} mm"
    )
    counts = ", ".join(f"{words}: {count}" for words, count in report.kinds().items())
    rows = []
    for i, pair in enumerate(report.pairs[:MOST_PAIRS]):
        cells = [
            _text(pair), kind_words(pair.kind), f"{1e3 * pair.width:.1f}", f"{1e4 * pair.area:.2f}",
            direction(np.asarray(pair.X_PG)[:3, 2]),
        ]  # fmt: skip
        words = f"{pair}: {1e3 * pair.width:.1f} mm wide"
        rows.append((cells, _shows(f"pair:{i}", words, i == 0)))
    told = [_note(jaws), f"<p>{_text(counts or 'no pair')}</p>"]
    if rows:
        head = ["features", "kind", "width mm ", "on cm2 ", "closing along"]
        told.append(_table(head, rows))
    if len(report.pairs) > MOST_PAIRS:
        told.append(_note(f"and {len(report.pairs) - MOST_PAIRS} more"))
    if report.rejected:
        refused = [
            ([_text(pair), _words(why_not(report, pair))], "")
            for pair in report.rejected[:MOST_REJECTED]
        ]
        told.append(f"<h3>{len(report.rejected)} pairs that these jaws do not span</h3>")
        told.append(_table(["features", "why"], refused))
    return _section(title, *told)


def _rests(report: PartReport) -> str:
    title = "How it stands on a table"
    if not report.closed or report.volume is None:
        return _section(title, _note("not looked for: the surface is not closed"))
    if not report.rests:
        return _section(title, _note("on no face stably"))
    buttons = []
    for i, rest in enumerate(report.rests[:MOST_RESTS]):
        chance, tips = 100 * rest.probability, math.degrees(rest.tip_angle)
        words = f"stands so {chance:.1f} times of 100, tips over at {tips:.1f} degrees"
        buttons.append(
            f'<button type="button" {_shows(f"rest:{i}", words)}>'
            f'<canvas role="img" aria-label="resting pose {i}"></canvas><b>{chance:.1f} %</b><br>'
            f"tips at {tips:.1f}&deg;<br>margin {1e3 * rest.margin:.1f} mm<br>"
            f"height {1e3 * rest.top:.1f} mm</button>"
        )
    told = [f'<div id="rests">{"".join(buttons)}</div>']
    if len(report.rests) > MOST_RESTS:
        told.append(_note(f"and {len(report.rests) - MOST_RESTS} rarer ones"))
    told.append(_note("how often when it falls at random; what it stands on in orange"))
    return _section(title, *told)


def _faces(report: PartReport) -> str:
    rows = []
    for i, face in enumerate(report.faces[:MOST_FACES]):
        words = f"face {i}: {1e4 * face.area:.2f} cm2"
        cells = [f"face {i}", f"{1e4 * face.area:.2f}", direction(face.normal)]
        rows.append((cells, _shows(f"face:{i}", words)))
    told = [_table(["", "area cm2 ", "normal"], rows)] if rows else [_note("none")]
    more = len(report.faces) - MOST_FACES
    if more > 0:
        told.append(_note(f"and {more} more"))
    if report.smaller_faces:
        told.append(_note(f"{report.smaller_faces} more are smaller than 25 mm2: none to hold"))
    return _section(f"{len(report.faces)} flat faces", *told)


# ------------------------------------------------------------------------------------------- robot


def _robot(report: RobotReport) -> str:
    robot, gripper = report.robot, report.robot.gripper
    rows = []
    for joint, home in zip(robot.joints, robot.home, strict=True):
        angles = [joint.limit.lower, joint.limit.upper, joint.limit.velocity, float(home)]
        shown = [f"{math.degrees(a) + 0.0:.1f}" if math.isfinite(a) else "none" for a in angles]
        rows.append(([_text(joint.name), *shown], ""))
    inverse = (
        f'<span class="bad">not supported, no planning</span>: {_text(report.objection)}'
        if report.objection
        else '<span class="good">closed form</span>: axes 2 and 3 parallel, spherical wrist'
    )
    jaws = "none"
    if report.has_jaws:
        opening = f"{1e3 * gripper.min_opening:g} to {1e3 * gripper.max_opening:g} mm"
        pads = f"{1e3 * gripper.pad_width:g} x {1e3 * gripper.pad_length:g} mm"
        jaws = f"open {opening}, pads {pads}"
    a, b = report.nearest
    clear = f"{1e3 * report.clearance:.1f} mm ({_text(a)}, {_text(b)})" if a else "more than 500 mm"
    if report.is_shapeless:
        clear = "no shapes were looked at"
    facts = [
        ("inverse kinematics", inverse),
        ("jaws", jaws),
        ("clear of itself at home", clear),
        ("never checked", _text(", ".join(f"{a}/{b}" for a, b in report.ignored) or "none")),
        ("joined by a joint", _text(", ".join(f"{a}/{b}" for a, b in report.joined))),
    ]
    if report.shapeless and not report.is_shapeless:
        facts.append(("without a shape", _text(", ".join(report.shapeless))))
    head = ["joint", "from deg ", "to deg ", "deg/s ", "home deg "]
    return "\n".join(
        [
            _warnings(report.warnings),
            _section("Robot", _facts(facts)),
            _section("Joints", _table(head, rows)),
            _reach(report),
        ]
    )


def _reach(report: RobotReport) -> str:
    reach = report.reach
    if reach is None:
        return _section("Reach", _note("not known: the inverse kinematics is not supported"))
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
    return _section(
        "Reach", f"<figure>{reach_figure(reach)}</figure>", _note(note), _table(head, rows)
    )


# -------------------------------------------------------------------------------------------- cell


def _cell(report: CellReport) -> str:
    cell = report.file.cell
    distance, a, b = report.home_clearance
    clear = f"{1e3 * distance:.1f} mm ({_text(a)}, {_text(b)})" if a else "more than 500 mm"
    facts = [("robot", _text(cell.robot.name)), ("clear of all at the start", clear)]
    if report.objection:
        facts.append(("inverse kinematics", f'<span class="bad">{_text(report.objection)}</span>'))
    facts += _supports(report)
    for entry in report.depth_maps:
        rows, columns = entry.shape
        share = f"{columns} x {rows}, {100 * entry.unmeasured:.1f} % not measured"
        facts.append((f"depth map {entry.name}", f"{entry.kind}, {share}"))
    if report.touching:
        touching = ", ".join(f"{a}/{b} {1e3 * depth:.2f} mm" for a, b, depth in report.touching)
        facts.append(("overlaps", _text(touching)))
    parts = [_cell_part(i, figures) for i, figures in enumerate(report.parts)]
    head = ["part", "size mm", "on", "pairs ", "unobstructed ", "legal hand poses ", "of "]
    goals = [
        (_goal(index, goal), _shows(f"goal:{index}", f"goal {index}: {goal.goal}"))
        for index, goal in enumerate(report.goals)
    ]
    return "\n".join(
        [
            _warnings(report.warnings),
            _section("Cell", _facts(facts)),
            _section(
                "Parts where they stand",
                _table(head, parts) if parts else _note("none"),
                *_why(report),
            ),
            _section(
                "Goals",
                _table(["", "goal", "", "there ", "both ends ", "why not"], goals)
                if goals
                else _note("none"),
                _note(
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
    on = _text(", ".join(standing.on) or "nothing")
    if not standing.stable:
        on += ' <span class="bad">not stable</span>'
    swatch = f'<span class="swatch" style="background:{PARTS[index % len(PARTS)]}"></span>'
    cells = [
        swatch + _text(part.name), " x ".join(f"{1e3 * x:.0f}" for x in part.size), on,
        str(len(part.pairs)), str(figures.unobstructed),
        "-" if held is None else _count(held), "-" if held is None else str(held.tried),
    ]  # fmt: skip
    return cells, _shows(f"body:{part.name}", part.name)


def _count(held: Held) -> str:
    return f'<span class="{"good" if held.legal else "bad"}">{held.legal}</span>'


def _why(report: CellReport) -> list[str]:
    """What keeps parts from standing and from being held."""
    told = []
    for figures in report.parts:
        name, held = figures.part.name, figures.held
        if not figures.standing.stable:
            told.append(_note(f"{name}: {figures.standing.reason}"))
        if held is not None and not held.legal and held.reason:
            told.append(_note(f"{name}: {held.reason}"))
    return told


def _goal(index: int, goal: GoalFigures) -> list[str]:
    good = goal.verdict in ("within reach", "met already")
    verdict = f'<span class="{"good" if good else "bad"}">{_text(goal.verdict)}</span>'
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
        _words(str(goal.goal)),
        f'<div class="words">{verdict}</div>',
        *counts,
        _words(why),
    ]
