"""The failed goal as advice sees it: where the part stands and goes, what carries it, what is near.

Which bodies are blamed, and at which end, is told by the typed reasons of the goal's report; where
there are none, by what is near to the ends.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.placement import TOUCHING, examine_standing
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason
from handey.task import Goal, PlaceAt

__all__ = ["Blame", "Situation"]

ENDS = ("origin", "destination")
# Choice: of many hand poses some miss by as little; that is no cause [m, rad].
LEAST_MISSED = {"out_of_reach": 1e-3, "joint_limit": 0.02}
SAME_FACE = 0.98  # Choice: cosine between what is up at both ends of a part not turned over
NEAR = 0.12  # Choice: what is so near to the part may be in the hand's way [m]


@dataclass(frozen=True)
class Blame:
    """A fixture or part that may be in the way, and at which end it was met."""

    name: str
    end: str = ""
    weight: float = 0.0


@dataclass(frozen=True)
class Situation:
    """One failed goal of a cell.

    Attributes:
        cell_file: as it is.
        index: of the goal in the task.
        report: of the goal.
        model: collision geometry of the cell.
    """

    cell_file: CellFile
    index: int
    report: GoalReport
    model: _core.CollisionModel = field(repr=False)

    @property
    def file(self) -> str:
        """Path of the cell file."""
        return self.cell_file.entry.document.file

    @property
    def content(self) -> dict[str, Any]:
        """Of the cell file."""
        value: dict[str, Any] = self.cell_file.entry.document.value
        return value

    @property
    def goal(self) -> Goal:
        """That failed."""
        return self.cell_file.goals[self.index]

    @cached_property
    def cell(self) -> _core.Cell:
        """With the parts where the goals before this one have put them, as far as these say."""
        cell = self.cell_file.cell
        if not self.cell_file.task.any_order:
            for goal in self.cell_file.goals[: self.index]:
                if isinstance(goal, PlaceAt):
                    cell = cell.with_part_at(cell.part_index(goal.part), goal.X_WP)
        return cell

    @cached_property
    def part(self) -> int:
        """Index of the part to be moved."""
        return self.cell.part_index(self.goal.part)

    @cached_property
    def robot_at(self) -> np.ndarray:
        """The robot's base in the world (3,) [m]."""
        return np.asarray(self.cell.X_WR[:3, 3])

    @cached_property
    def centre(self) -> np.ndarray:
        """Of mass, in the part (3,) [m]."""
        return np.asarray(_core.centre_of_mass(self.cell.parts[self.part]))

    @cached_property
    def ends(self) -> dict[str, np.ndarray]:
        """Poses of the part (4, 4) where it is and where it is to go, as far as known."""
        found = {"origin": np.asarray(self.cell.parts[self.part].X_WB)}
        if isinstance(self.goal, PlaceAt):
            found["destination"] = self.goal.X_WP
        return found

    def middle(self, end: str) -> np.ndarray:
        """The part's centre of mass at an end (3,) [m]."""
        X_WP = self.ends.get(end, self.ends["origin"])
        return np.asarray(X_WP[:3, :3] @ self.centre + X_WP[:3, 3])

    @cached_property
    def loads(self) -> dict[str, list[tuple[str, int]]]:
        """What each body carries: parts, with the goal at which it does; -1 for the start."""
        cell = self.cell_file.cell
        found: dict[str, list[tuple[str, int]]] = {}
        standing = [(i, -1, np.asarray(part.X_WB)) for i, part in enumerate(cell.parts)]
        for index, goal in enumerate(self.cell_file.goals):
            if isinstance(goal, PlaceAt):
                standing.append((cell.part_index(goal.part), index, goal.X_WP))
            else:
                found.setdefault(goal.fixture, []).append((goal.part, index))
        for part, index, X_WP in standing:
            there = cell.with_part_at(part, X_WP)
            near = _core.touching_bodies(self.model, there, part, TOUCHING)
            for name in examine_standing(there, part, X_WP, near).on:
                found.setdefault(name, []).append((cell.parts[part].name, index))
        return found

    @cached_property
    def pile(self) -> list[str]:
        """Parts that stand on the goal's part at the start, and on these, that may not move."""
        found, waiting = [], [self.goal.part]
        while waiting:
            for name, goal in self.loads.get(waiting.pop(), []):
                if goal < 0 and name not in found:
                    found.append(name)
                    waiting.append(name)
        may = {part.name for part in self.cell.parts if part.may_move}
        return [name for name in found if name not in may]

    @cached_property
    def boxes(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Least and greatest corner in the world of each fixture and part [m]."""
        found = {}
        for body in [*self.cell.fixtures, *self.cell.parts]:
            if not body.shapes:
                continue
            points = np.vstack([_core.hull_points(shape) for shape in body.shapes])
            points = points @ body.X_WB[:3, :3].T + body.X_WB[:3, 3]
            found[body.name] = points.min(axis=0), points.max(axis=0)
        return found

    @cached_property
    def reasons(self) -> list[Reason]:
        """Typed: the cause, then the others, most frequent first."""
        others = [reason for stage in self.report.stages for reason in stage.reasons]
        others.sort(key=lambda reason: -reason.count)
        cause = [] if self.report.cause is None else [self.report.cause]
        found = cause + [reason for reason in others if reason not in cause]
        return sorted(found, key=self._is_beside_the_point)

    def _is_beside_the_point(self, reason: Reason) -> bool:
        """Is it of the end at which grasps are legal, or missed by next to nothing?"""
        if reason.proved:
            return False
        by_nothing = LEAST_MISSED.get(reason.kind)
        is_near = by_nothing is not None and reason.by is not None and reason.by < by_nothing
        return is_near or (reason.end in ENDS and reason.end not in self.ends_at_fault)

    @cached_property
    def ends_at_fault(self) -> list[str]:
        """Where grasps fall: one end, if grasps are legal at the other alone."""
        told = {end: self.report.counts.get(f"legal at the {end}") for end in ENDS}
        if not any(told.values()):
            return list(ENDS)
        return [end for end in ENDS if not told[end]] or list(ENDS)

    @cached_property
    def blamed(self) -> list[Blame]:
        """Fixtures and parts that may be in the way, the likeliest first."""
        weights: dict[tuple[str, str], float] = {}
        for order, reason in enumerate(self.reasons):
            for place, name in enumerate(reason.bodies):
                key = name, reason.end
                weights[key] = weights.get(key, 0.0) + 10.0 / (1 + order) / (1 + place)
        for end, X_WP in self.ends.items():
            there = self.cell.with_part_at(self.part, X_WP)
            for ref in _core.touching_bodies(self.model, there, self.part, NEAR):
                key = there.body(ref).name, end
                weights[key] = weights.get(key, 0.0) + 1.0
        for name in self.boxes:
            if not any(name == known for known, _ in weights):
                weights[name, ""] = 0.1
        known = set(self.boxes) - {self.goal.part}
        found = [Blame(name, end, w) for (name, end), w in weights.items() if name in known]
        return sorted(found, key=lambda blame: -blame.weight)

    def goals_before(self, names: list[str]) -> list[int]:
        """Earlier goals, in a given order, that move bodies of these names; of each the last."""
        if self.cell_file.task.any_order:
            return []
        last = {goal.part: i for i, goal in enumerate(self.cell_file.goals[: self.index])}
        return [last[name] for name in names if name in last and name != self.goal.part]

    @property
    def wants_regrasp(self) -> bool:
        """Would it help to put the part down on the way?

        So it may where it is to stand on another face, or where grasps are legal at each end, but
        none at both, and nothing is a support.
        """
        legal = [self.report.counts.get(f"legal at the {end}", 0) for end in ENDS]
        supports = [body for body in [*self.cell.fixtures, *self.cell.parts] if body.support]
        return self.is_turned_over or (min(legal) > 0 and not supports)

    @cached_property
    def is_turned_over(self) -> bool:
        """Is the part to stand on another face than now?"""
        upward = [X_WP[2, :3] for X_WP in self.ends.values()]
        return float(upward[0] @ upward[-1]) < SAME_FACE

    def bulk(self, name: str) -> float:
        """Volume of a body's box [m3]."""
        low, high = self.boxes[name]
        return float(np.prod(high - low))

    def is_part(self, name: str) -> bool:
        """Is it a part, not a fixture?"""
        return any(part.name == name for part in self.cell.parts)

    def is_measured(self, name: str) -> bool:
        """Is it a depth map?"""
        return any(entry.name == name for entry in self.cell_file.depth_maps)
