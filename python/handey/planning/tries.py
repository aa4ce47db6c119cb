"""The grasps of one goal that were tried, and when to try them again with a greater budget.

Most motions are found at once or not for long, so every grasp first gets a small budget. Where
several have fallen, the first of them is given the next budget before one more is tried with the
smallest: neither a hard motion that all grasps share nor a hopeless grasp costs much. The empty
hand's ways to several grasps are one question: with greater budgets they are looked for together,
from where the arm is to any of them. What a grasp has, a way in or a way to it, is kept. The order
is fixed by what fell, not by time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.motion.carry import Carry, DirectOptions, Workspace
from handey.motion.gross_motion import Journey
from handey.motion.pick_and_place import carry_through, find_transit
from handey.motion.reach import Reach, find_approach, find_reach
from handey.planning.budgets import by_slides, with_budget
from handey.planning.grasps import Grasp, describe
from handey.planning.plan_options import PlanOptions
from handey.reporting.goal_report import Attempt, GoalReport

__all__ = ["Tries", "planned"]

# Choice: what hundreds of grasps alike fell at, more of them will fall at too. Grasps whose gross
# motions may fall in one pass; that get each greater budget; that are approached by search.
MOST_FALLEN = 8
MOST_IN_ALL = 16  # the same in all passes
MOST_ALIKE = 8  # the same, where what first met what is the same of all of them
MOST_CAUGHT = (10, 3)  # that get each greater budget before all have had the least
MOST_AGAIN = (6, 3, 1)
MOST_SEARCHED = 5
MOST_STUCK = 12  # slides that fail, before the second configuration of a grasp is passed over
MOST_JOINED = 12  # Choice: to so many grasps at once a way of the empty hand is looked for
FEW_REGRASPS = (3, 1, 0)  # sequences tried where many grasps have fallen at their gross motions
WAITING = 3  # Choice: grasps that fell before the first of them gets a greater budget


@dataclass(eq=False)
class _Try:
    """One grasp, and the arm's configuration in it, with what is known of it.

    Attributes:
        number: of the grasp.
        name: the grasp in words.
        pair, aim, q_pick: the same for the core.
        approach: what the local planners gave, if all of them were asked.
        reach: the motions near obstacles.
        transit: the way of the empty hand to it.
        falls: how often it fell at a gross motion.
    """

    number: int
    name: str
    pair: _core.RankedPair
    aim: _core.GraspPose
    q_pick: np.ndarray
    approach: _core.ApproachResult | None = None
    reach: Reach | None = None
    transit: Journey | None = None
    falls: int = 0


@dataclass
class Tries:
    """What came of the grasps of one goal so far.

    Attributes:
        work: the goal.
        report: is told of every attempt.
        options: budgets of the rounds.
        waiting: by round, what fell at a gross motion in the round before.
        slid: grasps to which no slide led, still to be approached by search.
        stalled: how many of these since one was searched for.
        stuck: the same in all.
        searched: to how many a way was searched for.
        fallen: grasps that fell near obstacles.
        grasps: how many were taken up.
        unconnected: grasps that fell at a gross motion.
        met: at what first: the motion, and the two bodies.
        caught: by round, how many got its budget before all had had the least.
    """

    work: Workspace
    report: GoalReport
    options: PlanOptions
    waiting: dict[int, list[_Try]] = field(default_factory=dict)
    slid: list[_Try] = field(default_factory=list)
    stalled: int = 0
    stuck: int = 0
    searched: int = 0
    fallen: list[_Try] = field(default_factory=list)
    grasps: int = 0
    unconnected: int = 0
    met: set[tuple[str, str, str]] = field(default_factory=set)
    caught: dict[int, int] = field(default_factory=dict)

    def regrasps_worth(self, round_: int) -> int | None:
        """How many sequences of regrasps are worth a try; None: as many as may be.

        Where the motions of many grasps that serve both ends have fallen, other grasps are seldom
        what helps.
        """
        if self.unconnected < MOST_FALLEN:
            return None
        return FEW_REGRASPS[min(round_, len(FEW_REGRASPS) - 1)]

    def reach_any(self, grasps: Iterator[Grasp]) -> Carry | None:
        """Steps 4 to 6 with the least budget for one grasp after the other: the first that serves.

        Every grasp is tried with up to two configurations of the arm, with one where many stick.
        """
        stop_at = min(self.unconnected + MOST_FALLEN, MOST_IN_ALL)
        while self.unconnected < stop_at and not self._are_alike():
            pair, aim = next(grasps, (None, None))
            if pair is None or aim is None:
                return None
            self.grasps += 1
            found = self.report.counts.get("legal grasp poses", self.grasps)
            self._announce(f"grasp {self.grasps} of {found}")
            for q_pick in aim.q_pick[: 1 if self.stuck >= MOST_STUCK else 2]:
                attempt = _Try(self.grasps, describe(pair, aim), pair, aim, q_pick)
                carry = self._slide(attempt) or self._catch_up()
                if carry is not None:
                    return carry
        return None

    def again(self, round_: int) -> Carry | None:
        """All that fell, with budgets up to a round's; then the whole arm near obstacles.

        What fell by its budget is tried with the next greater one first.
        """
        slid, self.slid = self.slid, []
        slid = slid[: max(0, MOST_SEARCHED - self.searched)]
        for number, attempt in enumerate(slid, 1):
            self._announce(f"by search, grasp {number} of {len(slid)}")
            self.searched += 1
            carry = self._reach(attempt, 0)
            if carry is not None:
                return carry
        for budget in range(1, round_ + 1):
            most = MOST_AGAIN[min(budget, len(MOST_AGAIN)) - 1]
            for number in range(min(most, len(self.waiting.get(budget, [])))):
                self._announce(f"again, grasp {number + 1} of {most}")
                carry = self._retry(budget)
                if carry is not None:
                    return carry
                if not self.waiting[budget]:
                    break
            self.waiting[budget] = []
        fallen, self.fallen = self.fallen, []
        # Half as many with each greater budget.
        fallen = fallen[: -(-self.options.most_by_arm // 2 ** (round_ - 1))]
        for number, attempt in enumerate(fallen, 1):
            self._announce(f"by the whole arm, grasp {number} of {len(fallen)}")
            carry = self._reach(attempt, round_)
            if carry is not None:
                return carry
        return None

    def _are_alike(self) -> bool:
        """Have enough grasps fallen at the same, whatever the grasp?"""
        return self.unconnected >= MOST_ALIKE and len(self.met) == 1

    def _announce(self, what: str) -> None:
        self.work.clock.trying = f"goal {self.report.goal}, {what}"

    def _catch_up(self) -> Carry | None:
        """The next budget for the first that wait for it; the greatest is left to the end."""
        for round_ in range(1, len(self.options.sampling_rounds) - 1):
            waiting = self.waiting.get(round_, [])
            most = MOST_CAUGHT[min(round_, len(MOST_CAUGHT)) - 1]
            if len(waiting) >= WAITING and self.caught.get(round_, 0) < most:
                self.caught[round_] = self.caught.get(round_, 0) + 1
                carry = self._retry(round_)
                if carry is not None:
                    return carry
        if self.stalled >= WAITING and self.searched < MOST_SEARCHED:
            self.stalled = 0
            self.searched += 1
            return self._reach(self.slid.pop(0), 0)
        return None

    def _slide(self, attempt: _Try) -> Carry | None:
        """The first time: the approach straight or by slides only."""
        direct, work = by_slides(self._budget(0)), self.work
        approach = find_approach(work, attempt.pair, attempt.aim, attempt.q_pick, direct)
        reach = find_reach(work, attempt.pair, attempt.aim, attempt.q_pick, direct, approach)
        if not isinstance(reach, Carry):
            return self._join(attempt, reach, 0)
        self._tell(attempt, reach, approached=False)
        if not approach and self.options.direct.approach.search_levels > 0:
            self.slid.append(attempt)
            self.stalled += 1
            self.stuck += 1
        else:
            attempt.approach = approach
            self._fell(attempt, reach)
        return None

    def _tell(self, attempt: _Try, carry: Carry, approached: bool) -> None:
        if self.report.looked is not None:
            self.report.looked.tried(attempt.number, attempt.aim, carry, approached)

    def _fell(self, attempt: _Try, carry: Carry) -> None:
        self.report.attempts.append(Attempt(attempt.name, carry.stage, carry.reason))
        self.fallen.append(attempt)

    def _reach(self, attempt: _Try, round_: int) -> Carry | None:
        """With all local planners; what they gave before, they give again."""
        direct, work = self._budget(round_), self.work
        grasp = attempt.pair, attempt.aim, attempt.q_pick
        if attempt.approach is None:
            attempt.approach = find_approach(work, *grasp, direct)
        reach = find_reach(work, *grasp, direct, attempt.approach)
        if isinstance(reach, Carry):
            self._tell(attempt, reach, approached=False)
            self._fell(attempt, reach)
            return None
        return self._join(attempt, reach, round_)

    def _join(self, attempt: _Try, reach: Reach, round_: int) -> Carry | None:
        """Gross motions to and from what was found near obstacles."""
        self.report.add("approached", 1)
        attempt.reach = reach
        transit = find_transit(self.work, [reach], self._budget(round_))
        return self._carry(attempt, transit, round_)

    def _retry(self, round_: int) -> Carry | None:
        """The next budget for the first that waits for it; its transit with those of others."""
        waiting = self.waiting[round_]
        first = waiting[0]
        if first.transit is not None:
            return self._carry(waiting.pop(0), first.transit, round_)
        opening = _reach_of(first).approach[0].opening
        joined = [
            attempt
            for attempt in waiting
            if attempt.transit is None and _reach_of(attempt).approach[0].opening == opening
        ][:MOST_JOINED]
        reaches = [_reach_of(attempt) for attempt in joined]
        transit = find_transit(self.work, reaches, self._budget(round_))
        fell = [joined[transit.goal]] if transit else joined
        for attempt in fell:
            waiting.remove(attempt)
        for attempt in fell:
            carry = self._carry(attempt, transit, round_)
            if carry is not None:
                return carry
        return None

    def _carry(self, attempt: _Try, transit: Journey, round_: int) -> Carry | None:
        attempt.transit = transit or None
        carry = carry_through(self.work, _reach_of(attempt), self._budget(round_), transit)
        self._tell(attempt, carry, approached=True)
        self.report.attempts.append(Attempt(attempt.name, carry.stage, carry.reason))
        if carry.stage == "done":
            return planned(self.report, attempt.name, carry)
        if not attempt.falls:
            self.unconnected += 1
            self.met |= {(carry.stage, hit.a, hit.b) for hit in carry.met()[:1]}
            if carry.stage == "transfer":
                self.work.give_part_up()
            if self.unconnected == WAITING:
                self.work.give_up(True)
        attempt.falls += 1
        if round_ + 1 < len(self.options.sampling_rounds):
            self.waiting.setdefault(round_ + 1, []).append(attempt)
        return None

    def _budget(self, round_: int) -> DirectOptions:
        return with_budget(self.options, round_)


def _reach_of(attempt: _Try) -> Reach:
    assert attempt.reach is not None
    return attempt.reach


def planned(report: GoalReport, name: str, carry: Carry) -> Carry:
    """Tell the report of the grasp with which a goal was planned."""
    report.status, report.grasp = "planned", name
    if carry.grasp is not None:
        report.jaws = {"open": carry.grasp.opening, "closed": carry.grasp.width}
    return carry
