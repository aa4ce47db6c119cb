"""Gross motions with what is told of them: planner, CPU time, and why a fallback was needed.

The core plans them at one opening; where the fingers must open on the way, they do so before the
motion if there is room, else after it. Every motion that leaves here is certified by the core.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from handey import _core

__all__ = ["Journey", "Search", "go", "go_straight", "open_and_go"]


@dataclass(frozen=True)
class Search:
    """How one gross motion was found.

    Attributes:
        planner: "straight", "slices" or "RRT-Connect".
        cpu_s: CPU seconds of the search that gave it; searches before it that failed not counted.
        fallback_reason: why the slices did not give it; empty where they were not needed or did.
    """

    planner: str
    cpu_s: float
    fallback_reason: str = ""


@dataclass(frozen=True)
class Journey:
    """A gross motion, or why there is none; true if found.

    Attributes:
        path: waypoints, empty if none was found.
        goal: index of the goal reached, -1 for none.
        reason: why not found.
        search: how it was found.
    """

    path: list[_core.Configuration] = field(default_factory=list)
    goal: int = -1
    reason: str = ""
    search: Search | None = None

    def __bool__(self) -> bool:
        return bool(self.path)


def go_straight(
    checker: _core.CollisionChecker,
    start: _core.Configuration,
    goals: list[_core.Configuration],
    certificate: _core.CertificateOptions,
) -> Journey:
    """The straight edge to the first of the goals to which it is free."""
    begin = time.process_time()
    for index, goal in enumerate(goals):
        if _core.certify_edge(checker, start, goal, certificate).is_free:
            cpu_s = time.process_time() - begin
            return Journey([start, goal], index, "", Search("straight", cpu_s))
    return Journey(reason="no straight edge is free")


def go(
    checker: _core.CollisionChecker,
    start: _core.Configuration,
    goals: list[_core.Configuration],
    options: _core.GrossOptions,
    table: Callable[[], _core.ArmTable | None],
) -> Journey:
    """Plan a gross motion to one of some goals with the start's opening.

    Args:
        checker: of the cell as it is then.
        start: where the arm is.
        goals: with the start's opening, the best first.
        options: budgets.
        table: makes or reads maps of the arm's plane; asked only where no straight edge is free.
    """
    journey = go_straight(checker, start, goals, options.sampling.certificate)
    if journey:
        return journey
    begin = time.process_time()
    options.free_space.table = table()
    motion = _core.plan_gross_motion(checker, start, goals, options)
    cpu_s = time.process_time() - begin
    if not motion:
        return Journey(reason=motion.reason)
    # Empty unless the slices were asked and gave nothing.
    search = Search(motion.planner, cpu_s, motion.slices_reason)
    return Journey(list(motion.path), motion.goal, "", search)


def open_and_go(
    checker: _core.CollisionChecker,
    start: _core.Configuration,
    goals: list[_core.Configuration],
    options: _core.GrossOptions,
    certificate: _core.CertificateOptions,
    table: Callable[[], _core.ArmTable | None],
) -> Journey:
    """A gross motion with a change of opening before it where there is room, else after it.

    Args:
        checker: of the cell as it is then.
        start: where the arm is.
        goals: all with the same opening, the best first.
        options: budgets.
        certificate: of the change of opening.
        table: as for `go`.
    """
    opening = goals[0].opening
    if start.opening == opening:
        return go(checker, start, goals, options, table)
    opened = _core.Configuration(q=start.q, opening=opening)
    if _core.certify_edge(checker, start, opened, certificate).is_free:
        journey = go(checker, opened, goals, options, table)
        return replace(journey, path=[start, *journey.path]) if journey else journey
    closed = [_core.Configuration(q=goal.q, opening=start.opening) for goal in goals]
    journey = go(checker, start, closed, options, table)
    if not journey:
        return journey
    at, goal = closed[journey.goal], goals[journey.goal]
    if not _core.certify_edge(checker, at, goal, certificate).is_free:
        return Journey(reason="no room to open the fingers at either end")
    return replace(journey, path=[*journey.path, goal])
