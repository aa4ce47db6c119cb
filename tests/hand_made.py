"""A small pick and place made by hand: numeric inverse kinematics, straight lines, timed at half
speed.

No planner is involved, so that the checker's tests stand on their own.
"""

from __future__ import annotations

import copy
from pathlib import Path

import numpy as np
import yaml
from scipy.spatial.transform import Rotation

from handey.check.cell import Cell
from handey.check.cell_reader import read_cell
from handey.check.kinematics import forward
from handey.check.values import rpy_matrix

ROOT = Path(__file__).resolve().parents[1]
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
DOWN = rpy_matrix(np.pi, 0, 0)  # the hand looks straight down, its closing axis along -y

CELL = {
    "handey_cell": 1,
    "name": "hand_made",
    "robot": {"file": str(ROBOT)},
    "fixtures": {
        "table": {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True},
    },
    "parts": {
        "block": {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.50, 0.15, 0.025]}},
        "bystander": {"box": [0.04, 0.04, 0.04], "pose": {"xyz": [0.35, 0.35, 0.02]}},
    },
    "task": [{"place": "block", "at": {"xyz": [0.50, -0.15, 0.025]}}],
}


def write_cell(folder: Path, **changes) -> Path:
    """The cell above; `changes` are merged in, `fixtures` and `parts` entry by entry."""
    content = copy.deepcopy(CELL)
    for key, value in changes.items():
        if key in ("fixtures", "parts", "robot"):
            content[key] = {**content[key], **value}
        else:
            content[key] = value
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(content, sort_keys=False))
    return path


def pose(xyz, R=DOWN):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = R, xyz
    return X


def hand_pose(cell: Cell, q):
    frames = forward(cell.robot, cell.base, np.array([q]), np.array([0.05]))
    return frames.matrix(cell.robot.hand, 0, cell.robot.grasp_frame)


def solve(cell: Cell, X_WH, seed):
    """A configuration near `seed` with the grasp frame at X_WH."""

    q, step = np.array(seed, dtype=float), 1e-7
    for _ in range(100):
        frames = forward(
            cell.robot, cell.base, np.vstack([q, q + step * np.eye(6)]), np.full(7, 0.05)
        )
        X = [frames.matrix(cell.robot.hand, k, cell.robot.grasp_frame) for k in range(7)]
        turns = Rotation.from_matrix([X_WH[:3, :3] @ x[:3, :3].T for x in X]).as_rotvec()
        error = np.hstack([X_WH[:3, 3] - np.array([x[:3, 3] for x in X]), turns])
        if np.abs(error[0]).max() < 1e-10:
            return q
        jacobian = (error[0] - error[1:]).T / step
        change = np.linalg.lstsq(jacobian, error[0], rcond=1e-6)[0]
        q = q + change * min(1.0, 0.3 / np.abs(change).max())
    raise AssertionError(f"no configuration found near {seed}: {error[0]}")


