"""Cells broken on the way: the path, the regrasp, the order, the places, and the part itself."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from broken_ends import BLOCK, moved
from broken_truth import GOAL, START, Truth, box, broken, cell, model, on_table, place, shapes

Cell = dict[str, Any]
BARE = {"box": [1.8, 1.6, 0.05], "pose": {"xyz": [0.6, 0, -0.025]}}  # a table, but no support
HIGH = [0.0, 0.7854, -3.1416, 0.0, -0.7854, 0.0]  # the hand before the arm, clear of the table
UPSIDE_DOWN = {"rpy": [3.141592653589793, 0, 1.0]}


def flipped(folder: Path, fixtures: dict[str, Any], table: dict[str, Any]) -> Cell:
    """A box is turned upside down, for which it must be put down on the way."""
    parts = {"block": {**on_table([0.06, 0.09, 0.05], (0.48, 0.26), 0.3), "mass": 0.2}}
    goal = {"place": "block", "at": {"xyz": [0.45, -0.3, 0.025], **UPSIDE_DOWN}}
    return cell(folder, fixtures, parts, [goal], table=table, robot={"start": HIGH})


@broken(Truth(("no_regrasp",)))
def support_missing(folder: Path, is_broken: bool) -> Cell:
    """The part must be put down to be turned over, and nothing is said to be a support."""
    return flipped(folder, {}, BARE if is_broken else {**BARE, "support": True})


@broken(Truth(("no_regrasp",)))
def support_is_taken(folder: Path, is_broken: bool) -> Cell:
    """The part must be put down to be turned over, and the only support holds a crate."""
    fixtures = {"ledge": {**on_table([0.3, 0.3, 0.04], (0.55, -0.02)), "support": True}}
    if is_broken:
        fixtures["crate"] = box([0.26, 0.26, 0.08], [0.55, -0.02, 0.08])
    return flipped(folder, fixtures, BARE)


def hall(gap: float) -> dict[str, Any]:
    """Walls from the arm's foot outwards, before and behind it, and a ceiling."""
    return {
        "wall": box([1.2, 0.02, 1.04], [0.42 + gap + 0.6, 0.0, 0.52]),
        "wall_behind": box([1.2, 0.02, 1.04], [-1.02, 0.0, 0.52]),
        "ceiling": box([3.0, 3.0, 0.02], [0.0, 0.0, 1.05]),
    }


@broken(Truth(("transfer",), bodies=("wall", "wall_behind", "ceiling")))
def parted_by_walls(folder: Path, is_broken: bool) -> Cell:
    """Walls and a ceiling part the arm's reach between the part and its goal."""
    start = [0.859, 0.557, -3.104, 0.0, -0.595, -2.282]
    fixtures = hall(0.0) if is_broken else {}
    return moved(folder, BLOCK, fixtures, robot={"start": start}, finish="anywhere")


@broken(Truth(("transit",), bodies=("collar",)))
def hand_in_a_collar(folder: Path, is_broken: bool) -> Cell:
    """The hand starts behind a ring of plates about its wrist, through which the palm cannot go."""
    # So does HIGH hold the hand: the plates lie between palm and link 5, about the flange.
    x, y, z = 0.5963, -0.1501, 0.6065
    plates = [box([0.26, 0.1, 0.006], [x, y + side * 0.08, z]) for side in (-1, 1)]
    plates += [box([0.1, 0.06, 0.006], [x + side * 0.08, y, z]) for side in (-1, 1)]
    fixtures = {"collar": shapes(*plates)} if is_broken else {}
    return moved(folder, BLOCK, fixtures, robot={"start": HIGH})


@broken(Truth(("would_fall",), bodies=("upper",)))
def another_stands_on_it(folder: Path, is_broken: bool) -> Cell:
    """Another part, which may not be moved, stands on the one that is to be moved."""
    upper = box(BLOCK, [*START, 0.075]) if is_broken else on_table(BLOCK, (0.35, 0.0))
    parts = {"block": on_table(BLOCK, START), "upper": upper}
    return cell(folder, {}, parts, [place("block", [*GOAL, 0.025])])


@broken(Truth(("in_the_way",), bodies=("one", "other")))
def swapped_without_support(folder: Path, is_broken: bool) -> Cell:
    """Two parts are to change places, and nothing is said to be a support for either meanwhile."""
    parts = {"one": on_table(BLOCK, START), "other": on_table(BLOCK, GOAL)}
    task = [place("one", [*GOAL, 0.025]), place("other", [*START, 0.025])]
    table = BARE if is_broken else {**BARE, "support": True}
    return cell(folder, {}, parts, task, table=table, order="any")


@broken(Truth(("obstructed", "collision", "approach"), bodies=("first",)), goal=1)
def wrong_order(folder: Path, is_broken: bool) -> Cell:
    """The first goal puts a part before the niche into which the second is to go."""
    at = (0.56, -0.2)
    walls = [
        box([0.02, 0.22, 0.30], [0.10, 0, 0.15]),
        box([0.2, 0.02, 0.30], [0.01, 0.12, 0.15]),
        box([0.2, 0.02, 0.30], [0.01, -0.12, 0.15]),
        box([0.22, 0.26, 0.02], [0.01, 0, 0.31]),
    ]
    parts = {
        "first": on_table([0.04, 0.09, 0.27], (0.35, 0.3)),
        "second": on_table(BLOCK, (0.5, 0.35)),
    }
    task = [place("first", [at[0] - 0.13, at[1], 0.135]), place("second", [*at, 0.025])]
    return cell(folder, {"niche": shapes(*walls, at=at)}, parts, task if is_broken else task[::-1])


