"""Robot, meshes and bodies of a cell file as one cell of the compiled core, ready to plan.

The faults of the robot file, of the URDF and of all meshes are reported together; then, if there
are none, what cannot be is refused (`handey.cell.refusals`).
"""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np

from handey import _core
from handey.cell.body_entry import BodyEntry, Box, Cylinder, Mesh, ShapeEntry, Sphere
from handey.cell.cell_entry import CellEntry, CellFile, RobotPlace
from handey.cell.measured import with_depth_maps
from handey.cell.refusals import find_refusals, find_warnings
from handey.errors import Fault, InvalidInput
from handey.robot_file import load_robot

__all__ = ["assemble", "assemble_like"]

LIMIT_TOLERANCE = 1e-9  # of the format [rad, m]


def assemble(entry: CellEntry, robot: _core.Robot | None = None) -> CellFile:
    """The cell that the entries of a file describe.

    Args:
        entry: the content of the file.
        robot: takes the place of the one that the robot's file describes.

    Raises:
        InvalidInput: with all faults of robot and meshes, or with all that cannot be.
    """
    faults: list[Fault] = []
    warnings: list[str] = []
    robot = robot or _robot(entry.robot, faults, warnings)
    bodies = {body.name: _body(body, faults, warnings) for body in (*entry.fixtures, *entry.parts)}
    start = None if robot is None else _start(entry.robot, robot, faults)
    if faults or robot is None or start is None:
        raise InvalidInput(faults)
    made = {name: body for name, body in bodies.items() if body is not None}
    cell = _core.Cell(
        name=entry.name,
        robot=robot,
        X_WR=entry.robot.X_WR,
        fixtures=[made[fixture.name] for fixture in entry.fixtures],
        parts=[made[part.name] for part in entry.parts],
        start=start,
    )
    cell = with_depth_maps(cell, entry.depth_maps, entry.task, faults, warnings)
    if faults:
        raise InvalidInput(faults)
    model = _core.make_collision_model(cell)
    faults = find_refusals(entry, cell, model)
    if faults:
        raise InvalidInput(faults)
    warnings += find_warnings(cell)
    file = Path(entry.document.file) if entry.document.file else None
    return CellFile(file, cell, entry.task, entry.depth_maps, tuple(warnings), entry, model)


def assemble_like(
    entry: CellEntry, like: CellFile, measured: set[str], robot: _core.Robot | None = None
) -> CellFile:
    """The cell of an entry that differs from another's in little; nothing is refused, quickly.

    Args:
        entry: has no depth maps.
        like: whose shapes are taken for the bodies of the same names.
        measured: names of the depth maps of `like` that are taken as they are.
        robot: as in `assemble`; by default that of `like`.

    Raises:
        InvalidInput: if the robot's start or a body is wrong.
    """
    faults: list[Fault] = []
    robot = robot or like.cell.robot
    shapes = {body.name: body.shapes for body in (*like.cell.fixtures, *like.cell.parts)}

    def made(body: BodyEntry) -> _core.Body | None:
        if body.name in shapes:
            return _with_shapes(body, shapes[body.name])
        return _body(body, faults, [])

    fixtures, parts = [made(it) for it in entry.fixtures], [made(it) for it in entry.parts]
    start = _start(entry.robot, robot, faults)
    if faults or start is None:
        raise InvalidInput(faults)
    maps = like.cell.fixtures[len(like.entry.fixtures) :]
    cell = _core.Cell(
        name=entry.name,
        robot=robot,
        X_WR=entry.robot.X_WR,
        fixtures=[
            *(body for body in fixtures if body is not None),
            *(it for it in maps if it.name in measured),
        ],
        parts=[body for body in parts if body is not None],
        start=start,
    )
    return CellFile(like.file, cell, entry.task, like.depth_maps, (), entry)


def _robot(place: RobotPlace, faults: list[Fault], warnings: list[str]) -> _core.Robot | None:
    try:
        robot, said = load_robot(place.file)
    except InvalidInput as error:
        faults += error.faults
        return None
    warnings += said
    return robot


