"""A page that shows a cell: a plan that plays, or why there is none.

One HTML file that needs no network and no server; see `page` for what is in it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from handey.check.cell import Cell
from handey.check.cell_reader import read_cell
from handey.check.plan_data import PlanData, load_json, read_plan
from handey.check.report import CheckReport
from handey.errors import Fault, InvalidInput
from handey.formats.fields import Field
from handey.formats.output import write_whole
from handey.formats.strict_yaml import Document
from handey.reporting.report import Report
from handey.reporting.report_file import ToldReport, is_report, read_report, read_report_file
from handey.view.page import cell_page

__all__ = ["make_page", "write_page"]

PathLike = str | os.PathLike[str]


def write_page(
    cell: PathLike,
    plan: PathLike | Mapping[str, Any] | None,
    path: PathLike,
    report: Report | Mapping[str, Any] | None = None,
    notes: Sequence[str] = (),
) -> None:
    """Writes the page, whole or not at all.

    Args:
        cell: the cell file.
        plan: the plan file or its content, or the file of a report; None shows the cell at its
            start.
        path: the HTML file to write.
        report: how planning went; the plan's own by default.
        notes: what there is to say besides.

    Raises:
        InvalidInput: if the cell, the plan or the report cannot be read; E_OUTPUT if the page
            cannot be written.
    """
    write_whole(path, make_page(cell, plan, report, notes))


def make_page(
    cell: PathLike,
    plan: PathLike | Mapping[str, Any] | None,
    report: Report | Mapping[str, Any] | None = None,
    notes: Sequence[str] = (),
    version: str = "",
) -> str:
    """The page as text; see `write_page`.

    Args:
        cell: the cell file.
        plan: the plan, as of `write_page`.
        report: the same.
        notes: what there is to say besides.
        version: of a page that is served live; it waits for a newer one.
    """
    content = read_cell(Path(cell))
    data, own = (None, None) if plan is None else _read(plan, content)
    told = own if report is None else _told(report)
    if notes:
        told = told or ToldReport("unknown" if data is None else "plan")
        told.notes += notes
    return cell_page(content, data, told, version)


def _read(
    source: PathLike | Mapping[str, Any], cell: Cell
) -> tuple[PlanData | None, ToldReport | None]:
    """The plan, if it is one, and what it tells of its planning."""
    given = source if isinstance(source, Mapping) else Path(source)
    content, name = load_json(given)
    if isinstance(given, Path) and is_report(content):
        told = read_report_file(given)
        if content.get("cell") not in (None, cell.name):
            told.notes.append(f"This report is of the cell {content['cell']}.")
        return None, told
    report = CheckReport()
    data = read_plan(content, cell, report)
    if data is None:
        raise InvalidInput([Fault("E_PLAN", "", str(fault), name) for fault in report.faults])
    own = content.get("report")
    if not isinstance(own, Mapping):
        return data, None
    try:  # what others have written there need not be for us
        return data, _told(own)
    except InvalidInput:
        return data, None


def _told(report: Report | Mapping[str, Any]) -> ToldReport | None:
    value = report.as_dict() if isinstance(report, Report) else dict(report)
    document = Document("report", Path(), value)
    told = read_report(Field(document, (), value))
    document.raise_faults()
    return told
