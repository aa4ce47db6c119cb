"""Cells broken by one cause each, written down before the first of them was planned: other parts,
another arm, other things about them than the 30 by which the diagnosis was made."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from broken_truth import GOAL, START, Truth, box, broken, cell, model, on_table, place, real, shapes

Cell = dict[str, Any]
BARE = {"box": [1.8, 1.6, 0.05], "pose": {"xyz": [0.6, 0, -0.025]}}  # a table, but no support
QUARTER = 1.5707963267948966


def lying(mesh: dict[str, Any], xyz: list[float], rpy: list[float], **more: Any) -> dict[str, Any]:
    """A part as a mesh, at a pose."""
    return {**mesh, "pose": {"xyz": xyz, "rpy": rpy}, **more}


@broken(Truth(("too_wide",), by=(0.002, 0.0003)))
def plate_2_mm_too_thick(folder: Path, is_broken: bool) -> Cell:
    """An L of 25 mm plate; with the clearance on both sides the jaws open 2 mm too little."""
    parts = {"lshape": lying(real("lshape.stl"), [0.5, 0.3, 0.0], [0, 0, 0.4])}
    goal = place("lshape", [0.45, -0.2, 0.0], -0.6)
    return cell(folder, {}, parts, [goal], opening=0.027 if is_broken else 0.06)


@broken(Truth(("out_of_reach",), "destination"))
def small_arm_cannot_reach(folder: Path, is_broken: bool) -> Cell:
    """The goal lies 0.85 m from a small arm, which reaches about 0.7 m."""
    parts = {"block": on_table([0.03, 0.05, 0.04], (0.35, 0.15))}
    x = 0.85 if is_broken else 0.42
    goal = place("block", [x, -0.1, 0.02])
    return cell(folder, {}, parts, [goal], opening=0.08, arm="irb120")


@broken(
    Truth(
        ("collision", "obstructed", "approach", "deposit", "withdrawal"),
        "destination",
        bodies=("shelf",),
    )
)
def deep_shelf_too_low(folder: Path, is_broken: bool) -> Cell:
    """The goal lies at the back of a shelf so low that the hand does not go in between."""
    high = 0.09 if is_broken else 0.42
    base = 0.35
    boards = [
        box([0.4, 0.5, 0.02], [0, 0, base - 0.01]),
        box([0.4, 0.5, 0.02], [0, 0, base + high + 0.01]),
        box([0.02, 0.5, high], [0.19, 0, base + high / 2]),
        box([0.38, 0.02, high], [-0.01, 0.24, base + high / 2]),
        box([0.38, 0.02, high], [-0.01, -0.24, base + high / 2]),
    ]
    fixtures = {"shelf": shapes(*boards, at=(0.62, -0.25))}
    parts = {"block": on_table([0.05, 0.05, 0.07], (0.4, 0.3))}
    return cell(folder, fixtures, parts, [place("block", [0.7, -0.25, base + 0.035])])


@broken(Truth(("obstructed", "collision"), "origin", bodies=("bin",)))
def narrow_bin_at_the_start(folder: Path, is_broken: bool) -> Cell:
    """The part stands in a deep bin with 5 mm to its walls on each side."""
    gap = 0.005 if is_broken else 0.05
    size = [0.05, 0.07, 0.04]
    x, y = size[0] / 2 + gap, size[1] / 2 + gap
    walls = [box([0.01, 2 * y + 0.02, 0.09], [side * (x + 0.005), 0, 0.045]) for side in (-1, 1)]
    walls += [box([2 * x, 0.01, 0.09], [0, side * (y + 0.005), 0.045]) for side in (-1, 1)]
    fixtures = {"bin": shapes(*walls, at=(0.48, 0.28))}
    parts = {"block": on_table(size, (0.48, 0.28))}
    return cell(folder, fixtures, parts, [place("block", [0.5, -0.2, 0.02], 0.7)])


@broken(Truth(("obstructed", "collision"), "destination", bodies=("ring",)))
def ring_round_the_goal(folder: Path, is_broken: bool) -> Cell:
    """A hexagonal peg is to stand in a collar as high as the peg, 4 mm wider all round."""
    radius = 0.027 if is_broken else 0.075
    side = 2 * radius * np.tan(np.pi / 8) + 0.008
    plates = [
        {
            "box": [0.008, float(side), 0.1],
            "pose": {
                "xyz": [
                    float((radius + 0.004) * np.cos(a)),
                    float((radius + 0.004) * np.sin(a)),
                    0.05,
                ],
                "rpy": [0, 0, float(a)],
            },
        }
        for a in np.arange(8) * np.pi / 4
    ]
    fixtures = {"ring": shapes(*plates, at=(0.52, -0.22))}
    parts = {"peg": lying(model("hex_peg"), [0.45, 0.25, 0.0], [0, 0, 0.2])}
    return cell(folder, fixtures, parts, [place("peg", [0.52, -0.22, 0.0])])


# So close and deep about a bar's goal that the hand comes straight down.
PIT = [
    *(box([0.02, 0.24, 0.15], [side * 0.1, 0, 0.075]) for side in (-1, 1)),
    *(box([0.18, 0.02, 0.15], [0, side * 0.11, 0.075]) for side in (-1, 1)),
]


@broken(Truth(("obstructed", "collision"), "origin", bodies=tuple(f"crate_{i}" for i in range(4))))
def crates_round_the_part(folder: Path, is_broken: bool) -> Cell:
    """Four crates, which may not be moved, stand 5 mm from the sides of the part, and higher."""
    size, gap = [0.05, 0.07, 0.05], 0.005 if is_broken else 0.06
    at = np.array([0.48, 0.28])
    parts = {"block": on_table(size, (0.48, 0.28))}
    for i, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
        away = [x * (size[0] / 2 + gap + 0.035), y * (size[1] / 2 + gap + 0.035)]
        parts[f"crate_{i}"] = on_table([0.07, 0.07, 0.09], tuple((at + away).tolist()))
    return cell(folder, {}, parts, [place("block", [0.45, -0.25, 0.025])])


@broken(Truth(("joint_limit",), "destination", joints=("joint2",), by=(0.07, 0.06)))
def joint_2_limited(folder: Path, is_broken: bool) -> Cell:
    """Joint 2 turns 0.07 rad less than it must to come down about the bar in a far pit."""
    limits = {"joint2": (-0.1, 3.2)} if is_broken else {}
    parts = {"bar": on_table([0.04, 0.12, 0.05], (0.42, 0.2))}
    at = (0.66, -0.2)
    fixtures = {"pit": shapes(*PIT, at=at)}
    return cell(folder, fixtures, parts, [place("bar", [*at, 0.025])], limits=limits)


@broken(Truth(("joint_limit",), joints=("joint_2",)))
def small_arm_does_not_lean(folder: Path, is_broken: bool) -> Cell:
    """The small arm's joint 2 turns too little to come down to the table at either end."""
    limits = {"joint_2": (-1.9, 0.3)} if is_broken else {}
    walls = [box([0.01, 0.2, 0.12], [side * 0.075, 0, 0.06]) for side in (-1, 1)]
    walls += [box([0.14, 0.01, 0.12], [0, side * 0.095, 0.06]) for side in (-1, 1)]
    at = (0.46, -0.2)
    parts = {"block": on_table([0.03, 0.06, 0.04], (0.3, 0.15))}
    fixtures = {"box": shapes(*walls, at=at)}
    goal = place("block", [*at, 0.02])
    return cell(folder, fixtures, parts, [goal], opening=0.08, limits=limits, arm="irb120")


