"""Is there certainly no plan?

A goal can be proved to be out of the question without a search: the part is wider than the jaws
open, or so far away that no hand pose lets the jaws close on it. Bodies that handey may move are no
obstacles here, so a proof of one goal holds in whatever order the goals are reached: the task is
infeasible.
Not guaranteed: a proof where there is no plan. What is proved is so at the resolution that is told.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.goal_places import is_met
from handey.jaws import wider_than_jaws
from handey.reasons import Reason
from handey.task import PlaceAt

__all__ = ["Proof", "Proofs", "Proved"]

ENDS = ("origin", "destination")


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


@dataclass(frozen=True)
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

    def at_once(self) -> Proved | None:
        """What needs no search, of the first goal of which it can be said."""
        for index, goal in enumerate(self.cell_file.goals):
            if not self._must_move(index):
                continue
            part = self._part(goal.part)
            proof = self._too_wide(part) or self._out_of_reach(index, part)
            if proof is not None:
                return Proved(index, proof)
        return None

    def _must_move(self, index: int) -> bool:
        """Is the part not yet where the goal wants it?"""
        cell = self.cell_file.cell
        return not is_met(self.cell_file.goals[index], cell, self.model, cell)

    def _part(self, name: str) -> _core.Body:
        cell = self.cell_file.cell
        return cell.parts[cell.part_index(name)]

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
