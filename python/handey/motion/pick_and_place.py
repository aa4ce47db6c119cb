"""One grasp carried through: approach, grasp, depart, carry, deposit, release, withdraw, home.

Given a grasp pose that is legal at both ends, is there a certified motion for every step? The
motions near obstacles come first (the article's step 4 and the put-down), the gross motions (steps
5 and 6) last, because they cost most. Every motion that leaves here was certified edge by edge by
the core, under the contacts that the step allows.
Not guaranteed: a grasp given up here may still be feasible; the reason tells where it fell.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from handey import _core
from handey.motion.gross_motion import Journey, Search, go, go_straight, open_and_go
from handey.motion.lift import PLANNERS, Lift, WaysOut, draw_back, lift
from handey.motion.stage_clock import StageClock
from handey.motion.way_out import WayOutOptions, way_out

__all__ = [
    "Carry",
    "DirectOptions",
    "Motion",
    "Placing",
    "Workspace",
    "carry_through",
    "find_approach",
    "find_reach",
    "find_transit",
]

# Choice: the pads are certified up to this far from the faces, each side; the last stretch is the
# contact itself [m].
CLOSING_GAP = 3e-4


@dataclass(frozen=True)
class DirectOptions:
    """Budgets of one attempt.

    Attributes:
        approach: options of the local planner.
        retreat: options of straight lifts and withdrawals.
        departure: the same in the grasp plane, where no straight one leads out.
        roomier: the same, where a straight one does, but ends with little room. Choice: farther,
            and only what is quick.
        gross: options of the gross motions.
        most_places: configurations at the destination that are tried for one grasp.
        arm: budget of motions near obstacles by the whole arm, where the local planners give none;
            None: they are not tried.
    """

    approach: _core.ApproachOptions = field(default_factory=_core.ApproachOptions)
    retreat: _core.RetreatOptions = field(default_factory=_core.RetreatOptions)
    departure: _core.DepartureOptions = field(default_factory=_core.DepartureOptions)
    roomier: _core.DepartureOptions = field(
        default_factory=lambda: _core.DepartureOptions(most=0.16, most_slides=1, search_levels=0)
    )
    gross: _core.GrossOptions = field(default_factory=_core.GrossOptions)
    most_places: int = 4
    arm: WayOutOptions | None = None


@dataclass(frozen=True)
class Workspace:
    """What stays the same while one goal is planned.

    Attributes:
        model: collision geometry of the cell.
        scene: the cell with the part at its origin and an empty hand, and where the part is to go.
        solver: inverse kinematics of the arm.
        current: where the arm is, and the opening.
        home: configurations to return to after the goal; None to stay.
        clock: CPU seconds by stage.
        table: makes or reads maps of the arm's plane, for gross motions that are not straight.
        given: how often each planner gave a motion near obstacles, by (action, planner).
        give_up: called where the first tries fail, told whether grasps were legal; raises if it is
            proved that all must fail.
    """

    model: _core.CollisionModel
    scene: _core.GraspScene
    solver: _core.SphericalWristSolver
    current: _core.Configuration
    home: np.ndarray | None
    clock: StageClock
    table: Callable[[], _core.ArmTable | None] = lambda: None
    given: Counter[tuple[str, str]] = field(default_factory=Counter)
    give_up: Callable[[bool], None] = lambda _: None


@dataclass(frozen=True)
class Motion:
    """A certified polyline that serves one action of the plan.

    Attributes:
        action: the plan's.
        path: waypoints.
        held: the part is in the hand.
        search: how it was found, of gross motions.
        planner: what gave it, of motions near obstacles.
        X_HP: the part in the grasp frame (4, 4), where it is not that of the whole carry.
    """

    action: str
    path: list[_core.Configuration]
    held: bool = False
    search: Search | None = None
    planner: str = ""
    X_HP: np.ndarray | None = None


@dataclass(frozen=True)
class Placing:
    """A certified way to put the part down and leave it; the deposit is a lift, reversed.

    Attributes:
        deposit, withdraw: paths.
        planners: what gave them.
        may_gain: the deposit starts with little room, and none with more was looked for.
    """

    deposit: list[_core.Configuration]
    withdraw: list[_core.Configuration]
    planners: tuple[str, str]
    may_gain: bool = False


@dataclass
class Carry:
    """How far one grasp got.

    Attributes:
        stage: the last stage reached; "done" if all of it was planned.
        reason: why it stopped.
        met: asked what stands in the way there: pairs of bodies, the most frequent first.
        motions: the whole of it when done.
        X_HP: the part in the grasp frame, shape (4, 4).
        end: where the arm is afterwards.
        regrasps: times that the part is put down on the way and taken again.
    """

    stage: str
    reason: str = ""
    motions: list[Motion] = field(default_factory=list)
    X_HP: np.ndarray = field(default_factory=lambda: np.eye(4))
    grasp: _core.GraspPose | None = None
    end: _core.Configuration | None = None
    regrasps: int = 0
    met: Callable[[], list[_core.Hit]] = field(default=list, repr=False)


@dataclass
class Reach:
    """A certified approach and departure for one grasp, with the ways to place it.

    Attributes:
        grasp: where the hand closes.
        approach: path of the open hand.
        depart: path of the part out of contact.
        planners: what gave the approach and the departure.
        X_HP: the part in the grasp frame, shape (4, 4).
        places: ways to place it that are known, at least one.
        others: finds more, when asked.
    """

    grasp: _core.GraspPose
    approach: list[_core.Configuration]
    depart: list[_core.Configuration]
    planners: tuple[str, str]
    X_HP: np.ndarray
    places: list[Placing]
    others: Iterator[Placing]


def _at(q: np.ndarray, opening: float) -> _core.Configuration:
    return _core.Configuration(q=q, opening=opening)


def find_approach(
    work: Workspace,
    pair: _core.RankedPair,
    aim: _core.GraspPose,
    q_pick: np.ndarray,
    options: DirectOptions,
) -> _core.ApproachResult:
    """The open hand's way in, by the local planners in the grasp plane."""
    with work.clock("approach"):
        return _core.plan_approach(work.scene, work.solver, pair, aim, q_pick, options.approach)


