"""What the page draws: meshes, robot, bodies, the rows of a plan, the hand poses that were tried.

Plain values for JSON, arrays packed as base64. The files are read as the checker reads them, and
the robot is moved by its own kinematics, so the page shows what the plan says, valid or not.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from handey.check.carries import find_carries
from handey.check.cell import Body, Cell
from handey.check.plan_data import PlanData
from handey.check.robot import Robot
from handey.check.shapes import Shape
from handey.check.values import Array
from handey.pages.meshes import creases, matrix, packed
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import STAGES, Tried
from handey.reporting.report_file import ToldReport
from handey.view.clearance import ClearanceCurve

__all__ = ["cell_scene", "clearance_scene", "ends_of", "tried_scene"]

MOST_TRIANGLES = 200_000  # of pictures; above that the collision shapes are shown
MOST_TRIED = 1200  # Choice: of one goal; more cannot be told apart


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
            bare = shape.is_measured
            edges = np.zeros((0, 2)) if bare else creases(shape.vertices, shape.faces)
            self.list.append(
                {"v": packed(vertices, "<f4"), "f": packed(faces, "<u4"), "e": packed(edges, "<u4")}
            )
        return self._known[key]


def cell_scene(cell: Cell, plan: PlanData | None) -> dict[str, Any]:
    """The cell, and the plan as rows."""
    meshes = _Meshes()

    def shapes(items: list[Shape]) -> list[dict[str, Any]]:
        return [
            {"mesh": meshes.add(shape.picture or shape), "pose": matrix(shape.pose)}
            for shape in items
        ]

    def body(item: Body) -> dict[str, Any]:
        return {"name": item.name, "pose": matrix(item.pose), "shapes": shapes(item.shapes)}

    robot = cell.robot
    joints = [*robot.joints, *robot.fingers]
    arm = {joint.name: i for i, joint in enumerate(robot.joints)}
    return {
        "name": cell.name,
        "robot": {
            "name": robot.name,
            "base": matrix(cell.base),
            "bodies": [{"name": b.name, "shapes": shapes(s)} for b, s in _pictures(robot)],
            "joints": [
                {
                    "name": j.name, "parent": j.parent, "child": j.child,
                    "origin": matrix(j.origin),
                    "axis": j.axis.tolist(), "slides": j.prismatic, "index": arm.get(j.name, -1),
                    "limits": [x if np.isfinite(x) else None for x in (j.lower, j.upper)],
                }
                for j in sorted(joints, key=lambda j: j.child)
            ],
            "arm": robot.joint_names(),
            "fingers": [finger.child for finger in robot.fingers],
            "hand": robot.hand,
            "grasp": matrix(robot.grasp_frame),
            "opening": list(robot.opening),
            "pad": list(robot.pad),
        },
        "fixtures": [{**body(item), "support": item.support} for item in cell.fixtures],
        "parts": [body(item) for item in cell.parts],
        "goals": [
            {
                "part": g.part, "at": None if g.at is None else matrix(g.at),
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
        start = {part.name: matrix(part.pose) for part in cell.parts}
        rows = np.concatenate([cell.start, [cell.start_opening]])
        note = "no plan" if plan is None else "every goal is met: nothing to do"
        return {
            "note": note, "steps": [], "start": start, "time": packed(np.zeros(1), "<f8"),
            "rows": packed(rows, "<f4"),
        }  # fmt: skip
    _, world = find_carries(plan, cell)
    steps, row = [], 0
    for step in plan.steps:
        parts = {name: matrix(pose) for name, pose in world.standing[step.index].items()}
        held = step.part if step.part is not None and step.part not in parts else None
        grip = None if held is None or step.X_HP is None else matrix(step.X_HP)
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
        "note": "", "steps": steps, "start": {part.name: matrix(part.pose) for part in cell.parts},
        "time": packed(time, "<f8"), "rows": packed(rows, "<f4"),
    }  # fmt: skip


def clearance_scene(curve: ClearanceCurve) -> dict[str, Any]:
    """The curve of clearance; its times and distances are packed."""
    return {
        "time": packed(curve.time, "<f4"),
        "distance": packed(curve.distance, "<f4"),
        "between": packed(curve.between, "<i2"),
        "pairs": [list(pair) for pair in curve.pairs],
    }


# ------------------------------------------------------------------------------------------- tried


def tried_scene(cell: Cell, plan: PlanData | None, report: ToldReport) -> list[dict[str, Any]]:
    """Of each goal that is told: where its part is at both ends, and the hand poses tried."""
    result = []
    for goal in report.goals:
        ends = ends_of(cell, plan, goal)
        if ends is None:
            continue
        part, origin, destination = ends
        texts: dict[str, int] = {}
        result.append(
            {
                "goal": goal.goal,
                "part": part,
                "status": goal.status,
                "origin": matrix(origin),
                "destination": None if destination is None else matrix(destination),
                "tried": [_tried(tried, texts) for tried in _some(goal.tried)],
                "texts": list(texts),
            }
        )
    return result


def _tried(tried: Tried, texts: dict[str, int]) -> dict[str, Any]:
    return {
        "at": [round(float(x), 5) for x in np.array(tried.X_PH).T.ravel()],
        "opening": round(tried.opening, 5),
        "width": round(tried.width, 5),
        "stage": tried.stage or "planned",
        "text": texts.setdefault(tried.text, len(texts)),
    }


def _some(tried: list[Tried]) -> list[Tried]:
    """Those that have a pose; of too many, some of each stage, those of the rarest stages all."""
    usable = [pose for pose in tried if pose.X_PH]
    if len(usable) <= MOST_TRIED:
        return usable
    stages = [[p for p in usable if p.stage == stage] for stage in ("", *STAGES)]
    left, kept = MOST_TRIED, []
    for done, poses in enumerate(sorted(stages, key=len)):
        most = left // (len(stages) - done)
        kept += poses if len(poses) <= most else poses[:: -(-len(poses) // max(most, 1))]
        left = MOST_TRIED - len(kept)
    return kept


def ends_of(
    cell: Cell, plan: PlanData | None, goal: GoalReport
) -> tuple[int, Array, Array | None] | None:
    """The goal's part, where it stands before, and where it is to go if that is known."""
    if not 0 <= goal.goal < len(cell.task):
        return None
    wanted = cell.task[goal.goal]
    part = cell.part_names().index(wanted.part)
    origin, destination = cell.parts[part].pose, wanted.at
    for earlier in cell.task[: goal.goal]:
        if earlier.part == wanted.part and earlier.at is not None:
            origin = earlier.at
    if plan is not None and plan.steps:
        carries, _ = find_carries(plan, cell)
        own = [c for c in carries if c.goal == goal.goal and c.part == wanted.part]
        if own:
            origin, destination = own[0].origin, own[-1].put
    return part, origin, destination
