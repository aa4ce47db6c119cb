"""A report as a page: one HTML file that needs no network and no server.

Tables that tell all without a script, beside a picture that can be turned (inspect.js: WebGL, plain
JavaScript). A row that is chosen is shown in the picture: a face, what the pads touch and how they
close, a way to rest, a part of the cell.
"""

from __future__ import annotations

import os

from handey.formats.output import write_whole
from handey.inspection.cell import CellReport
from handey.inspection.cell_page import cell_page
from handey.inspection.markup import escaped
from handey.inspection.part import PartReport
from handey.inspection.part_page import part_page
from handey.inspection.robot import RobotReport
from handey.inspection.robot_page import robot_page
from handey.inspection.scene import (
    cell_scene,
    part_scene,
    robot_scene,
)
from handey.pages.html import asset, filled, html_page

__all__ = ["write_page"]


def write_page(report: PartReport | RobotReport | CellReport, path: str | os.PathLike[str]) -> None:
    """Writes the page, whole or not at all.

    Raises:
        InvalidInput: E_OUTPUT if it cannot be written.
    """
    if isinstance(report, PartReport):
        kind, content, scene = "part", part_page(report), part_scene(report)
    elif isinstance(report, RobotReport):
        kind, content, scene = "robot", robot_page(report), robot_scene(report)
    else:
        kind, content, scene = "cell", cell_page(report), cell_scene(report)
    parts = {"title": escaped(report.name), "kind": kind, "content": content}
    page = html_page(
        report.name,
        asset(__package__, "style.css"),
        filled(asset(__package__, "page.html"), parts),
        asset(__package__, "inspect.js"),
        scene,
    )
    write_whole(path, page)
