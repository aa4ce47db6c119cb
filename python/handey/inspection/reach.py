"""Where does the hand get: how far out at which height, pointing down or level?

The hand is put at points of one upright half-plane through the first axis, in the direction in
which most of them are reached, pointing straight down or straight out, turned about its own axis
in steps. A point counts as reached if one turn has a configuration within the joint limits in which
the robot is clear of itself; the cell is not looked at. Sampled: nothing is said between samples.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from handey import _core

__all__ = ["BESIDE_ITSELF", "FREE", "OUT", "POINTINGS", "Reach", "ReachRow", "sample_reach"]

OUT, BESIDE_ITSELF, FREE = 0, 1, 2  # no configuration; each meets the robot itself; reached
POINTINGS = ("down", "level")
TURNS = 8  # Choice: of the hand about its own axis, an eighth of a turn apart
FINE, COARSE = 0.01, 0.025  # Choice: between samples of the table, and of the picture [m]
ROWS = 12  # Choice: heights of the table, at most about so many
FAR_OUT = 0.05  # Choice: turning the hand about its own axis moves the wrist by less [m]
_MISSED = (
    _core.InverseStatus.TooFar,
    _core.InverseStatus.TooClose,
    _core.InverseStatus.InsideShoulderCylinder,
)


@dataclass(frozen=True)
class ReachRow:
    """How far out the hand gets at a height.

    Attributes:
        height: above the robot's root frame [m].
        ranges: by pointing, from and to, the gaps left out [m].
    """

    height: float
    ranges: dict[str, list[tuple[float, float]]]

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "height_m": self.height,
            **{
                f"{pointing}_m": [list(r) for r in found] for pointing, found in self.ranges.items()
            },
        }


@dataclass(frozen=True)
class Reach:
    """What was sampled.

    Attributes:
        azimuth: direction of the half-plane about z of the root frame [rad].
        axis: x, y of the line from which radii count [m].
        rows: lowest first.
        radii, heights: of the picture's samples [m]; empty without a picture.
        kinds: by pointing (heights, radii) of OUT, BESIDE_ITSELF, FREE.
    """

    azimuth: float
    axis: tuple[float, float]
    rows: tuple[ReachRow, ...]
    radii: np.ndarray
    heights: np.ndarray
    kinds: dict[str, np.ndarray]

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "azimuth_rad": self.azimuth,
            "axis_m": list(self.axis),
            "rows": [row.as_dict() for row in self.rows],
        }


def sample_reach(
    robot: _core.Robot, solver: _core.SphericalWristSolver, picture: bool = False
) -> Reach:
    """Where the hand of a robot gets.

    Args:
        robot: alone, no cell about it.
        solver: of the same robot.
        picture: sample the whole half-plane too.
    """
    cell = _core.Cell(robot=robot, start=_core.Configuration(robot.home, robot.gripper.max_opening))
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    axis, shoulder = _first_axis(robot)
    probe = _Probe(robot, solver, checker, axis)
    ball = _core.reach_ball(cell)
    outer = ball.radius + float(np.hypot(*(np.asarray(ball.centre)[:2] - axis)))
    azimuth = probe.best_azimuth(shoulder, outer)
    lower, upper = ball.centre[2] - outer, ball.centre[2] + outer
    step = _round_step((upper - lower) / ROWS)
    rows = []
    for index in range(math.ceil(lower / step), math.floor(upper / step) + 1):
        row = probe.row(index * step, outer, azimuth)
        if any(row.ranges.values()):
            rows.append(row)
    radii = heights = np.zeros(0)
    kinds: dict[str, np.ndarray] = {}
    if picture:
        radii = np.arange(0.0, outer + COARSE, COARSE)
        heights = np.arange(lower, upper + COARSE, COARSE)
        kinds = {pointing: probe.plane(radii, heights, azimuth, pointing) for pointing in POINTINGS}
    return Reach(azimuth, (float(axis[0]), float(axis[1])), tuple(rows), radii, heights, kinds)


def _first_axis(robot: _core.Robot) -> tuple[np.ndarray, float]:
    """x, y of the first axis if it is upright, else of the root frame; height of the second."""
    start = _core.Configuration(np.zeros(robot.dof), robot.gripper.max_opening)
    poses = _core.body_poses(robot, start)
    frames = [np.asarray(poses[joint.parent]) @ np.asarray(joint.X_PJ) for joint in robot.joints]
    upright = abs((frames[0][:3, :3] @ np.asarray(robot.joints[0].axis))[2]) > 0.999
    height = frames[1][2, 3] if len(frames) > 1 else frames[0][2, 3]
    return (frames[0][:2, 3] if upright else np.zeros(2)), float(height)


def _round_step(least: float) -> float:
    """A round number of metres, not less than `least`."""
    decade = 10.0 ** math.floor(math.log10(least))
    return float(next(decade * s for s in (1, 2, 5, 10) if decade * s >= least * 0.999))


class _Probe:
    """Asks for one hand pose after the other."""

    def __init__(
        self,
        robot: _core.Robot,
        solver: _core.SphericalWristSolver,
        checker: _core.CollisionChecker,
        axis: np.ndarray,
    ) -> None:
        self._robot, self._solver, self._checker, self._axis = robot, solver, checker, axis

    def kind(self, radius: float, height: float, azimuth: float, pointing: str) -> int:
        """OUT, BESIDE_ITSELF or FREE."""
        X_RH = np.eye(4)
        out = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        X_RH[:3, 3] = [*(self._axis + radius * out[:2]), height]
        z = -np.array([0.0, 0.0, 1.0]) if pointing == "down" else out
        across = np.array([-out[1], out[0], 0.0])
        third = np.cross(z, across)
        best = OUT
        for turn in np.arange(TURNS) * (2 * math.pi / TURNS):
            y = math.cos(turn) * across + math.sin(turn) * third
            X_RH[:3, :3] = np.column_stack([np.cross(y, z), y, z])
            found = self._solver.solve(X_RH, self._robot.home)
            if found.status in _MISSED and found.excess > FAR_OUT:
                return best  # however the hand is turned
            for solution in found.solutions:
                stance = _core.Configuration(solution.q, self._robot.gripper.max_opening)
                if self._checker.is_free(stance):
                    return FREE
                best = BESIDE_ITSELF
        return best

    def plane(
        self, radii: np.ndarray, heights: np.ndarray, azimuth: float, pointing: str
    ) -> np.ndarray:
        """Kinds (heights, radii)."""
        return np.array([[self.kind(r, z, azimuth, pointing) for r in radii] for z in heights])

    def best_azimuth(self, height: float, outer: float) -> float:
        """Straight on, or another of eight directions in which clearly more is reached."""
        radii = np.linspace(0.1, 1.0, 10) * outer
        heights = height + np.array([-0.5, -0.25, 0.0, 0.25]) * outer

        def reached(azimuth: float) -> int:
            planes = [self.plane(radii, heights, azimuth, pointing) for pointing in POINTINGS]
            return int(sum((plane == FREE).sum() for plane in planes))

        sides = [math.radians(degrees) for degrees in (45, -45, 90, -90, 135, -135, 180)]
        best = max(sides, key=reached)
        return best if reached(best) > 1.2 * reached(0.0) else 0.0  # Choice: a fifth more

    def row(self, height: float, outer: float, azimuth: float) -> ReachRow:
        """The ranges of radii at a height."""
        radii = np.arange(0.0, outer + FINE, FINE)
        ranges = {}
        for pointing in POINTINGS:
            kinds = self.plane(radii, np.array([height]), azimuth, pointing)[0]
            ranges[pointing] = _runs(radii, kinds == FREE)
        return ReachRow(round(height, 9), ranges)


def _runs(values: np.ndarray, mask: np.ndarray) -> list[tuple[float, float]]:
    """First and last value of each run of a mask."""
    steps = np.flatnonzero(np.diff(np.concatenate(([0], mask.astype(np.int8), [0]))))
    return [
        (round(float(values[first]), 9), round(float(values[end - 1]), 9))
        for first, end in zip(steps[::2], steps[1::2], strict=True)
    ]
