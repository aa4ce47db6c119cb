"""The grasp plane of an approach as a picture: filled cells, the part, the hand and its bump lines.

Seen along the closing axis, world z up as far as the plane allows. The grid is filled as the local
planner fills it: for each piece of the hand with what of each body lies within the piece's extent
along the plane's normal. The hand follows the time line; a bump line that touches is red.
Article: "Local planning: the quasipotential method", Figure 5.
"""

from __future__ import annotations

import html
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.drawing.marks import Area, Cells, Line, Mark, Paint, number
from handey.errors import InvalidInput

__all__ = ["HandPose", "PlanePicture", "plane_picture"]

CELL, CLEARANCE = 0.004, 0.006  # of the local planner, by default [m]
LEAST, MOST, ROOM = 0.09, 0.20, 0.07  # half size of the picture; about the hand's path [m]
DEEP = 2.0  # more than anything reaches out of the plane [m]
WIDTH = 360.0  # of the picture [picture units]
FILLED = Paint("var(--cell)")
PALM_ONLY = Paint("var(--cell-faint)")
PART = Paint("var(--plane-part)", "var(--plane-part-edge)", 1.0, opacity=0.75)
PATH = Paint(stroke="var(--accent)", width=1.4, dash="4 3")


@dataclass(frozen=True)
class HandPose:
    """A hand pose of the approach.

    Attributes:
        time: on the plan's clock [s].
        X_WH: the grasp frame in the world (4, 4).
    """

    time: float
    X_WH: np.ndarray


@dataclass
class PlanePicture:
    """The picture, and what it says in words.

    Attributes:
        svg: the element; its attribute data-poses holds where the hand is when.
        off_plane: how far the hand is out of the plane at most [m].
        touching: how many bump lines touch at the grasp.
        lines: how many there are.
    """

    svg: str
    off_plane: float = 0.0
    touching: int = 0
    lines: int = 0


@dataclass
class _View:
    """The plane in the world, and the picture's frame about its origin."""

    X_WG: np.ndarray
    half: float
    scale: float = field(init=False)

    def __post_init__(self) -> None:
        self.scale = WIDTH / (2 * self.half)

    def to_picture(self, points: np.ndarray) -> np.ndarray:
        return np.asarray((np.asarray(points) * [1, -1] + self.half) * self.scale)

    def planar(self, X_WH: np.ndarray) -> _core.PlanarPose:
        X_GH = np.linalg.inv(self.X_WG) @ X_WH
        theta = math.atan2(X_GH[1, 2], X_GH[0, 2])
        return _core.PlanarPose(x=X_GH[0, 3], y=X_GH[1, 3], theta=theta)

    def transform(self, pose: _core.PlanarPose) -> str:
        """Of hand coordinates [m], first along the approach, to the picture."""
        c, s = self.scale * math.cos(pose.theta), self.scale * math.sin(pose.theta)
        ((x, y),) = self.to_picture(np.array([[pose.x, pose.y]]))
        return f"matrix({','.join(number(v) for v in (c, -s, -s, -c, x, y))})"


def plane_picture(
    cell: _core.Cell, part: int, opening: float, poses: Sequence[HandPose]
) -> PlanePicture | None:
    """The grasp plane of the last pose, and the hand at all of them.

    Args:
        cell: as it is while the hand comes in.
        part: index of the part that is grasped.
        opening: of the jaws [m].
        poses: the last one is the grasp.

    Returns:
        None where the cell has shapes that cannot be cut.
    """
    view = _view(poses)
    try:
        outline = _core.gripper_outline(cell.robot, opening, False)
        grid = _grid(cell, view, outline)
        shadow = _shadow(cell.parts[part], view)
    except InvalidInput:
        return None
    lines = _core.bump_lines(outline, CLEARANCE)
    X_GW = np.linalg.inv(view.X_WG)
    off_plane = max(abs(float((X_GW @ pose.X_WH)[2, 3])) for pose in poses)
    path = np.array([(X_GW @ pose.X_WH)[:2, 3] for pose in poses])
    hits = [_touching(grid, lines, view.planar(pose.X_WH)) for pose in poses]
    steps = [
        [round(pose.time, 3), view.transform(view.planar(pose.X_WH)), hit]
        for pose, hit in zip(poses, hits, strict=True)
    ]
    marks: list[Mark] = [_cells(grid, outline), Area(shadow, PART)]
    drawn = [line for mark in marks for line in mark.svg(view.to_picture)]
    if len(poses) > 1:
        drawn += Line([path], PATH).svg(view.to_picture)
    content = [*drawn, *_hand(outline, lines, steps[-1]), _target(), _scale_bar(view)]
    size = number(WIDTH)
    told = html.escape(json.dumps(steps, separators=(",", ":")))
    head = f'<svg viewBox="0 0 {size} {size}" role="img" data-poses="{told}"'
    title = "The grasp plane with the hand and its bump lines"
    svg = "\n".join([f'{head} aria-label="{title}">', *content, "</svg>"])
    return PlanePicture(svg, off_plane, hits[-1].count("1"), len(lines))


