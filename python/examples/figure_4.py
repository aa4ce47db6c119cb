"""Which faces to grasp: obstacles of the destination, moved by T^-1, join those at the origin.

T takes the part from its origin to its destination. Seen from the part, what will stand round it
there stands round it already: its obstacles, moved by T^-1, obstruct faces that look free at the
origin. The pair of faces that stays freest under both is taken.
Article: "Grasp planning", Figure 4.
Usage: figure_4.py [SVG [MODELS]]
"""

import sys
from pathlib import Path

import numpy as np
from grasp_plane import PlaneScene, hatched, placed
from puma560 import at

import handey
from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Note, Paint

TURN = np.radians(35.0)  # of the destination, beyond what the cell file says
AROUND = 0.085  # shown on each side of the part [m]

PART = Paint("#f2e2bf", "#8a6a24", 1.0, label="part")
BODY = Paint("#7d8793", "#4a525c", 0.7, label="obstacle at the origin")
THERE = Paint("#e3c7db", "#a04a8c", 0.8, label="obstacle at the destination")
MOVED = Paint(stroke="#a04a8c", width=1.2, label="the same, moved by T\u207b\u00b9")
FINGERS = Paint("#3f74ad", "#1e4670", 0.8, opacity=0.85, label="fingers, open, at the grasp taken")
FREE = Paint("#cfe5cc", "#2a8a3c", 1.0, label="face, unobstructed at both ends")
OBSTRUCTED = Paint("#d9dde2", "#4a525c", 1.0, label="face, obstructed")
LOST = Paint(stroke="#a04a8c", width=0.9, label="obstructed at the destination only")
PAD = Paint("#3f74ad", "#1e4670", 0.8, opacity=0.6, label="pad at the grasp taken")

Bodies = list[tuple[_core.Body, np.ndarray]]


def turned_cell(models: Path) -> tuple[_core.Cell, np.ndarray]:
    """The cell of the models folder with its destination turned; and the part's goal."""
    cell_file = handey.load_cell(models / "cells/figure_4.yaml")
    cell, goal = cell_file.cell, cell_file.goals[0].X_WP
    about = at(*goal[:3, 3])
    move = about @ at(0, 0, 0, TURN) @ np.linalg.inv(about)
    fixtures = [
        _core.Body(name=f.name, shapes=f.shapes, X_WB=move @ f.X_WB, support=f.support)
        if f.name.startswith("destination")
        else f
        for f in cell.fixtures
    ]
    turned = _core.Cell(
        name=cell.name, robot=cell.robot, start=cell.start, fixtures=fixtures, parts=cell.parts
    )
    return turned, move @ goal


def near_bodies(cell: _core.Cell, goal: np.ndarray, at_destination: bool) -> Bodies:
    """Obstacles of one end as seen from the part, with the part at its origin; no table."""
    near = _core.nearby_bodies(cell, 0, goal, AROUND)
    X_WP = cell.parts[0].X_WB
    return [
        (cell.body(n.body), X_WP @ n.X_PB)
        for n in near
        if n.at_destination == at_destination and n.name != "table"
    ]


def from_above(body: _core.Body, X_WB: np.ndarray) -> list[np.ndarray]:
    """Loops of a body in the world's x and y."""
    seen = [_core.slab_projection(shape, X_WB, -1.0, 1.0) for shape in body.shapes]
    return [np.asarray(loop) for loop in _core.unite(seen).loops]


def above(title: str, middle: np.ndarray) -> Panel:
    """Axes about a place, from above."""
    x = Axis("x [m]", middle[0] - AROUND, middle[0] + AROUND, False, 0.05)
    y = Axis("y [m]", middle[1] - AROUND, middle[1] + AROUND, False, 0.05)
    return Panel(title, x, y, 270, None)


def fingers(cell: _core.Cell, X_WP: np.ndarray, aim: _core.GraspPose) -> list[Area]:
    """The open fingers at a grasp, from above."""
    marks = []
    for finger in cell.robot.gripper.fingers:
        body = cell.robot.bodies[finger.child]
        # The hand's frame to the finger's: both lie on the link of the gripper.
        X_HF = np.linalg.inv(cell.robot.gripper.X_BH) @ finger.X_PJ
        X_HF[:3, 3] += X_HF[:3, :3] @ finger.axis * aim.opening / 2
        for shape in body.shapes:
            region = _core.slab_projection(shape, X_WP @ aim.X_PH @ X_HF, -1.0, 1.0)
            marks.append(Area([np.asarray(loop) for loop in region.loops], FINGERS))
    return marks


def same_pair(ranking: _core.Ranking, pair: _core.RankedPair) -> _core.RankedPair:
    """A pair of faces in another ranking, be it dropped there."""
    found = [*ranking.ranked, *ranking.obstructed]
    return next(p for p in found if str(p.pair) == str(pair.pair))