def tray(at: tuple[float, float]) -> dict[str, Any]:
    """A tray of 200 by 140 mm inside."""
    walls = [box([0.22, 0.01, 0.03], [0, side * 0.075, 0.015]) for side in (-1, 1)]
    walls += [box([0.01, 0.14, 0.03], [side * 0.105, 0, 0.015]) for side in (-1, 1)]
    return shapes(box([0.22, 0.16, 0.005], [0, 0, 0.0025]), *walls, at=at)


@broken(Truth(("no_place",)))
def tray_is_full(folder: Path, is_broken: bool) -> Cell:
    """The tray into which the part is to go holds others: no room for it is left."""
    parts = {"block": on_table([0.05, 0.08, 0.05], START)}
    for i, x in enumerate((-0.07, 0.0, 0.07)):
        if is_broken or i == 0:
            parts[f"other_{i}"] = box([0.05, 0.1, 0.05], [GOAL[0] + x, GOAL[1], 0.030])
    return cell(folder, {"tray": tray(GOAL)}, parts, [{"place": "block", "inside": "tray"}])


@broken(Truth(("no_place",)))
def region_too_small(folder: Path, is_broken: bool) -> Cell:
    """The region in which the part is to stand, as it does now, is smaller than its foot."""
    half = 0.02 if is_broken else 0.06
    x, y = GOAL
    region = [[x - half, y - half], [x + half, y + half]]
    parts = {"block": on_table([0.05, 0.06, 0.04], START)}
    goal = {"place": "block", "on": "table", "region": region, "resting": "same"}
    return cell(folder, {}, parts, [goal])


# Two features of it are opposite to each other only if one is of the face that it stands on.
@broken(Truth(("no_features",)), Truth(("obstructed", "collision"), "origin", bodies=("table",)))
def no_opposite_faces(folder: Path, is_broken: bool) -> Cell:
    """No two features of the part are opposite to each other: a tetrahedron, instead of a wedge."""
    name = "tetrahedron" if is_broken else "wedge"
    parts = {"part": {**model(name), "pose": {"xyz": [*START, 0]}}}
    return cell(folder, {}, parts, [place("part", [*GOAL, 0])])


@broken(Truth(("slips",)))
def too_heavy(folder: Path, is_broken: bool) -> Cell:
    """The part is so heavy that it slips and turns in the jaws, wherever they hold it."""
    return moved(folder, [0.08, 0.12, 0.06], {}, part={"mass": 9.0 if is_broken else 0.5})


def window(x: float, y: float) -> list[dict[str, Any]]:
    """A low cage with a lid that has a window of x by y over its middle."""
    size, low, thick = 0.26, 0.056, 0.006
    walls = [box([size, 0.01, low], [0, side * (size - 0.01) / 2, low / 2]) for side in (-1, 1)]
    walls += [
        box([0.01, size - 0.02, low], [side * (size - 0.01) / 2, 0, low / 2]) for side in (-1, 1)
    ]
    z = low + thick / 2
    wide, deep = (size - x) / 2, (size - y) / 2
    lid = [box([wide, size, thick], [side * (x + wide) / 2, 0, z]) for side in (-1, 1)]
    lid += [box([x, deep, thick], [0, side * (y + deep) / 2, z]) for side in (-1, 1)]
    return walls + lid


@broken(Truth(("deposit", "transfer"), bodies=("cage",)))
def window_too_small_for_the_part(folder: Path, is_broken: bool) -> Cell:
    """The hand finds its way through the window over the goal, the part in it does not."""
    cage = shapes(*window(0.13, 0.034 if is_broken else 0.09), at=GOAL)
    return moved(folder, BLOCK, {"cage": cage})


LANE = [
    box([0.05, 0.22, 0.01], [-0.073, -0.02, 0.165]),
    box([0.05, 0.22, 0.01], [0.073, -0.02, 0.165]),
    box([0.01, 0.22, 0.17], [-0.103, -0.02, 0.085]),
    box([0.01, 0.22, 0.17], [0.103, -0.02, 0.085]),
    box([0.216, 0.01, 0.17], [0, 0.085, 0.085]),
]


@broken(Truth(("approach", "transit"), bodies=("lane", "door")))
def lane_is_shut(folder: Path, is_broken: bool) -> Cell:
    """The hand would fit about the part under the rails of the lane, but its door is shut."""
    at = (0.48, 0.25)
    fixtures = {"lane": shapes(*LANE, at=at)}
    if is_broken:
        fixtures["door"] = box([0.216, 0.02, 0.17], [at[0], at[1] - 0.145, 0.085])
    parts = {"block": on_table([0.04, 0.12, 0.05], at)}
    goal = place("block", [0.48, -0.26, 0.025])
    return cell(folder, fixtures, parts, [goal], table=BARE)


@broken(Truth(("home",), bodies=("block",)))
def goal_where_the_arm_rests(folder: Path, is_broken: bool) -> Cell:
    """The goal is where the hand rests: with the part there, the arm cannot come back."""
    start = [0.3048, 0.1944, -3.1654, 0.0, -0.1706, -2.8368]
    y = 0.0 if is_broken else -0.3
    tower = box([0.12, 0.4, 0.08], [0.5, -0.15, 0.04])
    parts = {"block": on_table([0.04, 0.06, 0.12], (0.5, 0.3))}
    goal = place("block", [0.5, y, 0.14])
    return cell(folder, {"tower": tower}, parts, [goal], robot={"start": start})
