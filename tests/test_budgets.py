"""Budgets: a short try keeps what was asked for, and gives up what takes long."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import handey
from handey.planning.budgets import quick_options

CELLS = Path(__file__).resolve().parent.parent / "models" / "cells"


def test_a_short_try_keeps_the_seed_and_forbidden_regrasps() -> None:
    options = handey.PlanOptions(seed=7, sampling_rounds=(3,), most_by_arm=0, denser=())
    options = replace(options, regrasp=replace(options.regrasp, most_regrasps=0))
    quick = quick_options(options, deadline=2.0)
    assert (quick.seed, quick.deadline, quick.sampling_rounds) == (7, 2.0, (3,))
    assert (quick.most_by_arm, quick.denser, quick.regrasp.most_regrasps) == (0, (), 0)
    assert not quick.prove and not quick.thorough


def test_a_short_try_does_less_than_the_default() -> None:
    quick, full = quick_options(), handey.PlanOptions()
    assert max(quick.sampling_rounds) < max(full.sampling_rounds)
    assert len(quick.denser) < len(full.denser)
    assert quick.deadline is None


@pytest.mark.parametrize("cell", ["demo", "between_walls", "shelf"])
def test_a_short_try_plans_what_is_not_hard(cell: str) -> None:
    loaded = handey.load_cell(CELLS / f"{cell}.yaml")
    assert handey.plan(loaded, quick_options(deadline=60.0)).plan is not None
