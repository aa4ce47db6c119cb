"""The last resort of step 4: the whole arm, sampled, from the grasp outwards.

Where neither slide nor search in the grasp plane brings the hand in, the way may lead out of that
plane, or turn the hand about another axis. Poses of the open hand a few centimetres off the grasp
are proposed, on all sides and tilted; those where the robot is free are the goals of a sampled
motion that begins in the grasp; reversed it is the approach. Every edge is certified.
Not guaranteed: that a way that exists is found within the budget. Costs far more than
`_core.plan_approach`; ask only where that has failed, and late.
Article: the "guaranteed methods" to fall back on.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from handey import _core

__all__ = ["ArmApproach", "ArmApproachOptions", "plan_arm_approach"]

# Choice: the hand is turned by this about each axis of the grasp frame, either way [rad].
TILT = 0.5
# Choice: the room that the robot has at a good start, and at any [m].
ROOM, LEAST_ROOM = 0.015, 1e-3


@dataclass(frozen=True)
class ArmApproachOptions:
    """Budgets of one attempt.

    Attributes:
        distances: of the starts from the grasp [m].
        most_goals: starts that the sampling heads for at once.
        ranges: longest edges of the sampled trees, one attempt each; short ones find the way out of
            a narrow place, long ones the way beyond [rad].
        sampling: seed, iterations of each attempt, certificate.
    """

    distances: tuple[float, ...] = (0.10, 0.06)
    most_goals: int = 8
    ranges: tuple[float, ...] = (0.1, 0.4)
    sampling: _core.SamplingOptions = field(
        default_factory=lambda: _core.SamplingOptions(max_iterations=2000)
    )


@dataclass(frozen=True)
class ArmApproach:
    """An approach by the whole arm, or why there is none; true if found.

    Has the fields of `_core.ApproachResult` that a caller needs to go on.

    Attributes:
        grasp: the aim; which of its q_pick was reached is the path's end.
        path: from the start to the grasp, hand open; every edge certified.
        planner: always `ApproachPlanner.Arm`.
        reason: why not found.
    """

    grasp: _core.GraspPose
    path: list[_core.Configuration] = field(default_factory=list)
    planner: _core.ApproachPlanner = _core.ApproachPlanner.Arm
    reason: str = ""

    @property
    def found(self) -> bool:
        """Whether there is a path."""
        return bool(self.path)

    def __bool__(self) -> bool:
        return self.found


def plan_arm_approach(
    scene: _core.GraspScene,
    solver: _core.SphericalWristSolver,
    aim: _core.GraspPose,
    q_pick: np.ndarray,
    options: ArmApproachOptions | None = None,
) -> ArmApproach:
    """Plan how the open hand comes to a grasp, by sampling configurations of the whole arm.

    Args:
        scene: the cell with the part standing and an empty hand, as for `_core.plan_approach`; at a
            destination the cell with the part there, and the reversed path is the withdrawal.
        solver: inverse kinematics of the arm.
        aim: the grasp to reach, open by `aim.opening`.
        q_pick: (joints,) one of the aim's configurations [rad].
        options: budgets.

    Returns:
        An `ArmApproach`.
    """
    options = options or ArmApproachOptions()
    checker = _core.CollisionChecker(scene.model, scene.cell)
    grasp = _core.Configuration(q=q_pick, opening=aim.opening)
    hit = checker.find_hit(grasp)
    if hit is not None:
        return ArmApproach(aim, reason=f"{hit.a} meets {hit.b} in the grasp")
    starts = _starts(scene.cell, solver, checker, grasp, options)
    if not starts:
        return ArmApproach(aim, reason="the arm can stand nowhere near the grasp")
    reason = ""
    for longest in options.ranges:
        sampling = _core.SamplingOptions(
            seed=options.sampling.seed,
            max_iterations=options.sampling.max_iterations,
            range=longest,
            certificate=options.sampling.certificate,
        )
        motion = _core.plan_by_sampling(checker, grasp, starts, sampling)
        if motion.found:
            outwards = _core.shorten_path(
                checker, motion.path, _core.ShortcutOptions(seed=sampling.seed)
            )
            return ArmApproach(aim, list(outwards)[::-1])
        reason = motion.reason
    return ArmApproach(aim, reason=f"the whole arm, sampled: {reason}")


def _starts(
    cell: _core.Cell,
    solver: _core.SphericalWristSolver,
    checker: _core.CollisionChecker,
    grasp: _core.Configuration,
    options: ArmApproachOptions,
) -> list[_core.Configuration]:
    """Free configurations off the grasp, one for each place of the hand: with room if there are."""
    velocity = np.array([joint.limit.velocity for joint in cell.robot.joints])
    X_RW = np.linalg.inv(cell.X_WR)
    proposals: list[tuple[float, int, _core.Configuration]] = []
    for place, X_WH in _hand_poses(_core.hand_in_world(cell, grasp.q), options.distances):
        for solution in solver.solve(X_RW @ X_WH, grasp.q).solutions:
            travel = float(np.max(np.abs(solution.q - grasp.q) / velocity))
            start = _core.Configuration(q=solution.q, opening=grasp.opening)
            proposals.append((travel, place, start))
    proposals.sort(key=lambda proposal: proposal[:2])
    starts: list[_core.Configuration] = []
    taken: set[int] = set()
    for room in (ROOM, LEAST_ROOM):
        for _, place, start in proposals:
            if len(starts) == options.most_goals:
                return starts
            if place not in taken and checker.is_free(start, room):
                taken.add(place)
                starts.append(start)
    return starts


def _hand_poses(X_WH: np.ndarray, distances: tuple[float, ...]) -> Iterator[tuple[int, np.ndarray]]:
    """Places off a hand pose (back, aside, upwards), each with the hand turned some ways."""
    up = X_WH[:3, :3].T @ np.array([0.0, 0.0, 1.0])
    corners = [np.array([x, y, -1.0]) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    sides = [np.array([x, y, 0.0]) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    turns = [np.eye(3), *(_turn(axis, a) for axis in range(3) for a in (TILT, -TILT))]
    for place, (direction, distance) in enumerate(product([up, *corners, *sides], distances)):
        for turn in turns:
            X_HS = np.eye(4)
            X_HS[:3, :3] = turn
            X_HS[:3, 3] = distance * direction / np.linalg.norm(direction)
            yield place, X_WH @ X_HS


def _turn(axis: int, angle: float) -> np.ndarray:
    """Rotation about a coordinate axis, (3, 3)."""
    first, second = [i for i in range(3) if i != axis]
    turn = np.eye(3)
    turn[first, first] = turn[second, second] = np.cos(angle)
    turn[first, second], turn[second, first] = -np.sin(angle), np.sin(angle)
    return turn
