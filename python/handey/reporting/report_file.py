"""The report of planning as a file, and read back from there or from a plan file.

Only what pages show is read. Entries that are missing are empty, entries that nobody knows are
passed over: a report may be older or newer than the page. What is of a wrong kind is a fault.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from handey.formats.fields import Field, kind_of
from handey.formats.output import finite, write_whole
from handey.formats.strict_json import read_json
from handey.reporting.advice import Advice, Edit
from handey.reporting.goal_report import Attempt, GoalReport
from handey.reporting.reasons import STAGES, Reason, Stage, Tried

__all__ = ["ToldReport", "is_report", "read_report", "read_report_file", "write_report"]

VERSION = 1

Value = TypeVar("Value")
_Entries = dict[str, Field]


@dataclass
class ToldReport:
    """What a report tells.

    Attributes:
        verdict: "plan", "infeasible" or "unknown".
        goals: one report per goal of the task.
        stopped: why planning ended before all was tried; empty if it did not.
        cpu_s: CPU seconds of planning; None where that is not told.
        wall_s: the same by the wall clock.
        notes: what there is to say besides: no planning was possible, the plan is not valid.
    """

    verdict: str = "unknown"
    goals: list[GoalReport] = field(default_factory=list)
    stopped: str = ""
    cpu_s: float | None = None
    wall_s: float | None = None
    notes: list[str] = field(default_factory=list)


def write_report(path: str | os.PathLike[str], cell: str, report: dict[str, Any]) -> None:
    """Writes the file, whole or not at all.

    Args:
        path: of the file.
        cell: name of the cell.
        report: of planning, as a dict.

    Raises:
        InvalidInput: E_OUTPUT if it cannot be written.
    """
    content = {"handey_report": VERSION, "cell": cell} | finite(report)
    write_whole(path, json.dumps(content, default=str, allow_nan=False) + "\n")


def is_report(content: Any) -> bool:
    """Does the content of a JSON file say that it is a report, and no plan?"""
    named = isinstance(content, dict) and "handey_report" in content
    return named and "handey_plan" not in content


def read_report_file(path: str | os.PathLike[str]) -> ToldReport:
    """The report in a file of `write_report`.

    Raises:
        InvalidInput: with every fault of the file.
    """
    document = read_json(path)
    entries = _entries(Field(document, (), document.value))
    if "handey_report" in entries:
        entries["handey_report"].version(VERSION)
    told = read_report(Field(document, (), document.value))
    document.raise_faults()
    return told or ToldReport()


def read_report(report: Field) -> ToldReport | None:
    """The report at this place of a document, which then holds the faults.

    Returns:
        None where nothing is told of any goal.
    """
    entries = _entries(report)
    goals = [_goal(index, goal) for index, goal in enumerate(_list(entries, "goals"))]
    stopped = [
        words
        for key, words in (("deadline_passed", "the deadline passed"), ("cancelled", "interrupted"))
        if key in entries and entries[key].flag()
    ]
    if not goals and not stopped:
        return None
    verdict = (
        entries["verdict"].choice("plan", "infeasible", "unknown") if "verdict" in entries else ""
    )
    return ToldReport(
        verdict or "unknown",
        goals,
        ", ".join(stopped),
        cpu_s=_number(entries, "cpu_s", None),
        wall_s=_number(entries, "wall_s", None),
    )


def _goal(index: int, field: Field) -> GoalReport:
    entries = _entries(field)
    goal = GoalReport(_count(entries, "goal", index), _text(entries, "text"))
    goal.status = _text(entries, "status") or goal.status
    goal.counts = {key: value.count() or 0 for key, value in _of(entries, "counts").items()}
    goal.reasons = _texts(entries, "reasons")
    goal.attempts = [_attempt(_entries(item)) for item in _list(entries, "attempts")]
    goal.grasp, goal.proof = _text(entries, "grasp"), _text(entries, "proof")
    goal.jaws = {key: value.number() or 0.0 for key, value in _of(entries, "jaws").items()}
    goal.aside, goal.covered = _texts(entries, "aside"), _texts(entries, "covered")
    goal.stages = [_stage(_entries(item)) for item in _list(entries, "stages")]
    goal.cause = _maybe(entries, "cause", _reason)
    goal.tried = [_tried(_entries(item)) for item in _list(entries, "tried")]
    goal.advice = _maybe(entries, "advice", _advice)
    return goal


def _attempt(entries: _Entries) -> Attempt:
    return Attempt(*(_text(entries, key) for key in ("grasp", "stage", "reason")))


def _stage(entries: _Entries) -> Stage:
    return Stage(
        _stage_name(entries, "stage"),
        _count(entries, "entered"),
        _count(entries, "passed"),
        [_reason(_entries(item)) for item in _list(entries, "reasons")],
    )


def _reason(entries: _Entries) -> Reason:
    return Reason(
        kind=_text(entries, "kind"),
        stage=_stage_name(entries, "stage"),
        text=_text(entries, "text"),
        count=_count(entries, "count", 1),
        end=_text(entries, "end"),
        bodies=tuple(_texts(entries, "bodies")),
        mover=_text(entries, "mover"),
        joint=_text(entries, "joint"),
        by=_number(entries, "by", None),
        proved=bool(entries["proved"].flag()) if "proved" in entries else False,
    )


def _tried(entries: _Entries) -> Tried:
    rows = entries["X_PH"].items(4) if "X_PH" in entries else None
    matrix = [row.numbers(4) for row in rows or []]
    good = len(matrix) == 4 and all(row is not None for row in matrix)
    X_PH = [[float(x) for x in row] for row in matrix if row is not None] if good else []
    return Tried(
        X_PH,
        _number(entries, "opening", 0.0) or 0.0,
        _number(entries, "width", 0.0) or 0.0,
        _stage_name(entries, "stage", may_be_empty=True),
        _text(entries, "text"),
    )


def _advice(entries: _Entries) -> Advice:
    edits = [_entries(item) for item in _list(entries, "edits")]
    return Advice(
        kind=_text(entries, "kind"),
        text=_text(entries, "text"),
        edits=tuple(
            Edit(_text(e, "file"), _text(e, "place"), e["value"].value if "value" in e else None)
            for e in edits
        ),
        size=_number(entries, "size", 0.0) or 0.0,
        verified=bool(entries["verified"].flag()) if "verified" in entries else True,
    )


# ------------------------------------------------------------------------------------------ values


def _entries(field: Field) -> _Entries:
    """Of a mapping, whatever its keys are."""
    if not isinstance(field.value, dict):
        field.fault("E_TYPE", f"expected a mapping, found {kind_of(field.value)}")
        return {}
    return {str(key): field.child(str(key), value) for key, value in field.value.items()}


def _of(entries: _Entries, key: str) -> _Entries:
    return _entries(entries[key]) if key in entries else {}


def _list(entries: _Entries, key: str) -> list[Field]:
    return (entries[key].items() or []) if key in entries else []


def _maybe(entries: _Entries, key: str, read: Callable[[_Entries], Value]) -> Value | None:
    if key not in entries or entries[key].value is None:
        return None
    return read(_entries(entries[key]))


def _text(entries: _Entries, key: str) -> str:
    if key not in entries:
        return ""
    value: Any = entries[key].value
    if not isinstance(value, str):
        entries[key].fault("E_TYPE", f"expected a text, found {kind_of(value)}")
        return ""
    return value


def _texts(entries: _Entries, key: str) -> list[str]:
    return [_text({key: item}, key) for item in _list(entries, key)]


def _count(entries: _Entries, key: str, otherwise: int = 0) -> int:
    return otherwise if key not in entries else entries[key].count() or 0


def _number(entries: _Entries, key: str, otherwise: float | None) -> float | None:
    if key not in entries or entries[key].value is None:
        return otherwise
    return entries[key].number()


def _stage_name(entries: _Entries, key: str, may_be_empty: bool = False) -> str:
    if key not in entries:
        return "" if may_be_empty else next(iter(STAGES))
    if may_be_empty and entries[key].value == "":
        return ""
    return entries[key].choice(*STAGES) or next(iter(STAGES))
