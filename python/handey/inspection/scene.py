"""What a page draws: meshes, the faces of a part, what its pairs touch, how it rests; reach as SVG.

Plain values for JSON, arrays packed as base64. More triangles than a page should hold are not sent:
the tables tell the same without a picture.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Cells, Paint
from handey.inspection.cell import CellReport
from handey.inspection.part import FaceFigures, PartReport
from handey.inspection.reach import COARSE, POINTINGS, Reach
from handey.inspection.robot import RobotReport
from handey.pages.meshes import creases, matrix, packed, unit_normals
from handey.task import PlaceAt

__all__ = ["MOST_PAIRS", "MOST_RESTS", "cell_scene", "part_scene", "reach_figure", "robot_scene"]

SAME_NORMAL, SAME_PLANE = 1e-5, 2e-5  # a triangle lies on a face; [-], [m]
MOST_TRIANGLES = 400_000  # Choice: some 10 MB of page
MOST_PAIRS, MOST_RESTS = 200, 24  # Choice: more are in the JSON
MOST_LINES = 4000  # Choice: of a goal's outline
PARTS = ("#e8743b", "#2f8fdd", "#3fae5a", "#d9a514", "#b45bd0", "#e0527f", "#14a5a0", "#8a6a48")
FIXTURE, LINK, HAND = "#b9c4cf", "#f4f2ee", "#6d7884"


class _Meshes:
    """The meshes of a page and the bodies made of them."""

    def __init__(self) -> None:
        self.list: list[dict[str, str]] = []
        self.bodies: list[dict[str, Any]] = []
        self._corners: list[np.ndarray] = []
        self._triangles = 0

    def add(
        self, name: str, mesh: tuple[np.ndarray, np.ndarray], pose: np.ndarray, colour: str,
        creased: bool = True, framed: bool = True,
    ) -> None:  # fmt: skip
        """A body of one mesh; one that is not `framed` may lie outside of the first view."""
        vertices, triangles = mesh
        self._triangles += len(triangles)
        if self._triangles > MOST_TRIANGLES or not len(triangles):
            return
        edges = creases(vertices, triangles) if creased else np.zeros((0, 2))
        body = {"name": name, "mesh": len(self.list), "pose": matrix(pose), "colour": colour}
        self.bodies.append(body | {"ghost": colour == FIXTURE})
        self.list.append(
            {"v": packed(vertices, "<f4"), "f": packed(triangles, "<u4"), "e": packed(edges, "<u4")}
        )
        if framed:
            self._corners.append(vertices @ pose[:3, :3].T + pose[:3, 3])

    def scene(self, turn: float) -> dict[str, Any]:
        """All of them, and how to look at them."""
        points = np.concatenate(self._corners) if self._corners else np.zeros((1, 3))
        centre = (points.min(0) + points.max(0)) / 2
        radius = float(np.linalg.norm(points - centre, axis=1).max()) or 1.0
        return {
            "meshes": self.list,
            "bodies": self.bodies,
            "centre": centre.tolist(),
            "radius": radius,
            "turn": turn,
        }


# -------------------------------------------------------------------------------------------- part


def part_scene(report: PartReport) -> dict[str, Any]:
    """A part with its faces, pairs, ways to rest and holes."""
    meshes = _Meshes()
    mesh = (report.vertices, report.triangles)
    meshes.add(report.name, mesh, np.eye(4), FIXTURE)
    scene = meshes.scene(math.radians(-55.0))
    if not meshes.bodies:
        return scene
    owner = _owners(report.vertices, report.triangles, report.faces)
    holes = [hole for surface in report.surfaces for hole in surface.holes]
    return scene | {
        "owner": packed(owner, "<i4"),
        "pairs": [_pair(pair, scene["radius"]) for pair in report.pairs[:MOST_PAIRS]],
        "rests": [_rest(rest) for rest in report.rests[:MOST_RESTS]],
        "holes": [segment.tolist() for hole in holes for segment in hole.segments],
    }


def _owners(
    vertices: np.ndarray, triangles: np.ndarray, faces: Sequence[FaceFigures]
) -> np.ndarray:
    """Index of the face on which each triangle lies, or -1."""
    normals, centres = unit_normals(vertices, triangles), vertices[triangles].mean(axis=1)
    owner = np.full(len(triangles), -1)
    for index, face in enumerate(faces):
        on = (normals @ face.normal > 1 - SAME_NORMAL) & (owner < 0)
        owner[on & (np.abs((centres - face.origin) @ face.normal) < SAME_PLANE)] = index
    return owner


def _pair(pair: _core.FeaturePair, radius: float) -> dict[str, Any]:
    """The faces of a pair, outlines of what the pads touch, and how they close."""
    X_PG = np.asarray(pair.X_PG)
    z = X_PG[:3, 2]
    outlines = {
        1: pair.contact_a.loops or pair.overlap.loops,
        -1: pair.contact_b.loops or pair.overlap.loops,
    }
    touched = {side: _on_feature(pair, loops, side) for side, loops in outlines.items()}
    length = 0.55 * radius
    arrows = []
    for side in (1, -1):
        middle = _middle(touched[side], X_PG[:3, 3] + side * pair.width / 2 * z)
        arrows.append([(middle + side * length * z).tolist(), middle.tolist()])
    return {
        "a": _face_index(pair.a),
        "b": _face_index(pair.b),
        "onA": [line.tolist() for line in touched[1]],
        "onB": [line.tolist() for line in touched[-1]],
        "arrows": arrows,
    }


def _on_feature(
    pair: _core.FeaturePair, loops: Sequence[np.ndarray], side: int
) -> list[np.ndarray]:
    """Loops of the grasp plane, closed, moved along the closing axis onto a feature."""
    X_PG = np.asarray(pair.X_PG)
    lines = []
    for loop in loops:
        points = np.vstack([loop, loop[:1]])
        half = (pair.width + points @ np.asarray(pair.taper)) / 2
        inside = np.column_stack([points, side * half])
        lines.append(inside @ X_PG[:3, :3].T + X_PG[:3, 3])
    return lines


def _middle(lines: Sequence[np.ndarray], otherwise: np.ndarray) -> np.ndarray:
    """Middle of the box about the longest line."""
    if not lines:
        return otherwise
    longest = max(lines, key=lambda line: float(np.ptp(line, axis=0).sum()))
    return np.asarray((longest.min(0) + longest.max(0)) / 2)


def _face_index(feature: _core.Feature) -> int | None:
    return feature.index if feature.kind == _core.FeatureKind.Face else None


def _rest(rest: _core.RestingPose) -> dict[str, Any]:
    foot = np.asarray(rest.footprint)
    closed = np.vstack([foot, foot[:1]]) if len(foot) else foot.reshape(0, 2)
    return {
        "pose": matrix(np.asarray(rest.X_SP)),
        "top": rest.top,
        "foot": np.column_stack([closed, np.zeros(len(closed))]).tolist(),
    }


# --------------------------------------------------------------------------------- robot and cell


def _add_robot(
    meshes: _Meshes, robot: _core.Robot, at: _core.Configuration, X_WR: np.ndarray
) -> None:
    hand = {robot.gripper.body, *(finger.child for finger in robot.gripper.fingers)}
    for index, (body, X_RB) in enumerate(
        zip(robot.bodies, _core.body_poses(robot, at), strict=True)
    ):
        for shape in body.shapes:
            colour = HAND if index in hand else LINK
            meshes.add(body.name, _triangles(shape), X_WR @ np.asarray(X_RB), colour)


def _triangles(shape: _core.Shape) -> tuple[np.ndarray, np.ndarray]:
    """A shape in its body's frame."""
    mesh = _core.tessellate(shape)
    return np.asarray(mesh.vertices), np.asarray(mesh.triangles)


