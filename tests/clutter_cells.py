"""Random direct cells in clutter from a seed: made, planned, checked, counted.

One part stands among 3 to 10 neighbours and is to go among 3 to 10 others; each end may stand on a
low fixture and beside a wall with a roof. The nearest neighbours leave gaps of 1 to 4 finger
widths, a finger being as wide as it is thick across the jaws (12 mm): the least gap for it. The
part is a box, L, T, U, wedge or cylinder of facets with random sizes, turned about the vertical.
Whether there is a way is not asked; tests/exhaustive.py answers that.

    python tests/clutter_cells.py --count 40 --seed 1
    python tests/clutter_cells.py --count 40 --seed 1 --search 60     # is there a way, if no plan?
    python tests/clutter_cells.py --count 40 --seed 1 --roofed        # the part stands under a roof
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import exhaustive
import numpy as np
import random_cells
import shapely
import yaml
from random_cells import BASE_RADIUS, ROBOT, TABLE, Part, pose, turn

import handey
from handey import _core

sys.path.insert(0, str(random_cells.ROOT / "models" / "parts"))
import make_parts

FINGER = 0.012  # thickness of a finger of the demo gripper, across the jaws [m]
APART = 0.003  # least distance between two neighbours [m]
BETWEEN_ENDS = 0.30  # least distance of origin and goal [m]


@dataclasses.dataclass
class Ground:
    """What stands on the table, seen from above: areas, and roofs with their undersides."""

    parts: list[shapely.Polygon] = dataclasses.field(default_factory=list)
    bodies: list[shapely.Polygon] = dataclasses.field(default_factory=list)
    roofs: list[tuple[shapely.Polygon, float]] = dataclasses.field(default_factory=list)

    def has_room(self, area: shapely.Polygon, gap: float) -> bool:
        if area.distance(shapely.Point(0, 0)) < BASE_RADIUS:
            return False
        if any(area.distance(part) < gap for part in self.parts):
            return False
        return all(area.distance(body) >= APART for body in self.bodies)


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    return float(rng.uniform(low, high))


def _box(rng: np.random.Generator) -> np.ndarray:
    x, y, z = rng.uniform([20, 25, 25], [80, 110, 90])
    return make_parts.grid_solid([-x / 2, x / 2], [-y / 2, y / 2], [0, z], lambda *_: True)


def _grid(
    kind: Callable[[float, float, float, float], bool],
) -> Callable[[np.random.Generator], np.ndarray]:
    """A block from which a random share is cut: kind(x, z, a, h) in shares of width and height."""

    def make(rng: np.random.Generator) -> np.ndarray:
        x, y, z = rng.uniform([60, 25, 50], [95, 55, 95])
        a, h = rng.uniform(0.25, 0.4), rng.uniform(0.3, 0.6)
        xs = x * (np.array([0, a, 1 - a, 1]) - 0.5)
        return make_parts.grid_solid(
            xs,
            [-y / 2, y / 2],
            [0, h * z, z],
            lambda px, _, pz: kind(px / x + 0.5, pz / z, a, h),
        )

    return make


def _wedge(rng: np.random.Generator) -> np.ndarray:
    x, y, z, top = rng.uniform([50, 25, 30, 0.2], [95, 60, 70, 0.8])
    corners = [[-x / 2, 0], [x / 2, 0], [(top - 0.5) * x, z]]
    points = [[px, side * y / 2, pz] for side in (-1, 1) for px, pz in corners]
    faces = [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]
    return make_parts.hull_solid(points, faces)


def _peg(rng: np.random.Generator) -> np.ndarray:
    radius, height = rng.uniform([14, 35], [38, 100])
    angles = np.linspace(0, 2 * np.pi, int(rng.choice([12, 16, 24, 32])), endpoint=False)
    return make_parts.prism(radius * np.column_stack([np.cos(angles), np.sin(angles)]), height)


SHAPES: dict[str, Callable[[np.random.Generator], np.ndarray]] = {
    "box": _box,
    "l": _grid(lambda x, z, a, h: z < h or x < a),
    "t": _grid(lambda x, z, a, h: z > h or a < x < 1 - a),
    "u": _grid(lambda x, z, a, h: z < h or not a < x < 1 - a),
    "wedge": _wedge,
    "peg": _peg,
}


def random_part(rng: np.random.Generator, folder: Path, name: str) -> Part:
    """A part of random shape and size, written as a mesh; one in three lies on another side."""
    kind = str(rng.choice(list(SHAPES)))
    path = folder / f"{name}_{kind}.stl"
    make_parts.write_stl(path, SHAPES[kind](rng))
    turns = random_cells.axis_turns()
    stand = turns[int(rng.integers(1, len(turns)))] if rng.random() < 1 / 3 else turns[0]
    return dataclasses.replace(random_cells.read_part(path, 0.001, stand), name=kind)


def seen_from_above(part: Part, xy: np.ndarray, yaw: float) -> shapely.Polygon:
    """The hull of the part's shadow, its bounding box's middle at xy."""
    vertices = standing_vertices(part)
    middle = (part.lower + part.upper)[:2] / 2
    return shapely.MultiPoint((vertices[:, :2] - middle) @ turn(yaw).T + xy).convex_hull


def standing_vertices(part: Part) -> np.ndarray:
    loaded = _core.load_mesh(part.entry["mesh"], scale=[part.entry["scale"]] * 3)
    return np.asarray(loaded.mesh.vertices) @ part.stand.T


def hull_from_above(body: _core.Body) -> shapely.Polygon:
    """The hull of a body's shadow where it stands."""
    points = []
    for shape in body.shapes:
        vertices = np.asarray(_core.tessellate(shape).vertices)
        points.append(vertices @ body.X_WB[:3, :3].T + body.X_WB[:3, 3])
    return shapely.MultiPoint(np.concatenate(points)[:, :2]).convex_hull


