"""Cells broken at an end: the jaws, the reach, the joints, and what stands about the part."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from broken_truth import GOAL, START, Truth, box, broken, cell, on_table, place, shapes

Cell = dict[str, Any]
BLOCK = [0.04, 0.06, 0.05]
ROOM = 0.004  # that the open jaws need beside the part: 2 mm at each side [m]
BAR = [0.04, 0.20, 0.05]  # only its long sides can be held


def moved(folder: Path, size: list[float], fixtures: dict[str, Any], **more: Any) -> Cell:
    """A box is carried from START to GOAL."""
    height = size[2] / 2
    parts = {"block": {**on_table(size, START), **more.pop("part", {})}}
    return cell(folder, fixtures, parts, [place("block", [*GOAL, height])], **more)


@broken(Truth(("too_wide",), by=(0.003 + ROOM, 0.0003)))
def jaws_3_mm_short(folder: Path, is_broken: bool) -> Cell:
    """The jaws open 3 mm less than the part is wide where it is narrowest."""
    return moved(folder, [0.088, 0.12, 0.11], {}, opening=0.085 if is_broken else 0.1)


@broken(Truth(("too_wide",), by=(0.0004 + ROOM, 0.0001)))
def jaws_04_mm_short(folder: Path, is_broken: bool) -> Cell:
    """The jaws open 0.4 mm less than the part is wide; it is flat, but lies on the table."""
    return moved(folder, [0.0854, 0.13, 0.05], {}, opening=0.085 if is_broken else 0.09)


# Found by halving: where a block before the arm can just be taken and put down [m].
FARTHEST = 0.883


@broken(Truth(("out_of_reach",), "destination", by=(0.033, 0.008)))
def goal_40_mm_too_far(folder: Path, is_broken: bool) -> Cell:
    """The goal lies 40 mm beyond the farthest that the arm reaches."""
    x = FARTHEST + 0.04 if is_broken else FARTHEST - 0.01
    parts = {"block": on_table(BLOCK, START)}
    return cell(folder, {}, parts, [place("block", [x, 0.0, 0.025])])


@broken(Truth(("out_of_reach",), "origin", by=(0.020, 0.006)))
def start_25_mm_too_far(folder: Path, is_broken: bool) -> Cell:
    """The part stands 25 mm beyond the farthest that the arm reaches."""
    x = FARTHEST + 0.025 if is_broken else FARTHEST - 0.01
    parts = {"block": on_table(BLOCK, (x, 0.0))}
    return cell(folder, {}, parts, [place("block", [*GOAL, 0.025])])


@broken(Truth(("collision",), "destination", bodies=("base_link",)))
def goal_at_the_base(folder: Path, is_broken: bool) -> Cell:
    """The goal lies 9 mm beside the robot's base: a finger, of 12 mm, does not go between."""
    y = -0.2033 - 0.02 - (0.009 if is_broken else 0.15)
    parts = {"block": on_table(BAR, START, 1.5707963267948966)}
    return cell(folder, {}, parts, [place("block", [0.0, y, 0.025], 1.5707963267948966)])


# A shelf's floor, back, sides and roof, open to -x.
SHELF = 0.3
NICHE = [
    box([0.24, 0.34, SHELF], [0.0, 0, SHELF / 2]),
    box([0.02, 0.34, 0.30], [0.11, 0, SHELF + 0.15]),
    box([0.22, 0.02, 0.30], [-0.01, 0.16, SHELF + 0.15]),
    box([0.22, 0.02, 0.30], [-0.01, -0.16, SHELF + 0.15]),
    box([0.24, 0.34, 0.02], [0.0, 0, SHELF + 0.31]),
]


def shelf_and_wall(at: tuple[float, float], is_walled: bool) -> dict[str, Any]:
    """The niche, with its floor at SHELF; a wall before it, if asked."""
    fixtures = {"niche": shapes(*NICHE, at=at)}
    if is_walled:
        fixtures["wall"] = on_table([0.02, 0.34, SHELF + 0.3], (at[0] - 0.15, at[1]))
    return fixtures


@broken(Truth(("collision", "obstructed", "approach"), "origin", bodies=("wall",)))
def wall_before_the_part(folder: Path, is_broken: bool) -> Cell:
    """A wall stands before the shelf on which the part waits: the hand cannot come in."""
    at = (0.62, 0.2)
    parts = {"block": box(BLOCK, [*at, SHELF + 0.025])}
    fixtures = shelf_and_wall(at, is_broken)
    return cell(folder, fixtures, parts, [place("block", [*GOAL, 0.025])])


@broken(
    Truth(("collision", "obstructed", "deposit", "withdrawal"), "destination", bodies=("wall",))
)
def wall_before_the_goal(folder: Path, is_broken: bool) -> Cell:
    """A wall stands before the shelf onto which the part is to go."""
    at = (0.62, -0.2)
    parts = {"block": on_table(BLOCK, START)}
    fixtures = shelf_and_wall(at, is_broken)
    return cell(folder, fixtures, parts, [place("block", [*at, SHELF + 0.025])])


def beside(x: float, gap: float) -> dict[str, Any]:
    """Two blocks, so far from the long sides of a bar."""
    apart = 0.02 + gap + 0.03
    return {
        "left": on_table([0.06, 0.22, 0.06], (0.5 - apart, x)),
        "right": on_table([0.06, 0.22, 0.06], (0.5 + apart, x)),
    }


BESIDE = ("left", "right")


