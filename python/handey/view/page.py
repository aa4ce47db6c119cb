"""The page of a cell: a plan that plays, or a failure with its reasons.

What is told is HTML; what is drawn is data for the viewer (the scripts in viewer/: WebGL 2, plain
JavaScript).
"""

from __future__ import annotations

import html

from handey.check.cell import Cell
from handey.check.plan_data import PlanData
from handey.html_page import asset, filled, html_page, script_of
from handey.report_file import ToldReport
from handey.view.clearance import clearance_along
from handey.view.planes import grasp_planes
from handey.view.scene import cell_scene, clearance_scene, tried_scene
from handey.view.told import told

__all__ = ["cell_page", "fault_page"]

SCRIPTS = (
    "algebra",
    "scene",
    "webgl",
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
)


def cell_page(
    cell: Cell, plan: PlanData | None, report: ToldReport | None = None, *, live: bool = False
) -> str:
    """The whole page."""
    scene = cell_scene(cell, plan)
    scene["report"] = [] if report is None else tried_scene(cell, plan, report)
    curve = None if plan is None else clearance_along(cell, plan)
    scene["clearance"] = None if curve is None else clearance_scene(curve)
    failed = plan is None and report is not None
    panel = "" if report is None else told(report, grasp_planes(cell, plan, report))
    kinds = [
        "failed" if failed else "plain",
        "told" if panel else "untold",
        *(["live"] if live else []),
    ]
    parts = {"title": html.escape(cell.name), "told": panel, "kinds": " ".join(kinds)}
    return html_page(
        cell.name,
        asset(__package__, "style.css"),
        filled(asset(__package__, "page.html"), parts),
        script_of(__package__, [f"viewer/{name}.js" for name in SCRIPTS]),
        scene,
        dark=True,
        live=live,
    )


def fault_page(title: str, faults: list[str]) -> str:
    """A page that says what is wrong with a cell file; it waits for a better one."""
    raise NotImplementedError
