"""Changes of what may be done: supports, parts moved aside, the task, where the arm starts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from handey import _core
from handey.advising.change import Change, Family
from handey.advising.situation import Situation
from handey.reporting.advice import Edit
from handey.task import PlaceAt, PlaceOn

__all__ = ["finish", "orders", "other_places", "robot_starts", "sooner", "supports", "yielding"]

PLATE, THICKNESS = 0.24, 0.02  # Choice: of a support that is put into the cell [m]
GROWTH = (0.1, 0.05, 0.2, 0.4)  # of a region, on each side [m]
REGION_STEP = 0.01


def _once(change: Change, rank: float = 0.0, body: str = "") -> Family:
    return Family(change.kind, lambda _: change, rank=rank, body=body)


def supports(here: Situation) -> Iterator[Family]:
    """A fixture on which parts may be put down on the way; then a plate for that."""
    goal, order = here.goal, 0
    for fixture in here.cell.fixtures:
        if fixture.support or here.is_measured(fixture.name):
            continue
        if not _core.support_faces(fixture):
            continue
        edit = Edit(here.file, f"fixtures.{fixture.name}.support", True)
        words = f"let {fixture.name} be a support, to put {goal.part} down on the way"
        yield _once(Change("support", words, (edit,), regrasps=True), rank=0.5 * order)
        order += 1
    for place, xyz in enumerate(_plates(here)):
        value = {"box": [PLATE, PLATE, THICKNESS], "pose": {"xyz": xyz}, "support": True}
        edit = Edit(here.file, "fixtures.regrasp_support", value)
        words = (
            f"add a support of {1e3 * PLATE:.0f} x {1e3 * PLATE:.0f} mm at "
            f"({xyz[0]:.2f}, {xyz[1]:.2f}, {xyz[2]:.2f})"
        )
        change = Change("support added", words, (edit,), regrasps=True)
        yield _once(change, rank=2.0 + 0.5 * place)


def _plates(here: Situation) -> Iterator[list[float]]:
    """Places for a plate clear of all, about half way out, as high as the part stands now."""
    if "regrasp_support" in here.boxes:
        return
    origin = here.ends["origin"][:3, 3]
    low = here.boxes[here.goal.part][0][2]
    radius = float(np.clip(np.linalg.norm((here.middle("origin") - here.robot_at)[:2]), 0.4, 0.6))
    first = float(np.arctan2(*(origin - here.robot_at)[[1, 0]]))
    ends = [here.middle(end) for end in here.ends]
    boxes = [box for name, box in here.boxes.items() if name not in _grounds(here)]
    for height in (low + 0.05, low + 0.15):
        for angle in np.radians((35, -35, 60, -60, 90, -90, 120, -120)):
            turned = first + angle
            middle = here.robot_at + radius * np.array([np.cos(turned), np.sin(turned), 0.0])
            middle[2] = height
            half = np.array([PLATE / 2 + 0.03, PLATE / 2 + 0.03, THICKNESS / 2 + 0.005])
            clear = all(np.linalg.norm((middle - end)[:2]) > 0.25 for end in ends)
            clear = clear and not any(
                ((middle - half < high) & (middle + half > least)).all() for least, high in boxes
            )
            if clear:
                yield [round(float(value), 3) for value in middle]


def _grounds(here: Situation) -> set[str]:
    return set(here.loads)


def yielding(here: Situation, names: list[str]) -> Iterator[Family]:
    """Parts that may be moved aside, with a support to put them on if there is none."""
    has_support = any(body.support for body in [*here.cell.fixtures, *here.cell.parts])
    pile = here.pile
    if len(pile) > 1 and has_support:
        edits = tuple(Edit(here.file, f"parts.{name}.may_move", True) for name in pile)
        words = f"let {', '.join(pile[:-1])} and {pile[-1]} be moved aside"
        yield _once(Change("may move", words, edits, load=len(pile) - 1), rank=-1.0)
    for order, name in enumerate(names):
        index = next((i for i, p in enumerate(here.cell.parts) if p.name == name), None)
        if index is None or here.cell.parts[index].may_move:
            continue
        may = Edit(here.file, f"parts.{name}.may_move", True)
        words = f"let {name} be moved aside"
        if has_support:
            yield _once(Change("may move", words, (may,)), order, name)
            continue
        for ground, load in here.loads.items():
            if any(part == name and goal < 0 for part, goal in load) and not here.is_part(ground):
                on = Edit(here.file, f"fixtures.{ground}.support", True)
                text = f"{words}, on {ground} as a support"
                yield _once(Change("may move", text, (may, on)), order, name)


def orders(here: Situation, names: list[str]) -> Iterator[Family]:
    """This goal before an earlier one that puts a part in its way; or the order left open.

    Args:
        here: the goal that failed.
        names: of bodies in its way, the likeliest first.
    """
    task: list[Any] = here.content["task"]
    if here.cell_file.task.any_order or len(task) < 2:
        return
    for order, index in enumerate(here.goals_before(names)):
        kept = [goal for i, goal in enumerate(task) if i != here.index]
        value = [*kept[:index], task[here.index], *kept[index:]]
        words = f"reach goal {here.index} before goal {index}"
        yield _once(Change("order", words, (Edit(here.file, "task", value),)), order)
    edit = Edit(here.file, "order", "any")
    yield _once(Change("order", "leave the order of the goals open", (edit,)), rank=2.0)


def sooner(here: Situation, names: list[str]) -> Iterator[Family]:
    """An earlier goal that takes a part out of the way, onto a fixture."""
    task: list[Any] = here.content["task"]
    for order, name in enumerate(names):
        if not here.is_part(name):
            continue
        for fixture in here.cell.fixtures:
            if here.is_measured(fixture.name) or not _core.support_faces(fixture):
                continue
            goal = {"place": name, "on": fixture.name}
            value = [*task[: here.index], goal, *task[here.index :]]
            words = f"put {name} on {fixture.name} first, by a goal before goal {here.index}"
            change = Change("earlier goal", words, (Edit(here.file, "task", value),))
            yield _once(change, order, name)


def other_places(here: Situation) -> Iterator[Family]:
    """More room for a goal that leaves the place open: a larger region, another fixture."""
    goal, place = here.goal, f"task[{here.index}]"
    if isinstance(goal, PlaceAt):
        return
    if isinstance(goal, PlaceOn) and goal.region is not None:
        region = goal.region

        def grown(size: float) -> Change:
            value = [
                [round(float(v) - size, 6) for v in region[0]],
                [round(float(v) + size, 6) for v in region[1]],
            ]
            words = f"widen the region of {goal.part} by {1e3 * size:.0f} mm on each side"
            return Change("region", words, (Edit(here.file, f"{place}.region", value),), size)

        yield Family("region", grown, GROWTH, step=REGION_STEP)
    if isinstance(goal, PlaceOn) and goal.same_resting:
        words = f"let {goal.part} stand on another face"
        yield _once(Change("region", words, (Edit(here.file, f"{place}.resting", None),)), 0.5)
    key = "on" if isinstance(goal, PlaceOn) else "inside"
    for order, fixture in enumerate(here.cell.fixtures):
        if fixture.name == goal.fixture or here.is_measured(fixture.name):
            continue
        faces = _core.support_faces(fixture)
        if not faces:
            continue
        if key == "inside" and all(face.enclosed.empty() for face in faces):
            if fixture.support:
                out = Edit(here.file, f"{place}.inside", None)
                on = Edit(here.file, f"{place}.on", fixture.name)
                words = f"place {goal.part} on {fixture.name}, not inside {goal.fixture}"
                yield _once(Change("other goal", words, (out, on)), rank=2.0 + 0.5 * order)
            continue
        edits = [Edit(here.file, f"{place}.{key}", fixture.name)]
        if isinstance(goal, PlaceOn) and goal.region is not None:
            edits.append(Edit(here.file, f"{place}.region", None))
        words = f"place {goal.part} {key} {fixture.name}"
        yield _once(Change("other fixture", words, tuple(edits)), rank=1.0 + 0.5 * order)


def robot_starts(here: Situation) -> Iterator[Family]:
    """The arm at its home at the start, or turned about its first joint."""
    robot, start = here.cell.robot, np.asarray(here.cell.start.q)
    home = np.asarray(robot.home)
    limits = [(joint.limit.lower, joint.limit.upper) for joint in robot.joints]
    found = []
    if np.abs(home - start).max() > 1e-6:
        found.append(("start the arm at its home", home))
    for degrees in (45.0, -45.0, 90.0, -90.0, 135.0, -135.0):
        q = home.copy()
        q[0] += np.radians(degrees)
        if limits[0][0] <= q[0] <= limits[0][1]:
            name = robot.joints[0].name
            found.append(
                (f"start the arm at its home with {name} {degrees:+.0f} degrees from it", q)
            )
    for order, (words, q) in enumerate(found):
        edit = Edit(here.file, "robot.start", [round(float(v), 6) for v in q])
        yield _once(Change("robot start", words, (edit,)), rank=0.7 * order)


def finish(here: Situation) -> Iterator[Family]:
    """The arm may stay where it is in the end."""
    if here.cell_file.task.return_to_start:
        edit = Edit(here.file, "finish", "anywhere")
        yield _once(Change("finish", "let the arm end where it is", (edit,)))