def shadow(entry: dict, extent: np.ndarray, xy: np.ndarray, yaw: float) -> shapely.Polygon:
    """A neighbour seen from above."""
    if "box" in entry:
        return shapely.Polygon(random_cells.footprint(extent, xy, yaw))
    return shapely.Point(xy).buffer(extent[0] / 2)


def push_out(
    place: Callable[[float], shapely.Polygon], ground: Ground, gap: float
) -> tuple[float, shapely.Polygon] | None:
    """The nearest free distance along a ray, to a tenth of a millimetre; None within 0.25 m."""
    blocked = 0.0
    for reach in np.arange(0.0, 0.25, 0.004):
        if not ground.has_room(place(reach), gap):
            blocked = reach
            continue
        free = float(reach)
        while free - blocked > 1e-4:
            middle = (free + blocked) / 2
            free, blocked = (
                (middle, blocked) if ground.has_room(place(middle), gap) else (free, middle)
            )
        return free, place(free)
    return None


def add_neighbour(
    rng: np.random.Generator, centre: np.ndarray, ground: Ground
) -> tuple[dict, str] | None:
    """A body beside the part at `centre`: its entry with its pose, and 'fixtures' or 'parts'."""
    entry, extent = random_cells.random_body(rng)
    gap, yaw = FINGER * _between(rng, 1, 4), _between(rng, -np.pi, np.pi)
    angle = _between(rng, -np.pi, np.pi)
    along = np.array([np.cos(angle), np.sin(angle)])
    found = push_out(lambda s: shadow(entry, extent, centre + s * along, yaw), ground, gap)
    if found is None:
        return None
    reach, area = found
    if any(area.intersects(roof) and extent[2] > under - APART for roof, under in ground.roofs):
        return None
    ground.bodies.append(area)
    entry = {**entry, "pose": pose(centre + reach * along, extent[2] / 2, yaw)}
    # Some are parts that nobody moves; a sphere would roll away.
    can_stand = "sphere" not in entry
    return entry, "parts" if can_stand and rng.random() < 0.3 else "fixtures"


