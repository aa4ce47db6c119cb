"""The configuration space of a disembodied hand: where its reference point may be, turn by turn.

A gripper without an arm moves in a plane. For each orientation an obstacle grows by the mirrored
hand (Minkowski sum) to the places of the reference point at which the two meet; a slice of
configuration space for each orientation follows. Article: Figure 2.
Usage: figure_2.py [SVG]
"""

import sys
from pathlib import Path

import numpy as np

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Marker, Note, Paint

WIDTH, HEIGHT = 0.66, 0.58  # of the table's top [m]
START, GOAL = np.array([0.12, 0.14]), np.array([0.36, 0.28])  # of the reference point
ORIENTATIONS = (0.0, 45.0, 90.0)  # [degrees]

BLOCKED = Paint("#aab3be", "#6c7784", 0.7, label="a collision")
FREE = Paint("#ffffff", label="free")
REACHED = Paint("#dcebd9", label="free and joined to the start")
BODY = Paint("#7d8793", "#4a525c", 0.7, label="obstacle")
BLOCK = Paint("#d9b26a", "#8a6a24", 0.7, label="block to be grasped")
HAND = Paint("#3f74ad", "#1e4670", 0.7, opacity=0.85, label="hand")
AT_START = Paint("#2a8a3c", "#ffffff", 1.0, label="start")
AT_GOAL = Paint("#c43c2c", "#ffffff", 1.0, label="grasp")


def rectangle(x0: float, y0: float, x1: float, y1: float) -> np.ndarray:
    """A rectangle, counter-clockwise, (4, 2) [m]."""
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


# The hand: palm and two fingers about the reference point between their tips, fingers along +y.
PIECES = [
    rectangle(-0.075, -0.095, 0.075, -0.060),
    rectangle(-0.075, -0.060, -0.055, 0.015),
    rectangle(0.055, -0.060, 0.075, 0.015),
]
TARGET = rectangle(0.325, 0.25, 0.395, 0.31)
OBSTACLES = [
    rectangle(0.24, 0.165, 0.335, 0.195),  # a bar before the block
    rectangle(0.28, 0.42, 0.46, 0.46),  # a wall behind it
    np.array([(0.44, 0.19), (0.43, 0.16), (0.46, 0.14), (0.49, 0.16), (0.48, 0.19)]),  # a post
    np.array([(0.08, 0.36), (0.17, 0.34), (0.19, 0.44), (0.11, 0.48)]),
]


def turned(polygon: np.ndarray, degrees: float) -> np.ndarray:
    """The polygon turned about the origin."""
    angle = np.radians(degrees)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return polygon @ turn.T


def minkowski_sum(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The sum of two convex polygons, counter-clockwise: their edges in the order of direction."""
    edges = np.concatenate([np.roll(p, -1, axis=0) - p for p in (a, b)])
    order = np.argsort(np.arctan2(edges[:, 1], edges[:, 0]) % (2 * np.pi), kind="stable")
    lowest = sum(p[np.lexsort((p[:, 0], p[:, 1]))[0]] for p in (a, b))
    return lowest + np.cumsum(edges[order], axis=0)


def free_space(degrees: float) -> list[_core.Region]:
    """The connected pieces of where the reference point may be."""
    bodies = [*OBSTACLES, TARGET]
    hand = [turned(piece, degrees) for piece in PIECES]
    grown = [minkowski_sum(body, -piece) for body in bodies for piece in hand]
    blocked = _core.unite([_core.Region([polygon]) for polygon in grown])
    table = _core.Region([rectangle(0, 0, WIDTH, HEIGHT)])
    return _core.connected_parts(_core.subtract(table, blocked))


def axes(title: str) -> Panel:
    """An empty panel of the table's top."""
    x, y = Axis("x [m]", 0, WIDTH, False, 0.1), Axis("y [m]", 0, HEIGHT, False, 0.1)
    return Panel(title, x, y, width=250, height=None)


def workspace() -> Panel:
    """The obstacles, and the hand at the start and at the block in each orientation."""
    panel = axes("(a) workspace")
    panel.add(*(Area([body], BODY) for body in OBSTACLES), Area([TARGET], BLOCK))
    for place, degrees in ((START, 0.0), (GOAL, ORIENTATIONS[-1])):
        panel.add(*(Area([place + turned(piece, degrees)], HAND) for piece in PIECES))
    panel.add(Marker(tuple(START), "circle", AT_START), Marker(tuple(GOAL), "square", AT_GOAL))
    return panel


def slice_of(degrees: float, name: str) -> tuple[Panel, str]:
    """The slice of one orientation, and how the grasp stands in it."""
    panel = axes(f"{name} hand at {degrees:.0f}\u00b0")
    panel.add(Area([rectangle(0, 0, WIDTH, HEIGHT)], BLOCKED))
    state = "blocked"
    for piece in free_space(degrees):
        is_start, is_goal = piece.contains(START), piece.contains(GOAL)
        state = ("joined" if is_start else "cut off") if is_goal else state
        panel.add(Area(piece.loops, REACHED if is_start else FREE))
    outline = Paint(stroke="#4a525c", width=0.8, dash="3 2")
    panel.add(Line([np.vstack([body, body[:1]]) for body in [*OBSTACLES, TARGET]], outline))
    panel.add(Marker(tuple(START), "circle", AT_START), Marker(tuple(GOAL), "square", AT_GOAL))
    panel.add(Note(tuple(GOAL), state, (8, -8)))
    return panel, state


def main(picture: Path) -> bool:
    """Run the example; true if it found what it says."""
    names = ("(b)", "(c)", "(d)")
    slices = [slice_of(turn, name) for turn, name in zip(ORIENTATIONS, names, strict=True)]
    caption = (
        "Configuration space of a disembodied hand. (a) The hand at its start and at the grasp. "
        "(b) to (d) Places of its reference point between the finger tips, for three orientations: "
        "each obstacle (dashed) has grown by the mirrored hand. Only in the slice of "
        "90\u00b0 can the start be joined to the grasp by a translation."
    )
    panels = [workspace(), *(panel for panel, _ in slices)]
    Figure([panels[:2], panels[2:]], caption, "configuration space of a hand").save(picture)
    states = [state for _, state in slices]
    for turn, state in zip(ORIENTATIONS, states, strict=True):
        print(f"hand at {turn:.0f} degrees: the grasp is {state}")
    return states == ["blocked", "cut off", "joined"]


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "figure_2.svg")))