def robot_scene(report: RobotReport) -> dict[str, Any]:
    """A robot at home."""
    meshes = _Meshes()
    robot = report.robot
    home = _core.Configuration(robot.home, robot.gripper.max_opening)
    _add_robot(meshes, robot, home, np.eye(4))
    scene = meshes.scene(math.radians(-40.0))
    return scene if meshes.bodies else scene | _sticks(robot, home)


def _sticks(robot: _core.Robot, at: _core.Configuration) -> dict[str, Any]:
    """Lines from joint to joint to the grasp point, for a robot without shapes."""
    poses = [np.asarray(X_RB) for X_RB in _core.body_poses(robot, at)]
    frames = [poses[joint.parent] @ np.asarray(joint.X_PJ) for joint in robot.joints]
    frames.append(np.asarray(_core.hand_pose(robot, at.q)))
    points = np.array([np.zeros(3), *(X[:3, 3] for X in frames)])
    centre = (points.min(0) + points.max(0)) / 2
    radius = float(np.linalg.norm(points - centre, axis=1).max()) or 1.0
    axes = []
    for joint, X in zip(robot.joints, frames, strict=False):
        half = 0.08 * radius * (X[:3, :3] @ np.asarray(joint.axis))
        axes.append([(X[:3, 3] - half).tolist(), (X[:3, 3] + half).tolist()])
    sticks = [points.tolist(), *axes]
    return {"sticks": sticks, "centre": centre.tolist(), "radius": radius}