def add_stall(
    rng: np.random.Generator,
    centre: np.ndarray,
    extent: float,
    top: float,
    ground: Ground,
    roofed: bool,
) -> dict | None:
    """A wall beside the part; most have a roof that reaches over some of the part, or all."""
    gap, angle = FINGER * _between(rng, 1, 4), _between(rng, -np.pi, np.pi)
    length, height = _between(rng, 0.12, 0.30), _between(rng, 0.10, 0.25)
    along = np.array([np.cos(angle), np.sin(angle)])

    def wall(s: float) -> shapely.Polygon:
        return shapely.Polygon(
            random_cells.footprint(np.array([0.01, length]), centre + s * along, angle)
        )

    found = push_out(wall, ground, gap)
    if found is None:
        return None
    reach, area = found
    ground.bodies.append(area)
    shapes = [{"box": [0.01, length, height], "pose": {"xyz": [0, 0, height / 2]}}]
    if roofed or rng.random() < 0.6:
        under = top + _between(rng, 0.03, 0.15)
        share = _between(rng, 0.6, 1.2) if roofed else _between(rng, 0.2, 1.0)
        over = (float(reach) - extent / 2) + share * extent
        shapes[0] = {"box": [0.01, length, under], "pose": {"xyz": [0, 0, under / 2]}}
        plate = {"xyz": [0.005 - over / 2, 0, under + 0.005]}
        shapes.append({"box": [over, length, 0.01], "pose": plate})
        middle = centre + (reach + 0.005 - over / 2) * along
        roof = random_cells.footprint(np.array([over, length]), middle, angle)
        ground.roofs.append((shapely.Polygon(roof), under))
    x, y = (round(float(v), 5) for v in centre + reach * along)
    return {"pose": {"xyz": [x, y, 0], "rpy": [0, 0, angle]}, "shapes": shapes}


def random_ends(
    rng: np.random.Generator, part: Part, ground: Ground, fixtures: dict
) -> list[tuple[np.ndarray, float, float]] | None:
    """Where the part stands and where it goes: middle, turn, height of what it stands on."""
    ends: list[tuple[np.ndarray, float, float]] = []
    size = (part.upper - part.lower)[:2]
    while len(ends) < 2:
        radius, angle = _between(rng, 0.35, 0.68), _between(rng, -2.0, 2.0)
        xy = radius * np.array([np.cos(angle), np.sin(angle)])
        if ends and np.linalg.norm(xy - ends[0][0]) < BETWEEN_ENDS:
            continue
        yaw, z = _between(rng, -np.pi, np.pi), 0.0
        area = seen_from_above(part, xy, yaw)
        if area.distance(shapely.Point(0, 0)) < BASE_RADIUS:
            return None
        if rng.random() < 0.35:
            z = round(_between(rng, 0.015, 0.06), 4)
            base = [float(v) for v in (size * rng.uniform(0.8, 1.3, 2)).round(4)]
            place = pose(xy, z / 2, yaw)
            fixtures[f"stand_{len(ends)}"] = {"box": [*base, z], "pose": place, "support": True}
            ground.bodies.append(shapely.Polygon(random_cells.footprint(np.array(base), xy, yaw)))
        ground.parts.append(area)
        ends.append((xy, yaw, z))
    return ends


