"""The motions near obstacles of one grasp: in to the part, off with it, down with it, and away.

Given a grasp pose that is legal at both ends, the approach is planned first (the article's step 4),
then the departure, then ways to put the part down and leave it, one after the other as they are
asked for. Every motion that leaves here was certified edge by edge by the core, under the contacts
that the step allows.
Not guaranteed: a grasp given up here may still be feasible; the reason tells where it fell.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from handey import _core
from handey.motion.carry import Carry, DirectOptions, Workspace, at
from handey.motion.lift import PLANNERS, Lift, WaysOut, draw_back, lift
from handey.motion.way_out import way_out

__all__ = ["Placing", "Reach", "find_approach", "find_reach", "lift_held", "ways_out"]

# Choice: the pads are certified up to this far from the faces, each side; the last stretch is the
# contact itself [m].
CLOSING_GAP = 3e-4


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
        inside = at(q_pick, aim.opening)
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
        closing = _moved_fingers(work, standing, scene.cell, path[-1], grasp.width, options)
        if not closing.is_free:
            text = f"the closing fingers meet {closing.hit.b}"
            return Carry("approach", text, met=lambda: [closing.hit])
        out = ways_out(work, options)
        depart = lift_held(work, scene.cell, at(q, grasp.width), X_HP, out)
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
            out = replace(ways_out(work, options), roomier=None)
            deposit = lift_held(work, goal_cell, at(q_place, grasp.width), X_HP, out)
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
        return list(_core.find_enclosing(checker, work.solver, at(q, opening)))

    return Carry(stage, reason, met=met)


def _withdraw(
    work: Workspace,
    goal_cell: _core.Cell,
    grasp: _core.GraspPose,
    q_place: np.ndarray,
    options: DirectOptions,
) -> Lift:
    """Open the fingers at the destination and draw the hand back."""
    with work.clock("withdraw"):
        checker = _core.CollisionChecker(work.model, goal_cell)
        opened = at(q_place, grasp.opening)
        opening = _moved_fingers(work, checker, goal_cell, opened, grasp.width, options, opens=True)
        if not opening.is_free:
            return Lift(reason=f"the opening fingers meet {opening.hit.b}")
        return draw_back(checker, work.solver, opened, ways_out(work, options))


def _moved_fingers(
    work: Workspace,
    checker: _core.CollisionChecker,
    cell: _core.Cell,
    opened: _core.Configuration,
    width: float,
    options: DirectOptions,
    *,
    opens: bool = False,
) -> _core.EdgeResult:
    """The edge between the open hand and the pads on the part, which they meet at its end alone.

    Once more all the way, where contact is no hit: what stands close beside the part must not get
    between the pads.
    """

    def certify(checker: _core.CollisionChecker, opening: float) -> _core.EdgeResult:
        near = at(opened.q, opening)
        ends = (near, opened) if opens else (opened, near)
        return _core.certify_edge(checker, *ends, options.approach.certificate)

    found = certify(checker, width + 2 * CLOSING_GAP)
    if found.is_free:
        closed_on = _core.Allowance(closed_on=work.scene.part)
        found = certify(_core.CollisionChecker(work.model, cell, closed_on), width)
    return found


def _nearest_first(work: Workspace, solutions: list[np.ndarray], q: np.ndarray) -> list[np.ndarray]:
    """Order configurations by the travel time of the slowest joint from q."""
    velocity = np.array([joint.limit.velocity for joint in work.scene.cell.robot.joints])
    return sorted(solutions, key=lambda other: float(np.max(np.abs(other - q) / velocity)))


def lift_held(
    work: Workspace,
    cell: _core.Cell,
    start: _core.Configuration,
    X_HP: np.ndarray,
    out: WaysOut,
) -> Lift:
    """The held part leaves what it stands on, from `start`."""
    return lift(work.model, work.solver, cell, work.scene.part, start, X_HP, out)


def ways_out(work: Workspace, options: DirectOptions) -> WaysOut:
    """How far a hand goes out, and by which planners."""
    arm = options.arm

    def sample(
        checker: _core.CollisionChecker, stop: _core.Configuration
    ) -> list[_core.Configuration]:
        return [] if arm is None else way_out(work.solver, checker, stop, arm)

    return WaysOut(options.retreat, options.departure, options.roomier, sample)
