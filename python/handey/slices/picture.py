"""A picture of the slices of a gross motion: free, blocked, start, goal and path.

One row for each slice (wrist as at the start, anywhere between, as at the goal), one column for
each waist angle, theta2 across and theta3 upwards. The path is drawn whole, and bold where its
waist angle is near that of the column. Article: Figure 7.
"""

from __future__ import annotations

import numpy as np

from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Cells, Line, Mark, Marker, Paint, wrapped
from handey.slices.layers import BLOCKED, FREE, NOT_PROVED, Layer, wrist_range
from handey.slices.legs import Leg

__all__ = ["default_angles", "slice_figure", "slice_panel"]

NEAR = np.radians(4.0)  # Choice: half a cell of the range slice
APART = np.radians(2.0)  # Choice: waist angles nearer than this share a column
KINDS = {
    FREE: Paint(label="proved free"),
    NOT_PROVED: Paint("#f3d48f", label="free at the cell's centre, not proved"),
    BLOCKED: Paint("#99a4b1", label="collision at the cell's centre"),
}
PATH = Paint(stroke="#5d7fb0", width=1.0, dash="3 2.5", label="path")
PATH_HERE = Paint(stroke="#0b3d91", width=2.4, label="path near this \u03b8\u2081")
START, GOAL = "#1f8a3a", "#c8321f"
ROWS = {
    "start": "wrist as at the start",
    "range": "wrist anywhere between",
    "goal": "wrist as at the goal",
}


def default_angles(leg: Leg) -> list[float]:
    """The waist angles of start, half way and goal; those close to one before are left out."""
    turned = leg.positions[:, 0]
    angles: list[float] = []
    for angle in (turned[0], (turned[0] + turned[-1]) / 2, turned[-1]):  # all on the path
        if all(abs(angle - other) >= APART for other in angles):
            angles.append(float(angle))
    return angles


def slice_figure(leg: Leg, layers: list[Layer], name: str) -> Figure:
    """The figure of some layers.

    Args:
        leg: the gross motion.
        layers: slice by slice, the same waist angles for each.
        name: of the cell.
    """
    slices = list(dict.fromkeys(layer.slice for layer in layers))
    rows = [[slice_panel(leg, layer) for layer in layers if layer.slice == s] for s in slices]
    titles = [ROWS[s] for s in slices]
    return Figure(rows, _caption(leg, layers, name), f"slices of {name}", True, titles)


def slice_panel(
    leg: Leg, layer: Layer, window: np.ndarray | None = None, size: float = 220.0
) -> Panel:
    """The panel of one layer.

    Args:
        leg: the gross motion.
        layer: of one of its slices.
        window: least and greatest theta2 and theta3 shown (2, 2) [rad]; None for all.
        size: of the frame [picture units].
    """
    lower, cell = np.degrees(layer.lower), np.degrees(layer.size)
    shown = np.array([lower, lower + cell * layer.kinds.shape[::-1]])
    if window is not None:
        least, most = np.degrees(window)
        shown = np.array([np.maximum(shown[0], least), np.minimum(shown[1], most)])
    x = Axis("\u03b8\u2082", float(shown[0, 0]), float(shown[1, 0]))
    y = Axis("\u03b8\u2083", float(shown[0, 1]), float(shown[1, 1]))
    panel = Panel(_title(leg, layer), x, y, size, size)
    paints = [KINDS[kind] for kind in (FREE, NOT_PROVED, BLOCKED)]
    panel.add(Cells(layer.kinds, (lower[0], lower[1]), (cell[0], cell[1]), paints))
    panel.add(*_path(leg, layer), *_ends(leg, layer))
    return panel


def _title(leg: Leg, layer: Layer) -> str:
    places = {"start": leg.positions[0, 0], "goal": leg.positions[-1, 0]}
    near = [name for name, angle in places.items() if abs(angle - layer.theta1) < APART]
    angle = _angle(np.degrees(layer.theta1))
    return f"\u03b8\u2081 = {angle}" + (f" ({' and '.join(near)})" if near else "")