def _view(poses: Sequence[HandPose]) -> _View:
    """The plane through the grasp, its normal the closing axis, upright as far as may be."""
    X_WH = poses[-1].X_WH
    normal = X_WH[:3, 1]
    up = np.array([0.0, 0.0, 1.0]) if abs(normal[2]) < 0.9 else -X_WH[:3, 2]
    up = up - (up @ normal) * normal
    up /= np.linalg.norm(up)
    X_WG = np.eye(4)
    X_WG[:3, :3] = np.column_stack([np.cross(up, normal), up, normal])
    X_WG[:3, 3] = X_WH[:3, 3]
    far = max(float(np.linalg.norm(pose.X_WH[:3, 3] - X_WH[:3, 3])) for pose in poses)
    return _View(X_WG, min(max(far + ROOM, LEAST), MOST))


def _grid(cell: _core.Cell, view: _View, outline: _core.GripperOutline) -> _core.MotionGrid:
    grid = _core.MotionGrid([0.0, 0.0], view.half, CELL, len(outline.pieces))
    for body in [*cell.fixtures, *cell.parts]:
        X_GB = np.linalg.inv(view.X_WG) @ body.X_WB
        for index, piece in enumerate(outline.pieces):
            for shape in body.shapes:
                grid.fill(index, _core.slab_projection(shape, X_GB, piece.lower, piece.upper))
    return grid


def _cells(grid: _core.MotionGrid, outline: _core.GripperOutline) -> Cells:
    """The filled cells, those in the layers of fingers apart from those in the palm's only."""
    layers = np.array([grid.filled(index) for index in range(grid.layers)])
    across = np.array([piece.lower < 0 < piece.upper for piece in outline.pieces])
    kinds = np.where(layers[~across].any(axis=0), 1, 2 * layers[across].any(axis=0))
    corner = np.asarray(grid.centre) - grid.side * grid.cell / 2
    size = (grid.cell, grid.cell)
    return Cells(kinds, (corner[0], corner[1]), size, [Paint(), FILLED, PALM_ONLY])


def _shadow(body: _core.Body, view: _View) -> list[np.ndarray]:
    X_GB = np.linalg.inv(view.X_WG) @ body.X_WB
    seen = [_core.slab_projection(shape, X_GB, -DEEP, DEEP) for shape in body.shapes]
    return list(_core.unite(seen).loops)


def _touching(grid: _core.MotionGrid, lines: list[_core.BumpLine], pose: _core.PlanarPose) -> str:
    """For each bump line 1 if it touches a filled cell of its layer, else 0."""
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    turn, at = np.array([[c, -s], [s, c]]), np.array([pose.x, pose.y])
    return "".join(
        "1" if grid.touches(line.layer, turn @ line.a + at, turn @ line.b + at) else "0"
        for line in lines
    )


def _hand(
    outline: _core.GripperOutline, lines: list[_core.BumpLine], step: list[object]
) -> list[str]:
    """The hand and its bump lines in hand coordinates, where they are at the grasp."""
    _, transform, hits = step
    pieces = [_drawn(piece.polygon, True, "piece") for piece in outline.pieces]
    bumps = [
        _drawn(np.array([line.a, line.b]), False, "bump hit" if hit == "1" else "bump")
        for line, hit in zip(lines, str(hits), strict=True)
    ]
    return [f'<g class="hand" transform="{transform}">', *pieces, *bumps, "</g>"]


def _drawn(points: np.ndarray, closed: bool, kind: str) -> str:
    places = "L".join(f"{x:.4f} {y:.4f}" for x, y in np.asarray(points))
    path = f"M{places}{'z' if closed else ''}"
    return f'<path class="{kind}" vector-effect="non-scaling-stroke" d="{path}"/>'


def _target() -> str:
    half = number(WIDTH / 2)
    return f'<circle class="target" cx="{half}" cy="{half}" r="3.5"/>'


def _scale_bar(view: _View) -> str:
    length = number(0.02 * view.scale)
    return (
        f'<path class="ruler" d="M12 {number(WIDTH - 12)}h{length}"/>'
        f'<text x="12" y="{number(WIDTH - 18)}" font-size="11">20 mm</text>'
    )