def cell_scene(report: CellReport) -> dict[str, Any]:
    """A cell at its start; the first view is of its parts and of the robot."""
    meshes = _Meshes()
    cell = report.file.cell
    measured = {entry.name for entry in report.depth_maps}
    _add_robot(meshes, cell.robot, cell.start, np.asarray(cell.X_WR))
    for index, part in enumerate(cell.parts):
        colour = PARTS[index % len(PARTS)]
        for shape in part.shapes:
            meshes.add(part.name, _triangles(shape), np.asarray(part.X_WB), colour)
    for fixture in cell.fixtures:
        creased = fixture.name not in measured  # the steps between columns would blacken it
        for shape in fixture.shapes:
            meshes.add(
                fixture.name, _triangles(shape), np.asarray(fixture.X_WB), FIXTURE, creased, False
            )
    scene = meshes.scene(math.radians(-35.0))
    return scene | {"goals": _goals(report)}


def _goals(report: CellReport) -> list[dict[str, Any]]:
    """Crease edges of the parts at the goals that give a pose, in the colours of the parts."""
    drawn = []
    for index, goal in enumerate(report.file.goals):
        if not isinstance(goal, PlaceAt):
            continue
        part = report.file.cell.part_index(goal.part)
        lines = []
        for shape in report.file.cell.parts[part].shapes:
            vertices, triangles = _triangles(shape)
            placed = vertices @ goal.X_WP[:3, :3].T + goal.X_WP[:3, 3]
            lines += placed[creases(vertices, triangles)].tolist()
        colour = PARTS[part % len(PARTS)]
        drawn.append({"goal": index, "colour": colour, "lines": lines[:MOST_LINES]})
    return drawn


def reach_figure(reach: Reach) -> str:
    """Where the hand gets, as SVG: one panel for each way of pointing."""
    if not len(reach.radii):
        return ""
    used = np.any([kinds.any(axis=1) for kinds in reach.kinds.values()], axis=0)
    rows = np.flatnonzero(used)
    if not len(rows):
        return ""
    low, high = max(0, rows[0] - 2), min(len(reach.heights), rows[-1] + 3)
    paints = (
        Paint("#f4f6f8", label="not reached"),
        Paint("#f0c27a", label="only in collision with itself"),
        Paint("#58a86b", label="reached"),
    )
    panels = []
    for pointing in POINTINGS:
        title = "hand pointing down" if pointing == "down" else "hand level, pointing out"
        across = Axis("radius from axis 1 [m]", -COARSE / 2, reach.radii[-1] + COARSE / 2, False)
        bottom = float(reach.heights[low]) - COARSE / 2
        up = Axis("height [m]", bottom, float(reach.heights[high - 1]) + COARSE / 2, False)
        panel = Panel(title, across, up, 250.0, None)
        kinds = reach.kinds[pointing][low:high]
        panel.add(Cells(kinds, (-COARSE / 2, bottom), (COARSE, COARSE), paints))
        panels.append(panel)
    return Figure([panels], title="reach of the hand", shared_axes=True).svg()
