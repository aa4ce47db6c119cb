"""Depth maps as fixtures: what stands where, known by measurement only.

What a camera saw of the cell's own bodies is taken out; the rest becomes a fixture of a few convex
solids that contains what was measured. Where parts stand, at the start or at a goal, it is exactly
what was measured, so that a contact there is judged as it is; elsewhere it stands out a little.
Stages that plan see a fixture like any other, by the name of the depth map.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from handey import _core
from handey.cell.depth_map import DepthMapEntry
from handey.errors import Fault, InvalidInput
from handey.task import PlaceAt, Task

__all__ = ["with_depth_maps"]

START_GAP = 1e-3  # Choice: more than a motion's clearance; nearer, no more may stand out [m]


def with_depth_maps(
    cell: _core.Cell,
    entries: tuple[DepthMapEntry, ...],
    task: Task,
    faults: list[Fault],
    warnings: list[str],
) -> _core.Cell:
    """The cell with each depth map as one more fixture, after its own, in the order of the file.

    Args:
        cell: with its known bodies.
        entries: the depth maps.
        task: tells where parts will stand.
        faults: what is wrong is added.
        warnings: for people; added to.
    """
    if not entries:
        return cell
    ball = _core.reach_ball(cell)
    options = _core.DepthMapOptions(
        places=_places(cell, task), reach_centre=ball.centre, reach=ball.radius
    )
    found = [_taken_in(entry, cell, options, faults) for entry in entries]
    if faults:
        return cell
    result = _with_fixtures(cell, found)
    # What stands out must not touch a robot that what was measured does not touch.
    if _touches_robot(result, {entry.name for entry in entries}):
        options.places = options.places + _robot_bodies(cell)
        found = [_taken_in(entry, cell, options, faults) for entry in entries]
        result = _with_fixtures(cell, found)
    for entry, body in zip(entries, found, strict=True):
        if body is not None and not body.exact_at_places:
            warnings.append(
                f"{entry.place}: so much was measured where parts stand that more is kept free "
                f"there than has to be (up to {body.excess * 1e3:.1f} mm)"
            )
    return result


def _taken_in(
    entry: DepthMapEntry, cell: _core.Cell, options: _core.DepthMapOptions, faults: list[Fault]
) -> _core.MeasuredBody | None:
    try:
        if entry.kind == "heights":
            heights = _core.HeightMap(entry.content, cell=entry.cell, X_WD=entry.X_WD)
            return _core.cover_heights(entry.name, heights, options)
        image = _image(entry)
        return _core.cover_depths(entry.name, image, _core.explained_pixels(image, cell), options)
    except InvalidInput as error:
        file = entry.place.document.file if entry.place is not None else ""
        faults += [replace(f, place=str(entry.place), file=file) for f in error.faults]
        return None


def _image(entry: DepthMapEntry) -> _core.DepthImage:
    content = entry.content
    if isinstance(content, bytes):
        rows, columns = entry.shape
        content = _core.unfilter_png16(content, rows=rows, columns=columns)
    lens = entry.intrinsics
    assert lens is not None
    return _core.DepthImage(
        content, fx=lens.fx, fy=lens.fy, cx=lens.cx, cy=lens.cy, scale=entry.scale,
        X_WD=entry.X_WD, explained=entry.explained, far=entry.far,
    )  # fmt: skip


def _with_fixtures(cell: _core.Cell, found: list[_core.MeasuredBody | None]) -> _core.Cell:
    return _core.Cell(
        name=cell.name,
        robot=cell.robot,
        X_WR=cell.X_WR,
        fixtures=cell.fixtures + [m.body for m in found if m is not None and m.body.shapes],
        parts=cell.parts,
        start=cell.start,
    )


def _places(cell: _core.Cell, task: Task) -> list[_core.Body]:
    """The parts where they stand at the start, and at each goal that gives a pose."""
    goals = [goal for goal in task.goals if isinstance(goal, PlaceAt)]
    moved = [(cell.parts[cell.part_index(goal.part)], goal.X_WP) for goal in goals]
    return cell.parts + [_at(part, X_WP) for part, X_WP in moved]


def _at(body: _core.Body, X_WB: np.ndarray) -> _core.Body:
    return _core.Body(name=body.name, shapes=body.shapes, X_WB=X_WB)


def _touches_robot(cell: _core.Cell, names: set[str]) -> bool:
    """Is a depth map, whose solids may stand out, too near to the robot at its start?"""
    measured = [fixture for fixture in cell.fixtures if fixture.name in names]
    alone = _core.Cell(robot=cell.robot, X_WR=cell.X_WR, fixtures=measured, start=cell.start)
    checker = _core.CollisionChecker(_core.make_collision_model(alone), alone)
    hit = checker.find_hit(cell.start, START_GAP)
    return hit is not None and hit.b in names


def _robot_bodies(cell: _core.Cell) -> list[_core.Body]:
    """The robot at its start, but for the base, which nothing is checked against."""
    poses = _core.body_poses(cell.robot, cell.start)
    bodies = zip(cell.robot.bodies, poses, strict=True)
    return [
        _core.Body(name=body.name, shapes=body.shapes, X_WB=cell.X_WR @ X_RB)
        for body, X_RB in list(bodies)[1:]
        if body.shapes
    ]
