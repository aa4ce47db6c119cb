"""Random cells that have a plan: is any of them called infeasible when planning is crippled?

The generators of direct, cluttered, roofed and regrasp cells, and walls round the part, give the
cells. All proofs are asked for on each, whether planning would ask for them or not; then each is
planned with budgets so small that many fail. A cell of which something was proved is planned with
all budgets: a plan is a proof that was false.

    python tests/solvable_cells.py --count 200 --seed 1
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import chain, islice, zip_longest
from pathlib import Path

import clutter_cells
import numpy as np
import random_cells
import regrasp_cells
import yaml

import handey
from handey import _core
from handey.planning.budgets import by_slides
from handey.planning.proofs import Proofs

KINDS = ("direct", "clutter", "roofed", "walls", "regrasp")


def crippled() -> handey.PlanOptions:
    """Next to nothing is tried."""
    options = handey.PlanOptions()
    few = _core.LegalityOptions(directions=3, most_poses=1)
    return dataclasses.replace(
        options,
        legality=few,
        denser=(),
        direct=by_slides(options.direct),
        sampling_rounds=(1,),
        most_by_arm=0,
        thorough=False,
        regrasp=dataclasses.replace(options.regrasp, most_regrasps=0),
        advice=False,
    )


def walled_cells(seed: int, count: int, folder: Path) -> Iterator[Path]:
    """A block in a lane between two walls, now and then with a back or a low roof."""
    made, index = 0, 0
    while made < count and index < 20 * count:
        index += 1
        rng = np.random.default_rng([seed, index, 5])
        size = rng.uniform([0.03, 0.03, 0.03], [0.07, 0.08, 0.07]).round(4)
        room, yaw = 0.5 * float(size.max()) + rng.uniform(0.015, 0.06), rng.uniform(-3.1, 3.1)
        room, yaw = round(float(room), 4), float(yaw)
        high = round(float(rng.uniform(0.06, 0.25)), 4)
        shapes = [
            {"box": [0.2, 0.02, high], "pose": {"xyz": [0, side * (room + 0.01), high / 2]}}
            for side in (-1.0, 1.0)
        ]
        if rng.random() < 0.5:
            across = 2 * room + 0.04
            shapes.append({"box": [0.02, across, high], "pose": {"xyz": [0.11, 0, high / 2]}})
        if rng.random() < 0.5:
            top = max(high, float(size[2]) + 0.03) + 0.01
            shapes.append({"box": [0.2, 2 * room, 0.02], "pose": {"xyz": [0, 0, top]}})
        at = [float(v) for v in rng.uniform([0.35, 0.15], [0.6, 0.4]).round(4)]
        goal = [float(v) for v in rng.uniform([0.35, -0.4], [0.6, -0.15]).round(4)]
        block = {"box": [float(v) for v in size], "pose": {"xyz": [*at, float(size[2] / 2)]}}
        turned = {"xyz": [*goal, float(size[2] / 2)], "rpy": [0, 0, float(rng.uniform(-3.1, 3.1))]}
        walls = {"pose": {"xyz": [*at, 0], "rpy": [0, 0, yaw]}, "shapes": shapes}
        name = f"walls_{seed}_{index}"
        cell = {
            "handey_cell": 1,
            "name": name,
            "robot": {"file": str(random_cells.ROBOT)},
            "fixtures": {"table": random_cells.TABLE, "walls": walls},
            "parts": {"block": block},
            "task": [{"place": "block", "at": turned}],
        }
        path = folder / f"{name}.yaml"
        path.write_text(yaml.safe_dump(cell, sort_keys=False))
        try:
            handey.load_cell(path)
        except handey.InvalidInput:
            continue
        made += 1
        yield path


def cells(seed: int, count: int, folder: Path) -> Iterator[Path]:
    """All kinds by turns."""
    share = -(-count // len(KINDS))
    streams = (
        random_cells.direct_cells(seed, share, random_cells.own_parts(), folder),
        clutter_cells.clutter_cells(seed, share, folder),
        clutter_cells.clutter_cells(seed, share, folder, True),
        walled_cells(seed, share, folder),
        regrasp_cells.regrasp_cells(seed, share, folder),
    )
    turns = chain.from_iterable(zip_longest(*streams))
    yield from islice((path for path in turns if path is not None), count)


@dataclasses.dataclass
class Outcome:
    """What came of one cell: what is proved of it, and whether it has a plan."""

    name: str
    proofs: list[str]
    verdict: str  # with crippled budgets
    has_plan: bool | None = None  # None: not asked
    proof_s: float = 0.0

    @property
    def is_false(self) -> bool:
        """Was something proved although there is a plan?"""
        return bool(self.has_plan and self.proofs)


def look(path: Path, always_plan: bool = False) -> Outcome:
    """Ask for all proofs, plan with little, and with all where something was proved."""
    loaded = handey.load_cell(path)
    model = _core.make_collision_model(loaded.cell)
    proofs = Proofs(loaded, model, _core.SphericalWristSolver(loaded.cell.robot))
    begin = time.process_time()
    found = [proof.text for index in range(len(loaded.goals)) for proof in proofs.all_of(index)]
    seconds = time.process_time() - begin
    report = handey.plan(loaded, crippled()).report
    found += [goal.proof for goal in report.goals if goal.proof]
    outcome = Outcome(path.stem, found, report.verdict, proof_s=seconds)
    if report.verdict == "plan":
        outcome.has_plan = True
    elif found or always_plan:
        full = dataclasses.replace(handey.PlanOptions(), prove=False, advice=False, deadline=10.0)
        outcome.has_plan = handey.plan(loaded, full).plan is not None
    return outcome


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--all", action="store_true", help="plan all with all budgets")
    parser.add_argument("--keep", type=Path, help="folder to keep the cells in")
    parser.add_argument("-v", "--verbose", action="store_true")
    args = parser.parse_args()
    outcomes = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for path in cells(args.seed, args.count, folder):
            outcome = look(path, args.all)
            outcomes.append(outcome)
            if args.verbose or outcome.proofs:
                print(outcome, flush=True)
    false = [outcome for outcome in outcomes if outcome.is_false]
    solvable = sum(outcome.has_plan is True for outcome in outcomes)
    failed = sum(outcome.verdict != "plan" for outcome in outcomes)
    proved = sum(bool(outcome.proofs) for outcome in outcomes)
    median, p95 = np.percentile([outcome.proof_s for outcome in outcomes], [50, 95])
    print(
        f"{len(outcomes)} cells, {solvable} known to have a plan; {failed} fail with crippled "
        f"budgets; {proved} proved infeasible, {len(false)} of them with a plan; proofs take "
        f"median {1e3 * median:.0f} ms, p95 {1e3 * p95:.0f} ms"
    )
    return 1 if false else 0


if __name__ == "__main__":
    sys.exit(main())