@broken(Truth(("slips",)))
def slippery_part(folder: Path, is_broken: bool) -> Cell:
    """The part is so slippery that the jaws do not hold its weight."""
    friction = 0.04 if is_broken else 0.4
    parts = {
        "bracket": lying(model("bracket"), [0.5, 0.2, 0], [0, 0, 0.5], mass=1.5, friction=friction)
    }
    return cell(folder, {}, parts, [place("bracket", [0.4, -0.25, 0.0], -0.3)])


@broken(
    Truth(("withdrawal", "deposit", "obstructed", "collision"), "destination", bodies=("slot",))
)
def no_room_to_open_at_the_goal(folder: Path, is_broken: bool) -> Cell:
    """The fingers fit beside the bar in the slot at its goal, but there is no room to open them."""
    gap = 0.0125 if is_broken else 0.03
    apart = 0.02 + gap + 0.01
    walls = [on_table([0.02, 0.24, 0.1], (side * apart, 0.0)) for side in (-1, 1)]
    parts = {"bar": on_table([0.04, 0.2, 0.05], START)}
    fixtures = {"slot": shapes(*walls, at=GOAL)}
    return cell(folder, fixtures, parts, [place("bar", [*GOAL, 0.025])])


@broken(
    Truth(refused="E_GOAL_IN_COLLISION", bodies=("block", "crate")),
    Truth(("in_the_way",), bodies=("crate",)),
)
def crate_on_the_goal(folder: Path, is_broken: bool) -> Cell:
    """A crate, which may not be moved, stands where the part is to go."""
    crate = on_table([0.12, 0.1, 0.1], (0.5, -0.2) if is_broken else (0.35, 0.0))
    parts = {"block": on_table([0.04, 0.06, 0.05], START), "crate": crate}
    return cell(folder, {}, parts, [place("block", [0.5, -0.25, 0.025])])