class PlanMaker:
    """Collects steps; time runs on by itself."""

    def __init__(self, cell_path: Path):
        self.cell = read_cell(cell_path)
        self.q = self.cell.start.copy()
        self.opening = self.cell.start_opening
        self.time = 0.0
        self.steps = []
        self.placements = {}
        self.near_start = np.array([0.3, 0.9, -2.3, 0.0, -0.15, 0.0])  # elbow up, hand down

    def step(self, action, rows, openings, goal=0, part=None, X_HP=None):
        rows, openings = np.array(rows, dtype=float), np.array(openings, dtype=float)
        limits = np.array([joint.velocity for joint in self.cell.robot.joints])
        share = (np.abs(np.diff(rows, axis=0)) / limits).max(axis=1, initial=0)
        finger = self.cell.robot.fingers[0].velocity
        share = np.maximum(share, np.abs(np.diff(openings)) / 2 / finger)
        time = self.time + np.r_[0.0, np.cumsum(np.maximum(share * 2, 1e-3))]
        self.time, self.q, self.opening = time[-1], rows[-1], openings[-1]
        grip = None
        if X_HP is not None:
            quat = Rotation.from_matrix(X_HP[:3, :3]).as_quat()
            grip = {"xyz": X_HP[:3, 3].tolist(), "quat_xyzw": quat.tolist()}
        self.steps.append(
            {
                "action": action, "goal": goal, "part": part, "part_in_grasp_frame": grip,
                "time": time.tolist(), "positions": rows.tolist(), "opening": openings.tolist(),
            }
        )  # fmt: skip

    def move(self, action, q, opening=None, rows=60, **held):
        """Straight in joint space."""
        s = np.linspace(0, 1, rows)[:, None]
        last = self.opening if opening is None else opening
        self.step(
            action,
            self.q * (1 - s) + np.asarray(q) * s,
            np.linspace(self.opening, last, rows),
            **held,
        )

    def slide(self, action, X_WH, rows=25, **held):
        """Straight in space, the hand's direction kept."""
        start, q, path = hand_pose(self.cell, self.q)[:3, 3], self.q, [self.q]
        for s in np.linspace(0, 1, rows)[1:]:
            q = solve(self.cell, pose(start * (1 - s) + X_WH[:3, 3] * s, X_WH[:3, :3]), q)
            path.append(q)
        self.step(action, path, np.full(rows, self.opening), **held)

    def grip(self, action, opening, rows=8, **held):
        self.step(
            action,
            np.repeat([self.q], rows, axis=0),
            np.linspace(self.opening, opening, rows),
            **held,
        )

    def carry(self, part, X_from, X_to, X_PH, width, goal=0, lift=0.12, open_to=0.07):
        """One part from place to place, with the hand at X_PH in the part."""
        up = np.array([0, 0, lift])
        X_HP = np.linalg.inv(X_PH)
        pick, put = X_from @ X_PH, X_to @ X_PH
        over_pick, over_put = pick.copy(), put.copy()
        over_pick[:3, 3] += up
        over_put[:3, 3] += up
        held = {"goal": goal, "part": part, "X_HP": X_HP}
        seed = self.near_start if len(self.steps) == 0 else self.q
        self.move("transit", solve(self.cell, over_pick, seed), open_to, goal=goal)
        self.slide("approach", pick, goal=goal)
        self.grip("grasp", width, goal=goal)
        self.slide("depart", over_pick, rows=60, **held)
        self.move("transfer", solve(self.cell, over_put, self.q), **held)
        self.slide("deposit", put, rows=60, **held)
        self.grip("release", open_to, goal=goal)
        self.slide("withdraw", over_put, goal=goal)
        quat = Rotation.from_matrix(X_to[:3, :3]).as_quat()
        self.placements[part] = {"xyz": X_to[:3, 3].tolist(), "quat_xyzw": quat.tolist()}

    def finish(self, goal=0):
        self.move("transit", self.cell.start, goal=goal)

    def plan(self):
        return {
            "handey_plan": 1, "cell": self.cell.name, "joints": self.cell.robot.joint_names(),
            "steps": copy.deepcopy(self.steps), "placements": copy.deepcopy(self.placements),
            "report": {},
        }  # fmt: skip


X_PH = pose([0, 0, 0.005])  # grips the block's 40 mm across y, pads 5 mm above its middle
BLOCK = pose([0.50, 0.15, 0.025], np.eye(3))
BLOCK_GOAL = pose([0.50, -0.15, 0.025], np.eye(3))


def pick_and_place(cell_path: Path, X_from=BLOCK, X_to=BLOCK_GOAL, X_PH=X_PH, width=0.04, **how):
    """The valid plan for the cell above."""
    maker = PlanMaker(cell_path)
    maker.carry("block", X_from, X_to, X_PH, width, **how)
    maker.finish()
    return maker.plan()


def clauses(report):
    """The clauses of a valid plan that are broken."""
    return {fault.clause for fault in report.faults}


def step_of(plan, action):
    """Index of the first step with this action."""
    return next(i for i, step in enumerate(plan["steps"]) if step["action"] == action)


def wall(size, xyz):
    """Fixtures with one wall."""
    return {"wall": {"box": size, "pose": {"xyz": xyz}}}
