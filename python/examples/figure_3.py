"""A two-link planar arm among obstacles, and its configuration space: a torus.

Column by column of theta1 the core gives the exact angles of the second joint that obstacles
forbid; the free intervals of neighbouring columns, linked where they overlap, are searched for the
shortest way. Both angles go round, and so does the way.
Not guaranteed: what lies between two columns; slices made of cells are for that.
Article: Figure 3.
Usage: figure_3.py [SVG]
"""

import heapq
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Marker, Paint, wrapped

COLUMNS = 360  # one degree each
FACES = 72  # of the torus in space, each way round
EYE = np.radians([70.0, 48.0])  # turn of the torus, and height of the eye
MARGIN = np.radians(3.0)  # kept from the ends of the free intervals, where there is room
TURN = 2 * np.pi
LENGTHS, HALF_WIDTH = (0.5, 0.42), 0.035  # of the links [m]
START, GOAL = np.radians([205.0, 60.0]), np.radians([290.0, 300.0])

LINK = Paint("#3f74ad", "#1e4670", 0.8, opacity=0.95, label="arm at start and goal")
GHOST = Paint("#9dbbdc", "#6f93bd", 0.5, opacity=0.45, label="arm on its way")
BODY = Paint("#7d8793", "#4a525c", 0.7, label="obstacle")
BLOCKED = Paint("#aab3be", label="forbidden")
PATH = Paint(stroke="#0b3d91", width=2.0, label="path")
AT_START = Paint("#2a8a3c", "#ffffff", 1.0, label="start")
AT_GOAL = Paint("#c43c2c", "#ffffff", 1.0, label="goal")


def link(length: float) -> np.ndarray:
    """A link along x from its joint, with blunt ends, counter-clockwise (8, 2) [m]."""
    w, b = HALF_WIDTH, 0.4 * HALF_WIDTH
    right = [(length + b, -w + b), (length + w, -b), (length + w, b), (length + b, w - b)]
    low, high = [(-b, -w), (length, -w)], [(length, w), (-b, w)]
    return np.array([*low, *right[1:3], *high, (-w, b), (-w, -b)])


ARM = _core.PlanarArm(upper=[link(LENGTHS[0])], lower=[link(LENGTHS[1])], elbow=[LENGTHS[0], 0.0])
OBSTACLES = [
    np.array([(0.46, 0.34), (0.62, 0.30), (0.70, 0.44), (0.54, 0.52)]),
    np.array([(-0.66, 0.22), (-0.52, 0.20), (-0.46, 0.38), (-0.60, 0.46)]),
    np.array([(-0.30, -0.62), (-0.12, -0.66), (-0.08, -0.50), (-0.24, -0.44)]),  # bars the way
    np.array([(0.62, -0.22), (0.78, -0.30), (0.86, -0.14), (0.70, -0.06)]),
]


def free_intervals(forbidden: np.ndarray) -> list[tuple[float, float]]:
    """What is left of the circle; the last interval may pass a whole turn."""
    if len(forbidden) == 0:
        return [(0.0, TURN)]
    ends = np.append(forbidden[:, 0], forbidden[0, 0] + TURN)[1:]
    gaps = zip(forbidden[:, 1], ends, strict=True)
    return [(low + MARGIN, high - MARGIN) for low, high in gaps if high - low > 2 * MARGIN]


def nearest_inside(low: float, high: float, angle: float) -> float:
    """The value nearest to an angle (not wrapped) that lies in an interval of the circle."""
    if high - low >= TURN:
        return angle
    turns = np.round((angle - (low + high) / 2) / TURN)
    return float(np.clip(angle, low + turns * TURN, high + turns * TURN))


