"""More cells broken by one cause each, written down before the first of them was planned, after the
diagnosis had been mended by those of `broken_fresh`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from broken_fresh import BARE, lying
from broken_truth import GOAL, START, Truth, box, broken, cell, model, on_table, place, real, shapes

Cell = dict[str, Any]
BLOCK = [0.045, 0.06, 0.05]
ANY_MOTION = ("approach", "deposit", "withdrawal", "departure", "transit", "transfer")


@broken(Truth(("too_wide",), by=(0.002, 0.001)))
def jaws_too_small_for_the_motor(folder: Path, is_broken: bool) -> Cell:
    """A motor of 30 mm; with the clearance on both sides the jaws open 2 mm too little."""
    parts = {"motor": lying(real("motor_body.stl"), [0.45, 0.25, 0.0], [0, 0, 0.1])}
    opening = 0.032 if is_broken else 0.06
    return cell(folder, {}, parts, [place("motor", [0.5, -0.3, 0.0])], opening=opening)


@broken(Truth(("out_of_reach",), "destination"))
def goal_too_high(folder: Path, is_broken: bool) -> Cell:
    """The goal is on a tower as high as the arm reaches straight up."""
    high = 1.62 if is_broken else 0.5
    fixtures = {"tower": on_table([0.2, 0.2, high], (0.5, -0.3))}
    parts = {"block": on_table(BLOCK, START)}
    return cell(folder, fixtures, parts, [place("block", [0.5, -0.3, high + 0.025])])


@broken(Truth(("collision", "obstructed", *ANY_MOTION), bodies=("ceiling",)))
def ceiling_too_low(folder: Path, is_broken: bool) -> Cell:
    """A ceiling over the table leaves no room for the arm over the part and its goal."""
    high = 0.16 if is_broken else 1.5
    fixtures = {"ceiling": box([1.2, 1.6, 0.03], [0.9, 0.0, high + 0.015])}
    parts = {"block": on_table(BLOCK, (0.6, 0.25))}
    return cell(folder, fixtures, parts, [place("block", [0.6, -0.25, 0.025])])


@broken(Truth(("collision", "obstructed"), "destination", bodies=("well",)))
def well_too_narrow(folder: Path, is_broken: bool) -> Cell:
    """The goal is at the bottom of a well into which the fingers fit, but not the palm."""
    half = 0.05 if is_broken else 0.16
    deep = 0.2
    walls = [box([0.01, 2 * half + 0.02, deep], [s * (half + 0.005), 0, deep / 2]) for s in (-1, 1)]
    walls += [box([2 * half, 0.01, deep], [0, s * (half + 0.005), deep / 2]) for s in (-1, 1)]
    parts = {"block": on_table([0.03, 0.04, 0.04], (0.45, 0.25))}
    fixtures = {"well": shapes(*walls, at=(0.5, -0.2))}
    return cell(folder, fixtures, parts, [place("block", [0.5, -0.2, 0.02])])


@broken(Truth(("joint_limit",), "destination", joints=("joint_1",)))
def small_arm_does_not_turn_so_far(folder: Path, is_broken: bool) -> Cell:
    """The goal is beside and behind the small arm, whose first joint does not turn so far."""
    limits = {"joint_1": (-1.0, 1.0)} if is_broken else {}
    table = {"box": [1.4, 1.4, 0.02], "pose": {"xyz": [0, 0, -0.012]}, "support": True}
    parts = {"block": box([0.03, 0.05, 0.04], [0.4, 0.1, 0.018])}
    goal = place("block", [-0.05, -0.4, 0.018])
    more: dict[str, Any] = {"opening": 0.08, "arm": "irb120", "limits": limits}
    return cell(folder, {}, parts, [goal], table=table, **more)


@broken(Truth(("collision", "obstructed", *ANY_MOTION), bodies=("door",)))
def cabinet_door_shut(folder: Path, is_broken: bool) -> Cell:
    """The part stands in a cabinet whose door is shut."""
    base, high = 0.3, 0.34
    boards = [
        box([0.3, 0.4, base], [0, 0, base / 2]),
        box([0.3, 0.4, 0.02], [0, 0, base + high + 0.01]),
        box([0.02, 0.4, high], [0.14, 0, base + high / 2]),
        box([0.28, 0.02, high], [-0.01, 0.19, base + high / 2]),
        box([0.28, 0.02, high], [-0.01, -0.19, base + high / 2]),
    ]
    at = (0.66, 0.25)
    fixtures = {"cabinet": shapes(*boards, at=at)}
    if is_broken:
        fixtures["door"] = box([0.015, 0.4, high], [at[0] - 0.16, at[1], base + high / 2])
    parts = {"block": box(BLOCK, [at[0] - 0.03, at[1], base + 0.025])}
    return cell(folder, fixtures, parts, [place("block", [0.5, -0.3, 0.025])])


@broken(Truth(("out_of_reach",), "destination"), goal=1)
def second_goal_too_far(folder: Path, is_broken: bool) -> Cell:
    """Of two goals the second lies beyond the arm's reach."""
    parts = {
        "wedge": lying(model("wedge"), [0.45, 0.3, 0], [0, 0, 0.3]),
        "block": on_table(BLOCK, (0.55, 0.15)),
    }
    far = [0.95, -0.35, 0.025] if is_broken else [0.65, -0.35, 0.025]
    task = [place("wedge", [0.4, -0.2, 0]), place("block", far)]
    return cell(folder, {}, parts, task)


