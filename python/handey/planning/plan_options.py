"""What bounds and steers planning, checked once where it is said.

A budget that is no number would be found late and far from its cause, and one of zero grasps would
never end.
"""

from __future__ import annotations

import math
import numbers
from dataclasses import dataclass, field

from handey import _core
from handey.errors import Fault, InvalidInput
from handey.motion.carry import DirectOptions
from handey.regrasp.search import RegraspOptions

__all__ = ["PlanOptions"]

GREATEST_SEED = 2**64 - 1
MOST_ITERATIONS = 2**31 - 1


def _denser() -> tuple[_core.LegalityOptions, ...]:
    # Choice: 8 mm and 15 degrees, with half of the usual contact; then 6 mm and 5 degrees, with
    # little more contact than a valid plan must have.
    return tuple(
        _core.LegalityOptions(
            directions=directions, spacing=spacing, least_contact_share=share, spread=True
        )
        for directions, spacing, share in ((24, 0.008, 0.15), (72, 0.006, 0.05))
    )


@dataclass(frozen=True)
class PlanOptions:
    """What bounds and steers planning.

    Attributes:
        seed: fixes every random choice; 0 to 2^64 - 1.
        deadline: seconds of wall-clock time after which planning stops, whatever it is at; None for
            no bound.
        ranking: options of steps 1 to 3.
        legality: options of the test of grasp poses at both ends.
        denser: the same, for further passes over the grasps where the one before gave no plan.
        direct: options and budgets of one attempt.
        poses_per_round: grasp poses of each face pair tried before the next pair has its turn.
        sampling_rounds: iterations of the gross planner in each round of attempts.
        most_by_arm: grasps for which, from the second round on, the whole arm is sampled near
            obstacles, where the local planners gave no way.
        thorough: the last round may take all the time that its gross motions want.
        regrasp: budgets of step 7.
        prove: look for a proof that there is no plan where the first tries fail.
        diagnosis: where no grasp is legal, look for what alone keeps hand poses from being so.
        advice: where no plan is found, look for the nearest change with which there is one.
        advice_seconds: of the thread's CPU time for that, down to half where finding no plan took
            longer than usual; on the clock at most four times as much.

    Raises:
        TypeError: if a number is none.
        InvalidInput: E_RANGE, if one is out of its range.
    """

    seed: int = 0
    deadline: float | None = None
    ranking: _core.RankingOptions = field(default_factory=_core.RankingOptions)
    legality: _core.LegalityOptions = field(default_factory=_core.LegalityOptions)
    denser: tuple[_core.LegalityOptions, ...] = field(default_factory=_denser)
    direct: DirectOptions = field(default_factory=DirectOptions)
    poses_per_round: int = 4
    sampling_rounds: tuple[int, ...] = (50, 150, 500, 2000)
    most_by_arm: int = 2
    thorough: bool = True
    regrasp: RegraspOptions = field(default_factory=RegraspOptions)
    prove: bool = True
    diagnosis: bool = True
    advice: bool = True
    advice_seconds: float = 1.0

    def __post_init__(self) -> None:
        _require_whole("seed", self.seed, 0, GREATEST_SEED)
        _require_whole("poses_per_round", self.poses_per_round, 1, MOST_ITERATIONS)
        _require_whole("most_by_arm", self.most_by_arm, 0, MOST_ITERATIONS)
        if not self.sampling_rounds:
            raise _out_of_range("sampling_rounds", "expected at least one number, found none")
        for iterations in self.sampling_rounds:
            _require_whole("sampling_rounds", iterations, 1, MOST_ITERATIONS)
        if self.deadline is not None:
            _require_seconds("deadline", self.deadline, "a number of seconds or None")
        _require_seconds("advice_seconds", self.advice_seconds, "a number of seconds")


def _require_seconds(name: str, value: object, expected: str) -> None:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: expected {expected}, found {value!r}")
    if not (math.isfinite(value) and float(value) > 0):
        wanted = "expected a finite number of seconds greater than 0"
        raise _out_of_range(name, f"{wanted}, found {value}")


def _require_whole(name: str, value: object, least: int, most: int) -> None:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name}: expected a whole number, found {value!r}")
    if not least <= int(value) <= most:
        raise _out_of_range(name, f"expected a whole number from {least} to {most}, found {value}")


def _out_of_range(name: str, message: str) -> InvalidInput:
    return InvalidInput(Fault("E_RANGE", name, message))
