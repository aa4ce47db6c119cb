"""A page that plays a plan: one HTML file that needs no network and no server.

The page holds the geometry, the rows of the plan and a small viewer (viewer.js: WebGL 2, plain
JavaScript). It reads the files as the checker does and moves the robot by its own kinematics, so it
shows what the plan says, valid or not.
"""

from __future__ import annotations

import base64
import html
import json
import os
import tempfile
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.carries import find_carries
from handey.check.cell import Body, Cell, read_cell
from handey.check.plan_data import PlanData, load_json, read_plan
from handey.check.planar import unit_normals
from handey.check.report import CheckReport
from handey.check.robot import Robot
from handey.check.shapes import Shape
from handey.check.values import Array
from handey.errors import Fault, InvalidInput

__all__ = ["write_page"]

CREASE = np.radians(30.0)  # sharper edges are drawn
MOST_TRIANGLES = 200_000  # of pictures; above that the collision shapes are shown


def write_page(
    cell: str | os.PathLike[str],
    plan: str | os.PathLike[str] | Mapping[str, Any] | None,
    path: str | os.PathLike[str],
) -> None:
    """Writes the page, whole or not at all.

    Args:
        cell: the cell file.
        plan: the plan file or its content; None shows the cell at its start.
        path: the HTML file to write.

    Raises:
        InvalidInput: if the cell or the plan cannot be read.
        OSError: if the page cannot be written.
    """
    content = read_cell(Path(cell))
    page = _page(content, None if plan is None else _read(plan, content))
    target = Path(path)
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(page)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, target)
    except BaseException:
        os.unlink(temporary)
        raise


def _read(plan: str | os.PathLike[str] | Mapping[str, Any], cell: Cell) -> PlanData:
    source = plan if isinstance(plan, Mapping) else Path(plan)
    content, name = load_json(source)
    report = CheckReport()
    data = read_plan(content, cell, report)
    if data is None:
        raise InvalidInput([Fault("E_PLAN", "", str(fault), name) for fault in report.faults])
    return data


def _page(cell: Cell, plan: PlanData | None) -> str:
    assets = resources.files(__package__)
    scene = json.dumps(_scene(cell, plan), separators=(",", ":"), allow_nan=False)
    parts = {
        "title": html.escape(cell.name),
        "style": assets.joinpath("style.css").read_text(encoding="utf-8"),
        "scene": scene.replace("<", "\\u003c"),
        "script": assets.joinpath("viewer.js").read_text(encoding="utf-8"),
    }
    page = assets.joinpath("page.html").read_text(encoding="utf-8")
    for key, value in parts.items():
        page = page.replace("{{" + key + "}}", value)
    return page


# ------------------------------------------------------------------------------------------- scene


class _Meshes:
    """The meshes of the page; equal ones are kept once."""

    def __init__(self) -> None:
        self.list: list[dict[str, str]] = []
        self._known: dict[bytes, int] = {}

    def add(self, shape: Shape) -> int:
        vertices, faces = np.asarray(shape.vertices, "<f4"), np.asarray(shape.faces, "<u4")
        key = vertices.tobytes() + b"|" + faces.tobytes()
        if key not in self._known:
            self._known[key] = len(self.list)
            # The steps between columns would blacken a measured solid.
            creases = np.zeros((0, 2)) if shape.is_measured else _creases(shape)
            edges = np.asarray(creases, "<u4")
            self.list.append({"v": _packed(vertices), "f": _packed(faces), "e": _packed(edges)})
        return self._known[key]


def _packed(array: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")


def _creases(shape: Shape) -> np.ndarray:
    """Edges where the surface bends sharply, or ends (k, 2)."""
    normals = unit_normals(shape.vertices[shape.faces])
    edges = shape.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(shape.faces)), 3)
    unique, index = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    order = np.argsort(index.reshape(-1), kind="stable")
    count = np.bincount(index.reshape(-1))
    first = np.concatenate([[0], np.cumsum(count)[:-1]])
    a, b = owner[order[first]], owner[order[np.minimum(first + 1, len(order) - 1)]]
    bend = np.einsum("ij,ij->i", normals[a], normals[b]) < np.cos(CREASE)
    return np.asarray(unique[(count != 2) | bend])