@broken(
    Truth(("obstructed", "collision"), "origin", bodies=("bridge",)), Truth(("turns",), "origin")
)
def bridge_over_the_middle(folder: Path, is_broken: bool) -> Cell:
    """A heavy bar can be held at its middle only, and a bridge stands over that."""
    gap = 0.3 if is_broken else 0.0
    fixtures = {}
    if is_broken:
        fixtures["bridge"] = shapes(
            box([gap, 0.3, 0.02], [0, 0, 0.075]),
            box([0.02, 0.3, 0.065], [0.14, 0, 0.0325]),
            box([0.02, 0.3, 0.065], [-0.14, 0, 0.0325]),
            at=(0.5, 0.2),
        )
    bar = {**on_table([0.04, 0.44, 0.05], (0.5, 0.2)), "mass": 3.0}
    goal = place("bar", [0.5, -0.35, 0.025])
    return cell(folder, fixtures, {"bar": bar}, [goal])


@broken(Truth(("no_place",)))
def region_is_taken(folder: Path, is_broken: bool) -> Cell:
    """In the region in which the part is to stand is no room beside a crate."""
    crate = on_table([0.12, 0.12, 0.08], (0.5, -0.25) if is_broken else (0.35, 0.0))
    region = [[0.42, -0.33], [0.58, -0.17]]
    parts = {"u_block": lying(model("u_block"), [0.48, 0.25, 0], [0, 0, 0]), "crate": crate}
    goal = {"place": "u_block", "on": "table", "region": region}
    return cell(folder, {}, parts, [goal])


@broken(Truth(("collision", "obstructed", "no_place", *ANY_MOTION), bodies=("lid",)))
def lid_over_the_tray(folder: Path, is_broken: bool) -> Cell:
    """A lid hangs so low over the tray that the hand does not come under it."""
    walls = [box([0.01, 0.22, 0.03], [s * 0.105, 0, 0.015]) for s in (-1, 1)]
    walls += [box([0.2, 0.01, 0.03], [0, s * 0.105, 0.015]) for s in (-1, 1)]
    fixtures = {"tray": shapes(box([0.22, 0.22, 0.005], [0, 0, 0.0025]), *walls, at=GOAL)}
    if is_broken:
        fixtures["lid"] = box([0.4, 0.4, 0.01], [*GOAL, 0.085])
    parts = {"block": on_table(BLOCK, START)}
    return cell(folder, fixtures, parts, [{"place": "block", "inside": "tray"}])


@broken(
    Truth(refused="E_GOAL_IN_COLLISION", bodies=("block", "scan")),
    Truth(("in_the_way", "collision", "obstructed"), bodies=("scan",)),
)
def goal_in_the_measured_heap(folder: Path, is_broken: bool) -> Cell:
    """By the map of heights, a heap is where the part is to go."""
    heights = np.zeros((40, 40))
    heights[15:25, 15:25] = 0.05
    np.save(folder / "scan.npy", heights)
    y = GOAL[1] if is_broken else GOAL[1] + 0.45
    pose = {"xyz": [GOAL[0] - 0.1, y - 0.1, 0]}
    if not is_broken:
        pose["xyz"][0] = 0.7
    maps = {"scan": {"heights": "scan.npy", "cell": 0.005, "pose": pose}}
    parts = {"block": on_table(BLOCK, (0.35, 0.2))}
    return cell(folder, {}, parts, [place("block", [*GOAL, 0.025])], depth_maps=maps)


@broken(Truth(refused="E_START_IN_COLLISION", bodies=("bracket", "table")))
def part_sunk_into_the_table(folder: Path, is_broken: bool) -> Cell:
    """The part's start is given 20 mm too low."""
    z = -0.02 if is_broken else 0.0
    parts = {"bracket": lying(model("bracket"), [0.45, 0.25, z], [0, 0, 0.2])}
    return cell(folder, {}, parts, [place("bracket", [0.5, -0.25, 0.0])])


@broken(
    Truth(("collision", "obstructed", *ANY_MOTION), "destination", bodies=("crate",)),
    Truth(("transit", "transfer"), bodies=("crate",)),
)
def crate_before_the_niche(folder: Path, is_broken: bool) -> Cell:
    """A crate, which may not be moved, stands before the niche into which the part is to go."""
    at = (0.62, -0.22)
    walls = [
        box([0.02, 0.26, 0.30], [0.11, 0, 0.15]),
        box([0.2, 0.02, 0.30], [0, 0.12, 0.15]),
        box([0.2, 0.02, 0.30], [0, -0.12, 0.15]),
        box([0.22, 0.26, 0.02], [0, 0, 0.31]),
    ]
    crate = on_table([0.1, 0.2, 0.28], (0.46, -0.22) if is_broken else (0.45, 0.5))
    parts = {"block": on_table(BLOCK, (0.5, 0.25)), "crate": crate}
    fixtures = {"niche": shapes(*walls, at=at)}
    return cell(folder, fixtures, parts, [place("block", [*at, 0.025])])


