"""Task-level planning of pick-and-place robot motions: from a task to a checked program.

    import handey

    cell = handey.load_cell("cell.yaml")
    result = handey.plan(cell)
    if result.plan:
        result.plan.save("cell.plan.json")
        assert handey.check("cell.yaml", result.plan).ok
    else:
        print(result.report.reasons)

Metres, radians, seconds, kilograms; poses are 4 x 4 arrays. Nothing heavy is imported before it is
used.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from handey.errors import Fault, HandeyError, InvalidInput

if TYPE_CHECKING:
    from collections.abc import Callable

    from handey._core import CancelToken
    from handey.cell_file import CellFile, load_cell, parse_cell
    from handey.check import CheckReport
    from handey.plan import Plan, Step
    from handey.planner import PlanOptions, PlanResult
    from handey.reporting.report import Interrupted

__all__ = [
    "CancelToken",
    "CellFile",
    "CheckReport",
    "Fault",
    "HandeyError",
    "Interrupted",
    "InvalidInput",
    "Plan",
    "PlanOptions",
    "PlanResult",
    "Step",
    "check",
    "load_cell",
    "parse_cell",
    "plan",
]

_HOMES = {
    "CancelToken": "_core",
    "CellFile": "cell_file",
    "CheckReport": "check",
    "Interrupted": "reporting.report",
    "Plan": "plan",
    "PlanOptions": "planner",
    "PlanResult": "planner",
    "Step": "plan",
    "load_cell": "cell_file",
    "parse_cell": "cell_file",
    "__version__": "_core",
}


def plan(
    cell: CellFile | str | os.PathLike[str],
    options: PlanOptions | None = None,
    *,
    cancel: CancelToken | None = None,
    progress: Callable[[str, str], None] | None = None,
) -> PlanResult:
    """Plans the task of a cell.

    Args:
        cell: from `load_cell`, or the path of a cell file.
        options: budgets and seed; see `PlanOptions`.
        cancel: ends planning when another thread calls its `cancel()`.
        progress: told where planning is, as a stage and a detail: "transfer", "goal 0, grasp 3 of
            12".

    Returns:
        The plan and its report, or no plan and the reasons. Where the deadline passed or planning
        was cancelled, the report tells what was tried until then.

    Raises:
        InvalidInput: if the cell file is wrong, or has what this version cannot plan for.
        Interrupted: on Ctrl-C; a KeyboardInterrupt that carries the report so far.
    """
    from handey import cell_file, planner

    loaded = cell if isinstance(cell, cell_file.CellFile) else cell_file.load_cell(cell)
    return planner.plan(loaded, options, cancel=cancel, progress=progress)


def check(cell: str | os.PathLike[str], plan: Plan | str | os.PathLike[str]) -> CheckReport:
    """Replays a plan in its cell with an engine of its own and checks every clause of validity.

    Args:
        cell: path of the cell file.
        plan: from `plan`, or the path of a plan file.

    Raises:
        InvalidInput: if the cell file is wrong, or the plan file is no JSON.
    """
    from handey.plan import Plan

    replay = importlib.import_module("handey.check")
    # The replay is given the content of the plan file and nothing else: it shares no code.
    content = json.loads(plan.to_json()) if isinstance(plan, Plan) else Path(plan)
    return replay.check(Path(cell), content)  # type: ignore[no-any-return]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'handey' has no attribute '{name}'")
    return getattr(importlib.import_module(f"handey.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})


class _Package(ModuleType):
    """The functions `plan` and `check` keep their names when the modules of these names load."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in ("plan", "check") and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
