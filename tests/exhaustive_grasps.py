"""Both ends of a direct goal, and every hand pose on a fine lattice that is legal at both.

Legal as a valid plan needs it, and no more: some of a pad on the faces, inverse kinematics, the
open hand free and free to close. Nothing is ranked: the lattice comes in random order. Frames as
in handey: W world, R robot, P part, H hand, G grasp plane.
"""

from __future__ import annotations

import dataclasses
import math
import time
from collections import Counter
from collections.abc import Iterator

import numpy as np

import handey
from handey import _core

SPACING = 0.006  # of hand poses in the grasp plane [m]
TURNS = 72  # directions of the hand in the grasp plane
LEAST_CONTACT = 30e-6  # of a pad on the faces; a valid plan needs 25 mm2 [m2]
CLEARANCES = (0.008, 0.004, 0.002, 0.001)  # of the open pads, each side; and the widest opening [m]
NEAR = 3e-4  # of the pads to the faces before the contact itself [m]


class OutOfTime(Exception):
    """The search is cut off."""


class Stopwatch:
    """Raises OutOfTime once so many seconds of the processor have gone."""

    def __init__(self, seconds: float) -> None:
        self.begin, self.seconds = time.process_time(), seconds

    @property
    def passed(self) -> float:
        return time.process_time() - self.begin

    def respect(self) -> None:
        if self.passed > self.seconds:
            raise OutOfTime


class Ends:
    """The cell as it is at the start and, with the part at its goal, at the end."""

    def __init__(self, cell_file: handey.CellFile) -> None:
        goal = cell_file.goals[0]
        self.name, self.cell = goal.part, cell_file.cell
        self.part = self.cell.part_index(goal.part)
        self.X_WP, self.X_WP_goal = self.cell.parts[self.part].X_WB, goal.X_WP
        self.goal_cell = self.cell.with_part_at(self.part, self.X_WP_goal)
        self.robot, self.gripper = self.cell.robot, self.cell.robot.gripper
        fingers = [self.robot.bodies[finger.child].name for finger in self.gripper.fingers]
        self.hand = {self.robot.bodies[self.gripper.body].name, *fingers}
        self.model = _core.make_collision_model(self.cell)
        self.solver = _core.SphericalWristSolver(self.robot)
        self.X_RW = np.linalg.inv(self.cell.X_WR)
        self.before = _core.CollisionChecker(self.model, self.cell)
        self.after = _core.CollisionChecker(self.model, self.goal_cell)

    def solve(self, X_WH: np.ndarray) -> list[np.ndarray]:
        """All configurations that put the hand there."""
        return [solution.q for solution in self.solver.solve(self.X_RW @ X_WH).solutions]


@dataclasses.dataclass(frozen=True)
class Grasp:
    """A hand pose legal at both ends."""

    pair: int
    in_plane: _core.PlanarPose
    flipped: bool
    width: float
    opening: float
    contact: float
    X_PH: np.ndarray
    q_pick: list[np.ndarray]
    q_place: list[np.ndarray]


class Lattice:
    """Legal grasps of all feature pairs, in random order; counts say where hand poses fell."""

    def __init__(
        self, ends: Ends, watch: Stopwatch, seed: int, least_contact: float = LEAST_CONTACT
    ) -> None:
        self.ends, self.watch, self.least_contact = ends, watch, least_contact
        self.rng, self.counts = np.random.default_rng(seed), Counter()
        features = _core.find_feature_pairs(ends.cell.parts[ends.part], ends.gripper)
        self.pairs = list(features.pairs)
        closed = _core.Allowance(closed_on=ends.part)
        self.closed_before = _core.CollisionChecker(ends.model, ends.cell, closed)
        self.closed_after = _core.CollisionChecker(ends.model, ends.goal_cell, closed)

    def poses(self) -> Iterator[tuple[int, _core.PlanarPose, bool]]:
        """All hand poses of all feature pairs, in random order."""
        poses = []
        for index, pair in enumerate(self.pairs):
            corners = np.concatenate([np.asarray(loop) for loop in pair.overlap.loops])
            reach = self.ends.gripper.pad_length / 2
            low, high = corners.min(axis=0) - reach, corners.max(axis=0) + reach
            for x in np.arange(low[0], high[0] + SPACING, SPACING):
                for y in np.arange(low[1], high[1] + SPACING, SPACING):
                    poses += [(index, x, y, k, f) for k in range(TURNS) for f in (False, True)]
        self.rng.shuffle(poses)
        for index, x, y, k, flipped in poses:
            theta = 2 * math.pi * k / TURNS
            yield int(index), _core.PlanarPose(x=x, y=y, theta=theta), bool(flipped)

    def grasps(self) -> Iterator[Grasp]:
        """The legal ones."""
        ends, counts = self.ends, self.counts
        for index, pose, flipped in self.poses():
            self.watch.respect()
            counts["tried"] += 1
            pair = self.pairs[index]
            contact = _core.pad_contact_area(pair.overlap, pose, self.ends.gripper)
            if contact < self.least_contact:
                counts["with too little contact"] += 1
                continue
            X_PH = pair.X_PG @ _core.hand_in_plane(pose, flipped)
            width = pair.width_at([pose.x, pose.y])
            picks = ends.solve(ends.X_WP @ X_PH)
            places = ends.solve(ends.X_WP_goal @ X_PH)
            if not picks or not places:
                counts["out of reach"] += 1
                continue
            where = "origin"
            for opening in self.openings(width):
                q_pick = self.legal(ends.before, self.closed_before, picks, opening, width)
                if not q_pick:
                    continue
                where = "destination" if where == "origin" else where
                q_place = self.legal(ends.after, self.closed_after, places, opening, width)
                if not q_place:
                    continue
                where = ""
                yield Grasp(index, pose, flipped, width, opening, contact, X_PH, q_pick, q_place)
            counts[f"in collision at the {where}" if where else "legal"] += 1

    def openings(self, width: float) -> list[float]:
        most = self.ends.gripper.max_opening
        return [most, *(width + 2 * c for c in CLEARANCES if width + 2 * c < most)]

    def legal(
        self,
        checker: _core.CollisionChecker,
        closed: _core.CollisionChecker,
        solutions: list[np.ndarray],
        opening: float,
        width: float,
    ) -> list[np.ndarray]:
        """Configurations in which the open hand is free and may close."""
        found = []
        for q in solutions:
            at_opening = _core.Configuration(q=q, opening=opening)
            hit = checker.find_hit(at_opening)
            if hit is not None:
                if hit.a in self.ends.hand and hit.b not in self.ends.hand:
                    return found  # the hand stands there whatever the arm does
                continue
            nearly = _core.Configuration(q=q, opening=width + 2 * NEAR)
            shut = _core.Configuration(q=q, opening=width)
            if not _core.certify_edge(checker, at_opening, nearly).is_free:
                return found
            if not _core.certify_edge(closed, at_opening, shut).is_free:
                return found
            found.append(q)
        return found
