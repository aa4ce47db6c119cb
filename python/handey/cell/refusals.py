"""What in a cell cannot be: bodies in each other, a robot in a body, goals where no part stays.

Goals are taken in their order, each with the parts where the goals before it have put them. Where
handey may choose the order, a part's last goal is judged with all parts at their last goals; at an
earlier one the others may be anywhere. A goal that leaves the pose open (`on`, `inside`) puts its
part nowhere known, and a part that may move and has no goal may be moved out of the way: that one
overlaps them is not judged.
"""

from __future__ import annotations

import numpy as np

from handey import _core
from handey.cell.cell_entry import CellEntry
from handey.errors import Fault
from handey.placement import examine_standing
from handey.task import Goal, PlaceAt

__all__ = ["find_refusals", "find_warnings"]

CONTACT_TOLERANCE = 5e-4  # of the format: bodies that overlap no deeper touch [m]


def find_refusals(entry: CellEntry, cell: _core.Cell, model: _core.CollisionModel) -> list[Fault]:
    """All that cannot be at the start, then at the goals."""
    file = entry.document.file
    return [*_start_faults(cell, model, file), *_goal_faults(entry, cell, model)]


def find_warnings(cell: _core.Cell) -> list[str]:
    """Parts that do not stand stably at the start."""
    warnings = []
    for index, part in enumerate(cell.parts):
        standing = examine_standing(cell, index, np.asarray(part.X_WB))
        if not standing.stable:
            warnings.append(
                f"parts.{part.name} does not stand stably at the start: {standing.reason}"
            )
    return warnings


def _start_faults(cell: _core.Cell, model: _core.CollisionModel, file: str) -> list[Fault]:
    faults = []
    for overlap in _core.find_overlaps(model, cell, CONTACT_TOLERANCE):
        a, b = overlap.name_a, overlap.name_b
        message = f"'{a}' and '{b}' overlap at the start by {_deep(overlap.depth)}"
        part = overlap.a if _is_part(overlap.a) else overlap.b
        place = f"parts.{cell.parts[part.index].name}.pose"
        faults.append(Fault("E_START_IN_COLLISION", place, message, file))
    checker = _core.CollisionChecker(model, cell)
    for hit in _core.robot_overlaps(checker, cell.start, CONTACT_TOLERANCE):
        message = (
            f"'{hit.a}' of the robot overlaps '{hit.b}' at the start by {_deep(-hit.distance)}"
        )
        faults.append(Fault("E_START_IN_COLLISION", "robot.start", message, file))
    return faults


def _goal_faults(entry: CellEntry, cell: _core.Cell, model: _core.CollisionModel) -> list[Fault]:
    faults: list[Fault] = []
    goals, file = entry.task.goals, entry.document.file
    with_goal = {cell.part_index(goal.part) for goal in goals}
    may_give_way = {i for i, part in enumerate(cell.parts) if part.may_move} - with_goal
    unknown: set[int] = set()
    if entry.task.any_order:
        cell, unknown = _all_reached(cell, goals)
    for index, goal in enumerate(goals):
        part = cell.part_index(goal.part)
        if not isinstance(goal, PlaceAt):
            unknown.add(part)
            continue
        elsewhere = set(unknown)
        there = cell.with_part_at(part, goal.X_WP)
        if not entry.task.any_order:
            unknown.discard(part)
            cell = there
        elif any(later.part == goal.part for later in goals[index + 1 :]):
            elsewhere = with_goal
        elsewhere -= {part}
        place = f"task[{index}].at"
        found = _overlap_messages(there, model, part, elsewhere | may_give_way)
        faults += [Fault("E_GOAL_IN_COLLISION", place, text, file) for text in found]
        standing = examine_standing(there, part, goal.X_WP)
        if not standing.stable and not found and not elsewhere:
            message = f"'{goal.part}' does not stand stably at its goal: {standing.reason}"
            faults.append(Fault("E_GOAL_UNSTABLE", place, message, file))
    return faults


def _all_reached(cell: _core.Cell, goals: tuple[Goal, ...]) -> tuple[_core.Cell, set[int]]:
    """The cell with each part at its last goal, and the parts whose place that leaves open."""
    unknown = set()
    for part, goal in {cell.part_index(goal.part): goal for goal in goals}.items():
        if isinstance(goal, PlaceAt):
            cell = cell.with_part_at(part, goal.X_WP)
        else:
            unknown.add(part)
    return cell, unknown


def _overlap_messages(
    cell: _core.Cell, model: _core.CollisionModel, part: int, unknown: set[int]
) -> list[str]:
    messages = []
    name = cell.parts[part].name
    for overlap in _core.find_overlaps(model, cell, CONTACT_TOLERANCE):
        ours = [ref for ref in (overlap.a, overlap.b) if _is_part(ref)]
        if name not in (overlap.name_a, overlap.name_b):
            continue
        if any(ref.index in unknown and ref.index != part for ref in ours):
            continue
        other = overlap.name_b if overlap.name_a == name else overlap.name_a
        messages.append(f"'{name}' overlaps '{other}' at its goal by {_deep(overlap.depth)}")
    # The robot's base stands still too; its other bodies move out of the way.
    base = cell.robot.bodies[0].name
    checker = _core.CollisionChecker(model, cell)
    for hit in _core.robot_overlaps(checker, cell.start, CONTACT_TOLERANCE):
        if (hit.a, hit.b) == (base, name):
            depth = _deep(-hit.distance)
            messages.append(f"'{name}' overlaps '{base}' of the robot at its goal by {depth}")
    return messages


def _is_part(ref: _core.BodyRef) -> bool:
    return bool(ref.kind == _core.BodyRef.Kind.Part)


def _deep(depth: float) -> str:
    return f"{depth * 1e3:.1f} mm, more than the {CONTACT_TOLERANCE * 1e3:g} mm of a contact"