def find_path(columns: list[list[tuple[float, float]]]) -> np.ndarray:
    """The shortest way found from interval to interval (n, 2), angles not wrapped [rad]."""
    step = TURN / COLUMNS
    first, last = (round(q[0] / step) % COLUMNS for q in (START, GOAL))

    def interval_of(column: int, angle: float) -> int:
        distances = [abs(nearest_inside(*gap, angle) - angle) for gap in columns[column]]
        return int(np.argmin(distances))

    begin, end = (first, interval_of(first, START[1])), (last, interval_of(last, GOAL[1]))
    nowhere = (-1, -1)
    queue = [(0.0, begin, (float(START[0]), float(START[1])), nowhere)]
    come_from: dict[tuple[int, int], tuple[tuple[int, int], tuple[float, float]]] = {}
    while queue:
        cost, node, place, parent = heapq.heappop(queue)
        if node in come_from:
            continue
        come_from[node] = (parent, place)
        if node == end:
            break
        for side in (-1, 1):
            column = (node[0] + side) % COLUMNS
            for k, gap in enumerate(columns[column]):
                angle = nearest_inside(*gap, place[1])
                # Within the interval here, too: a corner of the way is free in both columns.
                if abs(nearest_inside(*columns[node[0]][node[1]], angle) - angle) > 1e-9:
                    continue
                there = (place[0] + side * step, angle)
                length = float(np.hypot(step, angle - place[1]))
                heapq.heappush(queue, (cost + length, (column, k), there, node))
    places, node = [], end if end in come_from else nowhere
    while node != nowhere:
        node, place = come_from[node]
        places.append(place)
    if not places:
        return np.empty((0, 2))
    turns = np.round((np.array(places[0]) - GOAL) / TURN)
    return np.array([*places[::-1], GOAL + turns * TURN])


def refined(path: np.ndarray) -> np.ndarray:
    """The path in steps of at most a degree."""
    parts = [path[:1]]
    for a, b in pairwise(path):
        count = max(1, int(np.ceil(np.degrees(np.abs(b - a).max()) - 1e-9)))
        parts.append(a + np.linspace(0.0, 1.0, count + 1)[1:, None] * (b - a))
    return np.concatenate(parts)


def placed(q: np.ndarray) -> list[np.ndarray]:
    """The outlines of both links at a configuration."""
    turn1, turn2 = (
        np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) for a in (q[0], q[0] + q[1])
    )
    return [ARM.upper[0] @ turn1, ARM.elbow @ turn1 + ARM.lower[0] @ turn2]


def hits(q: np.ndarray) -> bool:
    """Does the arm meet an obstacle? By the areas in common, not by the slice."""
    links = [_core.Region([outline]) for outline in placed(q)]
    bodies = [_core.Region([outline]) for outline in OBSTACLES]
    return any(_core.intersect(a, b).area > 0 for a in links for b in bodies)


def workspace(path: np.ndarray) -> Panel:
    """Obstacles and arm."""
    x, y = Axis("x [m]", -1.05, 1.05, False, 0.5), Axis("y [m]", -1.05, 1.05, False, 0.5)
    panel = Panel("(a) workspace", x, y, 290, None)
    panel.add(*(Area([body], BODY) for body in OBSTACLES))
    for q in path[::24]:
        panel.add(*(Area([outline], GHOST) for outline in placed(q)))
    for q in (START, GOAL):
        panel.add(*(Area([outline], LINK) for outline in placed(q)))
    hinge = Paint("#ffffff", "#1e4670", 1.0)
    panel.add(Marker((0, 0), "circle", hinge, 3.5))
    for q, paint, kind in ((START, AT_START, "circle"), (GOAL, AT_GOAL, "square")):
        turns = np.cumsum(q)
        tip = LENGTHS @ np.column_stack([np.cos(turns), np.sin(turns)])
        panel.add(Marker((tip[0], tip[1]), kind, paint))
    return panel


def chart(forbidden: list[np.ndarray], path: np.ndarray) -> Panel:
    """The torus cut open: each edge of the chart continues at the one opposite."""
    x, y = Axis("\u03b8\u2081", 0, 360, tick=90), Axis("\u03b8\u2082", 0, 360, tick=90)
    panel = Panel("(b) configuration space", x, y, 290, 290)
    half, bars = 180 / COLUMNS, []
    for column, intervals in enumerate(forbidden):
        centre = 360 * column / COLUMNS
        for low, high in np.degrees(intervals):
            left, right = centre - half, centre + half
            bars.append(np.array([(left, low), (right, low), (right, high), (left, high)]))
    panel.add(Area(bars, BLOCKED))
    panel.add(Line(wrapped(np.degrees(path), (0, 0), (360, 360)), PATH))
    panel.add(Marker(tuple(np.degrees(START)), "circle", AT_START))
    panel.add(Marker(tuple(np.degrees(GOAL)), "square", AT_GOAL))
    return panel


