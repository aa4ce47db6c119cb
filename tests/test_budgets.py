"""Budgets of the rounds of attempts: the first are cheap; slides alone mean no search."""

from __future__ import annotations

from dataclasses import replace

import handey
from handey import _core
from handey.motion.carry import DirectOptions
from handey.planning.budgets import by_slides, with_budget


def test_by_slides_gives_up_the_complete_search_alone() -> None:
    approach = _core.ApproachOptions(most_slides=3, contact_share=0.35)
    given = DirectOptions(approach=approach, most_places=2)
    slides = by_slides(given)
    assert slides.approach.search_levels == 0 and given.approach.search_levels > 0
    assert (slides.approach.most_slides, slides.approach.contact_share) == (3, 0.35)
    assert slides.most_places == 2


def test_the_whole_arm_is_sampled_from_the_second_round_on() -> None:
    options = handey.PlanOptions()
    assert with_budget(options, 0).arm is None
    assert with_budget(options, 1).arm is not None


def test_each_round_samples_as_much_as_the_options_say() -> None:
    options = handey.PlanOptions(sampling_rounds=(3, 50, 700), seed=5)
    budgets = [with_budget(options, round_) for round_ in range(3)]
    assert [budget.gross.sampling.max_iterations for budget in budgets] == [3, 50, 700]
    assert {budget.gross.sampling.seed for budget in budgets} == {5}


def test_proofs_that_there_is_no_way_wait_for_the_last_round_of_thorough_planning() -> None:
    options = handey.PlanOptions(sampling_rounds=(10, 100))
    first, last = (with_budget(options, round_).gross for round_ in (0, 1))
    assert first.separation.most_cells == 0 and last.separation.most_cells > 0
    hasty = replace(options, thorough=False)
    assert with_budget(hasty, 1).gross.separation.most_cells == 0
