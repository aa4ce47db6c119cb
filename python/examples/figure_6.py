"""Start and end of a slide among the obstacles of both ends: the overlap suffices.

A bar is to be put down upright, turned by a quarter about the axis along which the hand closes. The
table on which it will stand, moved by T^-1 with the bar's destination brought to its origin, stands
upright beside the bar and is an obstacle of the slide. The finger point cannot reach its target;
the hand stops in front of it, and the pads lie on enough of the faces all the same.
Article: "Local planning: the quasipotential method", Figure 6.
Usage: figure_6.py [SVG [MODELS]]
"""

import sys
from pathlib import Path

import numpy as np
from grasp_plane import PlaneScene, hatched, placed, plane_scene, slide
from puma560 import at, box, table_cell

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Marker, Note, Paint

GRID, HALF_SIZE, CLEARANCE = 0.004, 0.20, 0.006  # [m]
# As seen from the side: places from the bar's middle [m], direction of the hand [degrees].
START, DIRECTION, TARGET = (-0.10, 0.13), -52.0, (0.042, 0.0)
ENOUGH = 0.3  # of a pad on the faces: what the planner asks for

BODY = Paint("#7d8793", "#4a525c", 0.7, label="obstacle at the origin")
MOVED = Paint(
    stroke="#a04a8c", width=1.1, label="obstacle at the destination, moved by T\u207b\u00b9"
)
PART = Paint("#f2e2bf", "#8a6a24", 1.0, label="bar")
HAND = Paint("#3f74ad", "#1e4670", 0.8, opacity=0.7, label="hand at the end")
GHOST = Paint("#9dbbdc", "#3f74ad", 0.5, opacity=0.25, label="hand at the start and on its way")
PADS = Paint("#2a8a3c", "#1c5f29", 0.8, opacity=0.9, label="pad on the face at the end")
PATH = Paint(stroke="#0b3d91", width=1.6, label="path of the finger point")
FINGER = Paint("#ffffff", "#0b3d91", 1.4, label="finger point at the end")
AT_TARGET = Paint("#c43c2c", "#ffffff", 1.0, label="target of the finger point")


def quarter(X: np.ndarray) -> np.ndarray:
    """The pose turned by a quarter about the world's x."""
    turned = X.copy()
    turned[:3, :3] = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]) @ X[:3, :3]
    return turned


def scene(models: Path) -> PlaneScene:
    """The bar lies among three boxes and goes to where it stands on its end."""
    fixtures = [
        box("block", [0.10, 0.03, 0.08], at(0.50, 0.30, 0.04)),
        box("beam", [0.20, 0.05, 0.03], at(0.50, 0.18, 0.20)),
    ]
    bar = box("bar", [0.03, 0.11, 0.04], at(0.50, 0.20, 0.02))
    cell = table_cell(models, fixtures, [bar])
    return plane_scene(cell, quarter(at(0.50, -0.25, 0.055)))


def moved_bodies(there: PlaneScene) -> list[tuple[_core.Body, np.ndarray]]:
    """What stands near the destination, moved by T^-1 to the origin."""
    near = _core.nearby_bodies(there.cell, 0, there.X_WP_goal)
    X_WP = there.cell.parts[0].X_WB
    return [(there.cell.body(n.body), X_WP @ n.X_PB) for n in near if n.at_destination]


def axes(
    there: PlaneScene,
    title: str,
    moved: list[tuple[_core.Body, np.ndarray]],
    window: np.ndarray,
) -> Panel:
    """Obstacles of both ends and the bar; window: lower and upper corner as seen [m]."""
    x = Axis("along the grasp plane [m]", *window[:, 0], False, 0.05)
    panel = Panel(title, x, Axis("height [m]", *window[:, 1], False, 0.05), 360, None)
    panel.add(*(Area(there.shadow(body), BODY) for body in there.cell.fixtures))
    for body, X_WB in moved:
        loops = there.shadow(body, X_WB)
        apart = 0.03 * (window[1, 0] - window[0, 0])
        panel.add(hatched(loops, apart, MOVED), Line([np.vstack([p, p[:1]]) for p in loops], MOVED))
    panel.add(Area(there.shadow(there.cell.parts[0]), PART))
    return panel


