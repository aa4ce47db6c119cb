"""An obstacle as a torus of constant section about the waist, beside one section for each cell.

While the waist turns, an obstacle is in the way of the forearm only within a window of angles. The
article takes one polygon for the whole window, which makes the obstacle a piece of a torus; handey
takes one for each cell of the waist angle. For a post the two are alike; for a long beam they are
not. Both contain the true section.
Article: "Global planning", Figure 8.
Usage: figure_8.py [SVG [MODELS]]
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from puma560 import table_cell

from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Marker, Paint

CELL = np.radians(8.0)  # of the waist angle
CORNERS = np.array([[(i >> axis) & 1 for axis in range(3)] for i in range(8)]) - 0.5
FACES = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]

BODY = Paint("#7d8793", "#4a525c", 0.7, label="obstacle")
WINDOW = Paint("#dbe6f3", "#6f93bd", 0.7, label="torus, seen from above")
SLAB = Paint(stroke="#3f74ad", width=0.9, dash="4 2.5", label="slab of the forearm at its ends")
TORUS = Paint("#dbe6f3", "#0b3d91", 1.4, label="section of the torus")
CELLS = Paint("#e0a546", opacity=0.35, label="sections of the cells")
EDGES = Paint(stroke="#a8731c", width=0.6)
ONE = Paint(stroke="#b3261e", width=1.5, label="section of one cell")
AXIS = Paint("#ffffff", "#1e4670", 1.2, label="waist axis")


def beam(start: list[float], end: list[float], width: float, depth: float) -> _core.SceneHull:
    """A beam from point to point, in the robot frame [m]."""
    along = np.subtract(end, start)
    across = np.cross([0.0, 0.0, 1.0], along)
    up = np.cross(along, across)
    sides = np.array(
        [along, width * across / np.linalg.norm(across), depth * up / np.linalg.norm(up)]
    )
    return _core.SceneHull(np.add(start, end) / 2 + CORNERS @ sides)


def forearm_slab(cell: _core.Cell, plane: _core.ArmPlane) -> _core.Slab:
    """Where the forearm lies across the arm's plane: the same at every configuration."""
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    straight = _core.Configuration(q=np.zeros(len(cell.robot.joints)), opening=0.0)
    poses = _core.body_poses(cell.robot, straight)
    lateral = plane.X_RE(0.0)[:3, 2], plane.X_RE(0.0)[:3, 3]
    across = [
        (hull.points @ poses[mover.body][:3, :3].T + poses[mover.body][:3, 3] - lateral[1])
        @ lateral[0]
        for mover in _core.describe_scene(checker).movers
        if mover.depth == 3
        for hull in mover.hulls
    ]
    together = np.concatenate(across)
    return _core.Slab(together.min(), together.max())


def counter_clockwise(polygon: np.ndarray) -> _core.Region:
    """The region of a polygon that may run either way."""
    x, y = polygon.T
    is_right = x @ np.roll(y, -1) < y @ np.roll(x, -1)
    return _core.Region([polygon[::-1] if is_right else polygon])


def from_above(
    plane: _core.ArmPlane, hull: _core.SceneHull, slab: _core.Slab, torus: _core.Torus, title: str
) -> Panel:
    """The obstacle, its window and the torus, in x and y of the robot."""
    x, y = Axis("x [m]", -0.2, 1.0, False, 0.2), Axis("y [m]", -0.5, 0.7, False, 0.2)
    panel = Panel(title, x, y, 280, None)
    near, far = torus.section[:, 0].min(), torus.section[:, 0].max()
    middle, turns = (slab.lower + slab.upper) / 2, np.linspace(torus.lower, torus.upper, 60)

    def seen(turn: float, rho: float, across: float) -> np.ndarray:
        return (plane.X_RE(turn) @ [rho, 0, across, 1])[:2]

    inner = [seen(turn, near, middle) for turn in turns]
    outer = [seen(turn, far, middle) for turn in turns[::-1]]
    panel.add(Area([np.array(inner + outer)], WINDOW))
    faces = [hull.points[face, :2] for face in FACES]
    panel.add(Area(_core.unite([counter_clockwise(face) for face in faces]).loops, BODY))
    for turn in (torus.lower, torus.upper):
        for across in (slab.lower, slab.upper):
            panel.add(Line([np.array([seen(turn, 0, across), seen(turn, 1.2, across)])], SLAB))
    panel.add(Marker((0, 0), "circle", AXIS))
    return panel


