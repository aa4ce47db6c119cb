"""30 cells with one known break each: the report names it, and the advice mends the cell.

The bars are for all cells together: what each is told is in the table of broken_cells.py.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from broken_cells import CELLS, Answer, answer, is_planned
from broken_truth import Truth

import handey
from handey.reporting.reasons import Reason

NAMES = [name for name, it in CELLS.items() if it.batch in ("broken_ends", "broken_ways")]
# No test asserts a time; a slow machine may take longer for the same advice.
PATIENT = handey.PlanOptions(advice_seconds=4.0, deadline=10.0)
# Bars under which the planner never falls again: of the causes told, and of the cells mended.
TOLD, MENDED = 28, 22


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> list[Answer]:
    folder = tmp_path_factory.mktemp("broken")
    return [answer(CELLS[name], folder / name, PATIENT) for name in NAMES]


@pytest.mark.parametrize("name", NAMES)
def test_without_its_break_the_cell_plans(tmp_path: Path, name: str) -> None:
    assert is_planned(CELLS[name].write(tmp_path, is_broken=False))


def test_there_are_30_and_none_is_planned_as_it_is(answers: list[Answer]) -> None:
    assert len(answers) == 30
    assert [a.broken.name for a in answers if a.verdict == "plan"] == []
    assert all(a.told.status in ("failed", "stopped") for a in answers)


def test_the_report_names_the_true_cause(answers: list[Answer]) -> None:
    wrong = {a.broken.name: a.told.cause and a.told.cause.text for a in answers if not a.is_told}
    assert len(answers) - len(wrong) >= TOLD, wrong


def test_the_advice_applied_mends_most(answers: list[Answer]) -> None:
    assert sum(a.is_mended for a in answers) >= MENDED


def test_no_advice_is_told_that_does_not_mend(answers: list[Answer]) -> None:
    advised = [a for a in answers if a.told.advice is not None]
    assert [a.broken.name for a in advised if not a.is_mended] == []


def test_a_truth_is_not_met_by_another_body_end_joint_or_number() -> None:
    truth = Truth(("collision",), "origin", bodies=("wall",), by=(0.003, 0.0005))
    said = {"kind": "collision", "stage": "reachable", "text": "", "end": "origin"}
    assert truth.holds(Reason(**said, bodies=("wall", "table"), by=0.0033))
    assert not truth.holds(None)
    assert not truth.holds(Reason(**said, bodies=("table", "wall"), by=0.003))
    assert not truth.holds(Reason(**said, bodies=("wall",), by=0.004))
    assert not truth.holds(Reason(**said, bodies=("wall",)))
    assert not truth.holds(Reason(**{**said, "end": ""}, bodies=("wall",), by=0.003))
    assert not truth.holds(Reason(**{**said, "kind": "approach"}, bodies=("wall",), by=0.003))
    limit = Truth(("joint_limit",), joints=("joint5",))
    assert not limit.holds(Reason("joint_limit", "reachable", "", joint="joint1"))
