"""Part by part of a folder: its feature pairs, the best grasp, planned or the reason; a picture.

Each mesh is put on a bare table on each of six sides on which it stands, to be moved across; what
is planned is checked. Scales come from `parts.json` beside the folder; without it, millimetres.

    python tests/part_grasps.py ../shared/data/parts --picture grasps.svg
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import random_cells
import yaml

import handey
from handey import _core
from handey.drawing import Axis, Figure, Panel
from handey.drawing.marks import Area, Line, Paint
from handey.robot_file import load_robot

KINDS = ["FaceFace", "FaceEdge", "ParallelEdges", "FaceVertex", "CrossedEdges"]
VIEW = (np.radians(-38.0), np.radians(24.0))  # about the vertical, and from above
PAD, FINGER, PART = "#d1495b", "#8d99ae", np.array([196, 208, 220])


@dataclass
class Outcome:
    """What came of one part on one side."""

    planned: bool = False
    valid: bool = True
    text: str = ""
    X_PH: np.ndarray | None = None
    width: float = 0.0


@dataclass
class Row:
    """One part: its features and what came of it on each side that it stands on."""

    name: str
    counts: dict[str, int]
    features: str
    found_ms: float
    outcomes: list[Outcome] = field(default_factory=list)

    @property
    def best(self) -> Outcome | None:
        """Of the first side on which it was planned."""
        return next((outcome for outcome in self.outcomes if outcome.planned), None)


def cell_of(part: random_cells.Part) -> dict:
    """The part on a bare table, to be moved across."""
    middle = (part.upper + part.lower) / 2

    def place(x: float, y: float, yaw: float) -> dict:
        xy = np.array([x, y]) - random_cells.turn(yaw) @ middle[:2]
        return random_cells.pose(xy, -float(part.lower[2]), yaw, part.stand)

    return {
        "handey_cell": 1,
        "name": part.name,
        "robot": {"file": str(random_cells.ROBOT)},
        "fixtures": {"table": random_cells.TABLE},
        "parts": {part.name: {**part.entry, "pose": place(0.5, 0.2, 0.3)}},
        "task": [{"place": part.name, "at": place(0.45, -0.22, -0.4)}],
    }


def attempt(part: random_cells.Part, folder: Path) -> Outcome | None:
    """Plan and check; None where the part does not stand on this side."""
    path = folder / f"{part.name}.yaml"
    path.write_text(yaml.safe_dump(cell_of(part), sort_keys=False))
    try:
        loaded = handey.load_cell(path)
    except handey.InvalidInput:
        return None
    result = handey.plan(loaded)
    if result.plan is None:
        return Outcome(text=" | ".join(result.report.reasons[2:5]))
    out = folder / "plan.json"
    result.plan.save(out)
    checked = handey.check(path, out)
    held = next(step for step in result.plan.steps if step.part is not None)
    return Outcome(
        planned=True,
        valid=checked.ok,
        text=result.report.goals[0].grasp,
        X_PH=np.linalg.inv(held.part_in_grasp_frame),
        width=float(held.opening[0]),
    )


def examine(path: Path, scale: float, folder: Path) -> tuple[Row, random_cells.Part]:
    """All of a part."""
    parts = [random_cells.read_part(path, scale, turn) for turn in random_cells.axis_turns()]
    mesh = _core.load_mesh(str(path), scale=[scale] * 3, must_be_closed=True).mesh
    body = _core.Body(name=path.stem, shapes=[_core.Shape(_core.MeshShape(mesh, solid=True))])
    robot = load_robot(random_cells.ROBOT)[0]
    begin = time.process_time()
    found = _core.find_feature_pairs(body, robot.gripper)
    spent = 1e3 * (time.process_time() - begin)
    counts = Counter(pair.kind.name for pair in found.pairs)
    features = f"{len(found.faces)} / {len(found.edges)} / {len(found.vertices)}"
    row = Row(path.stem, {kind: counts[kind] for kind in KINDS}, features, spent)
    for part in parts:
        outcome = attempt(part, folder)
        if outcome is not None:
            row.outcomes.append(outcome)
    return row, parts[0]


def panel_of(row: Row, path: Path, scale: float) -> Panel:
    """The part held by its best grasp, seen from aside and above, the hand pointing down."""
    mesh = _core.load_mesh(str(path), scale=[scale] * 3, must_be_closed=False).mesh
    triangles = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
    best = row.best
    X_HP = np.eye(4) if best is None or best.X_PH is None else np.linalg.inv(best.X_PH)
    triangles = triangles @ X_HP[:3, :3].T + X_HP[:3, 3]
    pads: list[np.ndarray] = []
    fingers: list[np.ndarray] = []
    if best is not None:
        for side in (1.0, -1.0):
            y = side * best.width / 2
            pads.append(np.array([[x, y, z] for x, z in _rectangle(0.010, 0.015, 0.0)]))
            for outer in (y, y + side * 0.012):
                shape = _rectangle(0.010, 0.025, -0.010)
                fingers.append(np.array([[x, outer, z] for x, z in shape]))
    return _drawn(row, triangles, pads, fingers)


def _rectangle(half_x: float, half_z: float, z: float) -> list[tuple[float, float]]:
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    return [(a * half_x, z + b * half_z) for a, b in corners]


def _drawn(
    row: Row, triangles: np.ndarray, pads: list[np.ndarray], fingers: list[np.ndarray]
) -> Panel:
    """Farthest first: what is nearer covers it."""
    turn, lift = VIEW
    # Paper: closing axis to the right, approach downwards, x of the hand toward the reader.
    to_paper = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])
    about = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    above = np.array([[1, 0, 0], [0, np.cos(lift), -np.sin(lift)], [0, np.sin(lift), np.cos(lift)]])
    camera = above @ about @ to_paper
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-15)
    facing = normals @ camera[2]
    shapes = []
    for corners, front in zip(triangles, facing, strict=True):
        if front <= 0:
            continue
        shade = (PART * (0.45 + 0.55 * front)).astype(int)
        colour = "#" + "".join(f"{value:02x}" for value in shade)
        shapes.append((corners, Paint(colour, colour, 0.4)))
    shapes += [(corners, Paint(FINGER, "#555555", 0.6, opacity=0.45)) for corners in fingers]
    shapes += [(corners, Paint(PAD, PAD, 0.8, opacity=0.6)) for corners in pads]
    shapes.sort(key=lambda shape: float((shape[0] @ camera[2]).mean()))
    seen = np.vstack([corners @ camera[:2].T for corners, _ in shapes])
    middle, half = (seen.max(0) + seen.min(0)) / 2, 0.55 * np.ptp(seen, axis=0).max()
    title = f"{row.name}: {row.best.text.split(', hand')[0] if row.best else 'no grasp'}"
    axes = [Axis("", *(c + s * half for s in (-1, 1)), degrees=False) for c in middle]
    panel = Panel(title, axes[0], axes[1], 230.0, 230.0, framed=False)
    for corners, paint in shapes:
        panel.add(Area([corners @ camera[:2].T], paint))
    tip = np.array([[0, 0, -0.05], [0, 0, -0.02]]) @ camera[:2].T
    if row.best:
        panel.add(Line([tip], Paint(stroke="#222222", width=2.0)))
    return panel


def print_row(row: Row) -> None:
    """One line of the table, in Markdown."""
    counts = " | ".join(str(row.counts[kind]) for kind in KINDS)
    planned = sum(outcome.planned for outcome in row.outcomes)
    text = row.best.text if row.best else "none"
    fallen = sorted({o.text for o in row.outcomes if not o.planned})
    if any(not outcome.valid for outcome in row.outcomes):
        text = "NOT VALID " + text
    sides = f"{planned} of {len(row.outcomes)}"
    reasons = " // ".join(fallen)[:240]
    print(
        f"| {row.name} | {row.features} | {counts} | {row.found_ms:.1f} | {sides} | {text} "
        f"| {reasons} |",
        flush=True,
    )


def main() -> int:
    """Print the table; 1 if a plan is not valid."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--picture", type=Path, help="SVG file of the best grasps")
    args = parser.parse_args()
    table = args.folder.parent / "parts.json"
    scales = {}
    if table.exists():
        scales = {row["file"]: row["scale_to_m"] for row in json.loads(table.read_text())}
    meshes = sorted(p for p in args.folder.iterdir() if p.suffix in (".stl", ".obj", ".ply"))
    print("| part | faces / edges / vertices | " + " | ".join(KINDS), end="")
    print(" | ms | sides planned | grasp on the first | where not |")
    print("| --- " * 11 + "|")
    rows, panels = [], []
    with tempfile.TemporaryDirectory() as scratch:
        for path in meshes:
            scale = scales.get(path.name, 0.001)
            try:
                row, _ = examine(path, scale, Path(scratch))
            except handey.InvalidInput as error:
                print(f"| {path.stem} | not a part: {str(error)[:200]} |" + " |" * 9)
                continue
            print_row(row)
            rows.append(row)
            panels.append(panel_of(row, path, scale))
    if args.picture:
        grid = [panels[i : i + 4] for i in range(0, len(panels), 4)]
        Figure(grid, title="best grasps").save(args.picture)
    return 0 if all(outcome.valid for row in rows for outcome in row.outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