def pad_on_face(there: PlaneScene, pose: _core.PlanarPose) -> _core.Region:
    """Where a pad lies on the faces, the hand at a pose, in x and y of G."""
    gripper = there.cell.robot.gripper
    half = np.array([gripper.pad_length, gripper.pad_width]) / 2
    corners = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    return _core.intersect(there.pair.pair.overlap, _core.Region([placed(corners, pose)]))


def is_legal(there: PlaneScene, pose: _core.PlanarPose) -> bool:
    """May the part be taken there, at the origin and at the destination?"""
    model = _core.make_collision_model(there.cell)
    scene = _core.GraspScene(model=model, cell=there.cell, part=0, X_WP_goal=there.X_WP_goal)
    solver = _core.SphericalWristSolver(there.cell.robot)
    return len(_core.test_grasp_pose(scene, solver, there.pair, pose, False).poses) == 1


def main(picture: Path, models: Path) -> bool:
    """Run the example; true if it found what it says."""
    there = scene(models)
    moved = moved_bodies(there)
    start, target = there.hand_at(START, DIRECTION), there.hand_at(TARGET, 0.0)
    result = slide(there, there.grid(HALF_SIZE, GRID, moved), start, target, CLEARANCE)
    path = list(result.path)
    end, point = path[-1], there.seen(np.array([[target.x, target.y]]))[0]
    short = float(np.hypot(end.x - target.x, end.y - target.y))
    pad = pad_on_face(there, end)
    gripper = there.cell.robot.gripper
    share = pad.area / (gripper.pad_length * gripper.pad_width)

    whole = axes(there, "(a) start and slide", moved, np.array([(-0.19, -0.03), (0.13, 0.29)]))
    for pose in path[:-1:9]:
        whole.add(*there.hand(pose, GHOST))
    close = axes(there, "(b) end", moved, np.array([(-0.07, -0.02), (0.09, 0.14)]))
    for panel in (whole, close):
        panel.add(*there.hand(end, HAND))
        panel.add(Line([there.seen(np.array([[p.x, p.y] for p in path]))], PATH))
    close.add(Area([there.seen(loop) for loop in pad.loops], PADS))
    for panel in (whole, close):
        panel.add(Marker((point[0], point[1]), "diamond", AT_TARGET))
    finger = there.seen(np.array([[end.x, end.y]]))[0]
    close.add(Marker((finger[0], finger[1]), "circle", FINGER, 3.5))
    close.add(Note((point[0], point[1]), f"{1e3 * short:.0f} mm short", (0, 26), "middle"))
    names = ", ".join(body.name for body, _ in moved)
    caption = (
        "Start and end of a slide, from the side. The bar is to stand on the end that is at the "
        f"right here: the {names} of its destination, moved by T\u207b\u00b9, stands upright "
        "beside it. (a) The hand slides in below the beam. (b) The finger point stops "
        f"{1e3 * short:.0f} mm before its target, because no bump line may touch the {names} at "
        f"either end; {100 * share:.0f} % of a pad lies on the face, {100 * ENOUGH:.0f} % are "
        "enough, and the grasp is legal at both ends."
    )
    Figure([[whole, close]], caption, "start and end of a slide").save(picture)
    print(f"{result.status.name} {1e3 * short:.1f} mm short after {len(path) - 1} steps; ", end="")
    print(f"{100 * share:.0f} % of a pad on the face")
    return short > 0.5 * GRID and share >= ENOUGH and is_legal(there, end)


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    models_there = Path(__file__).parents[2] / "models"
    sys.exit(not main(*(given + [Path("figure_6.svg"), models_there][len(given) :])))
