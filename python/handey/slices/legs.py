"""The gross motions of a plan, each with the world in which it takes place.

A plan says how the robot moves; where the parts are meanwhile follows from the steps before: what
is held moves with the hand, what is released stands where the hand left it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.errors import Fault, InvalidInput
from handey.plan import Plan

__all__ = ["Leg", "legs_of", "standing"]


@dataclass(frozen=True, eq=False)
class Leg:
    """One gross motion.

    Attributes:
        step: index in the plan's steps; -1 where there is no motion.
        action: "transit" or "transfer"; "start" where there is no motion.
        cell: as it is then, with what is held.
        positions: of the arm joints (n, dof) [rad].
        opening: distance between the pads half way [m].
    """

    step: int
    action: str
    cell: _core.Cell
    positions: np.ndarray
    opening: float

    @property
    def held(self) -> str:
        """Name of the held part; empty for none."""
        held = self.cell.held
        return "" if held is None else self.cell.parts[held.part].name


def legs_of(cell_file: CellFile, plan: Plan, file: str = "") -> list[Leg]:
    """The gross motions, in the order of the plan's steps.

    Args:
        cell_file: the cell that the plan is for.
        plan: from the planner or a file.
        file: the plan's file, for faults.

    Raises:
        InvalidInput: E_REF if the plan is of another robot or moves parts that the cell has not.
    """
    _require_fit(cell_file, plan, file)
    cell, legs = cell_file.cell, []
    for index, step in enumerate(plan.steps):
        now = cell
        if step.part is not None and step.part_in_grasp_frame is not None:
            part, X_HP = cell.part_index(step.part), step.part_in_grasp_frame
            now = cell.with_held(part, X_HP)
            cell = cell.with_part_at(part, _core.hand_in_world(cell, step.positions[-1]) @ X_HP)
        if step.action in ("transit", "transfer"):
            opening = float(step.opening[len(step.opening) // 2])
            legs.append(Leg(index, step.action, now, step.positions, opening))
    return legs


def standing(cell_file: CellFile) -> Leg:
    """The robot at its start, for a task that needs no gross motion."""
    start = cell_file.cell.start
    return Leg(-1, "start", cell_file.cell, np.array([start.q]), start.opening)


def _require_fit(cell_file: CellFile, plan: Plan, file: str) -> None:
    joints = [joint.name for joint in cell_file.cell.robot.joints]
    parts = [part.name for part in cell_file.cell.parts]
    faults = []
    if list(plan.joints) != joints:
        faults.append(
            Fault("E_REF", "joints", f"are not those of the robot: {', '.join(joints)}", file)
        )
    for index, step in enumerate(plan.steps):
        if step.part is not None and step.part not in parts:
            known = ", ".join(parts) or "none"
            message = f"the cell has no part '{step.part}'; it has: {known}"
            faults.append(Fault("E_REF", f"steps[{index}].part", message, file))
    if faults:
        raise InvalidInput(faults)
