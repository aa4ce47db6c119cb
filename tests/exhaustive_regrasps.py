"""The least number of regrasps by brute force, to judge the planner by.

Grasps on a fine lattice (every feature pair, 48 directions, every 10 mm) and places on a lattice
(every resting pose, every 5 cm of every support, every 15 degrees), in random order, until time is
up. No ranking, no score and no sequence of the planner takes part; motions are not planned, so the
number is a lower bound over the lattice. Not guaranteed: that finer lattices have no fewer.

    python tests/exhaustive_regrasps.py CELL [--seconds 60]
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import handey
from handey import _core
from handey.placement import examine_standing

LEGALITY = _core.LegalityOptions(directions=48, spacing=0.010, least_contact_share=0.15)
MOST_GRASPS = 12000
STEP, TURNS = 0.05, 24  # of the lattice of places [m], [-]
REACH = 0.95  # farther from the base nothing can be put down [m]


class Search:
    """One goal of one cell."""

    def __init__(self, path: Path, seed: int = 0) -> None:
        cell_file = handey.load_cell(path)
        goal = cell_file.goals[0]
        self.cell = cell_file.cell
        self.part = self.cell.part_index(goal.part)
        self.body = self.cell.parts[self.part]
        self.model = _core.make_collision_model(self.cell)
        self.solver = _core.SphericalWristSolver(self.cell.robot)
        self.rng = np.random.default_rng(seed)
        self.grasps = _core.sample_part_grasps(
            self.body, self.cell.robot, legality=LEGALITY, most=MOST_GRASPS
        )
        self.every = np.arange(len(self.grasps))
        self.start = self.legal(self.body.X_WB, self.every)
        self.goal = self.legal(goal.X_WP, self.every)

    def legal(self, X_WP: np.ndarray, among: np.ndarray) -> frozenset[int]:
        found = _core.find_compatible_grasps(
            self.model, self.cell, self.part, self.solver, self.grasps, [among.tolist()],
            X_WP[None], configurations=1,
        )[0]  # fmt: skip
        return frozenset(item.grasp for item in found.legal)

    def places(self) -> Iterator[tuple[int, np.ndarray]]:
        """Where the part stands on supports alone and touches nothing else; in random order."""
        others = [body for i, body in enumerate(self.cell.parts) if i != self.part]
        rests = _core.resting_poses(self.body)
        lattice = []
        for body in [*self.cell.fixtures, *others]:
            for face in _core.support_faces(body) if body.support else ():
                corners = np.concatenate([np.asarray(loop) for loop in face.region.loops])
                low, high = corners.min(axis=0), corners.max(axis=0)
                for x in np.arange(low[0], high[0] + 1e-9, STEP):
                    for y in np.arange(low[1], high[1] + 1e-9, STEP):
                        point = face.X_WS @ np.array([x, y, 0.0, 1.0])
                        if np.linalg.norm((point[:3] - self.cell.X_WR[:3, 3])[:2]) < REACH:
                            lattice.append(point[:3])
        keys = [
            (k, i, j) for k in range(len(rests)) for i in range(len(lattice)) for j in range(TURNS)
        ]
        for k, i, j in self.rng.permutation(keys):
            angle = 2 * np.pi * j / TURNS
            X_WS = np.eye(4)
            X_WS[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
            X_WS[:3, 3] = lattice[i]
            X_WP = X_WS @ rests[k].X_SP
            if self.stands(X_WP):
                yield int(k), X_WP

    def stands(self, X_WP: np.ndarray) -> bool:
        there = self.cell.with_part_at(self.part, X_WP)
        near = _core.touching_bodies(self.model, there, self.part)
        if any(not there.body(ref).support for ref in near) or not near:
            return False
        if any(self.part in (o.a.index, o.b.index) for o in _core.find_overlaps(self.model, there)):
            return False
        return examine_standing(self.cell, self.part, X_WP, near).stable

    def least(self, seconds: float) -> int:
        """The least number found; -1 if none was in this time."""
        if self.start & self.goal:
            return 0
        if not self.start or not self.goal:
            return -1
        clear = [
            np.flatnonzero(_core.clears_plane(self.cell.robot, self.grasps, rest.X_SP, LEGALITY))
            for rest in _core.resting_poses(self.body)
        ]
        ends = self.start | self.goal
        seen: list[frozenset[int]] = []
        stop = time.process_time() + seconds
        for k, X_WP in self.places():
            if time.process_time() > stop:
                break
            # First those that one put-down needs; all of them only where some are legal.
            at_ends = self.legal(X_WP, np.array([g for g in clear[k] if g in ends], dtype=int))
            if at_ends & self.start and at_ends & self.goal:
                return 1
            if len(seen) < 200:
                seen.append(at_ends | self.legal(X_WP, self.rng.permutation(clear[k])[:1500]))
        return self.chain(seen)

    def chain(self, seen: list[frozenset[int]]) -> int:
        """The least number through the places seen."""
        held = self.start
        for regrasps in range(1, 5):
            held = held.union(*(place for place in seen if place & held))
            if held & self.goal:
                return regrasps
        return -1


def least(path: Path, seconds: float, seed: int = 0) -> int:
    """The least number of regrasps for the first goal of a cell; -1 if no way was found."""
    return Search(path, seed).least(seconds)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cell", type=Path)
    parser.add_argument("--seconds", type=float, default=60.0, help="of the processor, at most")
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    number = least(args.cell, args.seconds, args.seed)
    print("no way found" if number < 0 else f"{number} regrasps")
    return 0 if number >= 0 else 3


if __name__ == "__main__":
    sys.exit(main())
