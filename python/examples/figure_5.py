"""A slide in the grasp plane: the hand is drawn to its target, bump lines keep it off obstacles.

The open hand slides to a block under a roof. Bump lines stand round it at a small distance; the
bump vector of a line that touches a filled cell becomes zero. The hand goes along the goal vector
where no zeroed vector forbids it, else along the bump vector that is left nearest to it, and turns
away from what it touches.
Article: "Local planning: the quasipotential method", Figure 5.
Usage: figure_5.py [SVG [MODELS]]
"""

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
from grasp_plane import PlaneScene, arrow, placed, plane_scene, slide
from puma560 import at, box, table_cell

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Marker, Paint

GRID, HALF_SIZE, CLEARANCE = 0.004, 0.20, 0.006  # [m]
# As seen from the side: places from the block's middle [m], direction of the hand [degrees].
START, DIRECTION, TARGET = (-0.10, 0.12), -75.0, (-0.03, 0.004)
MIDDLE = 0.18  # height of the block's middle [m]
VECTOR, HEAD = 0.016, 0.004  # lengths of a unit vector and of an arrow's head in the picture [m]

RULES = Paint(stroke="#e4e7eb", width=0.5, label="grid of 4 mm")
PART = Paint("#f2e2bf", "#8a6a24", 1.0, opacity=0.8, label="block, between the fingers")
HAND = Paint("#3f74ad", "#1e4670", 0.8, opacity=0.7, label="hand: finger and palm")
GHOST = Paint("#9dbbdc", "#3f74ad", 0.5, opacity=0.3, label="hand on its way")
PATH = Paint(stroke="#0b3d91", width=1.6, label="path of the finger point")
FREE = Paint(stroke="#2a8a3c", width=1.5, label="bump line that touches nothing, and its vector")
HIT = Paint(stroke="#c43c2c", width=2.6, label="bump line that touches: its vector is zero")
WISH = Paint(stroke="#e07b00", width=2.2, label="goal vector")
MOVE = Paint(stroke="#111111", width=2.2, label="way that the hand then takes")
AT_TARGET = Paint("#c43c2c", "#ffffff", 1.0, label="target of the finger point")


def scene(models: Path) -> PlaneScene:
    """The block can be reached only from one side, below the roof."""
    fixtures = [
        box("stand", [0.16, 0.12, 0.15], at(0.53, 0.10, 0.075)),
        box("roof", [0.16, 0.20, 0.03], at(0.580, 0.10, 0.27)),
        box("sill", [0.02, 0.20, 0.185], at(0.385, 0.10, 0.0925)),
    ]
    block = box("block", [0.12, 0.03, 0.06], at(0.53, 0.10, MIDDLE))
    return plane_scene(table_cell(models, fixtures, [block]), at(0.45, -0.35, 0.03))


def touching(
    grid: _core.MotionGrid, lines: list[_core.BumpLine], pose: _core.PlanarPose
) -> list[bool]:
    """Which bump lines touch filled cells of their layer?"""
    ends = [placed(np.array([line.a, line.b]), pose) for line in lines]
    return [grid.touches(line.layer, *end) for line, end in zip(lines, ends, strict=True)]


def most_turned_aside(
    grid: _core.MotionGrid,
    lines: list[_core.BumpLine],
    path: list[_core.PlanarPose],
    target: _core.PlanarPose,
) -> int:
    """The step that leaves the goal vector most."""
    least, found = 1.0, 0
    for index, (here, there) in enumerate(pairwise(path[:-1])):
        move, wish = _vector(here, there), _vector(here, target)
        along = move @ wish / (np.linalg.norm(move) * np.linalg.norm(wish) + 1e-12)
        if along < least and any(touching(grid, lines, here)):
            least, found = along, index
    return found


def _vector(a: _core.PlanarPose, b: _core.PlanarPose) -> np.ndarray:
    return np.array([b.x - a.x, b.y - a.y])


def whole_slide(
    panel: Panel, there: PlaneScene, path: list[_core.PlanarPose], target: _core.PlanarPose
) -> None:
    """The hand at the start, on its way, and at the end."""
    for pose in path[:-1:9]:
        panel.add(*there.hand(pose, GHOST))
    panel.add(*there.hand(path[-1], HAND))
    panel.add(Line([there.seen(np.array([[p.x, p.y] for p in path]))], PATH))
    panel.add(_target(there, target))


def _target(there: PlaneScene, target: _core.PlanarPose) -> Marker:
    ((x, y),) = there.seen(np.array([[target.x, target.y]]))
    return Marker((x, y), "diamond", AT_TARGET)