def clutter_cell(
    rng: np.random.Generator, folder: Path, name: str, roofed: bool = False
) -> dict | None:
    """A cell as a mapping; None where the neighbours found no room.

    With `roofed` the part stands under a roof at its origin: no hand comes straight down.
    """
    part, ground = random_part(rng, folder, name), Ground()
    bodies: dict[str, dict] = {"fixtures": {"table": TABLE}, "parts": {}}
    ends = random_ends(rng, part, ground, bodies["fixtures"])
    if ends is None:
        return None
    size, middle = part.upper - part.lower, (part.upper + part.lower) / 2
    places = []
    for i, (xy, yaw, z) in enumerate(ends):
        where = xy - turn(yaw) @ middle[:2]
        places.append(pose(where, z - float(part.lower[2]), yaw, part.stand))
        under_roof = roofed and i == 0
        if under_roof or rng.random() < 0.35:
            extent, top = float(size[:2].max()), z + float(size[2])
            stall = add_stall(rng, xy, extent, top, ground, under_roof)
            if stall is not None:
                bodies["fixtures"][f"stall_{i}"] = stall
        wanted, count = int(rng.integers(3, 11)), 0
        for _ in range(5 * wanted):
            found = add_neighbour(rng, xy, ground) if count < wanted else None
            if found is not None:
                bodies[found[1]][f"neighbour_{i}_{count}"] = found[0]
                count += 1
        if count < 3:
            return None
    mesh = {**part.entry, "mesh": Path(part.entry["mesh"]).name}
    return {
        "handey_cell": 1,
        "name": name,
        "robot": {"file": str(ROBOT)},
        "fixtures": bodies["fixtures"],
        "parts": {part.name: {**mesh, "pose": places[0]}, **bodies["parts"]},
        "task": [{"place": part.name, "at": places[1]}],
    }


def write_cell(seed: int, index: int, folder: Path, roofed: bool = False) -> Path | None:
    """The cell of a seed and a number as a file; None if this number gives none."""
    name = f"{'roofed' if roofed else 'clutter'}_{seed}_{index}"
    cell = clutter_cell(np.random.default_rng([seed, index]), folder, name, roofed)
    if cell is None:
        return None
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(cell, sort_keys=False))
    try:
        handey.load_cell(path)
    except handey.InvalidInput:
        return None  # it would not stand on that side
    return path


def clutter_cells(seed: int, count: int, folder: Path, roofed: bool = False) -> Iterator[Path]:
    """Yield `count` cell files."""
    made, index = 0, 0
    while made < count and index < 20 * count:
        index += 1
        path = write_cell(seed, index, folder, roofed)
        if path is not None:
            made += 1
            yield path


def count_missed(paths: Sequence[Path], seconds: float) -> int:
    """Of cells without a plan, how many the exhaustive search solves; a line for each."""
    missed = 0
    for path in paths:
        verdict = exhaustive.search(path, seconds)
        missed += verdict.solvable
        print(f"  {path.stem}: {verdict}", flush=True)
    return missed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--number", type=int, help="only the cell of this number")
    parser.add_argument("--roofed", action="store_true", help="the part stands under a roof")
    parser.add_argument("--keep", type=Path, help="folder to keep the cells and plans in")
    parser.add_argument(
        "--search", type=float, metavar="S", help="seconds to look for a way where there is no plan"
    )
    parser.add_argument("--no-repeat", action="store_true", help="do not plan a second time")
    parser.add_argument("-v", "--verbose", action="store_true")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        if args.number is None:
            paths = clutter_cells(args.seed, args.count, folder, args.roofed)
        else:
            path = write_cell(args.seed, args.number, folder, args.roofed)
            paths = iter([] if path is None else [path])
        tally = random_cells.run(paths, not args.no_repeat, args.verbose)
        random_cells.report("clutter under a roof" if args.roofed else "clutter", tally)
        if args.search is not None:
            missed = count_missed(
                [folder / f"{name}.yaml" for name in tally.unplanned], args.search
            )
            solvable = tally.planned + missed
            share = 100 * tally.planned / max(1, solvable)
            print(f"{tally.planned} of {solvable} planned that have a way: {share:.1f} %")
    return 0 if tally.valid == tally.planned else 1


if __name__ == "__main__":
    sys.exit(main())
