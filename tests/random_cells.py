"""Random direct cells from a seed: made, planned, checked, counted.

A cell has a table, one part standing upright, 0 to 6 other bodies, and a goal with the same face
down anywhere that the arm
reaches: on the bare table some grasp is legal at both ends. Whether the other bodies leave a way
    is not asked: such a cell counts.

    python tests/random_cells.py --count 200 --seed 1
    python tests/random_cells.py --count 40 --parts ../shared/data/parts   # with other people's
    parts
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import trimesh
import yaml

import handey
from handey import _core

ROOT = Path(__file__).resolve().parent.parent
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
OWN_PARTS = [
    "block", "bracket", "cross", "engraved_block", "hex_peg", "l_block", "stepped_block", "t_block",
    "u_block", "wedge",
]  # fmt: skip
TABLE = {"box": [1.6, 1.6, 0.05], "pose": {"xyz": [0.45, 0, -0.025]}, "support": True}
GAP = 0.015  # least distance between the footprints of two bodies [m]
BASE_RADIUS = 0.26  # of the robot's base and shoulder on the table [m]


@dataclasses.dataclass(frozen=True)
class Part:
    """A part to place: its entry in a cell file, its turn to stand, its bounds when so turned."""

    name: str
    entry: dict
    stand: np.ndarray
    lower: np.ndarray
    upper: np.ndarray


def read_part(path: Path, scale: float, stand: np.ndarray | None = None) -> Part:
    loaded = _core.load_mesh(str(path), scale=[scale] * 3, must_be_closed=True)
    stand = np.eye(3) if stand is None else stand
    vertices = np.asarray(loaded.mesh.vertices) @ stand.T
    entry = {"mesh": str(path.resolve()), "scale": scale}
    return Part(path.stem, entry, stand, vertices.min(axis=0), vertices.max(axis=0))


def axis_turns() -> list[np.ndarray]:
    """The six rotations that put another axis of a part upright; the part's own first."""
    x_up = np.array([[0.0, 0, -1], [0, 1, 0], [1, 0, 0]])
    y_up = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    upside_down = np.diag([1.0, -1.0, -1.0])
    return [np.eye(3), upside_down, x_up, upside_down @ x_up, y_up, upside_down @ y_up]


def own_parts() -> list[Part]:
    """The graspable parts of models/parts."""
    return [read_part(ROOT / "models" / "parts" / f"{name}.stl", 0.001) for name in OWN_PARTS]


def turn(yaw: float) -> np.ndarray:
    return np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])


