"""What is in this cell, what can be held where it stands, and which goals are within reach?

A grasp counts where hand and arm are legal with the part standing there, all else where it is:
the tests of the planner, at one place instead of two. Goals are looked at in the order of the
file, each with the parts where the goals before it have put them; where the order is free, without
the other parts that may move. Not looked at: whether there is a way, and grasps that only a denser
search finds. A goal that no grasp serves from end to end may still be reached by way of another
placement.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from handey import _core
from handey.cell.depth_map import DepthMapEntry
from handey.cell_file import CellFile
from handey.errors import InvalidInput
from handey.inspection.holding import Held, Holding, rank
from handey.inspection.part import PartReport, inspect_body
from handey.placement import TOUCHING, Standing, examine_standing
from handey.planning.goal_places import is_met, places_for
from handey.resting import Sought
from handey.task import Goal, PlaceAt

__all__ = ["CellReport", "GoalFigures", "MapFigures", "PartFigures", "inspect_cell"]

PLACES = 6  # Choice: of a goal that leaves the pose open, so many placements are looked at


@dataclass(frozen=True)
class PartFigures:
    """A part where it stands at the start.

    Attributes:
        part: what it is.
        standing: on what, and whether it stays.
        unobstructed: pairs that fingers get to.
        held: hand poses at its place; None where the kinematics is not supported.
        may_move: it may be moved aside.
    """

    part: PartReport
    standing: Standing
    unobstructed: int
    held: Held | None
    may_move: bool

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return self.part.as_dict() | {
            "stands_on": list(self.standing.on),
            "stable": self.standing.stable,
            "unstable_reason": self.standing.reason,
            "unobstructed_pairs": self.unobstructed,
            "may_move": self.may_move,
            "grasps": _held_dict(self.held),
        }


@dataclass(frozen=True)
class GoalFigures:
    """A goal of the task.

    Attributes:
        goal: of the task.
        met: the part is there already.
        places: placements that the goal allows and that were looked at.
        why_none: why there is no placement.
        there: hand poses at the best of them; None where the kinematics is not supported.
        both: hand poses that are legal where the part is and there.
        here: hand poses where the part is before.
    """

    goal: Goal
    met: bool
    places: int
    why_none: str
    there: Held | None
    both: Held | None
    here: Held | None = None

    @property
    def verdict(self) -> str:
        """In one word or a few."""
        if self.met:
            return "met already"
        if self.why_none:
            return "no placement"
        if self.there is None or self.both is None:
            return "not known"
        if self.both.legal:
            return "within reach"
        if self.here is not None and not self.here.legal:
            return "no grasp found where it stands"
        return "by a regrasp at best" if self.there.legal else "no grasp found there"

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "goal": str(self.goal),
            "part": self.goal.part,
            "verdict": self.verdict,
            "met": self.met,
            "placements": self.places,
            "why_no_placement": self.why_none,
            "grasps_there": _held_dict(self.there),
            "grasps_at_both_ends": _held_dict(self.both),
            "grasps_where_it_stands": _held_dict(self.here),
        }


@dataclass(frozen=True)
class MapFigures:
    """A depth map: rows and columns, and the share that was not measured."""

    name: str
    kind: str
    shape: tuple[int, int]
    unmeasured: float

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "name": self.name,
            "kind": self.kind,
            "rows": self.shape[0],
            "columns": self.shape[1],
            "unmeasured_share": self.unmeasured,
        }


@dataclass(frozen=True)
class CellReport:
    """What was found out about a cell.

    Attributes:
        file: the cell.
        objection: why planning does not support the robot's kinematics; empty if it does.
        parts: in the order of the file.
        goals: in the order of the file.
        supports: names of bodies with the faces on which parts may be put down, highest first.
        depth_maps: in the order of the file.
        touching: pairs of fixtures and parts that overlap less than what is refused, and how deep.
        home_clearance: of the robot at the start, up to 0.5 m [m], and the two that are so near.
        warnings: for people.
    """

    file: CellFile
    objection: str
    parts: tuple[PartFigures, ...]
    goals: tuple[GoalFigures, ...]
    supports: tuple[tuple[str, tuple[_core.SupportFace, ...]], ...]
    depth_maps: tuple[MapFigures, ...]
    touching: tuple[tuple[str, str, float], ...]
    home_clearance: tuple[float, str, str]
    warnings: tuple[str, ...]

    @property
    def name(self) -> str:
        """Of the cell."""
        return self.file.name

    def as_dict(self) -> dict[str, Any]:
        """For JSON: metres, radians."""
        cell = self.file.cell
        distance, a, b = self.home_clearance
        return {
            "kind": "cell",
            "name": self.name,
            "robot": cell.robot.name,
            "inverse_kinematics": {"supported": not self.objection, "reason": self.objection},
            "fixtures": [fixture.name for fixture in cell.fixtures],
            "parts": {figures.part.name: figures.as_dict() for figures in self.parts},
            "supports": {
                name: {
                    "area_m2": sum(face.area for face in faces),
                    "heights_m": sorted({round(float(face.X_WS[2, 3]), 6) for face in faces}),
                }
                for name, faces in self.supports
            },
            "depth_maps": [entry.as_dict() for entry in self.depth_maps],
            "goals": [goal.as_dict() for goal in self.goals],
            "order": "any" if self.file.task.any_order else "given",
            "overlaps": [{"a": a, "b": b, "depth_m": depth} for a, b, depth in self.touching],
            "start_clearance_m": distance if a else None,
            "start_nearest": [a, b] if a else None,
            "warnings": list(self.warnings),
        }


def inspect_cell(file: CellFile) -> CellReport:
    """What a cell is.

    Args:
        file: from `handey.load_cell`.
    """
    cell = file.cell
    model = _core.make_collision_model(cell)
    objection, solver = "", None
    try:
        solver = _core.SphericalWristSolver(cell.robot)
    except InvalidInput as error:
        objection = error.faults[0].message
    holding = None if solver is None else Holding(cell.robot, solver)
    parts = [_part(cell, model, holding, index) for index in range(len(cell.parts))]
    goals = []
    now = cell
    for goal in file.goals:
        around = _without_movable(file, goal) if file.task.any_order else now
        figures, after = _goal(file, around, now, solver, holding, goal)
        goals.append(figures)
        now = now if file.task.any_order else after
    hit = _core.CollisionChecker(model, cell).closest(cell.start, 0.5)
    overlaps = _core.find_overlaps(model, cell, 1e-5)
    return CellReport(
        file,
        objection,
        tuple(parts),
        tuple(goals),
        _supports(cell),
        tuple(_map(entry) for entry in file.depth_maps),
        tuple((o.name_a, o.name_b, o.depth) for o in overlaps),
        (hit.distance, hit.a, hit.b),
        file.warnings,
    )


def _part(
    cell: _core.Cell,
    model: _core.CollisionModel,
    holding: Holding | None,
    index: int,
) -> PartFigures:
    part = cell.parts[index]
    report = inspect_body(part, cell.robot)
    near = _core.touching_bodies(model, cell, index, TOUCHING)
    standing = examine_standing(cell, index, np.asarray(part.X_WB), near)
    ranking = rank(cell, index, part.X_WB, False, report.features)
    held = None if holding is None else holding.at(cell, model, index, part.X_WB)[1]
    return PartFigures(report, standing, len(ranking.ranked), held, part.may_move)


def _without_movable(file: CellFile, goal: Goal) -> _core.Cell:
    """The cell without the other parts that have a goal or may move."""
    cell = file.cell
    movable = {other.part for other in file.goals} | {p.name for p in cell.parts if p.may_move}
    kept = [part for part in cell.parts if part.name == goal.part or part.name not in movable]
    return _core.Cell(
        name=cell.name, robot=cell.robot, X_WR=cell.X_WR, fixtures=cell.fixtures, parts=kept,
        start=cell.start,
    )  # fmt: skip


def _goal(
    file: CellFile,
    cell: _core.Cell,
    now: _core.Cell,
    solver: _core.SphericalWristSolver | None,
    holding: Holding | None,
    goal: Goal,
) -> tuple[GoalFigures, _core.Cell]:
    """The figures of a goal in a cell, and the cell after it; `now` tells whether it is met."""
    if is_met(goal, now, _core.make_collision_model(now), file.cell):
        return GoalFigures(goal, True, 0, "", None, None), cell
    part = cell.part_index(goal.part)
    if solver is None or holding is None:
        then = cell.with_part_at(part, goal.X_WP) if isinstance(goal, PlaceAt) else cell
        return GoalFigures(goal, False, 0, "", None, None), then
    model = _core.make_collision_model(cell)
    sought = Sought()
    stream = places_for(goal, cell, model, solver, file.cell, sought=sought)
    here, at_start = holding.at(cell, model, part, np.asarray(cell.parts[part].X_WB))
    found: list[tuple[Held, Held, _core.Cell]] = []
    for place in islice(stream, PLACES):
        there, at_goal = holding.at(cell, model, part, place.X_WP)
        at_both = Held(0, 0, "no grasp is legal there" if at_start.legal else at_start.reason)
        if at_goal.legal and at_start.legal:
            at_both = holding.at_both(cell, model, part, place.X_WP, here & there)
        found.append((at_goal, at_both, cell.with_part_at(part, place.X_WP)))
        if at_both.legal:
            break
    if not found:
        return GoalFigures(goal, False, 0, sought.reason(), None, None, at_start), cell
    at_goal, at_both, after = max(found, key=lambda f: (f[1].legal, f[0].legal))
    return GoalFigures(goal, False, len(found), "", at_goal, at_both, at_start), after


def _supports(cell: _core.Cell) -> tuple[tuple[str, tuple[_core.SupportFace, ...]], ...]:
    bodies = [body for body in [*cell.fixtures, *cell.parts] if body.support]
    return tuple((body.name, tuple(_core.support_faces(body))) for body in bodies)


def _map(entry: DepthMapEntry) -> MapFigures:
    """The share of a depth map that was not measured."""
    content = entry.content
    if isinstance(content, bytes):
        rows, columns = entry.shape
        content = _core.unfilter_png16(content, rows=rows, columns=columns)
    values = np.asarray(content, dtype=float)
    missing = np.isnan(values) if entry.kind == "heights" else ~(values > 0)
    return MapFigures(entry.name, entry.kind, entry.shape, float(missing.mean()))


def _held_dict(held: Held | None) -> dict[str, Any] | None:
    return None if held is None else held.as_dict()