def _path(leg: Leg, layer: Layer) -> list[Mark]:
    """The whole path, and bold the pieces of it whose waist angle is near the layer's."""
    rows = _refined(leg.positions)
    places = np.degrees(rows[:, 1:3])
    is_near = np.abs(rows[:, 0] - layer.theta1) <= NEAR
    changes = np.flatnonzero(np.diff(is_near)) + 1
    pieces = np.split(places, changes)
    first = 0 if is_near[0] else 1
    near = [piece for bold in pieces[first::2] for piece in _laid(leg, layer, bold)]
    return [Line(_laid(leg, layer, places), PATH), Line(near, PATH_HERE)]


def _refined(positions: np.ndarray) -> np.ndarray:
    """The path in steps so short that pieces can be told by their points."""
    steps = np.max(np.abs(np.diff(positions[:, :3], axis=0)), axis=1, initial=0.0)
    counts = np.maximum(1, np.ceil(steps / np.radians(0.25))).astype(int)
    parts = [
        a + np.linspace(0.0, 1.0, count, endpoint=False)[:, None] * (b - a)
        for a, b, count in zip(positions[:-1], positions[1:], counts, strict=True)
    ]
    return np.concatenate([*parts, positions[-1:]])


def _laid(leg: Leg, layer: Layer, places: np.ndarray) -> list[np.ndarray]:
    """A line in the panel: joints without limits wrap around."""
    lower = np.degrees(layer.lower)
    joints = leg.cell.robot.joints[1:3]
    period = [0.0 if np.isfinite(joint.limit.lower) else 360.0 for joint in joints]
    return wrapped(places, (lower[0], lower[1]), (period[0], period[1]))


def _ends(leg: Leg, layer: Layer) -> list[Mark]:
    """Start and goal, hollow where their waist angle is not near the layer's."""
    marks: list[Mark] = []
    for row, kind, colour, name in ((0, "circle", START, "start"), (-1, "square", GOAL, "goal")):
        q = leg.positions[row]
        is_here = abs(q[0] - layer.theta1) <= NEAR
        fill, stroke = (colour, "#ffffff") if is_here else ("#ffffff", colour)
        paint = Paint(fill, stroke, 1.2 if is_here else 1.6, label=name if is_here else "")
        (place,) = _laid(leg, layer, np.degrees([q[1:3], q[1:3]]))
        marks.append(Marker((place[0][0], place[0][1]), kind, paint))
    return marks


def _caption(leg: Leg, layers: list[Layer], name: str) -> str:
    hand = f"{leg.held} in the hand" if leg.held else "hand empty"
    sizes = {layer.slice: np.degrees(max(layer.size)) for layer in layers}
    cells = ", ".join(f"{ROWS[s]}: {size:.2g}\u00b0" for s, size in sizes.items())
    if leg.step < 0:
        return f"Slices of the configuration space of {name} at the start, {hand}. Cells: {cells}."
    lower, upper = np.degrees(wrist_range(leg))
    joints = [joint.name for joint in leg.cell.robot.joints[3:]]
    turns = [
        f"{joint} {_angle(a)}" if abs(a - b) < 0.05 else f"{joint} {_angle(a)} to {_angle(b)}"
        for joint, a, b in zip(joints, lower, upper, strict=True)
    ]
    return (
        f"Slices of the configuration space of {name} for the {leg.action} of step {leg.step}, "
        f"{hand}. Wrist between start and goal: {', '.join(turns)}. Cells: {cells}. The path is "
        f"bold where its \u03b8\u2081 is within {_angle(np.degrees(NEAR))} of the panel's; start "
        f"and goal are hollow where theirs is not.{_reason(layers)}"
    )


def _reason(layers: list[Layer]) -> str:
    reasons = dict.fromkeys(layer.reason for layer in layers if layer.reason)
    return "".join(f" No cell with the wrist anywhere between is free: {r}." for r in reasons)


def _angle(degrees: float) -> str:
    """An angle in words, to a tenth of a degree."""
    shown = f"{round(degrees, 1) + 0.0:.1f}".removesuffix(".0")  # + 0.0: no minus before zero
    return shown.replace("-", "\u2212") + "\u00b0"
