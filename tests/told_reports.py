"""Reports of planning made by hand, for the page: one failure that has a bit of everything."""

from __future__ import annotations

import numpy as np
from hand_made import X_PH

from handey.check.values import rpy_matrix
from handey.reporting.advice import Advice, Edit
from handey.reporting.goal_report import Attempt, GoalReport
from handey.reporting.reasons import STAGES, Reason, Stage, Tried
from handey.reporting.report import Report

WIDE = Reason(
    "too_wide", "spanned", "pair 2/5: 60.0 mm wide, jaws open 50.0 mm: 10.0 mm short", 2, by=0.010,
    proved=True,
)  # fmt: skip
COVERED = Reason(
    "obstructed", "unobstructed", "84 % obstructed at the destination by wall", 1, "destination",
    ("wall",), by=0.84,
)  # fmt: skip
LIMIT = Reason(
    "joint_limit", "reachable", "joint5 is 11.4 degrees past its limit at the destination", 30,
    "destination", joint="joint5", by=0.199,
)  # fmt: skip
HIT = Reason(
    "collision", "reachable", "forearm hits wall, 7.0 mm deep, at the destination", 41,
    "destination", ("wall",), "forearm", by=0.007,
)  # fmt: skip
STALLED = Reason("approach", "approached", "the hand does not come in past bystander <b>", 4,
                 "origin", ("bystander",))  # fmt: skip
NO_WAY = Reason("transfer", "connected", "no gross motion with the part past wall", 1,
                bodies=("wall",), mover="held block")  # fmt: skip


def _around(count: int, stage: str, text: str, tilt: float) -> list[Tried]:
    """Hand poses that come in from all sides, turned about the closing axis."""
    poses = []
    for angle in np.linspace(-tilt, tilt, count):
        X = np.eye(4)
        X[:3, :3] = rpy_matrix(0, angle, 0) @ X_PH[:3, :3]
        X[:3, 3] = [0.015 * np.sin(angle), 0, 0.005]
        poses.append(Tried(X.tolist(), 0.07, 0.04, stage, text))
    return poses


def failure() -> Report:
    """No plan for the block: something fell at each stage."""
    counts = [(6, 6), (6, 4), (4, 3), (80, 9), (9, 5), (5, 0)]
    reasons = [[], [WIDE], [COVERED], [HIT, LIMIT], [STALLED], [NO_WAY]]
    stages = [
        Stage(name, entered, passed, why)
        for name, (entered, passed), why in zip(STAGES, counts, reasons, strict=True)
    ]
    tried = [
        *_around(3, "unobstructed", COVERED.text, 0.3),
        *_around(9, "reachable", HIT.text, 1.4),
        *_around(6, "reachable", LIMIT.text, 1.0),
        *_around(4, "approached", STALLED.text, 0.6),
        *_around(1, "connected", NO_WAY.text, 0.0),
    ]
    goal = GoalReport(
        0, "place block at (0.500, -0.150, 0.025)", "failed", {"face pairs": 6}, ["a line"],
        [Attempt("faces 0/1, 40.0 mm", "transfer", "no motion")],
        stages=stages, cause=HIT, tried=tried, covered=["6 feature pairs, 80 hand poses"],
        advice=Advice(
            "fixture moved", "move wall by 60 mm along +y: then goal 0 plans",
            (Edit("cell.yaml", "fixtures.wall.pose.xyz", [0.5, 0.06, 0.1]),), 0.06,
        ),
    )  # fmt: skip
    return Report("unknown", [goal], cpu_s=0.8, wall_s=0.42)