def find_reach(
    work: Workspace,
    pair: _core.RankedPair,
    aim: _core.GraspPose,
    q_pick: np.ndarray,
    options: DirectOptions,
    approach: _core.ApproachResult | None = None,
) -> Reach | Carry:
    """Plan the motions near obstacles for one grasp: approach to depart, deposit to withdraw.

    Args:
        work: the goal.
        pair: of features.
        aim: where the hand is to close.
        q_pick: the arm's configuration there.
        options: budgets.
        approach: what the local planners gave, if they were asked before.

    Returns:
        A `Reach`, or a `Carry` that says at which stage it fell.
    """
    scene = work.scene
    if approach is None:
        approach = find_approach(work, pair, aim, q_pick, options)
    with work.clock("approach"):
        grasp, path = approach.grasp, list(approach.path)
        planner = PLANNERS[approach.planner.name]
        inside = _at(q_pick, aim.opening)
        if not approach and options.arm is not None:
            path = way_out(work.solver, _coming_in(work, options), inside, options.arm)[::-1]
            grasp, planner = aim, PLANNERS["Arm"]
    if not path:
        return Carry(
            "approach",
            approach.reason,
            met=lambda: list(_core.find_enclosing(_coming_in(work, options), work.solver, inside)),
        )
    work.given["approach", planner] += 1
    q = path[-1].q
    X_WP = scene.cell.parts[scene.part].X_WB
    X_HP = np.linalg.inv(_core.hand_in_world(scene.cell, q)) @ X_WP

    with work.clock("depart"):
        standing = _core.CollisionChecker(work.model, scene.cell)
        closing = _core.certify_edge(
            standing, path[-1], _at(q, grasp.width + 2 * CLOSING_GAP), options.approach.certificate
        )
        if closing.is_free:
            # All the way: what stands close beside the part must not get between the pads.
            closing = _core.certify_edge(
                _core.CollisionChecker(
                    work.model, scene.cell, _core.Allowance(closed_on=scene.part)
                ),
                path[-1],
                _at(q, grasp.width),
                options.approach.certificate,
            )
        if not closing.is_free:
            text = f"the closing fingers meet {closing.hit.b}"
            return Carry("approach", text, met=lambda: [closing.hit])
        out = _ways_out(work, options)
        depart = _lift(work, scene.cell, _at(q, grasp.width), X_HP, out)
    if not depart:
        held = scene.cell.with_held(scene.part, X_HP)
        return _fell(work, "depart", depart.reason, held, q, grasp.width)
    work.given["depart", depart.planner] += 1

    reasons: list[Carry] = []
    others = _placings(work, pair, grasp, q, X_HP, options, reasons)
    first = next(others, None)
    if first is None:
        return (reasons or [Carry("deposit", "no configuration at the destination")])[-1]
    planners = (planner, depart.planner)
    return Reach(grasp, path, depart.path, planners, X_HP, [first], others)


def _placings(
    work: Workspace,
    pair: _core.RankedPair,
    grasp: _core.GraspPose,
    q: np.ndarray,
    X_HP: np.ndarray,
    options: DirectOptions,
    reasons: list[Carry],
) -> Iterator[Placing]:
    """Ways to put the part down and leave it, the arm nearest to `q` first.

    A straight edge needs no room to start from: deposits that start with more are not looked for.
    """
    scene = work.scene
    goal_cell = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
    for q_place in _nearest_first(work, grasp.q_place, q)[: options.most_places]:
        with work.clock("deposit"):
            out = replace(_ways_out(work, options), roomier=None)
            deposit = _lift(work, goal_cell, _at(q_place, grasp.width), X_HP, out)
        if not deposit:
            held = goal_cell.with_held(scene.part, X_HP)
            reasons.append(_fell(work, "deposit", deposit.reason, held, q_place, grasp.width))
            continue
        work.given["deposit", deposit.planner] += 1
        withdraw = _withdraw(work, goal_cell, grasp, q_place, options)
        if withdraw:
            work.given["withdraw", withdraw.planner] += 1
            planners = deposit.planner, withdraw.planner
            yield Placing(deposit.path[::-1], withdraw.path, planners, not deposit.has_room)
        else:
            reason = withdraw.reason
            reasons.append(_fell(work, "withdraw", reason, goal_cell, q_place, grasp.opening))


