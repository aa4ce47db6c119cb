"""The moves of a plan, one after the other, as steps with times."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.motion.carry import Carry, Motion
from handey.plan import Step
from handey.planning.state import Move
from handey.reporting.report import GrossMotion, LocalMotion, Report

__all__ = ["TimedSteps"]


@dataclass
class TimedSteps:
    """The steps so far, and where they bring the parts.

    Attributes:
        cell: after them.
        clock: when they end [s].
        steps: in order.
    """

    cell: _core.Cell
    clock: float = 0.0
    steps: list[Step] = field(default_factory=list)

    def append(self, move: Move, report: Report) -> None:
        """Time the motions of a move; tell the report which planners gave them."""
        carry, target = move.carry, move.target
        report.regrasps += carry.regrasps
        for motion in carry.motions:
            self._tell(motion, move.goal, report)
            timed = _core.time_path(self.cell.robot, motion.path)
            self.steps.append(
                Step(
                    action=motion.action,
                    goal=move.goal,
                    part=target.part if motion.held else None,
                    part_in_grasp_frame=_held_at(motion, carry),
                    time=self.clock + np.array(timed.time),
                    positions=np.array([c.q for c in timed.configurations]),
                    opening=np.array([c.opening for c in timed.configurations]),
                )
            )
            self.clock += timed.duration
        self.cell = self.cell.with_part_at(self.cell.part_index(target.part), target.X_WP)

    def placements(self) -> dict[str, np.ndarray]:
        """Where each part that was moved stands in the end, be it where it stood at first."""
        moved = {step.part for step in self.steps}
        return {part.name: part.X_WB for part in self.cell.parts if part.name in moved}

    def _tell(self, motion: Motion, goal: int, report: Report) -> None:
        step = len(self.steps)
        if motion.search is not None:
            report.gross_motions.append(GrossMotion(step, goal, motion.action, motion.search))
        if motion.planner:
            report.local_motions.append(LocalMotion(step, goal, motion.action, motion.planner))


def _held_at(motion: Motion, carry: Carry) -> np.ndarray | None:
    if not motion.held:
        return None
    return carry.X_HP if motion.X_HP is None else motion.X_HP