@broken(Truth(("obstructed", "collision"), "destination", bodies=BESIDE))
def neighbours_at_the_goal(folder: Path, is_broken: bool) -> Cell:
    """Other parts stand beside the goal, against both of the sides that can be held."""
    neighbours = beside(GOAL[1], 0.004 if is_broken else 0.03)
    parts = {"block": on_table(BAR, START), **neighbours}
    return cell(folder, {}, parts, [place("block", [*GOAL, 0.025])])


@broken(Truth(("obstructed", "collision"), "origin", bodies=BESIDE))
def neighbours_at_the_start(folder: Path, is_broken: bool) -> Cell:
    """Other parts stand beside the part, against both of the sides that can be held."""
    neighbours = beside(START[1], 0.004 if is_broken else 0.03)
    parts = {"block": on_table(BAR, START), **neighbours}
    return cell(folder, {}, parts, [place("block", [*GOAL, 0.025])])


def slot(gap: float, height: float) -> dict[str, Any]:
    """Two walls along the goal of a bar."""
    apart = 0.02 + gap + 0.01
    walls = [on_table([0.02, 0.24, height], (side * apart, 0.0)) for side in (-1, 1)]
    return {"slot": shapes(*walls, at=GOAL)}


@broken(Truth(("obstructed", "collision"), "destination", bodies=("slot",)))
def slot_too_deep(folder: Path, is_broken: bool) -> Cell:
    """The slot at the goal, 2 mm wider than the part on each side, is as deep as it is high."""
    return moved(folder, BAR, slot(0.002, 0.05 if is_broken else 0.02))


@broken(Truth(("collision", "obstructed"), "origin", bodies=("roof",)))
def roof_over_the_part(folder: Path, is_broken: bool) -> Cell:
    """The part stands in the midst under a roof so low that the palm does not come under it."""
    height = 0.065 if is_broken else 0.6
    return moved(folder, BLOCK, {"roof": box([0.36, 0.36, 0.02], [*START, height + 0.01])})


@broken(Truth(("collision", "obstructed"), "destination", bodies=("roof",)))
def roof_over_the_goal(folder: Path, is_broken: bool) -> Cell:
    """The goal lies under a roof so low that the palm does not come under it."""
    height = 0.065 if is_broken else 1.3
    return moved(folder, BLOCK, {"roof": box([0.36, 0.36, 0.02], [*GOAL, height + 0.01])})


@broken(Truth(("collision",), "destination", bodies=("beam",)))
def beam_before_the_forearm(folder: Path, is_broken: bool) -> Cell:
    """The arm must reach over a beam that lies where its forearm would be."""
    beam = box([0.06, 1.4, 0.12], [0.42, -0.3, 0.37 if is_broken else 0.06])
    walls = shapes(
        box([0.02, 0.2, 0.2], [0.1, 0, 0.1]),
        box([0.22, 0.02, 0.2], [0, 0.1, 0.1]),
        box([0.22, 0.02, 0.2], [0, -0.1, 0.1]),
        box([0.02, 0.2, 0.2], [-0.1, 0, 0.1]),
        at=(0.58, -0.3),
    )
    parts = {"block": on_table(BLOCK, (0.3, 0.35))}
    goal = place("block", [0.58, -0.3, 0.025])
    return cell(folder, {"beam": beam, "well": walls}, parts, [goal])


@broken(Truth(("obstructed", "collision"), "destination", bodies=("scan",)))
def unmeasured_about_the_goal(folder: Path, is_broken: bool) -> Cell:
    """The map of heights has no measurements round the goal: there it is as high as anywhere."""
    heights = np.zeros((60, 60))
    heights[:6, :6] = 0.08
    if is_broken:
        heights[15:45, 15:45] = np.nan
        heights[22:38, 24:36] = 0.0
    np.save(folder / "scan.npy", heights)
    pose = {"xyz": [GOAL[0] - 0.15, GOAL[1] - 0.15, 0]}
    maps = {"scan": {"heights": "scan.npy", "cell": 0.005, "pose": pose}}
    return moved(folder, BLOCK, {}, depth_maps=maps)


# Round the bar at its goal, so deep and close that the hand comes straight down into it.
PIT = [
    *(box([0.02, 0.24, 0.15], [side * 0.1, 0, 0.075]) for side in (-1, 1)),
    *(box([0.18, 0.02, 0.15], [0, side * 0.11, 0.075]) for side in (-1, 1)),
]


@broken(Truth(("joint_limit",), "destination", joints=("joint5",), by=(0.2, 0.03)))
def joint_5_limited(folder: Path, is_broken: bool) -> Cell:
    """Joint 5 turns 0.2 rad less than it must to come straight down into the pit at the goal."""
    limits = {"joint5": (-0.262, 0.262)} if is_broken else {}
    parts = {"block": on_table([0.04, 0.12, 0.05], (0.38, 0.2))}
    at = (0.66, -0.2)
    goal = place("block", [*at, 0.025])
    return cell(folder, {"pit": shapes(*PIT, at=at)}, parts, [goal], limits=limits)


@broken(Truth(("joint_limit",), "destination", joints=("joint1",), by=(0.2, 0.03)))
def joint_1_limited(folder: Path, is_broken: bool) -> Cell:
    """Joint 1 turns 0.2 rad less than it must to come down into the pit beside the robot."""
    limits = {"joint1": (-1.029, 1.029)} if is_broken else {}
    parts = {"block": on_table([0.04, 0.12, 0.05], START)}
    at = (0.0, -0.55)
    goal = place("block", [*at, 0.025])
    return cell(folder, {"pit": shapes(*PIT, at=at)}, parts, [goal], limits=limits)
