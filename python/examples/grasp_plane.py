"""A hand in the grasp plane of a pair of faces, as figures show it: from the side, world z up.

The grid is filled as the local planner fills it: layer by layer, with what of each body lies within
the extent of one piece of the hand along the plane's normal.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from handey import _core
from handey.drawing.marks import Area, Cells, Line, Paint

DEEP = 2.0  # more than anything reaches out of the plane [m]
LARGEST_JUMP = 0.15  # of a joint from step to step [rad]

FILLED = Paint("#9aa4b0", label="filled cells in a finger's layer")
PALM_ONLY = Paint("#d9dde2", label="filled cells in the palm's layer only")


@dataclass(frozen=True)
class PlaneScene:
    """A cell whose first part is to be grasped by a pair of faces; their plane stands upright.

    Attributes:
        cell: as it is at the start.
        X_WP_goal: where the part is to go, (4, 4).
        pair: with the grasp plane.
        outline: of the open hand.
        opening: between the pads [m].
    """

    cell: _core.Cell
    X_WP_goal: np.ndarray
    pair: _core.RankedPair
    outline: _core.GripperOutline
    opening: float

    @property
    def X_WG(self) -> np.ndarray:
        """The grasp plane in the world."""
        return self.cell.parts[0].X_WB @ self.pair.pair.X_PG

    @property
    def turn(self) -> np.ndarray:
        """Rows: along and up, in x and y of G, (2, 2)."""
        up = self.X_WG[2, :2]
        return np.array([[up[1], -up[0]], up])

    def seen(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) of G as (along, height above z = 0 of the world) [m]."""
        return np.asarray(points) @ self.turn.T + [0.0, self.X_WG[2, 3]]

    def hand_at(self, place: Sequence[float], direction: float) -> _core.PlanarPose:
        """A hand pose from a place beside the part's middle and a direction, as seen."""
        x, y = np.asarray(place) @ self.turn
        angle = np.radians(direction)
        c, s = np.array([np.cos(angle), np.sin(angle)]) @ self.turn
        return _core.PlanarPose(x=x, y=y, theta=float(np.arctan2(s, c)))

    def hand(self, pose: _core.PlanarPose, paint: Paint) -> list[Area]:
        """The pieces of the hand at a pose."""
        return [Area([self.seen(placed(p.polygon, pose))], paint) for p in self.outline.pieces]

    def shadow(self, body: _core.Body, X_WB: np.ndarray | None = None) -> list[np.ndarray]:
        """Loops of a body seen from the side, where it stands or elsewhere."""
        X_GB = np.linalg.inv(self.X_WG) @ (body.X_WB if X_WB is None else X_WB)
        seen = [_core.slab_projection(shape, X_GB, -DEEP, DEEP) for shape in body.shapes]
        return [self.seen(loop) for loop in _core.unite(seen).loops]

    def grid(
        self, half_size: float, cell: float, moved: Sequence[tuple[_core.Body, np.ndarray]] = ()
    ) -> _core.MotionGrid:
        """The motion grid about the part's middle; `moved` are bodies with other poses besides."""
        layers = self.outline.pieces
        grid = _core.MotionGrid([0.0, 0.0], half_size, cell, len(layers))
        standing = [(body, body.X_WB) for body in [*self.cell.fixtures, *self.cell.parts]]
        for body, X_WB in [*standing, *moved]:
            X_GB = np.linalg.inv(self.X_WG) @ X_WB
            for index, piece in enumerate(layers):
                for shape in body.shapes:
                    region = _core.slab_projection(shape, X_GB, piece.lower, piece.upper)
                    grid.fill(index, region)
        return grid

    def cells(self, grid: _core.MotionGrid) -> Cells:
        """The filled cells, those in the layers of fingers apart from those in the palm's only."""
        layers = np.array([grid.filled(index) for index in range(grid.layers)])
        across = np.array([piece.lower < 0 < piece.upper for piece in self.outline.pieces])
        kinds = np.where(layers[~across].any(axis=0), 1, 2 * layers[across].any(axis=0))
        corner = self.seen(np.array([grid.centre - grid.half_size]))[0]
        if self.turn[0, 0] < 0:  # the plane's axes point left and down
            kinds, corner = kinds[::-1, ::-1], corner - grid.side * grid.cell
        size = (grid.cell, grid.cell)
        return Cells(kinds, (corner[0], corner[1]), size, [Paint(), FILLED, PALM_ONLY])


