"""What was found out about a part, as the content of a page."""

from __future__ import annotations

import math

import numpy as np

from handey.inspection.lines import direction, millimetres
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
from handey.inspection.part import PartReport, kind_words
from handey.inspection.part_text import why_not
from handey.inspection.scene import (
    MOST_PAIRS,
    MOST_RESTS,
)

__all__ = ["part_page"]

MOST_FACES, MOST_REJECTED = 300, 200  # Choice: more are in the JSON


def part_page(report: PartReport) -> str:
    """Sections of a part: surface, pairs, rests, faces."""
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
            warning_notes(report.warnings),
            section("Part", fact_list(facts), *_holes(report)),
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
        told.append(table(["shape ", "edges ", "length mm ", "about, mm"], rows))
    if overfull:
        told.append(remark(f"{overfull} edges have more than two triangles"))
    return told


def _pairs(report: PartReport) -> str:
    title = "What jaws can hold"
    if not report.closed:
        return section(title, remark("not looked for: the surface is not closed"))
    gripper = report.gripper
    if gripper is None or report.features is None:
        return section(title, remark("not looked for: --robot ROBOT.yaml tells which jaws"))
    jaws = (
        f"jaws of {report.robot}: open {1e3 * gripper.min_opening:g} to "
        f"{1e3 * gripper.max_opening:g} mm, pads {1e3 * gripper.pad_width:g} x "
        f"{1e3 * gripper.pad_length:g} mm"
    )
    counts = ", ".join(f"{words}: {count}" for words, count in report.kinds().items())
    rows = []
    for i, pair in enumerate(report.pairs[:MOST_PAIRS]):
        cells = [
            escaped(pair),
            kind_words(pair.kind),
            f"{1e3 * pair.width:.1f}",
            f"{1e4 * pair.area:.2f}",
            direction(np.asarray(pair.X_PG)[:3, 2]),
        ]
        words = f"{pair}: {1e3 * pair.width:.1f} mm wide"
        rows.append((cells, shows(f"pair:{i}", words, i == 0)))
    told = [remark(jaws), f"<p>{escaped(counts or 'no pair')}</p>"]
    if rows:
        head = ["features", "kind", "width mm ", "on cm2 ", "closing along"]
        told.append(table(head, rows))
    if len(report.pairs) > MOST_PAIRS:
        told.append(remark(f"and {len(report.pairs) - MOST_PAIRS} more"))
    if report.rejected:
        refused = [
            ([escaped(pair), words_cell(why_not(report, pair))], "")
            for pair in report.rejected[:MOST_REJECTED]
        ]
        told.append(f"<h3>{len(report.rejected)} pairs that these jaws do not span</h3>")
        told.append(table(["features", "why"], refused))
    return section(title, *told)


def _rests(report: PartReport) -> str:
    title = "How it stands on a table"
    if not report.closed or report.volume is None:
        return section(title, remark("not looked for: the surface is not closed"))
    if not report.rests:
        return section(title, remark("on no face stably"))
    buttons = []
    for i, rest in enumerate(report.rests[:MOST_RESTS]):
        chance, tips = 100 * rest.probability, math.degrees(rest.tip_angle)
        words = f"stands so {chance:.1f} times of 100, tips over at {tips:.1f} degrees"
        buttons.append(
            f'<button type="button" {shows(f"rest:{i}", words)}>'
            f'<canvas role="img" aria-label="resting pose {i}"></canvas><b>{chance:.1f} %</b><br>'
            f"tips at {tips:.1f}&deg;<br>margin {1e3 * rest.margin:.1f} mm<br>"
            f"height {1e3 * rest.top:.1f} mm</button>"
        )
    told = [f'<div id="rests">{"".join(buttons)}</div>']
    if len(report.rests) > MOST_RESTS:
        told.append(remark(f"and {len(report.rests) - MOST_RESTS} rarer ones"))
    told.append(remark("how often when it falls at random; what it stands on in orange"))
    return section(title, *told)


def _faces(report: PartReport) -> str:
    rows = []
    for i, face in enumerate(report.faces[:MOST_FACES]):
        words = f"face {i}: {1e4 * face.area:.2f} cm2"
        cells = [f"face {i}", f"{1e4 * face.area:.2f}", direction(face.normal)]
        rows.append((cells, shows(f"face:{i}", words)))
    told = [table(["", "area cm2 ", "normal"], rows)] if rows else [remark("none")]
    more = len(report.faces) - MOST_FACES
    if more > 0:
        told.append(remark(f"and {more} more"))
    if report.smaller_faces:
        told.append(remark(f"{report.smaller_faces} more are smaller than 25 mm2: none to hold"))
    return section(f"{len(report.faces)} flat faces", *told)