@broken(Truth(refused="E_GOAL_UNSTABLE", bodies=("bracket",)), Truth(("unstable",)))
def goal_over_the_edge(folder: Path, is_broken: bool) -> Cell:
    """At its goal most of the part would be beyond the edge of a block on the table."""
    fixtures = {"step": on_table([0.2, 0.2, 0.05], (0.5, -0.2))}
    y = -0.325 if is_broken else -0.22
    parts = {"bracket": lying(model("bracket"), [0.45, 0.25, 0], [0, 0, 0])}
    return cell(folder, fixtures, parts, [place("bracket", [0.5, y, 0.05])])


@broken(Truth(("no_place",)))
def region_beside_the_table(folder: Path, is_broken: bool) -> Cell:
    """The region in which the part is to stand lies beside the table."""
    y = -0.95 if is_broken else -0.35
    region = [[0.35, y - 0.08], [0.6, y + 0.08]]
    parts = {"t_block": lying(model("t_block"), [0.45, 0.2, 0], [0, 0, 0.3])}
    goal = {"place": "t_block", "on": "table", "region": region}
    return cell(folder, {}, parts, [goal])


@broken(Truth(("no_place",)))
def tray_too_small(folder: Path, is_broken: bool) -> Cell:
    """The tray into which the part is to go is smaller than the part."""
    x, y = (0.045, 0.05) if is_broken else (0.14, 0.16)
    walls = [
        box([0.006, y + 0.012, 0.025], [side * (x / 2 + 0.003), 0, 0.0125]) for side in (-1, 1)
    ]
    walls += [box([x, 0.006, 0.025], [0, side * (y / 2 + 0.003), 0.0125]) for side in (-1, 1)]
    floor = box([x + 0.012, y + 0.012, 0.004], [0, 0, 0.002])
    fixtures = {"tray": shapes(floor, *walls, at=(0.45, -0.28))}
    parts = {"part": on_table([0.07, 0.09, 0.05], (0.5, 0.2), 0.2)}
    return cell(folder, fixtures, parts, [{"place": "part", "inside": "tray"}])


def lidded(x: float, y: float) -> list[dict[str, Any]]:
    """A low box with a lid that has a window of x by y."""
    size, low, thick = 0.28, 0.056, 0.006
    walls = [box([size, 0.01, low], [0, side * (size - 0.01) / 2, low / 2]) for side in (-1, 1)]
    walls += [
        box([0.01, size - 0.02, low], [side * (size - 0.01) / 2, 0, low / 2]) for side in (-1, 1)
    ]
    z, wide, deep = low + thick / 2, (size - x) / 2, (size - y) / 2
    lid = [box([wide, size, thick], [side * (x + wide) / 2, 0, z]) for side in (-1, 1)]
    return walls + lid + [box([x, deep, thick], [0, side * (y + deep) / 2, z]) for side in (-1, 1)]


@broken(Truth(("departure", "transfer", "deposit"), bodies=("cage",)))
def part_does_not_come_out(folder: Path, is_broken: bool) -> Cell:
    """The hand goes through the window over the part, but the part is wider than the window."""
    at = (0.45, 0.25)
    cage = shapes(*lidded(0.12, 0.036 if is_broken else 0.11), at=at)
    parts = {"block": on_table([0.045, 0.07, 0.05], at)}
    return cell(folder, {"cage": cage}, parts, [place("block", [0.5, -0.25, 0.025])])