def torus(path: np.ndarray) -> Panel:
    """The torus in space, far faces first, those turned away left out."""
    edge = Axis("", -1.5, 1.5, False)
    panel = Panel("(c) the same as a torus", edge, edge, 290, None, framed=False)
    drawn = [*_faces(), *_stretches(path)]
    panel.add(*(mark for _, mark in sorted(drawn, key=lambda entry: entry[0])))
    return panel


def on_torus(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 3) across, up and towards the eye, and how far the surface faces the eye."""
    around, about = theta[:, 0] + EYE[0], theta[:, 1]
    outward = np.column_stack(
        [np.cos(about) * np.cos(around), np.cos(about) * np.sin(around), np.sin(about)]
    )
    ring = np.column_stack([np.cos(around), np.sin(around), np.zeros_like(around)])
    s, c = np.sin(EYE[1]), np.cos(EYE[1])
    view = np.array([[1, 0, 0], [0, s, c], [0, -c, s]])
    return (ring + 0.45 * outward) @ view.T, outward @ view[2]


def _faces() -> list[tuple[float, Area]]:
    """The faces of the torus by their distance, grey where forbidden."""
    middles = (np.arange(FACES) + 0.5) * TURN / FACES
    half, faces = TURN / FACES / 2, []
    columns = _core.planar_slice(ARM, OBSTACLES, middles)
    corners = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    for theta1, forbidden in zip(middles, columns, strict=True):
        for theta2 in middles:
            middle = np.array([theta1, theta2])
            (place,), (facing,) = on_torus(middle[None])
            if facing <= -0.1:
                continue
            is_blocked = any(low <= theta2 <= high for low, high in forbidden)
            light = 0.62 + 0.38 * max(0.0, facing)
            grey = [light * v for v in ((150, 160, 173) if is_blocked else (255, 255, 255))]
            colour = "#" + "".join(f"{round(v):02x}" for v in grey)
            outline, _ = on_torus(middle + corners)
            faces.append((place[2], Area([outline[:, :2]], Paint(colour, colour, 0.5))))
    return faces


def _stretches(path: np.ndarray) -> list[tuple[float, Line | Marker]]:
    """The path by its distance, piece by piece, where the surface faces the eye."""
    places, facing = on_torus(path)
    pieces: list[tuple[float, Line | Marker]] = []
    for i in np.flatnonzero((facing[:-1] > 0) & (facing[1:] > 0)):
        line = Line([places[i : i + 2, :2]], PATH.unnamed())
        pieces.append((places[i, 2] + 0.1, line))  # before the faces that it lies on
    for i, paint, kind in ((0, AT_START, "circle"), (-1, AT_GOAL, "square")):
        if facing[i] > 0:
            pieces.append((places[i, 2] + 0.1, Marker(tuple(places[i, :2]), kind, paint)))
    return pieces


def main(picture: Path) -> bool:
    """Run the example; true if it found what it says."""
    angles = TURN * np.arange(COLUMNS) / COLUMNS
    forbidden = _core.planar_slice(ARM, OBSTACLES, angles)
    path = refined(find_path([free_intervals(column) for column in forbidden]))
    if len(path) == 0:
        print("no way")
        return False
    caption = (
        "A two-link planar arm. (a) The arm at start and goal, and on its way. (b) Its "
        "configuration space, exact in each column of \u03b8\u2081: opposite edges of the chart "
        "are one, and the path goes over them. (c) Joined at its edges, the chart is a torus; the "
        "goal is on its far side."
    )
    Figure([[workspace(path), chart(forbidden, path), torus(path)]], caption, "planar arm").save(
        picture
    )
    goes_round = any(np.floor(path / TURN).max(axis=0) != np.floor(path / TURN).min(axis=0))
    length = np.degrees(np.abs(np.diff(path, axis=0)).sum(axis=0))
    print(f"path of {len(path)} points, joints turn {length[0]:.0f} and {length[1]:.0f} degrees")
    return goes_round and not any(hits(q) for q in path)


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "figure_3.svg")))
