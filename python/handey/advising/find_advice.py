"""The nearest change with which a failed goal plans: which to try first, and how small it may be.

What the goal fell by says which kinds of changes are plausible, and what met the hand or arm says
which bodies to move. These are tried at sizes far apart, the most plausible first; the first that
plans is made as small as it may be, and what is left of the time goes to cheaper kinds.
Not guaranteed: that there is no smaller change, or, where none is told, that there is none.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

from handey import _core
from handey.advising import cell_changes, gripping, poses, robot_changes
from handey.advising.change import COSTS, Change, Family, written
from handey.advising.situation import Blame, Situation
from handey.advising.trials import Planner, Trials
from handey.cell_file import CellFile
from handey.planning.plan_options import PlanOptions
from handey.reporting.advice import Advice, Edit
from handey.reporting.reasons import Reason
from handey.reporting.report import Report

__all__ = ["PATIENCE", "find_advice"]

MOST_BODIES = 4  # Choice: of those blamed, so many are tried to be moved
PATIENCE = 4.0  # Choice: on the wall's clock the search may take so many times as long
FOR_PROOF = 0.3  # Choice: share of the time that is kept for the last look at the change
WORTH = 0.8  # Choice: a change of another kind is tried if it costs less than this share
# Choice: trials in vain after a change that plans, and their share of the time.
IN_VAIN, PATIENT = 6, 0.2
DEAR = 0.05  # Choice: as much less plausible is what costs one shift of 10 mm more
HARDER = 6.0  # Choice: as much less plausible is it that more effort helps
PROVED = 8.0  # Choice: as much more plausible is what moves a body without which it plans
BULK, BULKIEST = 0.01, 2.0  # Choice: what is large is moved with reluctance [m3]
FINE = 0.12  # Choice: share of a size to which it is told
SOON = 5.0  # Choice: where moving bodies is as plausible as this, each is taken out at first
NAMED = 2.0  # weight of a body that a reason names
MOTIONS = ("approach", "departure", "deposit", "withdrawal", "transit", "transfer", "home")


def find_advice(
    cell_file: CellFile, options: PlanOptions, report: Report, planner: Planner
) -> None:
    """Tell the first failed goal's nearest change in its report, where one is found in time.

    The cause, too, is told more closely: where the goal plans without one single body, that is in
    the way.

    Args:
        cell_file: whose planning failed.
        options: of that planning; `advice_seconds` bounds the CPU time.
        report: of it.
        planner: plans a changed cell.
    """
    start, begin = time.thread_time(), time.perf_counter()

    def slowness() -> float:
        cpu = report.cpu_s + time.thread_time() - start
        wall = report.wall_s + time.perf_counter() - begin
        return min(PATIENCE, max(1.0, wall / max(cpu, 1e-3)))

    failed = next((goal for goal in report.goals if goal.status == "failed"), None)
    if failed is None:
        return
    model = _core.make_collision_model(cell_file.cell, cell_file.model)
    here = Situation(cell_file, failed.goal, failed, model)
    end = start + (1 - FOR_PROOF) * options.advice_seconds
    search = _Search(here, Trials(here, options, planner, end, slowness))
    search.run()
    if search.culprit and failed.cause is not None and failed.cause.kind in MOTIONS:
        failed.cause = _blaming(failed.cause, search.culprit)
    search.trials.end = start + options.advice_seconds
    for change in sorted(search.found, key=lambda change: change.cost):
        cell = search.trials.read(change)
        if cell is None:
            continue
        failed.advice = _advice(change, failed.goal)
        if not search.trials.is_refuted(cell):
            break
        failed.advice = None


def _advice(change: Change, goal: int) -> Advice:
    edits = "; ".join(f"{edit.place}: {_told(edit)}" for edit in change.edits)
    text = f"{change.words} ({edits}): then goal {goal} plans"
    return Advice(change.kind, text, change.edits, change.size)


def _told(edit: Edit) -> str:
    if edit.value is None:
        return "taken out"
    if edit.place == "task":
        return ", ".join(f"{goal.get('place')}" for goal in edit.value)
    return written(edit.value)


def _blaming(cause: Reason, body: str) -> Reason:
    bodies = (body, *(name for name in cause.bodies if name != body))
    return replace(cause, text=f"{cause.text}; without {body} it plans", bodies=bodies)


@dataclass(frozen=True, eq=False)
class _Try:
    """One size of a family, with how implausible it is, and how much effort it is worth."""

    rank: float
    family: Family
    size: float
    effort: int


@dataclass
class _Search:
    """Tries families of changes, one size after the other.

    Attributes:
        here: the goal that failed.
        trials: plans with changes.
        found: changes that planned.
        culprit: a body without which it plans.
        without: whether it plans without a body, with so much effort.
    """

    here: Situation
    trials: Trials
    found: list[Change] = field(default_factory=list)
    culprit: str = ""
    without: dict[tuple[str, int], bool] = field(default_factory=dict)

    @cached_property
    def ranks(self) -> dict[str, float]:
        """How plausible each kind of change is."""
        return _ranks(self.here)

    @cached_property
    def bodies(self) -> list[Blame]:
        """Those blamed most, each once."""
        first: dict[str, Blame] = {}
        for blame in self.here.blamed:
            first.setdefault(blame.name, blame)
        return list(first.values())[:MOST_BODIES]

    def run(self) -> None:
        """Try until the time is over."""
        waiting = list(self._tries())
        if self.ranks.get("moved", LATE) < SOON:
            for blame in self.bodies:
                self._plans_without(blame.name, 0)
        failed: dict[tuple[int, int], list[float]] = {}
        last, until = 0, 0.0
        while waiting and self.trials.left > 0:
            if self.found and (self.trials.count > last + IN_VAIN or self.trials.left < until):
                break
            it = min(waiting, key=self._rank)
            waiting.remove(it)
            change = it.family.make(it.size)
            if change is None or not self._is_worth(change) or self._is_vain(it):
                continue
            key = id(it.family), it.effort
            if self.trials.plans(change, it.effort):
                self.found.append(change)
                self._shrink(it, failed.get(key, []))
                last = self.trials.count
                until = self.trials.left - PATIENT * self.trials.options.advice_seconds
                if change.kind == "order":  # nothing need be moved
                    break
            else:
                failed.setdefault(key, []).append(it.size)
        for name in dict.fromkeys(name for (name, _), plans in self.without.items() if plans):
            change = poses.removed(self.here, name)
            if change is not None:
                self.found.append(change)

    def _is_worth(self, change: Change) -> bool:
        best = min((found.cost for found in self.found), default=float("inf"))
        return change.cost < WORTH * best

    def _rank(self, it: _Try) -> float:
        """Less for what is to be tried sooner."""
        # A body without which it plans is the likeliest to be moved.
        proved = any(self.without.get((it.family.body, effort)) for effort in range(it.effort + 1))
        is_moved = proved and it.family.kind != "may move"  # which takes long to try
        return it.rank - (PROVED if is_moved else 0.0)

    def _plans_without(self, name: str, effort: int) -> bool:
        """Is this single body in the way?"""
        key = name, effort
        if key not in self.without:
            change = poses.removed(self.here, name)
            known = effort > 0 and self.without.get((name, effort - 1), False)
            self.without[key] = known or (change is not None and self.trials.plans(change, effort))
            if self.without[key] and not self.culprit:
                self.culprit = name
        return self.without[key]

    def _is_vain(self, it: _Try) -> bool:
        """Does it not even plan without the body that the family moves?"""
        body = it.family.body
        if not body or poses.removed(self.here, body) is None:
            return False
        return not self._plans_without(body, it.effort)

    def _shrink(self, it: _Try, failed: list[float]) -> None:
        """Halve the gap between what plans and what does not."""
        family, size = it.family, it.size
        if family.step <= 0:
            return
        low = max((other for other in failed if other < size), default=0.0)
        while size - low > max(1.5 * family.step, FINE * size) and self.trials.left > 0:
            middle = family.step * round(0.5 * (low + size) / family.step)
            change = family.make(middle)
            if change is not None and self.trials.plans(change, it.effort):
                self.found.append(change)
                size = middle
            else:
                low = middle

    def _missing(self, end: str) -> float | None:
        """How far an end is out of reach, if that is why it fails [m]."""
        cause = self.here.reasons[0] if self.here.reasons else None
        is_far = cause is not None and cause.kind == "out_of_reach" and cause.end == end
        return cause.by if cause is not None and is_far else None

    def _joint_missing(self, end: str) -> float | None:
        """How far the first joint turns too little for an end, if that is told [rad]."""
        first = self.here.cell.robot.joints[0].name
        for reason in self.here.reasons[:1]:
            if reason.kind == "joint_limit" and reason.joint == first and reason.end == end:
                return reason.by
        return None

    def _tries(self) -> Iterator[_Try]:
        """All that may be tried."""
        for family, rank in self._families():
            for wave, size in enumerate(family.sizes):
                least, slope = COSTS[family.kind]
                dear = DEAR * (least + slope * abs(size))
                is_order = family.kind == "order"
                for effort in (2,) if is_order else (0, 1):
                    harder = 0.0 if is_order else HARDER * effort
                    total = rank + family.rank + family.wave * wave + harder + dear
                    yield _Try(total, family, size, effort)

    def _families(self) -> Iterator[tuple[Family, float]]:
        """Each family of changes with its rank among all."""
        here = self.here
        ranks = self.ranks
        blamed = list(dict.fromkeys(blame.name for blame in here.blamed))
        parts = [name for name in blamed if here.is_part(name)]
        ends = list(here.ends)
        makers: dict[str, Callable[[], Iterator[Family]]] = {
            "jaws": lambda: chain(gripping.wider_jaws(here), gripping.closer_jaws(here)),
            "friction": lambda: gripping.frictions(here),
            "support": lambda: cell_changes.supports(here),
            "may move": lambda: cell_changes.yielding(here, parts[:MOST_BODIES]),
            "order": lambda: cell_changes.orders(here, blamed),
            "joint limit": lambda: robot_changes.farther_joints(here),
            "robot": lambda: robot_changes.mounts(here),
            "earlier goal": lambda: cell_changes.sooner(here, parts[:2]),
            "region": lambda: cell_changes.other_places(here),
            "robot start": lambda: cell_changes.robot_starts(here),
            "finish": lambda: cell_changes.finish(here),
        }
        for kind, make in makers.items():
            for family in make():
                yield family, ranks.get(kind, LATE)
        for order, blame in enumerate(self.bodies):
            for family in poses.moved_bodies(here, blame):
                bulky = min(BULKIEST, here.bulk(blame.name) / BULK)
                yield family, ranks.get("moved", LATE) + order + bulky
        for end in ends:
            away = [b.name for b in here.blamed if b.end == end and b.weight >= NAMED]
            away = [
                name
                for name in away
                if all(p != here.goal.part for p, _ in here.loads.get(name, []))
            ]
            for family in poses.shifts(here, end, away, self._missing(end)):
                yield family, ranks.get(f"shift {end}", LATE)
            for family in poses.lowered(here, end, self._missing(end)):
                yield family, ranks.get(f"shift {end}", LATE) + 2.0
            for family in poses.swings(here, end, self._joint_missing(end)):
                yield family, ranks.get(f"shift {end}", LATE)
            for family in poses.turns(here, end):
                yield family, ranks.get(f"turn {end}", LATE)


FIRST = -20.0  # Choice: rank of what needs nothing to be moved
LATE = 12.0  # Choice: rank of what the reasons do not suggest

# What a reason suggests, the likeliest first; {end} is its end, or both where it names none.
SUGGESTED = {
    "would_fall": ("may move", "order", "earlier goal"),
    "unstable": ("shift destination", "order"),
    "in_the_way": ("may move", "order", "earlier goal", "shift destination"),
    "no_place": ("region", "moved", "may move", "earlier goal", "order"),
    "no_features": ("jaws",),
    "too_wide": ("jaws", "support"),
    "too_thin": ("jaws",),
    "slips": ("friction", "jaws"),
    "obstructed": ("moved", "shift {end}", "turn {end}", "may move", "support"),
    "little_contact": ("shift {end}", "turn {end}", "moved"),
    "turns": ("friction", "support"),
    "out_of_reach": ("shift {end}", "robot", "turn {end}", "moved"),
    "joint_limit": ("turn {end}", "joint limit", "shift {end}", "support", "moved"),
    "collision": ("moved", "shift {end}", "turn {end}", "may move", "support"),
    "approach": ("moved", "shift origin", "turn origin", "may move"),
    "departure": ("moved", "shift origin", "turn origin", "may move"),
    "deposit": ("moved", "shift destination", "turn destination", "may move"),
    "withdrawal": ("moved", "shift destination", "turn destination", "may move"),
    "transit": ("moved", "robot start", "may move", "shift origin"),
    "transfer": ("moved", "shift destination", "turn destination", "may move", "shift origin"),
    "home": ("finish", "robot start", "moved"),
    "no_regrasp": ("support", "turn destination", "turn origin"),
}  # fmt: skip


def _ranks(here: Situation) -> dict[str, float]:
    """How plausible each kind of change is: 0 for what the cause suggests first."""
    ranks: dict[str, float] = {"support": 0.0} if here.wants_regrasp else {}
    kinds = list(dict.fromkeys((reason.kind, reason.end) for reason in here.reasons))
    if not kinds:
        return dict(_UNKNOWN)
    for order, (kind, end) in enumerate(kinds):
        ends = [end] if end else here.ends_at_fault
        for place, wanted in enumerate(SUGGESTED.get(kind, ())):
            for each in ends:
                name = wanted.format(end=each)
                rank = 1.5 * place + 3.0 * order
                ranks[name] = min(ranks.get(name, LATE), rank)
    named = [name for reason in here.reasons[:1] for name in reason.bodies[:2]]
    if here.goals_before(named):
        ranks["order"] = FIRST
    return ranks


# Where no typed reason is known.
_UNKNOWN = {
    "jaws": 0.0,
    "moved": 0.5,
    "shift destination": 1.0,
    "turn destination": 1.5,
    "may move": 2.0,
    "order": 2.0,
    "support": 3.0,
    "region": 0.0,
    "shift origin": 3.0,
    "turn origin": 3.5,
    "friction": 4.0,
    "robot start": 4.0,
    "finish": 5.0,
    "earlier goal": 6.0,
}