def _coming_in(work: Workspace, options: DirectOptions) -> _core.CollisionChecker:
    """Of the open hand as it comes in."""
    if options.approach.destination_obstacles_join:
        return _core.join_destination(work.scene).checker()
    return _core.CollisionChecker(work.model, work.scene.cell)


def _fell(
    work: Workspace, stage: str, reason: str, cell: _core.Cell, q: np.ndarray, opening: float
) -> Carry:
    """A grasp that fell with the hand at `q`; what stands round it is looked for when asked."""

    def met() -> list[_core.Hit]:
        checker = _core.CollisionChecker(work.model, cell)
        return list(_core.find_enclosing(checker, work.solver, _at(q, opening)))

    return Carry(stage, reason, met=met)


def _between(
    checker: _core.CollisionChecker, start: _core.Configuration, goal: _core.Configuration
) -> Callable[[], list[_core.Hit]]:
    """What stands between two configurations."""
    return lambda: list(_core.find_hits_along(checker, start, goal))


def _lift(
    work: Workspace,
    cell: _core.Cell,
    start: _core.Configuration,
    X_HP: np.ndarray,
    out: WaysOut,
) -> Lift:
    return lift(work.model, work.solver, cell, work.scene.part, start, X_HP, out)


def _ways_out(work: Workspace, options: DirectOptions) -> WaysOut:
    arm = options.arm

    def sample(
        checker: _core.CollisionChecker, stop: _core.Configuration
    ) -> list[_core.Configuration]:
        return [] if arm is None else way_out(work.solver, checker, stop, arm)

    return WaysOut(options.retreat, options.departure, options.roomier, sample)


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
        Motion("grasp", [_at(q_pick, grasp.opening), _at(q_pick, grasp.width)]),
        Motion("depart", reach.depart, held=True, planner=reach.planners[1]),
        Motion("transfer", transfer.path, held=True, search=transfer.search),
        Motion("deposit", placing.deposit, held=True, planner=placing.planners[0]),
        Motion("release", [_at(q_place, grasp.width), _at(q_place, opened)]),
        Motion("withdraw", placing.withdraw, planner=placing.planners[1]),
    ]
    end = placing.withdraw[-1]
    if work.home is not None:
        with work.clock("home"):
            goal_cell = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
            checker = _core.CollisionChecker(work.model, goal_cell)
            home = go(checker, end, [_at(work.home, end.opening)], options.gross, work.table)
        if not home:
            met = _between(checker, end, _at(work.home, end.opening))
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
    scene, out = work.scene, _ways_out(work, options)
    goal_cell = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
    for index, placing in enumerate(reach.places):
        if not placing.may_gain:
            continue
        with work.clock("deposit"):
            deposit = _lift(work, goal_cell, placing.deposit[-1], reach.X_HP, out)
        reach.places[index] = replace(placing, may_gain=False)
        if deposit.has_room:
            work.given["deposit", deposit.planner] += 1
            planners = deposit.planner, placing.planners[1]
            reach.places[index] = Placing(deposit.path[::-1], placing.withdraw, planners)


def _goals(reach: Reach) -> list[_core.Configuration]:
    return [placing.deposit[0] for placing in reach.places]


def _nearest_first(work: Workspace, solutions: list[np.ndarray], q: np.ndarray) -> list[np.ndarray]:
    """Order configurations by the travel time of the slowest joint from q."""
    velocity = np.array([joint.limit.velocity for joint in work.scene.cell.robot.joints])
    return sorted(solutions, key=lambda other: float(np.max(np.abs(other - q) / velocity)))


def _withdraw(
    work: Workspace,
    goal_cell: _core.Cell,
    grasp: _core.GraspPose,
    q_place: np.ndarray,
    options: DirectOptions,
) -> Lift:
    """Open the fingers at the destination and draw the hand back."""
    scene = work.scene
    with work.clock("withdraw"):
        checker = _core.CollisionChecker(work.model, goal_cell)
        opened = _at(q_place, grasp.opening)
        opening = _core.certify_edge(
            checker,
            _at(q_place, grasp.width + 2 * CLOSING_GAP),
            opened,
            options.approach.certificate,
        )
        if opening.is_free:
            closed_on = _core.Allowance(closed_on=scene.part)
            opening = _core.certify_edge(
                _core.CollisionChecker(work.model, goal_cell, closed_on),
                _at(q_place, grasp.width),
                opened,
                options.approach.certificate,
            )
        if not opening.is_free:
            return Lift(reason=f"the opening fingers meet {opening.hit.b}")
        return draw_back(checker, work.solver, opened, _ways_out(work, options))