def in_the_plane(torus: _core.Torus, cells: dict[float, np.ndarray], title: str) -> Panel:
    """The section of the torus and those of the cells, in x and y of the arm's plane."""
    x = Axis("along the arm's plane [m]", 0.0, 1.0, False, 0.2)
    y = Axis("above the shoulder [m]", -0.7, 0.3, False, 0.2)
    panel = Panel(title, x, y, 280, None)
    drawn = list(cells.values())
    panel.add(Area([torus.section], TORUS))
    panel.add(*(Area([section], paint) for paint in (CELLS, EDGES) for section in drawn))
    panel.add(Area([torus.section], replace(TORUS, fill="none", label="")))
    panel.add(Area([drawn[len(drawn) // 2]], ONE))
    return panel


def sections(
    plane: _core.ArmPlane, hull: _core.SceneHull, slab: _core.Slab, torus: _core.Torus
) -> dict[float, np.ndarray]:
    """The section for each cell of the waist angle in the torus' window, by the cell's middle."""
    count = max(1, int(np.ceil((torus.upper - torus.lower) / CELL)))
    half = (torus.upper - torus.lower) / count / 2
    angles = torus.lower + half * (2 * np.arange(count) + 1)
    found = {a: _core.cross_section(plane, hull, slab, a, half) for a in angles.tolist()}
    return {angle: section for angle, section in found.items() if len(section)}


def hold_true(
    plane: _core.ArmPlane,
    hull: _core.SceneHull,
    slab: _core.Slab,
    torus: _core.Torus,
    cells: dict[float, np.ndarray],
) -> bool:
    """Do both contain the true sections? By points of the obstacle at random waist angles."""
    random = np.random.default_rng(0)
    whole = _core.Region([torus.section])
    regions = {angle: _core.Region([section]) for angle, section in cells.items()}
    points = random.dirichlet(np.full(8, 0.3), 4000) @ hull.points
    for point, turn in zip(points, random.uniform(torus.lower, torus.upper, 4000), strict=True):
        p_E = np.linalg.inv(plane.X_RE(turn)) @ [*point, 1.0]
        if not (slab.lower <= p_E[2] <= slab.upper and p_E[0] > 0):
            continue
        own = regions[min(cells, key=lambda angle: abs(angle - turn))]
        if not (whole.contains(p_E[:2]) and own.contains(p_E[:2])):
            return False
    return True


def main(picture: Path, models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell = table_cell(models)
    plane, reason = _core.arm_plane(cell.robot)
    if plane is None:
        print(reason)
        return False
    slab = forearm_slab(cell, plane)
    print(f"slab of the forearm: {1e3 * slab.lower:.0f} to {1e3 * slab.upper:.0f} mm")
    obstacles = {
        "a post": beam([0.40, 0.28, 0.0], [0.48, 0.34, 0.62], 0.07, 0.07),
        "a beam": beam([0.36, -0.02, 0.25], [0.72, 0.50, 0.85], 0.06, 0.06),
    }
    rows, right, shares = [], True, []
    for letters, (name, hull) in zip(("ab", "cd"), obstacles.items(), strict=True):
        torus = max(_core.torus_of(plane, hull, slab), key=lambda t: t.section[:, 0].max())
        cells = sections(plane, hull, slab, torus)
        right &= hold_true(plane, hull, slab, torus, cells)
        whole = _core.Region([torus.section]).area
        mean = np.mean([_core.Region([cell]).area for cell in cells.values()])
        shares.append(mean / whole)
        low, high = np.degrees([torus.lower, torus.upper])
        print(f"{name}: waist {low:.0f} to {high:.0f} degrees; section of the torus ", end="")
        print(f"{1e4 * whole:.0f} cm2, of {len(cells)} cells {1e4 * mean:.0f} cm2 in the mean")
        rows.append(
            [
                from_above(plane, hull, slab, torus, f"({letters[0]}) {name} from above"),
                in_the_plane(torus, cells, f"({letters[1]}) {name} in the arm's plane"),
            ]
        )
    caption = (
        "Obstacles in the way of the forearm of a Puma 560 while its waist turns. Left: the window "
        "of waist angles at which the forearm's slab meets the obstacle, and the piece of a torus "
        "that takes its place. Right: the constant section of the torus, and those for cells of "
        f"the waist angle: in the mean {100 * shares[0]:.0f} % of its area for the post, "
        f"{100 * shares[1]:.0f} % for the beam. All contain the true section; a cell's may stick "
        "out of the torus', being rounded up for the turn within the cell."
    )
    Figure(rows, caption, "obstacles as tori").save(picture)
    return right and shares[1] < 0.5


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    models_there = Path(__file__).parents[2] / "models"
    sys.exit(not main(*(given + [Path("figure_8.svg"), models_there][len(given) :])))