def plane_scene(
    cell: _core.Cell, X_WP_goal: np.ndarray, clearance: float = 0.008, flipped: bool = False
) -> PlaneScene:
    """The best pair of faces of the cell's first part, and the hand open that much wider."""
    pair = _core.rank_grasps(cell, 0, X_WP_goal).ranked[0]
    opening = pair.pair.width + 2 * clearance
    outline = _core.gripper_outline(cell.robot, opening, flipped)
    return PlaneScene(cell, X_WP_goal, pair, outline, opening)


class ArmFollows:
    """May the hand be there? The arm follows in its branch and meets nothing."""

    def __init__(self, scene: PlaneScene) -> None:
        self.scene = scene
        self.solver = _core.SphericalWristSolver(scene.cell.robot)
        model = _core.make_collision_model(scene.cell)
        self.checker = _core.CollisionChecker(model, scene.cell)
        self.q: np.ndarray | None = None

    def solutions(self, pose: _core.PlanarPose) -> list[np.ndarray]:
        """Configurations without collision that put the hand there."""
        X_WH = self.scene.X_WG @ _core.hand_in_plane(pose, False)
        X_RH = np.linalg.inv(self.scene.cell.X_WR) @ X_WH
        found = [solution.q for solution in self.solver.solve(X_RH, self.q).solutions]
        return [q for q in found if self.checker.is_free(self._with_opening(q))]

    def __call__(self, pose: _core.PlanarPose) -> bool:
        """The reach test of a slide."""
        for q in self.solutions(pose):
            if self.q is None or np.abs(q - self.q).max() <= LARGEST_JUMP:
                self.q = q
                return True
        return False

    def _with_opening(self, q: np.ndarray) -> _core.Configuration:
        return _core.Configuration(q=q, opening=self.scene.opening)


def slide(
    scene: PlaneScene,
    grid: _core.MotionGrid,
    start: _core.PlanarPose,
    target: _core.PlanarPose,
    clearance: float,
) -> _core.SlideResult:
    """The slide of the arm's branch that comes nearest to the target."""
    arm, best = ArmFollows(scene), None
    options = _core.QuasipotentialOptions(clearance=clearance)
    goal = np.array([target.x, target.y])
    for q in arm.solutions(start):
        arm.q = q
        result = _core.slide_to_target(grid, scene.outline, start, goal, arm, options)
        end = result.path[-1] if result.path else start
        left = float(np.hypot(end.x - target.x, end.y - target.y))
        if best is None or left < best[0]:
            best = (left, result)
    if best is None:
        raise RuntimeError("the arm cannot stand at the start of the slide")
    return best[1]


def placed(points: np.ndarray, pose: _core.PlanarPose) -> np.ndarray:
    """Points in hand coordinates (n, 2), the hand at a pose of the grasp plane, in G."""
    c, s = np.cos(pose.theta), np.sin(pose.theta)
    return np.asarray(points) @ np.array([[c, s], [-s, c]]) + [pose.x, pose.y]


def arrow(start: np.ndarray, end: np.ndarray, head: float, paint: Paint) -> Line:
    """An arrow between two places; the length of its head in the same units."""
    along = (end - start) / np.linalg.norm(end - start)
    across = np.array([-along[1], along[0]])
    barbs = [end - head * along + side * 0.5 * head * across for side in (1, -1)]
    return Line([np.array([start, end]), np.array([barbs[0], end, barbs[1]])], paint)


def hatched(loops: Sequence[np.ndarray], apart: float, paint: Paint) -> Line:
    """Slanted lines within a region, so far apart; they may be drawn over others."""
    corners = np.concatenate([np.asarray(loop) for loop in loops])
    low, high = corners.min(axis=0), corners.max(axis=0)
    thin, pieces = np.array([1e-3 * apart, 0.0]), []
    for level in np.arange(low.sum(), high.sum(), apart * np.sqrt(2.0)):
        a, b = np.array([level - low[1], low[1]]), np.array([level - high[1], high[1]])
        strip = np.array([a, a + thin, b + thin, b])
        for loop in _core.intersect(_core.Region(list(loops)), _core.Region([strip])).loops:
            heights = loop[:, 1]
            pieces.append(np.array([loop[heights.argmin()], loop[heights.argmax()]]))
    return Line(pieces, paint)