@broken(Truth(("no_regrasp",)))
def upside_down_without_support(folder: Path, is_broken: bool) -> Cell:
    """A cross is to be turned upside down, and nothing is said to be a support."""
    cross = lying(model("cross"), [0.48, 0.25, 0.0], [0, 0, 0.2])
    goal = {
        "place": "cross",
        "at": {"xyz": [0.45, -0.25, 0.04], "rpy": [3.141592653589793, 0, 0.5]},
    }
    table = BARE if is_broken else {**BARE, "support": True}
    return cell(folder, {}, {"cross": cross}, [goal], table=table)


@broken(Truth(("obstructed", "collision"), "origin", bodies=("heap",)))
def heap_against_the_part(folder: Path, is_broken: bool) -> Cell:
    """A measured heap lies against the part on all sides, 90 mm high; the part is 45 mm high."""
    heights = np.zeros((50, 50))
    gap = 3 if is_broken else 13  # cells
    heights[25 - 6 - gap - 8 : 25 + 6 + gap + 8, 25 - 6 - gap - 8 : 25 + 6 + gap + 8] = 0.09
    heights[25 - 6 - gap : 25 + 6 + gap + 1, 25 - 6 - gap : 25 + 6 + gap + 1] = 0.0
    np.save(folder / "heap.npy", heights)
    at = (0.5, 0.22)
    pose = {"xyz": [at[0] - 0.1, at[1] - 0.1, 0]}
    maps = {"heap": {"heights": "heap.npy", "cell": 0.004, "pose": pose}}
    parts = {"block": on_table([0.05, 0.05, 0.045], at)}
    return cell(folder, {}, parts, [place("block", [0.45, -0.2, 0.0225])], depth_maps=maps)


@broken(Truth(("out_of_reach",)))
def robot_mounted_too_far_back(folder: Path, is_broken: bool) -> Cell:
    """The robot stands 0.6 m too far from the table: start and goal are beyond its reach."""
    base = {"base": {"xyz": [-0.6 if is_broken else 0.0, 0, 0]}}
    parts = {"cross": lying(model("cross"), [0.5, 0.2, 0.0], [0, 0, 0])}
    return cell(folder, {}, parts, [place("cross", [0.55, -0.2, 0.0], 0.4)], robot=base)


@broken(Truth(("too_thin",), by=(0.010, 0.003)))
def jaws_do_not_close(folder: Path, is_broken: bool) -> Cell:
    """The jaws close to 30 mm, and a cube of 20 mm is to be held."""
    cube = real("xyz_cube_20mm.stl", 0.001)
    parts = {"cube": lying(cube, [0.5, 0.2, 0.031], [0, 0, 0.3])}
    least = 0.03 if is_broken else 0.0
    goal = place("cube", [0.4, -0.3, 0.031])
    return cell(folder, {}, parts, [goal], least_opening=least)


@broken(
    Truth(
        ("obstructed", "collision", "deposit", "transfer", "approach", "withdrawal"),
        bodies=("lid",),
    ),
    goal=1,
)
def lid_before_the_content(folder: Path, is_broken: bool) -> Cell:
    """The lid is to be put on the open box before the part that is to go into it."""
    at, wall, high = (0.5, -0.25), 0.008, 0.1
    x, y = 0.16, 0.2
    walls = [box([wall, y, high], [side * (x - wall) / 2, 0, high / 2]) for side in (-1, 1)]
    walls += [
        box([x - 2 * wall, wall, high], [0, side * (y - wall) / 2, high / 2]) for side in (-1, 1)
    ]
    grip = box([0.04, 0.06, 0.04], [0, 0, 0.025])
    lid = {"pose": {"xyz": [0.45, 0.35, 0.005]}, "shapes": [box([x, y, 0.01], [0, 0, 0]), grip]}
    parts = {"lid": lid, "block": on_table([0.04, 0.06, 0.05], (0.55, 0.12))}
    task = [place("lid", [*at, high + 0.005]), place("block", [*at, 0.025])]
    return cell(
        folder, {"open_box": shapes(*walls, at=at)}, parts, task if is_broken else task[::-1]
    )