def _matrix(matrix: Array) -> list[float]:
    """Column by column, as WebGL has it."""
    return [round(float(x), 9) for x in matrix.T.ravel()]


def _scene(cell: Cell, plan: PlanData | None) -> dict[str, Any]:
    meshes = _Meshes()

    def shapes(items: list[Shape]) -> list[dict[str, Any]]:
        return [
            {"mesh": meshes.add(shape.picture or shape), "pose": _matrix(shape.pose)}
            for shape in items
        ]

    def body(item: Body) -> dict[str, Any]:
        return {"name": item.name, "pose": _matrix(item.pose), "shapes": shapes(item.shapes)}

    robot = cell.robot
    joints = [*robot.joints, *robot.fingers]
    arm = {joint.name: i for i, joint in enumerate(robot.joints)}
    return {
        "name": cell.name,
        "robot": {
            "name": robot.name,
            "base": _matrix(cell.base),
            "bodies": [{"name": b.name, "shapes": shapes(s)} for b, s in _pictures(robot)],
            "joints": [
                {
                    "name": j.name, "parent": j.parent, "child": j.child,
                    "origin": _matrix(j.origin),
                    "axis": j.axis.tolist(), "slides": j.prismatic, "index": arm.get(j.name, -1),
                    "limits": [x if np.isfinite(x) else None for x in (j.lower, j.upper)],
                }
                for j in sorted(joints, key=lambda j: j.child)
            ],
            "arm": robot.joint_names(),
            "fingers": [finger.child for finger in robot.fingers],
            "hand": robot.hand,
            "grasp": _matrix(robot.grasp_frame),
            "opening": list(robot.opening),
        },
        "fixtures": [{**body(item), "support": item.support} for item in cell.fixtures],
        "parts": [body(item) for item in cell.parts],
        "goals": [
            {
                "part": g.part, "at": None if g.at is None else _matrix(g.at),
                "on": g.on, "inside": g.inside,
            }
            for g in cell.task
        ],
        "plan": _motion(cell, plan),
        "meshes": meshes.list,
    }  # fmt: skip


def _pictures(robot: Robot) -> list[tuple[Any, list[Shape]]]:
    """Each body with what is shown of it: its visual shapes if they can be had, else the others."""
    total = sum(len(shape.faces) for body in robot.bodies for shape in body.visuals)
    if total > MOST_TRIANGLES:
        return [(body, body.shapes) for body in robot.bodies]
    return [(body, body.visuals or body.shapes) for body in robot.bodies]


def _motion(cell: Cell, plan: PlanData | None) -> dict[str, Any]:
    """The rows of all steps, and where every part is in each step."""
    if plan is None or not plan.steps:
        start = {part.name: _matrix(part.pose) for part in cell.parts}
        rows = np.concatenate([cell.start, [cell.start_opening]])
        note = "no plan" if plan is None else "every goal is met: nothing to do"
        return {
            "note": note, "steps": [], "start": start, "time": _packed(np.zeros(1, "<f8")),
            "rows": _packed(rows.astype("<f4")),
        }  # fmt: skip
    _, world = find_carries(plan, cell)
    steps, row = [], 0
    for step in plan.steps:
        parts = {name: _matrix(pose) for name, pose in world.standing[step.index].items()}
        held = step.part if step.part is not None and step.part not in parts else None
        grip = None if held is None or step.X_HP is None else _matrix(step.X_HP)
        steps.append(
            {
                "action": step.action, "goal": step.goal, "held": held, "grip": grip,
                "parts": parts, "row": row, "rows": len(step.time),
                "from": float(step.time[0]), "to": float(step.time[-1]),
            }
        )  # fmt: skip
        row += len(step.time)
    rows = np.vstack([np.c_[step.q, step.opening] for step in plan.steps])
    time = np.concatenate([step.time for step in plan.steps])
    return {
        "note": "", "steps": steps, "start": {part.name: _matrix(part.pose) for part in cell.parts},
        "time": _packed(time.astype("<f8")), "rows": _packed(rows.astype("<f4")),
    }  # fmt: skip
