"""Is there certainly no plan?

A goal can be proved to be out of the question without a search: the part is wider than the jaws
open, or so far away that no hand pose lets the jaws close on it. Where the first grasps that are
looked at are illegal, all hand poses on all of its feature pairs may be proved so at its start or
at its goal alone: no regrasp helps then. Where motions fail, the part may be proved to be shut in
at either, or the arm to be walled off from it. Bodies that handey may move are no obstacles here,
so a proof of one goal holds in whatever order the goals are reached: the task is infeasible.
Not guaranteed: a proof where there is no plan. What is proved is so at the resolution that is told.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.planning.goal_places import is_met
from handey.planning.jaws import wider_than_jaws
from handey.reporting.reasons import Reason
from handey.reporting.wording import plain
from handey.task import PlaceAt

__all__ = ["Proof", "Proofs", "Proved"]

ENDS = ("origin", "destination")
MOST_CAUSES = 4  # Choice: that are told of illegal hand poses
MOST_CELLS = 12000  # Choice: of the first three joints, looked at for a wall: 0.1 s
FAR_AWAY = 50.0  # under the cell, out of the way [m]


@dataclass(frozen=True)
class Proof:
    """Why a goal certainly cannot be reached.

    Attributes:
        text: what is proved, at which resolution.
        cause: the same as a typed reason; None: the funnel of the grasps tells it best.
    """

    text: str
    cause: Reason | None = None


class Proved(Exception):
    """Planning ends: a goal was proved to be infeasible."""

    def __init__(self, goal: int, proof: Proof) -> None:
        super().__init__(proof.text)
        self.goal, self.proof = goal, proof


@dataclass
class Proofs:
    """Proofs for the goals of one cell.

    Attributes:
        cell_file: the cell at the start, and its task.
        model: collision geometry of the cell.
        solver: inverse kinematics of the arm.
    """

    cell_file: CellFile
    model: _core.CollisionModel
    solver: _core.SphericalWristSolver
    _exhausted: dict[tuple[object, ...], _core.Exhaustion] = field(default_factory=dict)
    _walled: dict[tuple[object, ...], _core.WalledOff] = field(default_factory=dict)
    _shut: dict[int, _core.ShutIn] = field(default_factory=dict)

    def at_once(self) -> Proved | None:
        """What needs no search, of the first goal of which it can be said."""
        for index in range(len(self.cell_file.goals)):
            if not self._must_move(index):
                continue
            proof = next(iter(self._plain(index)), None)
            if proof is not None:
                return Proved(index, proof)
        return None

    def all_of(self, index: int) -> list[Proof]:
        """All that can be proved of a goal."""
        if not self._must_move(index):
            return []
        found = (self.no_grasp(index), self.shut_in(index), self.no_way(index))
        return [*self._plain(index), *(proof for proof in found if proof is not None)]

    def _plain(self, index: int) -> list[Proof]:
        """What needs no search."""
        part = self._part(self.cell_file.goals[index].part)
        found = (
            self._too_wide(part),
            self._out_of_reach(index, part),
            self._rests_in_goal(index, part),
        )
        return [proof for proof in found if proof is not None]

    def _must_move(self, index: int) -> bool:
        """Is the part not yet where the goal wants it?"""
        cell = self.cell_file.cell
        return not is_met(self.cell_file.goals[index], cell, self.model, cell)

    def _part(self, name: str) -> _core.Body:
        cell = self.cell_file.cell
        return cell.parts[cell.part_index(name)]

    def no_grasp(self, index: int) -> Proof | None:
        """No hand pose is legal where the part must be held to reach a goal."""
        if not self._must_move(index):
            return None
        ends = list(self.ends(index))
        for end, X_WP in ends:
            found = self._exhaust(index, [X_WP])
            if found:
                return self._no_legal_pose(index, f"at the {end}", found)
        if len(ends) == 2 and not self._can_regrasp(index):
            found = self._exhaust(index, [X_WP for _, X_WP in ends])
            if found:
                where = "at both ends, and there is no support to regrasp it on"
                proof = self._no_legal_pose(index, where, found)
                name = self.cell_file.goals[index].part
                text = f"no grasp serves both ends, and there is no support to put {name} down on"
                return replace(proof, cause=Reason("no_regrasp", "connected", text))
        return None

    def no_way(self, index: int) -> Proof | None:
        """The arm does not come to where the part must be held to reach a goal."""
        if not self._must_move(index):
            return None
        cell, name = self.cell_file.cell, self.cell_file.goals[index].part
        for end, X_WP in self.ends(index):
            key = (name, X_WP.tobytes())
            if key not in self._walled:
                self._walled[key] = _core.prove_walled_off(
                    _core.CollisionChecker(self.model, self._unmoved),
                    cell.start,
                    self.solver,
                    self._part(name),
                    np.linalg.inv(cell.X_WR) @ X_WP,
                    _core.SeparationOptions(most_cells=MOST_CELLS),
                )
            found = self._walled[key]
            if found:
                return _no_way(name, end, found)
        return None

    def shut_in(self, index: int) -> Proof | None:
        """The part does not come to its goal, whoever carries it."""
        ends = [X_WP for _, X_WP in self.ends(index)]
        if len(ends) < 2 or not self._must_move(index):
            return None
        name, X_RW = self.cell_file.goals[index].part, np.linalg.inv(self.cell_file.cell.X_WR)
        if index not in self._shut:
            part = self.cell_file.cell.part_index(name)
            held = self._unmoved.with_held(part, np.eye(4))
            self._shut[index] = _core.prove_shut_in(
                _core.CollisionChecker(self.model, held), X_RW @ ends[0], X_RW @ ends[1]
            )
        found = self._shut[index]
        return _shut_in(name, found) if found else None

    def _no_legal_pose(self, index: int, where: str, found: _core.Exhaustion) -> Proof:
        part = self.cell_file.goals[index].part
        if not found.pairs:
            return Proof(f"no grasp: {part} has no two features that the jaws could hold it by")
        resolution = "proved throughout"
        if found.spacing > 0.0:
            turn = math.degrees(found.turn)
            resolution = f"at a resolution of {1e3 * found.spacing:g} mm and {turn:.3g} degrees"
        robot = self.cell_file.cell.robot
        hand = robot.bodies[robot.gripper.body].name
        causes = ", ".join(_told(cause, hand) for cause in found.causes[:MOST_CAUSES])
        return Proof(
            f"no grasp: of {found.pairs} feature pairs of {part}, no hand pose is legal {where}, "
            f"{resolution}: {causes}"
        )

    def _exhaust(self, index: int, places: Sequence[np.ndarray]) -> _core.Exhaustion:
        part = self.cell_file.cell.part_index(self.cell_file.goals[index].part)
        key = (part, *(X_WP.tobytes() for X_WP in places))
        if key not in self._exhausted:
            self._exhausted[key] = _core.exhaust_grasps(
                self.model, self._unmoved, part, places, self.solver
            )
        return self._exhausted[key]

    @cached_property
    def _unmoved(self) -> _core.Cell:
        """The cell without the parts that may be moved, which are put far away."""
        cell = self.cell_file.cell
        with_goal = {goal.part for goal in self.cell_file.goals}
        for index, part in enumerate(cell.parts):
            if part.may_move or part.name in with_goal:
                away = part.X_WB.copy()
                away[2, 3] -= FAR_AWAY * (index + 1)
                cell = cell.with_part_at(index, away)
        return cell

    def _can_regrasp(self, index: int) -> bool:
        """May the part be let go on its way from its start to its goal?"""
        name, cell = self.cell_file.goals[index].part, self.cell_file.cell
        others = [*cell.fixtures, *(part for part in cell.parts if part.name != name)]
        goals = [goal for goal in self.cell_file.goals if goal.part == name]
        return len(goals) > 1 or any(body.support for body in others)

    def ends(self, index: int) -> Iterator[tuple[str, np.ndarray]]:
        """Where the part of a goal must be held, whatever else is done: its start, its goal."""
        goal = self.cell_file.goals[index]
        yield ENDS[0], self._part(goal.part).X_WB
        if isinstance(goal, PlaceAt):
            yield ENDS[1], goal.X_WP

    def _too_wide(self, part: _core.Body) -> Proof | None:
        gripper = self.cell_file.cell.robot.gripper
        lack = wider_than_jaws(part, gripper)
        if lack <= 0.0:
            return None
        width, opening = gripper.max_opening + lack, gripper.max_opening
        return Proof(
            f"no grasp: {part.name} is convex and holds a ball of {1e3 * width:.1f} mm, the jaws "
            f"open {1e3 * opening:.1f} mm"
        )

    def _rests_in_goal(self, index: int, part: _core.Body) -> Proof | None:
        """The arm returns to its start, and that is where the part must be in the end."""
        goals, cell = self.cell_file.goals, self.cell_file.cell
        goal = goals[index]
        is_last = all(other.part != goal.part for other in goals[index + 1 :])
        if not (self.cell_file.task.return_to_start and is_last and isinstance(goal, PlaceAt)):
            return None
        there = self._unmoved.with_part_at(cell.part_index(goal.part), goal.X_WP)
        checker = _core.CollisionChecker(self.model, there)
        fingers = {cell.robot.bodies[finger.child].name for finger in cell.robot.gripper.fingers}
        for hit in _core.robot_overlaps(checker, cell.start):
            # The fingers may come to rest at another opening.
            if hit.a not in fingers and hit.b == part.name:
                return _rests_in(part.name, hit)
        return None

    def _out_of_reach(self, index: int, part: _core.Body) -> Proof | None:
        cell = self.cell_file.cell
        X_RW = np.linalg.inv(cell.X_WR)
        for end, X_WP in self.ends(index):
            lack = _core.beyond_reach(self.solver, cell.robot.gripper, part, X_RW @ X_WP)
            if lack > 0.0:
                return _too_far(part.name, end, lack)
        return None


def _too_far(part: str, end: str, lack: float) -> Proof:
    text = f"{part} is {1e3 * lack:.0f} mm beyond the arm's reach at the {end}, whatever the grasp"
    cause = Reason("out_of_reach", "reachable", text, end=end, by=lack, proved=True)
    return Proof(f"no grasp: {text}", cause)


def _rests_in(part: str, hit: _core.Hit) -> Proof:
    mover, depth = plain(hit.a), -hit.distance
    text = (
        f"the arm is to return to its start, where {mover} is {1e3 * depth:.1f} mm deep in {part}"
    )
    text += " at its goal"
    bodies = (part,)
    cause = Reason(
        "home", "connected", text, end="destination", bodies=bodies, mover=hit.a, by=depth
    )
    return Proof(text, replace(cause, proved=True))


def _no_way(part: str, end: str, found: _core.WalledOff) -> Proof:
    if not found.within_limits:
        text = f"no configuration within the limits of joints 1 to 3 brings the hand to {part}"
        cause = Reason("joint_limit", "reachable", f"{text} at the {end}", end=end, proved=True)
        return Proof(f"no grasp: {text} at the {end}", cause)
    bodies = ", ".join(plain(name) for name in found.bodies[:MOST_CAUSES]) or "the joints' limits"
    movers = ", ".join(plain(name) for name in found.movers[:MOST_CAUSES])
    passing = f" ({movers} cannot pass)" if movers else ""
    text = f"the arm is walled off from {part} at the {end}: {bodies}{passing}"
    degrees = math.degrees(found.resolution)
    kind = "transit" if end == ENDS[0] else "transfer"
    cause = Reason(
        kind, "connected", text, end=end, bodies=tuple(found.bodies[:MOST_CAUSES]), proved=True
    )
    return Proof(f"no way: {text}, by cells of {degrees:.2g} degrees of joints 1 to 3", cause)


def _shut_in(part: str, found: _core.ShutIn) -> Proof:
    bodies = tuple(found.bodies[:MOST_CAUSES])
    end, way = ENDS[found.end], ("out", "in")[found.end]
    about = ", ".join(plain(name) for name in bodies)
    text = f"{part} does not come {way} at the {end}: {about}"
    width, edge = 2e3 * found.radius, 1e3 * found.resolution
    how = f"nowhere a ball of {width:.1f} mm passes, which the part holds, by cubes of {edge:g} mm"
    cause = Reason("transfer", "connected", f"{text}; {how}", end=end, bodies=bodies, proved=True)
    return Proof(f"no way: {text}; {how}", cause)


def _told(cause: _core.IllegalCause, hand: str) -> str:
    share = f"{100 * cause.share:.0f} %"
    if cause.kind == _core.IllegalKind.OutOfReach:
        return f"{share} out of reach"
    if cause.kind == _core.IllegalKind.JointLimit:
        return f"{share} past a limit of joint {cause.joint + 1}"
    mover = "hand" if cause.mover == hand else plain(cause.mover)
    return f"{share} {mover} in {plain(cause.other)}"