def footprint(size: np.ndarray, xy: np.ndarray, yaw: float) -> np.ndarray:
    """Corners of a turned rectangle, shape (4, 2)."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * size[:2] / 2
    return corners @ turn(yaw).T + xy


def gap_between(a: np.ndarray, b: np.ndarray) -> float:
    """Distance of two convex polygons along the best edge normal; negative where they overlap."""
    best = -math.inf
    for polygon in (a, b):
        edges = np.roll(polygon, -1, axis=0) - polygon
        normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        for normal in normals:
            along_a, along_b = a @ normal, b @ normal
            best = max(best, along_b.min() - along_a.max(), along_a.min() - along_b.max())
    return best


def random_place(rng: np.random.Generator) -> tuple[np.ndarray, float]:
    radius, angle = rng.uniform(0.28, 0.85), rng.uniform(-2.2, 2.2)
    xy = np.array([radius * math.cos(angle), radius * math.sin(angle)])
    return xy, rng.uniform(-math.pi, math.pi)


def random_body(rng: np.random.Generator) -> tuple[dict, np.ndarray]:
    """A box, cylinder or sphere: its entry, and its size."""
    kind = rng.choice(["box", "box", "cylinder", "sphere"])
    if kind == "box":
        size = rng.uniform([0.03, 0.03, 0.03], [0.12, 0.12, 0.20]).round(4)
        return {"box": [float(s) for s in size]}, size
    if kind == "cylinder":
        radius, length = (round(float(v), 4) for v in rng.uniform([0.015, 0.04], [0.05, 0.25]))
        entry = {"cylinder": {"radius": radius, "length": length}}
        return entry, np.array([2 * radius, 2 * radius, length])
    radius = round(float(rng.uniform(0.02, 0.06)), 4)
    return {"sphere": {"radius": radius}}, np.full(3, 2 * radius)


def pose(xy: np.ndarray, z: float, yaw: float, stand: np.ndarray | None = None) -> dict:
    x, y = (round(float(value), 5) for value in xy)
    matrix = np.eye(4)
    matrix[:2, :2] = turn(yaw)
    matrix[:3, :3] = matrix[:3, :3] @ (np.eye(3) if stand is None else stand)
    quaternion = [float(value) for value in trimesh.transformations.quaternion_from_matrix(matrix)]
    return {"xyz": [x, y, round(float(z), 9)], "quat_xyzw": [*quaternion[1:], quaternion[0]]}


def find_room(
    rng: np.random.Generator, size: np.ndarray, taken: list[np.ndarray], gap: float
) -> tuple[np.ndarray, float] | None:
    """A free place for a footprint, which is then taken; None where none was found."""
    for _ in range(100):
        xy, yaw = random_place(rng)
        area = footprint(size, xy, yaw)
        is_clear = all(gap_between(area, other) > gap for other in taken)
        if np.linalg.norm(area, axis=1).min() > BASE_RADIUS and is_clear:
            taken.append(area)
            return xy, yaw
    return None


def random_cell(rng: np.random.Generator, parts: list[Part], name: str) -> dict | None:
    """A cell as a mapping; its footprints keep GAP, nothing else is promised."""
    part = parts[int(rng.integers(len(parts)))]
    size, middle = part.upper - part.lower, (part.upper + part.lower) / 2
    taken: list[np.ndarray] = []
    places = []
    for _ in ("origin", "goal"):
        room = find_room(rng, size, taken, 0.0)
        if room is None:
            return None
        xy, yaw = room
        places.append(pose(xy - turn(yaw) @ middle[:2], -float(part.lower[2]), yaw, part.stand))
    fixtures = {"table": TABLE}
    for i in range(int(rng.integers(0, 7))):
        entry, extent = random_body(rng)
        room = find_room(rng, extent, taken, GAP)
        if room is not None:
            fixtures[f"body_{i}"] = {**entry, "pose": pose(room[0], extent[2] / 2, room[1])}
    return {
        "handey_cell": 1,
        "name": name,
        "robot": {"file": str(ROBOT)},
        "fixtures": fixtures,
        "parts": {part.name: {**part.entry, "pose": places[0]}},
        "task": [{"place": part.name, "at": places[1]}],
    }


def is_reachable(cell: dict, folder: Path) -> bool:
    """On the bare table, is some grasp legal at both ends?"""
    path = folder / "bare.yaml"
    path.write_text(yaml.safe_dump({**cell, "fixtures": {"table": TABLE}}, sort_keys=False))
    try:
        loaded = handey.load_cell(path)
    except handey.InvalidInput:
        return False
    goal, part = loaded.goals[0], loaded.cell.part_index(loaded.goals[0].part)
    solver = _core.SphericalWristSolver(loaded.cell.robot)
    model = _core.make_collision_model(loaded.cell)
    scene = _core.GraspScene(model=model, cell=loaded.cell, part=part, X_WP_goal=goal.X_WP)
    ranking = _core.rank_grasps(loaded.cell, part, goal.X_WP)
    return any(_core.find_legal_grasps(scene, solver, pair).poses for pair in ranking.ranked)


def direct_cells(seed: int, count: int, parts: list[Part], folder: Path) -> Iterator[Path]:
    """Yield up to `count` cell files, each with a reachable goal."""
    made, index = 0, 0
    while made < count and index < 20 * count:
        index += 1
        cell = random_cell(np.random.default_rng([seed, index]), parts, f"random_{seed}_{index}")
        if cell is None or not is_reachable(cell, folder):
            continue
        path = folder / f"{cell['name']}_{next(iter(cell['parts']))}.yaml"
        path.write_text(yaml.safe_dump(cell, sort_keys=False))
        try:
            handey.load_cell(path)
        except handey.InvalidInput:
            continue
        made += 1
        yield path


@dataclasses.dataclass
class Tally:
    """What came of the cells."""

    tried: int = 0
    planned: int = 0
    valid: int = 0
    repeated: int = 0
    cpu: list[float] = dataclasses.field(default_factory=list)
    failed: list[str] = dataclasses.field(default_factory=list)
    unplanned: list[str] = dataclasses.field(default_factory=list)


def run(paths: Iterable[Path], repeat: bool = True, verbose: bool = False) -> Tally:
    """Plan and check; if asked, plan again and compare the bytes."""
    tally = Tally()
    for path in paths:
        tally.tried += 1
        result = handey.plan(handey.load_cell(path))
        tally.cpu.append(result.report.cpu_s)
        outcome = f"no plan, {result.report.verdict}: " + " | ".join(result.report.reasons)[:400]
        if result.plan is None:
            tally.unplanned.append(path.stem)
        else:
            tally.planned += 1
            out = path.with_suffix(".plan.json")
            result.plan.save(out)
            checked = handey.check(path, out)
            tally.valid += checked.ok
            outcome = "" if checked.ok else "NOT VALID: " + " | ".join(map(str, checked.faults[:3]))
            if repeat:
                again = handey.plan(handey.load_cell(path)).plan
                tally.repeated += again is not None and is_same(result.plan, again, path.parent)
        if outcome:
            tally.failed.append(f"{path.stem}: {outcome}")
        if verbose:
            print(f"{path.stem}: {outcome or 'valid'}, {result.report.cpu_s:.2f} s", flush=True)
    return tally


def report(name: str, tally: Tally) -> None:
    """Print a line, and one for each cell that failed."""
    median, p95 = np.percentile(tally.cpu or [math.nan], [50, 95])
    print(
        f"{name}: {tally.tried} cells, {tally.planned} planned, {tally.valid} valid, "
        f"{tally.repeated} repeated byte for byte; "
        f"CPU of planning median {median:.3f} s, p95 {p95:.3f} s"
    )
    for line in tally.failed:
        print("  " + line)


def is_same(first: handey.Plan, second: handey.Plan, folder: Path) -> bool:
    """The same bytes, but for the report with its timings."""
    texts = []
    for index, plan in enumerate((first, second)):
        path = folder / f"again_{index}.json"
        dataclasses.replace(plan, report={}).save(path)
        texts.append(path.read_bytes())
    return texts[0] == texts[1]


def part_groups(folder: Path | None) -> dict[str, list[Part]]:
    """Our own parts; or each watertight part of parts.json with a pair, on any of six sides."""
    if folder is None:
        return {"own parts": own_parts()}
    rows = json.loads((folder.parent / "parts.json").read_text())
    rows = [row for row in rows if row["watertight"] and row["antiparallel_pairs_100mm"]]
    return {
        row["file"]: [read_part(folder / row["file"], row["scale_to_m"], t) for t in axis_turns()]
        for row in rows
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--parts", type=Path, help="folder of meshes with parts.json beside it")
    parser.add_argument("--keep", type=Path, help="folder to keep the cells and plans in")
    parser.add_argument("--no-repeat", action="store_true", help="do not plan a second time")
    parser.add_argument("-v", "--verbose", action="store_true")
    args = parser.parse_args()
    planned = valid = tried = 0
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        groups = part_groups(args.parts)
        for name, parts in groups.items():
            cells = direct_cells(args.seed, max(1, args.count // len(groups)), parts, folder)
            tally = run(cells, not args.no_repeat, args.verbose)
            report(name, tally)
            tried, planned, valid = (
                tried + tally.tried,
                planned + tally.planned,
                valid + tally.valid,
            )
    seconds = time.perf_counter() - begin
    print(f"all: {planned} of {tried} planned, {valid} valid, {seconds:.0f} s")
    return 0 if valid == planned else 1


if __name__ == "__main__":
    sys.exit(main())
