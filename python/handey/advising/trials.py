"""Does the goal plan with a change? Tried by planning with it, in memory, until the time is over.

A trial is short: little effort, and a bound of its own. What is told as advice was planned so, and
is read as the files would be with it; then it is planned with all that the options allow, as far as
the time goes. Not guaranteed: that a change fails for good which failed here.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from handey import _core
from handey.advising.change import Change, edited, with_edits
from handey.advising.situation import Situation
from handey.cell.assembly import assemble, assemble_like
from handey.cell.refusals import find_refusals
from handey.cell_file import CellFile, read_document
from handey.errors import InvalidInput
from handey.formats.strict_yaml import Document
from handey.placement import examine_standing
from handey.planning.budgets import by_slides
from handey.planning.plan_options import PlanOptions
from handey.task import PlaceAt

__all__ = ["Planner", "Trials"]

LONGEST = 0.25  # Choice: of one trial, in shares of `advice_seconds`
# Choice: of a trial in which the part may be put down on the way, or others are moved too
LONG = 1.0
HALF = 0.5  # Choice: of a trial of another order, which is tried with all effort
MORE_MOVES = ("may move", "earlier goal")


MOVING = ("part moved", "part shifted", "part turned", "fixture moved")
INTRICATE = 200  # Choice: triangles of the parts


class Planner(Protocol):
    """Plans a cell: `handey.planner.plan`."""

    def __call__(self, cell_file: CellFile, options: PlanOptions) -> Any:
        """Its result, with a plan or without."""


def little(options: PlanOptions, effort: int, regrasps: bool) -> PlanOptions:
    """Options of a trial: what needs much searching is given up.

    Args:
        options: of the plan that failed.
        effort: 0: one pass over the grasps; 1: one more, of more grasps; 2: all but the proofs.
        regrasps: the part may be put down on the way.
    """
    if effort > 1:
        return replace(options, advice=False, diagnosis=False, prove=False, thorough=False)
    most = min(options.regrasp.most_regrasps, 2) if regrasps else 0
    regrasp = replace(
        options.regrasp,
        most_regrasps=most,
        samples=options.regrasp.samples[:1],
        sequences=(10,),
    )
    return replace(
        options,
        advice=False,
        diagnosis=False,
        deadline=None,
        direct=by_slides(options.direct),
        denser=options.denser[:effort],
        sampling_rounds=options.sampling_rounds[: 1 + effort],
        most_by_arm=0,
        thorough=False,
        prove=False,
        regrasp=regrasp,
    )


@dataclass
class Trials:
    """Tries changes of one cell.

    Attributes:
        here: the goal that failed.
        options: of the plan that failed.
        planner: plans a changed cell.
        end: on the clock of `time.thread_time`; no trial goes on after it.
        slowness: seconds on the wall's clock in which the thread gets one; a deadline is longer by
            that, so that other work on the machine changes little.
        count: trials so far.
    """

    here: Situation
    options: PlanOptions
    planner: Planner
    end: float
    slowness: Callable[[], float] = lambda: 1.0
    count: int = 0

    @property
    def left(self) -> float:
        """CPU time of this thread until the end [s]."""
        return self.end - time.thread_time()

    def plans(self, change: Change, effort: int = 0) -> bool:
        """Does the goal plan with the change, with little effort?"""
        cell = self._changed(change)
        if cell is None:
            return False
        regrasps = change.regrasps or self.here.is_turned_over
        longest = LONG if regrasps or change.kind in MORE_MOVES else LONGEST
        longest = HALF if effort > 1 else longest
        options = replace(
            little(self.options, effort, regrasps),
            deadline=self._deadline(min(longest * self.options.advice_seconds, self.left)),
        )
        self.count += 1
        return self.planner(cell, options).plan is not None

    def _deadline(self, seconds: float) -> float:
        """On the wall's clock, for so much CPU time [s]."""
        return max(1e-3, seconds * self.slowness())

    def read(self, change: Change) -> CellFile | None:
        """The cell as its files would be read with the change; None if it would be refused."""
        entry = self.here.cell_file.entry
        try:
            content = with_edits(entry.document.value, self._of_cell(change))
            read = read_document(Document(entry.document.file, entry.document.folder, content))
            cell = assemble(read, change.robot)
            if len(cell.warnings) > len(self.here.cell_file.warnings):
                return None  # something would not stand
            cut = self._cut(content, len(entry.document.value["task"]))
            read = read_document(Document(entry.document.file, entry.document.folder, cut))
        except InvalidInput:
            return None
        return replace(cell, task=read.task, entry=read)

    def is_refuted(self, cell: CellFile) -> bool:
        """Does it not plan with all effort, in the time that is left?"""
        if self.left <= 0:
            return False
        deadline = self._deadline(self.left)
        options = replace(self.options, advice=False, diagnosis=False, deadline=deadline)
        result = self.planner(cell, options)
        return result.plan is None and not result.report.stopped

    def _of_cell(self, change: Change) -> list[Any]:
        return [edit for edit in change.edits if edit.file == self.here.file]

    def _changed(self, change: Change) -> CellFile | None:
        """The cell with a change, as far as the failed goal; None where that cannot be."""
        document = self.here.cell_file.entry.document
        content = with_edits(document.value, self._of_cell(change))
        measured = set(content.get("depth_maps") or {})
        content = edited(self._cut(content, len(document.value["task"])), "depth_maps", None)
        try:
            entry = read_document(Document(document.file, document.folder, content))
            cell = assemble_like(entry, self.here.cell_file, measured, change.robot)
        except InvalidInput:
            return None
        model = _core.make_collision_model(cell.cell, self.here.model)
        cell = replace(cell, model=model)
        if self._is_intricate:
            return cell if self._contacts(cell, model) <= self._known_contacts else None
        if find_refusals(entry, cell.cell, model):
            return None
        return None if self._falls(change, cell) else cell

    def _falls(self, change: Change, cell: CellFile) -> bool:
        """Does a part that the change moves stand on nothing?"""
        parts = cell.cell.parts if change.kind in MOVING else []
        return any(
            not examine_standing(cell.cell, index, np.asarray(part.X_WB)).stable
            for index, part in enumerate(parts)
            if any(edit.place.startswith(f"parts.{part.name}.") for edit in change.edits)
        )

    @cached_property
    def _is_intricate(self) -> bool:
        """Does it take long to tell how deep parts overlap? Then that is asked only in the end."""
        shapes = [shape for part in self.here.cell.parts for shape in part.shapes]
        meshes = [getattr(shape.geometry, "mesh", None) for shape in shapes]
        return sum(len(mesh.triangles) for mesh in meshes if mesh is not None) > INTRICATE

    @cached_property
    def _known_contacts(self) -> set[tuple[str, int, str]]:
        return self._contacts(self.here.cell_file, self.here.model)

    def _contacts(self, cell: CellFile, model: _core.CollisionModel) -> set[tuple[str, int, str]]:
        """What each part touches, at the start (-1) and at goals."""
        found, parts = set(), cell.cell.parts
        places = [(i, -1, np.asarray(part.X_WB)) for i, part in enumerate(parts)]
        for index, goal in enumerate(cell.goals):
            if isinstance(goal, PlaceAt):
                places.append((cell.cell.part_index(goal.part), index, goal.X_WP))
        for part, index, X_WP in places:
            there = cell.cell.with_part_at(part, X_WP)
            for ref in _core.touching_bodies(model, there, part, 0.0):
                found.add((parts[part].name, index, there.body(ref).name))
        return found

    def _cut(self, content: dict[str, Any], goals: int) -> dict[str, Any]:
        """The task up to the failed goal, where the order is given."""
        task = content["task"]
        if content.get("order", "given") == "any":
            return content
        # Goals that were put in come before it.
        last = self.here.index + len(task) - goals
        if last == len(task) - 1:
            return content
        return {**content, "task": task[: last + 1], "finish": "anywhere"}
