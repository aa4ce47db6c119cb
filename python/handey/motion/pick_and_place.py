"""One grasp carried through: approach, grasp, depart, carry, deposit, release, withdraw, home.

The motions near obstacles are known (`reach`); the gross motions (the article's steps 5 and 6) join
them to where the arm is, to each other and to home. They come last, because they cost most. Every
motion that leaves here was certified edge by edge by the core.
Not guaranteed: a grasp given up here may still be feasible; the reason tells where it fell.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from handey import _core
from handey.motion.carry import Carry, DirectOptions, Motion, Workspace, at
from handey.motion.gross_motion import Journey, go, go_straight, open_and_go
from handey.motion.reach import Placing, Reach, lift_held, ways_out

__all__ = ["carry_through", "find_transit"]


def find_transit(work: Workspace, reaches: Sequence[Reach], options: DirectOptions) -> Journey:
    """The empty hand's gross motion (step 5) to where the approach of one of some reaches begins.

    Args:
        work: the goal, and where the arm is.
        reaches: all with the hand as wide open, the best first.
        options: budgets.
    """
    with work.clock("transit"):
        return open_and_go(
            _core.CollisionChecker(work.model, work.scene.cell),
            work.current,
            [reach.approach[0] for reach in reaches],
            options.gross,
            options.approach.certificate,
            work.table,
        )


def carry_through(
    work: Workspace, reach: Reach, options: DirectOptions, transit: Journey | None = None
) -> Carry:
    """Join a reach to where the arm is, to its destination and home by gross motions (steps 5, 6).

    Args:
        work: the goal, and where the arm is.
        reach: the motions near obstacles.
        options: budgets.
        transit: the way to it, if that is known.

    Returns:
        A `Carry`, "done" or with the stage at which it fell.
    """
    scene, grasp = work.scene, reach.grasp
    checker = _core.CollisionChecker(work.model, scene.cell)
    transit = find_transit(work, [reach], options) if transit is None else transit
    if not transit:
        met = _between(checker, work.current, reach.approach[0])
        return Carry("transit", transit.reason, met=met)

    held = scene.cell.with_held(scene.part, reach.X_HP)
    checker = _core.CollisionChecker(work.model, held)
    transfer = _transfer_straight(work, checker, reach, options)
    if not transfer:
        _gain_room(work, reach, options)
        with work.clock("transfer"):
            transfer = go(checker, reach.depart[-1], _goals(reach), options.gross, work.table)
    if not transfer:
        met = _between(checker, reach.depart[-1], _goals(reach)[0])
        return Carry("transfer", transfer.reason, met=met)
    placing = reach.places[transfer.goal]

    q_pick, q_place = reach.approach[-1].q, placing.deposit[-1].q
    opened = placing.withdraw[0].opening
    motions = [
        Motion("transit", transit.path, search=transit.search),
        Motion("approach", reach.approach, planner=reach.planners[0]),
        Motion("grasp", [at(q_pick, grasp.opening), at(q_pick, grasp.width)]),
        Motion("depart", reach.depart, held=True, planner=reach.planners[1]),
        Motion("transfer", transfer.path, held=True, search=transfer.search),
        Motion("deposit", placing.deposit, held=True, planner=placing.planners[0]),
        Motion("release", [at(q_place, grasp.width), at(q_place, opened)]),
        Motion("withdraw", placing.withdraw, planner=placing.planners[1]),
    ]
    end = placing.withdraw[-1]
    if work.home is not None:
        with work.clock("home"):
            goal_cell = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
            checker = _core.CollisionChecker(work.model, goal_cell)
            home = go(checker, end, [at(work.home, end.opening)], options.gross, work.table)
        if not home:
            met = _between(checker, end, at(work.home, end.opening))
            return Carry("home", home.reason, met=met)
        motions.append(Motion("transit", home.path, search=home.search))
        end = home.path[-1]
    motions = [m for m in motions if m.action not in ("transit", "transfer") or len(m.path) > 1]
    return Carry("done", "", motions, reach.X_HP, grasp, end)


def _transfer_straight(
    work: Workspace, checker: _core.CollisionChecker, reach: Reach, options: DirectOptions
) -> Journey:
    """The straight edge to the first way to place the part to which it is free.

    Each further way is looked for only when the edges to all before are not free.
    """
    start, known = reach.depart[-1], 0
    while True:
        with work.clock("transfer"):
            journey = go_straight(
                checker, start, _goals(reach)[known:], options.gross.sampling.certificate
            )
        if journey:
            return replace(journey, goal=journey.goal + known)
        known = len(reach.places)
        following = next(reach.others, None)
        if following is None:
            return journey
        reach.places.append(following)


def _gain_room(work: Workspace, reach: Reach, options: DirectOptions) -> None:
    """Let deposits start with more room where they may: a search for the transfer needs it."""
    scene, out = work.scene, ways_out(work, options)
    goal_cell = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
    for index, placing in enumerate(reach.places):
        if not placing.may_gain:
            continue
        with work.clock("deposit"):
            deposit = lift_held(work, goal_cell, placing.deposit[-1], reach.X_HP, out)
        reach.places[index] = replace(placing, may_gain=False)
        if deposit.has_room:
            work.given["deposit", deposit.planner] += 1
            planners = deposit.planner, placing.planners[1]
            reach.places[index] = Placing(deposit.path[::-1], placing.withdraw, planners)


def _goals(reach: Reach) -> list[_core.Configuration]:
    return [placing.deposit[0] for placing in reach.places]


def _between(
    checker: _core.CollisionChecker, start: _core.Configuration, goal: _core.Configuration
) -> Callable[[], list[_core.Hit]]:
    """What stands between two configurations."""
    return lambda: list(_core.find_hits_along(checker, start, goal))