@broken(Truth(("would_fall",), bodies=("middle",)))
def bottom_of_a_stack(folder: Path, is_broken: bool) -> Cell:
    """The lowest of three parts is to be moved; those on it may not be."""
    size = [0.06, 0.08, 0.04]
    other = START if is_broken else (0.35, -0.05)
    low = 0.04 if is_broken else 0.0
    parts = {
        "bottom": on_table(size, START),
        "middle": box(size, [*other, low + 0.02]),
        "top": box([0.04, 0.05, 0.04], [*other, low + 0.06]),
    }
    return cell(folder, {}, parts, [place("bottom", [*GOAL, 0.02])])


@broken(
    Truth(refused="E_GOAL_IN_COLLISION", bodies=("one", "other")),
    Truth(("in_the_way",), bodies=("other",)),
)
def other_leaves_too_late(folder: Path, is_broken: bool) -> Cell:
    """The first goal is where another part stands until the second goal."""
    parts = {"one": on_table(BLOCK, START), "other": on_table(BLOCK, GOAL)}
    task = [place("one", [*GOAL, 0.025]), place("other", [0.35, 0.0, 0.025])]
    return cell(folder, {}, parts, task if is_broken else task[::-1])


@broken(Truth(("no_regrasp",)))
def support_out_of_reach(folder: Path, is_broken: bool) -> Cell:
    """The part must be put down to be turned over, and the only support is out of reach."""
    x = 1.35 if is_broken else 0.55
    fixtures = {"ledge": {**on_table([0.3, 0.3, 0.03], (x, 0.0)), "support": True}}
    cross = lying(model("cross"), [0.48, 0.32, 0.0], [0, 0, 0.2])
    goal = {
        "place": "cross",
        "at": {"xyz": [0.45, -0.32, 0.04], "rpy": [3.141592653589793, 0, 0.5]},
    }
    return cell(folder, fixtures, {"cross": cross}, [goal], table=BARE)


@broken(Truth(refused="E_UNITS"), Truth(refused="E_RANGE"))
def part_in_the_wrong_unit(folder: Path, is_broken: bool) -> Cell:
    """The mesh of the part, which is in metres, is read as if it were a thousand times larger."""
    mesh = real("lshape.stl", 1000.0 if is_broken else 1.0)
    parts = {"lshape": lying(mesh, [0.5, 0.3, 0.0], [0, 0, 0.4])}
    return cell(folder, {}, parts, [place("lshape", [0.45, -0.2, 0.0], -0.6)])


@broken(Truth(("obstructed", "collision"), "destination", bodies=("crate", "wall")))
def crate_at_the_wall(folder: Path, is_broken: bool) -> Cell:
    """The goal is at a wall, and on a side that can be held then stands a crate."""
    fixtures = {"wall": on_table([0.02, 0.2, 0.12], (0.54, -0.25))}
    away = 0.045 + (0.006 if is_broken else 0.15) + 0.05
    parts = {
        "block": on_table([0.05, 0.09, 0.05], START),
        "crate": on_table([0.1, 0.1, 0.08], (0.475, -0.25 - away)),
    }
    return cell(folder, fixtures, parts, [place("block", [0.5, -0.25, 0.025])])


@broken(Truth(("obstructed", "collision", "approach", "deposit"), "destination", bodies=("bench",)))
def bench_over_the_goal(folder: Path, is_broken: bool) -> Cell:
    """The small arm is to put the part under the midst of a bench, where its hand has no room."""
    high = 0.09
    legs = [box([0.02, 0.02, high], [x, y, high / 2]) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    board = box([0.42, 0.42, 0.015], [0, 0, high + 0.0075])
    parts = {"block": on_table([0.03, 0.05, 0.04], (0.3, 0.25))}
    at = (0.42, -0.15)
    fixtures = {"bench": shapes(board, *legs, at=at)} if is_broken else {}
    goal = place("block", [*at, 0.02])
    return cell(folder, fixtures, parts, [goal], opening=0.08, arm="irb120")


@broken(Truth(("obstructed", "collision"), "origin", bodies=("nest",)))
def plus_in_its_nest(folder: Path, is_broken: bool) -> Cell:
    """A plus of 20 mm stands in a nest as high as it is, with 2 mm all round."""
    half, out, at = (0.012 if is_broken else 0.06), 0.1, (0.48, 0.25)
    walls = [box([out - half, 2 * out, 0.02], [s * (out + half) / 2, 0, 0.01]) for s in (-1, 1)]
    walls += [box([2 * half, out - half, 0.02], [0, s * (out + half) / 2, 0.01]) for s in (-1, 1)]
    parts = {"plus": lying(real("kit_plus.obj", 0.001), [*at, 0.0], [0, 0, 0])}
    fixtures = {"nest": shapes(*walls, at=at)}
    return cell(folder, fixtures, parts, [place("plus", [0.5, -0.25, 0.0])])