def _start(
    place: RobotPlace, robot: _core.Robot, faults: list[Fault]
) -> _core.Configuration | None:
    """Where the robot starts, within its limits."""
    file = place.field.document.file
    q = np.array(robot.home if place.start is None else place.start, dtype=float)
    found = len(faults)
    if len(q) != len(robot.joints):
        message = f"expected {len(robot.joints)} numbers, one for each arm joint, found {len(q)}"
        faults.append(Fault("E_DOF", "robot.start", message, file))
        return None
    for index, (joint, value) in enumerate(zip(robot.joints, q, strict=True)):
        low, high = joint.limit.lower, joint.limit.upper
        if not low - LIMIT_TOLERANCE <= value <= high + LIMIT_TOLERANCE:
            limits = f"{low:g} to {high:g} rad (tolerance {LIMIT_TOLERANCE:g})"
            message = f"{joint.name} = {float(value)} rad lies outside its limits {limits}"
            faults.append(Fault("E_LIMIT", f"robot.start[{index}]", message, file))
    gripper = robot.gripper
    opening = gripper.max_opening if place.start_opening is None else place.start_opening
    low, high = gripper.min_opening, gripper.max_opening
    if not low - LIMIT_TOLERANCE <= opening <= high + LIMIT_TOLERANCE:
        message = f"expected an opening from {low:g} to {high:g} m, found {opening:g}"
        faults.append(Fault("E_RANGE", "robot.start_opening", message, file))
    return None if len(faults) > found else _core.Configuration(q=q, opening=opening)


def _body(body: BodyEntry, faults: list[Fault], warnings: list[str]) -> _core.Body | None:
    made = [_shape(body, shape, faults, warnings) for shape in body.shapes]
    shapes = [shape for shape in made if shape is not None]
    return None if len(shapes) < len(made) else _with_shapes(body, shapes)


def _with_shapes(body: BodyEntry, shapes: list[_core.Shape]) -> _core.Body:
    return _core.Body(
        name=body.name,
        shapes=shapes,
        X_WB=body.X_WB,
        support=body.support,
        friction=body.friction,
        mass=body.mass,
        density=body.density,
        may_move=body.may_move,
    )


def _shape(
    body: BodyEntry, shape: ShapeEntry, faults: list[Fault], warnings: list[str]
) -> _core.Shape | None:
    geometry = shape.geometry
    if isinstance(geometry, Box):
        return _core.Shape(geometry=_core.Box(geometry.size), X_BS=shape.X_BS)
    if isinstance(geometry, Cylinder):
        return _core.Shape(_core.Cylinder(geometry.radius, geometry.length), X_BS=shape.X_BS)
    if isinstance(geometry, Sphere):
        return _core.Shape(_core.Sphere(geometry.radius), X_BS=shape.X_BS)
    try:
        loaded = _load_mesh(geometry, body.is_part)
    except InvalidInput as error:
        faults += [_at_mesh(fault, geometry, shape) for fault in error.faults]
        return None
    warnings += [f"{shape.field}: {geometry.file}: {warning}" for warning in loaded.warnings]
    mesh = _core.MeshShape(mesh=loaded.mesh, solid=loaded.surface.closed)
    return _core.Shape(geometry=mesh, X_BS=shape.X_BS)


def _load_mesh(mesh: Mesh, must_be_closed: bool) -> _core.LoadedMesh:
    return _core.load_mesh(mesh.file, scale=mesh.scale, must_be_closed=must_be_closed)


def _at_mesh(fault: Fault, mesh: Mesh, shape: ShapeEntry) -> Fault:
    """The fault of a mesh, told at the place of the cell file that names the mesh."""
    file = os.fspath(mesh.file)
    within = fault.place[len(file) :].lstrip(": ") if fault.place.startswith(file) else fault.place
    within = re.sub(r"^(\d+)$", r"line \1", within)
    message = ": ".join(part for part in (shape.field.value, within, fault.message) if part)
    return Fault(fault.code, str(shape.field), message, shape.field.document.file)
