"""The page of a cell: a plan that plays, or a failure with its reasons.

What is told is HTML; what is drawn is data for the viewer (the scripts in viewer/: WebGL 2, plain
JavaScript).
"""

from __future__ import annotations

import html
from collections.abc import Sequence

from handey.check.cell import Cell
from handey.check.plan_data import PlanData
from handey.pages.html import asset, filled, html_page, script_of
from handey.reporting.report_file import ToldReport
from handey.view.clearance import clearance_along
from handey.view.planes import grasp_planes
from handey.view.scene import cell_scene, clearance_scene, tried_scene
from handey.view.told import told

__all__ = ["cell_page", "words_page"]

SCRIPTS = (
    "algebra",
    "scene",
    "webgl",
    "lines",
    "places",
    "camera",
    "tried",
    "picture",
    "words",
    "timeline",
    "clearance",
    "grasp_plane",
    "report",
    "hands",
    "live",
)


WORDS = """<body class="words" data-version="{{version}}">
<main id="words" role="status">
<h1>{{title}}</h1>
<p><b>{{heading}}</b></p>
{{lines}}
</main>
<p id="live" hidden role="status"></p>
"""


def cell_page(
    cell: Cell, plan: PlanData | None, report: ToldReport | None = None, version: str = ""
) -> str:
    """The whole page; one with a version asks its server for newer ones."""
    scene = cell_scene(cell, plan)
    scene["report"] = [] if report is None else tried_scene(cell, plan, report)
    curve = None if plan is None else clearance_along(cell, plan)
    scene["clearance"] = None if curve is None else clearance_scene(curve)
    failed = plan is None and report is not None
    panel = "" if report is None else told(report, grasp_planes(cell, plan, report))
    kinds = f"{'failed' if failed else 'plain'} {'told' if panel else 'untold'}"
    parts = {
        "title": html.escape(cell.name),
        "told": panel,
        "kinds": kinds,
        "version": html.escape(version),
    }
    return html_page(
        cell.name,
        asset(__package__, "style.css"),
        filled(asset(__package__, "page.html"), parts),
        script_of(__package__, [f"viewer/{name}.js" for name in SCRIPTS]),
        scene,
        dark=True,
        live=bool(version),
    )


def words_page(title: str, heading: str, lines: Sequence[str], version: str) -> str:
    """A page without a picture, served live: what is wrong with a file, or what is being done."""
    items = "".join(f"<li>{html.escape(line)}</li>" for line in lines)
    parts = {
        "title": html.escape(title),
        "heading": html.escape(heading),
        "lines": f"<ul>{items}</ul>" if items else "",
        "version": html.escape(version),
    }
    return html_page(
        title,
        asset(__package__, "style.css"),
        filled(WORDS, parts),
        script_of(__package__, ["viewer/live.js"]),
        dark=True,
        live=True,
    )
