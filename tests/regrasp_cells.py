"""Random cells that no single grasp solves, from a seed: made, planned, checked, counted.

A part stands on a table and is to stand on it on another side: upside down, up on its end, laid on
a side, or so in a slot between two walls. 0 to 4 other bodies stand about. Only cells count for
which no grasp of a dense search is legal at both ends. Whether there is a way is not asked;
`--search` looks for the least number of regrasps by brute force over a lattice of places.

    python tests/regrasp_cells.py --count 40 --seed 1
    python tests/regrasp_cells.py --count 10 --seed 1 --search 40    # the least, 40 s each
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import random_cells
import yaml
from random_cells import BASE_RADIUS, GAP, OWN_PARTS, ROBOT, ROOT, TABLE, footprint, gap_between

import handey
from handey import _core

# No grasp of the wedge on a slope serves it on an end: no regrasp turns it there.
PARTS = [name for name in OWN_PARTS if name != "wedge"]
DENSE = _core.LegalityOptions(directions=72, spacing=0.008)
KINDS = ("upside down", "stand up", "lay on a side", "slot")


@dataclasses.dataclass(frozen=True)
class Rest:
    """A part standing on a table: its pose there, and its box seen from above."""

    pose: _core.RestingPose
    lower: np.ndarray
    upper: np.ndarray


def rests_of(body: _core.Body) -> list[Rest]:
    found = []
    for pose in _core.resting_poses(body):
        if pose.tip_angle < 0.1:
            continue
        shadow = np.asarray(pose.shadow)
        found.append(Rest(pose, shadow.min(axis=0), shadow.max(axis=0)))
    return found


def goals_of(kind: str, start: Rest, rests: list[Rest]) -> list[Rest]:
    """The resting poses that a task of this kind may end in."""
    up = start.pose.X_SP[2, :3]
    chosen = []
    for rest in rests:
        cosine = float(rest.pose.X_SP[2, :3] @ up)
        higher = rest.pose.top / start.pose.top
        fits = {
            "upside down": cosine < -0.99,
            "stand up": abs(cosine) < 0.9 and higher > 1.15,
            "lay on a side": abs(cosine) < 0.9 and higher < 0.87,
            "slot": cosine < 0.9,
        }
        if fits[kind]:
            chosen.append(rest)
    return chosen


def random_cell(rng: np.random.Generator, name: str, kind: str) -> dict | None:
    """A cell as a mapping; None where nothing of this kind came out."""
    part = str(rng.choice(PARTS))
    entry = {"mesh": str(ROOT / "models" / "parts" / f"{part}.stl"), "scale": 0.001, "mass": 0.2}
    loaded = _core.load_mesh(entry["mesh"], scale=[0.001] * 3, must_be_closed=True)
    body = _core.Body(name=part, shapes=[_core.Shape(_core.MeshShape(loaded.mesh))])
    rests = rests_of(body)
    if len(rests) < 2:
        return None
    start = rests[int(rng.integers(len(rests)))]
    goals = goals_of(kind, start, rests)
    if not goals:
        return None
    goal = goals[int(rng.integers(len(goals)))]
    taken: list[np.ndarray] = []
    fixtures: dict[str, dict] = {"table": TABLE}
    places = []
    for rest in (start, goal):
        walled = kind == "slot" and rest is goal
        room = find_room(rng, rest, taken, 0.05 if walled else 0.0)
        if room is None:
            return None
        X_WP, xy, yaw = room
        places.append(pose_entry(X_WP))
        if walled:
            add_slot(rng, rest, xy, yaw, fixtures, taken)
    for i in range(int(rng.integers(0, 5))):
        shape, extent = random_cells.random_body(rng)
        found = random_cells.find_room(rng, extent, taken, GAP)
        if found is not None:
            place = random_cells.pose(found[0], extent[2] / 2, found[1])
            fixtures[f"body_{i}"] = {**shape, "pose": place}
    return {
        "handey_cell": 1,
        "name": name,
        "robot": {"file": str(ROBOT)},
        "fixtures": fixtures,
        "parts": {part: {**entry, "pose": places[0]}},
        "task": [{"place": part, "at": places[1]}],
    }


def find_room(
    rng: np.random.Generator, rest: Rest, taken: list[np.ndarray], gap: float
) -> tuple[np.ndarray, np.ndarray, float] | None:
    """A place for the part where the arm works well: its pose, and the middle of its box."""
    size, middle = rest.upper - rest.lower, (rest.upper + rest.lower) / 2
    for _ in range(100):
        radius, angle = rng.uniform(0.36, 0.66), rng.uniform(-1.8, 1.8)
        xy = radius * np.array([np.cos(angle), np.sin(angle)])
        yaw = float(rng.uniform(-np.pi, np.pi))
        area = footprint(size, xy, yaw)
        clear = all(gap_between(area, other) > 0.04 + gap for other in taken)
        if clear and np.linalg.norm(area, axis=1).min() > BASE_RADIUS + gap:
            taken.append(area)
            X_WS = np.eye(4)
            X_WS[:2, :2] = random_cells.turn(yaw)
            X_WS[:2, 3] = xy - X_WS[:2, :2] @ middle
            return X_WS @ rest.pose.X_SP, xy, yaw
    return None


def pose_entry(X_WP: np.ndarray) -> dict:
    return {
        "xyz": [round(float(v), 9) for v in X_WP[:3, 3]],
        "quat_xyzw": [float(v) for v in _core.quaternion_xyzw(X_WP)],
    }


def add_slot(
    rng: np.random.Generator,
    rest: Rest,
    xy: np.ndarray,
    yaw: float,
    fixtures: dict[str, dict],
    taken: list[np.ndarray],
) -> None:
    """Two walls beside the part's longer sides."""
    size = rest.upper - rest.lower
    across = int(size[1] <= size[0])
    height = round(float(rest.pose.top * rng.uniform(0.5, 1.0)), 4)
    thick, length = 0.012, round(float(size[1 - across] * rng.uniform(0.7, 1.2)), 4)
    for side in (-1, 1):
        gap = rng.uniform(0.004, 0.012)
        offset = np.zeros(2)
        offset[across] = side * (size[across] / 2 + gap + thick / 2)
        centre = xy + random_cells.turn(yaw) @ offset
        box = [length, thick, height] if across else [thick, length, height]
        place = random_cells.pose(centre, height / 2, yaw)
        fixtures[f"wall_{(side + 1) // 2}"] = {"box": box, "pose": place}
        taken.append(footprint(np.array(box), centre, yaw))


