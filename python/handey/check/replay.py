"""Replays a plan against its cell and asks after every clause.

The order: form and kinematics of the rows; what is carried where, and on what it stands; collisions
in continuous time. All clauses are asked, so that one fault does not hide another.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from handey.check.carries import find_carries
from handey.check.cell_reader import read_cell
from handey.check.collisions import Collisions
from handey.check.form import check_form
from handey.check.goals import check_goals
from handey.check.handling import check_handling
from handey.check.plan_data import load_json, read_plan
from handey.check.report import CheckReport

__all__ = ["check"]


def check(cell: str | Path, plan: str | Path | Mapping[str, Any]) -> CheckReport:
    """Is a plan valid for a cell?

    Args:
        cell: the cell file.
        plan: the plan file, or its content.

    Returns:
        All faults found, each under the name of its clause, and the least clearance.

    Raises:
        InvalidInput: if the cell, its robot or a mesh cannot be read, or the plan is no JSON.
    """
    report = CheckReport()
    content, _ = load_json(plan if isinstance(plan, Mapping) else Path(plan))
    world_cell = read_cell(Path(cell))
    data = read_plan(content, world_cell, report)
    if data is None:
        return report
    if data.steps:
        report.duration = float(data.steps[-1].time[-1])
    check_form(data, world_cell, report)
    carries, world = find_carries(data, world_cell)
    check_handling(data, world_cell, carries, world, report)
    check_goals(data, world_cell, carries, world, report)
    Collisions(world_cell, data, carries, world, report).check()
    report.faults.sort(key=lambda f: (f.step is None, f.step or 0))
    return report
