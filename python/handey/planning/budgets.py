"""How long to try: the budgets of each round of attempts."""

from __future__ import annotations

from dataclasses import replace

from handey import _core
from handey.motion.carry import DirectOptions
from handey.motion.way_out import WayOutOptions
from handey.options import with_fields
from handey.planning.plan_options import PlanOptions

__all__ = ["by_slides", "with_budget"]


def by_slides(direct: DirectOptions) -> DirectOptions:
    """The same without the complete search of approaches, which costs most where there is none."""
    return replace(direct, approach=with_fields(direct.approach, search_levels=0))


def with_budget(options: PlanOptions, round_: int) -> DirectOptions:
    """Gross motions of one round of attempts: the last may take all the time that they want."""
    iterations = options.sampling_rounds[round_]
    gross = _core.GrossOptions(
        sampling=_core.SamplingOptions(seed=options.seed, max_iterations=iterations),
        shortcut=_core.ShortcutOptions(seed=options.seed),
    )
    if round_ < len(options.sampling_rounds) - 1 or not options.thorough:
        # Choice: about as long for the slices as for sampling. A proof that there is no way waits.
        gross.search = _core.SearchOptions(max_proofs=5 * iterations)
        gross.separation = _core.SeparationOptions(most_cells=0)
    arm = None
    if round_ > 0:
        arm = WayOutOptions(
            sampling=_core.SamplingOptions(seed=options.seed, max_iterations=iterations)
        )
    return replace(options.direct, gross=gross, arm=arm)