def is_direct(path: Path) -> bool:
    """Is some grasp legal at both ends, of a coarse search or of a dense one?"""
    loaded = handey.load_cell(path)
    goal = loaded.goals[0]
    part = loaded.cell.part_index(goal.part)
    solver = _core.SphericalWristSolver(loaded.cell.robot)
    model = _core.make_collision_model(loaded.cell)
    scene = _core.GraspScene(model=model, cell=loaded.cell, part=part, X_WP_goal=goal.X_WP)
    ranking = _core.rank_grasps(loaded.cell, part, goal.X_WP)
    return any(
        _core.find_legal_grasps(scene, solver, pair, legality).poses
        for legality in (_core.LegalityOptions(), DENSE)
        for pair in ranking.ranked
    )


def regrasp_cells(seed: int, count: int, folder: Path) -> Iterator[Path]:
    """Yield `count` cell files, the kinds in turn."""
    made, index = 0, 0
    while made < count and index < 40 * count:
        index += 1
        kind = KINDS[made % len(KINDS)]
        name = f"regrasp_{seed}_{index}_{kind.replace(' ', '_')}"
        cell = random_cell(np.random.default_rng([seed, index]), name, kind)
        if cell is None:
            continue
        path = folder / f"{name}.yaml"
        path.write_text(yaml.safe_dump(cell, sort_keys=False))
        try:
            if is_direct(path):
                continue
        except handey.InvalidInput:
            continue
        made += 1
        yield path


@dataclasses.dataclass
class Outcome:
    """What came of one cell."""

    path: Path
    part: str
    planned: bool
    valid: bool
    cpu: float
    duration: float
    regrasps: int
    reasons: list[str]
    least: int | None = None  # by brute force; -1: none found

    def __str__(self) -> str:
        state = "valid" if self.valid else "NOT VALID" if self.planned else "no plan"
        text = f"{self.path.stem} {state} {self.cpu:.2f} s, {self.regrasps} regrasps"
        if self.planned:
            text += f", {self.duration:.1f} s long"
        if self.least is not None:
            text += f", least {self.least}"
        if not self.valid:
            text += ": " + " | ".join(self.reasons)[:600]
        return text


def run_one(path: Path) -> Outcome:
    cell_file = handey.load_cell(path)
    part = cell_file.goals[0].part
    result = handey.plan(cell_file)
    report = result.report
    if result.plan is None:
        return Outcome(path, part, False, False, report.cpu_s, 0.0, 0, report.reasons)
    out = path.with_suffix(".plan.json")
    result.plan.save(out)
    checked = handey.check(path, out)
    faults = [str(fault) for fault in checked.faults[:3]]
    duration, regrasps = report.duration_s, report.regrasps
    return Outcome(path, part, True, checked.ok, report.cpu_s, duration, regrasps, faults)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder to keep the cells and plans in")
    parser.add_argument("--search", type=float, metavar="S", help="seconds to look for the least")
    parser.add_argument("-v", "--verbose", action="store_true")
    args = parser.parse_args()
    outcomes: list[Outcome] = []
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for path in regrasp_cells(args.seed, args.count, folder):
            outcome = run_one(path)
            if args.search:
                import exhaustive_regrasps

                outcome.least = exhaustive_regrasps.least(path, args.search)
            outcomes.append(outcome)
            if args.verbose or not outcome.valid:
                print(outcome, flush=True)
    planned = [o for o in outcomes if o.planned]
    cpu = [o.cpu for o in outcomes] or [float("nan")]
    parts = {outcome.part for outcome in outcomes}
    counts = {n: sum(o.regrasps == n for o in planned) for n in range(5)}
    print(
        f"regrasp: {len(outcomes)} cells, {len(planned)} planned, "
        f"{sum(o.valid for o in outcomes)} valid; CPU of planning median {np.median(cpu):.3f} s, "
        f"p95 {np.percentile(cpu, 95):.3f} s; by number of regrasps {counts}; "
        f"{len(parts)} parts; {time.perf_counter() - begin:.0f} s"
    )
    if args.search:
        solvable = [o for o in outcomes if o.least is not None and o.least >= 0]
        missed = [o for o in solvable if not o.planned]
        more = [o for o in solvable if o.planned and o.regrasps > (o.least or 0)]
        print(
            f"{len(solvable)} with a way by brute force: {len(missed)} missed, {len(more)} longer"
        )
    return 0 if all(o.valid for o in planned) else 1


if __name__ == "__main__":
    sys.exit(main())