def one_step(
    panel: Panel,
    there: PlaneScene,
    lines: list[_core.BumpLine],
    hits: list[bool],
    steps: tuple[_core.PlanarPose, _core.PlanarPose, _core.PlanarPose],
) -> None:
    """Bump lines and vectors at one pose; steps: here, next, target."""
    here, after, target = steps
    panel.add(*there.hand(here, HAND))
    for line, hit in zip(lines, hits, strict=True):
        ends = placed(np.array([line.a, line.b]), here)
        panel.add(Line([there.seen(ends)], HIT if hit else FREE))
        if not hit:
            middle = ends.mean(axis=0)
            tip = placed(np.array([(line.a + line.b) / 2 + VECTOR * line.normal]), here)[0]
            panel.add(arrow(*there.seen(np.array([middle, tip])), HEAD, FREE))
    finger = np.array([here.x, here.y])
    for vector, paint in ((_vector(here, target), WISH), (_vector(here, after), MOVE)):
        tip = finger + 2.2 * VECTOR * vector / np.linalg.norm(vector)
        panel.add(arrow(*there.seen(np.array([finger, tip])), HEAD, paint))
    panel.add(_target(there, target))


def axes(there: PlaneScene, grid: _core.MotionGrid, title: str, window: np.ndarray) -> Panel:
    """The filled cells and the block; window: lower and upper corner as seen [m]."""
    x = Axis("along the grasp plane [m]", *window[:, 0], False, 0.05)
    panel = Panel(title, x, Axis("height [m]", *window[:, 1], False, 0.05), 380, None)
    panel.add(there.cells(grid), Area(there.shadow(there.cell.parts[0]), PART))
    return panel


def grid_lines(window: np.ndarray) -> Line:
    """The borders of the grid's cells."""
    (left, low), (right, high) = window
    # The grid's middle is the block's, at its height.
    across = np.arange(-HALF_SIZE, HALF_SIZE + GRID / 2, GRID)
    up = across + MIDDLE
    columns = [np.array([(x, low), (x, high)]) for x in across if left < x < right]
    rows = [np.array([(left, y), (right, y)]) for y in up if low < y < high]
    return Line(columns + rows, RULES)


def main(picture: Path, models: Path) -> bool:
    """Run the example; true if it found what it says."""
    there = scene(models)
    grid = there.grid(HALF_SIZE, GRID)
    start, target = there.hand_at(START, DIRECTION), there.hand_at(TARGET, 0.0)
    result = slide(there, grid, start, target, CLEARANCE)
    path, lines = list(result.path), _core.bump_lines(there.outline, CLEARANCE)
    step = most_turned_aside(grid, lines, path, target)
    hits = touching(grid, lines, path[step])
    whole = axes(there, grid, "(a) the slide", np.array([(-0.21, 0.09), (0.11, 0.41)]))
    whole_slide(whole, there, path, target)
    middle = there.seen(np.array([[path[step].x, path[step].y]]))[0] + [-0.02, 0.03]
    window = np.array([middle - 0.09, middle + 0.09])
    close = axes(there, grid, f"(b) step {step}: bump lines and vectors", window)
    close.marks.insert(0, grid_lines(window))
    one_step(close, there, lines, hits, (path[step], path[step + 1], target))
    turned = np.degrees(path[-1].theta - path[0].theta)
    caption = (
        "The quasipotential method, from the side. (a) The open hand slides down to a block under "
        f"a roof: {len(path) - 1} steps of at most {1e3 * GRID:.0f} mm, turned by "
        f"{abs(turned):.0f}\u00b0 on the way. (b) Bump lines {1e3 * CLEARANCE:.0f} mm off the "
        "hand; a line meets only the cells of its own layer, so the block does not count for the "
        "fingers on both sides of it. The goal vector has a component along a vector that is zero: "
        "the hand takes the nearest vector that is left, and turns."
    )
    Figure([[whole, close]], caption, "a slide in the grasp plane").save(picture)
    print(f"{result.status.name}: {len(path) - 1} steps, turned by {turned:.0f} degrees; ", end="")
    print(f"at step {step} {sum(hits)} of {len(lines)} bump lines touch")
    return result.status == _core.SlideStatus.Reached and any(hits) and not all(hits)


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    models_there = Path(__file__).parents[2] / "models"
    sys.exit(not main(*(given + [Path("figure_5.svg"), models_there][len(given) :])))