def faces_panel(
    cell: _core.Cell,
    goal: np.ndarray,
    letter: str,
    alone: _core.RankedPair,
    both: _core.RankedPair,
    aim: _core.GraspPose | None,
) -> Panel:
    """The common area of a pair of faces, and what the obstacles of either end leave of it."""
    scene = PlaneScene(cell, goal, both, _core.GripperOutline([]), 0.0)
    x = Axis("along the faces [m]", -0.045, 0.045, False, 0.02)
    y = Axis("height [m]", -0.01, 0.08, False, 0.02)
    panel = Panel(f"({letter}) faces {1e3 * both.pair.width:.0f} mm apart", x, y, 270, None)
    for line, (share, where) in enumerate(
        ((alone.share, "free at the origin alone"), (both.share, "free at both ends"))
    ):
        panel.add(Note((-0.045, 0.08), f"{100 * share:.0f} % {where}", (8, 16 + 14 * line)))
    panel.add(Area(_seen(scene, both.pair.overlap), OBSTRUCTED))
    panel.add(Area(_seen(scene, both.unobstructed), FREE))
    lost = _core.subtract(alone.unobstructed, both.unobstructed)
    if lost.area > 1e-9:
        panel.add(hatched(_seen(scene, lost), 0.003, LOST))
    if aim is not None:
        gripper = cell.robot.gripper
        half = np.array([gripper.pad_length, gripper.pad_width]) / 2
        corners = half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
        panel.add(Area([scene.seen(placed(corners, aim.in_plane))], PAD))
    return panel


def _seen(scene: PlaneScene, region: _core.Region) -> list[np.ndarray]:
    return [scene.seen(loop) for loop in region.loops]


def from_above_panels(
    cell: _core.Cell, goal: np.ndarray, aim: _core.GraspPose
) -> tuple[Panel, Panel, Panel]:
    """The part at its origin, at its destination, and at its origin among both."""
    part, X_WP = cell.parts[0], cell.parts[0].X_WB
    at_origin, moved = (near_bodies(cell, goal, end) for end in (False, True))
    T = goal @ np.linalg.inv(X_WP)
    first = above("(a) at the origin", X_WP[:2, 3])
    second = above("(b) at the destination", goal[:2, 3])
    third = above("(c) T\u207b\u00b9 brings them to the origin", X_WP[:2, 3])
    for panel in (first, third):
        panel.add(*(Area(from_above(body, X_WB), BODY) for body, X_WB in at_origin))
    second.add(*(Area(from_above(body, T @ X_WB), THERE) for body, X_WB in moved))
    for panel, X in ((first, X_WP), (second, goal), (third, X_WP)):
        panel.add(Area(from_above(part, X), PART))
    third.add(*fingers(cell, X_WP, aim))
    for body, X_WB in moved:
        loops = from_above(body, X_WB)
        third.add(hatched(loops, 0.005, MOVED), Line([np.vstack([p, p[:1]]) for p in loops], MOVED))
    return first, second, third


def main(picture: Path, models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell, goal = turned_cell(models)
    model = _core.make_collision_model(cell)
    scene = _core.GraspScene(model=model, cell=cell, part=0, X_WP_goal=goal)
    solver = _core.SphericalWristSolver(cell.robot)
    alone = _core.rank_grasps(cell, 0, goal, _core.RankingOptions(use_destination=False))
    both = _core.rank_grasps(cell, 0, goal)
    first, taken = alone.ranked[0], both.ranked[0]
    aims = _core.find_legal_grasps(scene, solver, taken).poses
    for name, pair in (("at the origin alone", first), ("at both ends", taken)):
        print(f"best {name}: the faces {1e3 * pair.pair.width:.0f} mm apart, ", end="")
        print(f"{100 * pair.share:.0f} % unobstructed")
    if not aims:
        print("no legal grasp")
        return False
    obstructed = same_pair(both, first)
    rows = [
        from_above_panels(cell, goal, aims[0]),
        (
            faces_panel(cell, goal, "d", first, obstructed, None),
            faces_panel(cell, goal, "e", same_pair(alone, taken), taken, aims[0]),
        ),
    ]
    caption = (
        "The part is to go from (a), between low walls, to (b), between high ones. (c) Seen from "
        "the part, the high walls stand beside it already at the origin. (d) The faces that "
        "are best at the origin alone could not be held at the destination. (e) The other pair "
        "stays free above the low walls at both ends, and is taken."
    )
    Figure(rows, caption, "obstacles of the destination at the origin").save(picture)
    return obstructed.share < 0.02 and taken.share > 0.2 and first.share > taken.share


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    models_there = Path(__file__).parents[2] / "models"
    sys.exit(not main(*(given + [Path("figure_4.svg"), models_there][len(given) :])))
