"""What a direct task costs, on an open table and in clutter: one table of success and CPU time.

Cells come from a seed (tests/random_cells.py, tests/clutter_cells.py). The whole plan is timed with
files read and the tables of robot and part kept, without the check; the check by itself. Cells that
want a regrasp are told apart. The approach is
timed twice: as the planner asked for it, and on a sample of legal grasps of each cell, where the
usual fixed approach, a straight line of 0.1 m along the hand, is tried on the very same grasps.
Both are certified edge by edge. With --search, cells without a plan are searched exhaustively.
Usage: direct_task_benchmark.py [--count N] [--seed N] [--search SECONDS]
"""

from __future__ import annotations

import argparse
import itertools
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import handey
from handey import _core

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
import clutter_cells
import exhaustive
import random_cells

RUN_IN = 0.10  # of the fixed straight approach [m]
GRASPS = 6  # of each cell, for the comparison


@dataclass
class Approaches:
    """Approaches asked for: CPU seconds of each, and how many were found."""

    seconds: list[float] = field(default_factory=list)
    found: int = 0
    planners: Counter[str] = field(default_factory=Counter)

    def add(self, seconds: float, found: bool, planner: str = "") -> None:
        """Count one."""
        self.seconds.append(seconds)
        self.found += found
        if found:
            self.planners[planner] += 1


@dataclass
class Family:
    """What was measured on the cells of one family."""

    name: str
    cells: int = 0
    planned: int = 0
    valid: int = 0
    missed: int = 0
    plan_s: list[float] = field(default_factory=list)
    regrasp_s: list[float] = field(default_factory=list)
    no_plan_s: list[float] = field(default_factory=list)
    check_s: list[float] = field(default_factory=list)
    asked: Approaches = field(default_factory=Approaches)
    ours: Approaches = field(default_factory=Approaches)
    straight: Approaches = field(default_factory=Approaches)


def timed(call: Callable[..., Any], *args: Any) -> tuple[Any, float]:
    """A call's result and its seconds of the processor."""
    begin = time.process_time()
    result = call(*args)
    return result, time.process_time() - begin


def plan_watched(cell_file: handey.CellFile, asked: Approaches) -> handey.PlanResult:
    """Plan, and note every approach that the planner asks for."""
    plan_approach = _core.plan_approach

    def watched(*args: Any) -> _core.ApproachResult:
        result, seconds = timed(plan_approach, *args)
        asked.add(seconds, result.found, result.planner.name)
        return result

    _core.plan_approach = watched
    try:
        return handey.plan(cell_file)
    finally:
        _core.plan_approach = plan_approach


def sample_grasps(
    scene: _core.GraspScene, solver: _core.SphericalWristSolver
) -> Iterator[tuple[_core.RankedPair, _core.GraspPose]]:
    """Legal grasps of a cell: the best of each pair in turn, then the next."""
    ranked = _core.rank_grasps(scene.cell, scene.part, scene.X_WP_goal).ranked
    legal = [list(_core.find_legal_grasps(scene, solver, pair).poses) for pair in ranked]
    chosen = (
        (pair, pose)
        for poses in itertools.zip_longest(*legal)
        for pair, pose in zip(ranked, poses, strict=True)
        if pose is not None
    )
    return itertools.islice(chosen, GRASPS)


def straight_approach(
    model: _core.CollisionModel,
    cell: _core.Cell,
    solver: _core.SphericalWristSolver,
    aim: _core.GraspPose,
) -> bool:
    """The fixed approach: the open hand runs straight in over the last 0.1 m."""
    checker = _core.CollisionChecker(model, cell)
    start = _core.Configuration(q=aim.q_pick[0], opening=aim.opening)
    back = -_core.hand_in_world(cell, start.q)[:3, 2]
    options = _core.RetreatOptions(least=RUN_IN, most=RUN_IN)
    return bool(_core.plan_retreat(checker, checker, solver, start, back, options))


def compare(cell_file: handey.CellFile, family: Family) -> None:
    """Both approaches on the same grasps."""
    goal, cell = cell_file.goals[0], cell_file.cell
    model = _core.make_collision_model(cell)
    solver = _core.SphericalWristSolver(cell.robot)
    part = cell.part_index(goal.part)
    scene = _core.GraspScene(model=model, cell=cell, part=part, X_WP_goal=goal.X_WP)
    for pair, aim in sample_grasps(scene, solver):
        args = (scene, solver, pair, aim, aim.q_pick[0])
        result, seconds = timed(_core.plan_approach, *args)
        family.ours.add(seconds, result.found, result.planner.name)
        found, seconds = timed(straight_approach, model, cell, solver, aim)
        family.straight.add(seconds, found)


def measure(name: str, paths: Iterator[Path], search: float | None) -> Family:
    """Plan, check and compare on each cell."""
    family = Family(name)
    for path in paths:
        cell_file = handey.load_cell(path)
        handey.plan(cell_file)  # the tables
        family.cells += 1
        result = plan_watched(cell_file, family.asked)
        if result.plan is None:
            family.no_plan_s.append(result.report.cpu_s)
        else:
            kept = family.regrasp_s if result.report.regrasps else family.plan_s
            kept.append(result.report.cpu_s)
        compare(cell_file, family)
        if result.plan is None:
            found = search is not None and exhaustive.search(path, search).solvable
            family.missed += found
            continue
        family.planned += 1
        out = path.with_suffix(".plan.json")
        result.plan.save(out)
        checked, seconds = timed(handey.check, path, out)
        family.valid += checked.ok
        family.check_s.append(seconds)
    return family


def spread(seconds: list[float], scale: float = 1e3, digits: int = 1) -> str:
    """Median / p95."""
    if not seconds:
        return ""
    median, p95 = scale * np.percentile(seconds, [50, 95])
    return f"{median:.{digits}f} / {p95:.{digits}f}"


def share(part: int, whole: int) -> str:
    """So many of so many, in per cent."""
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else ""


def planners(approaches: Approaches) -> str:
    """Of the approaches found, how many came from which planner, in the order they are asked."""
    found = max(1, approaches.found)
    names = [name for name in _core.ApproachPlanner.__members__]
    return " / ".join(f"{100 * approaches.planners[name] / found:.0f}" for name in names) + " %"


def table(families: list[Family], searched: bool) -> str:
    """The measures down, the families across."""
    rows: list[tuple[str, Callable[[Family], str]]] = [
        ("planned", lambda f: share(f.planned, f.cells)),
        ("planned, of cells known to have a way", lambda f: share(f.planned, f.planned + f.missed)),
        ("valid plans", lambda f: share(f.valid, f.planned)),
        ("of these with a regrasp", lambda f: str(len(f.regrasp_s))),
        ("whole plan of a direct task, CPU ms", lambda f: spread(f.plan_s)),
        ("whole plan with a regrasp, CPU ms", lambda f: spread(f.regrasp_s)),
        ("no plan found, CPU ms until told", lambda f: spread(f.no_plan_s)),
        ("`handey check`, CPU s", lambda f: spread(f.check_s, 1, 2)),
        ("approaches that the planner asked for: found", lambda f: _found(f.asked)),
        ("the same, CPU ms", lambda f: spread(f.asked.seconds)),
        ("the same, straight / quasipotential / plane search / arm", lambda f: planners(f.asked)),
        ("approach to a legal grasp: found", lambda f: _found(f.ours)),
        ("the same, CPU ms", lambda f: spread(f.ours.seconds)),
        ("the same, straight / quasipotential / plane search / arm", lambda f: planners(f.ours)),
        ("fixed straight 0.1 m to the same grasp: found", lambda f: _found(f.straight)),
        ("the same, CPU ms", lambda f: spread(f.straight.seconds)),
    ]
    if not searched:
        del rows[1]
    lines = ["| median / p95 | " + " | ".join(f.name for f in families) + " |"]
    lines.append("| --- |" + " --- |" * len(families))
    lines += [f"| {row} | " + " | ".join(cell(f) for f in families) + " |" for row, cell in rows]
    return "\n".join(lines)


def _found(approaches: Approaches) -> str:
    return share(approaches.found, len(approaches.seconds))


def main() -> None:
    """Measure both families and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=40, help="cells of each family")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--search", type=float, metavar="S", help="look for a way if no plan")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder, parts = Path(scratch), random_cells.own_parts()
        sources = {
            "open table": random_cells.direct_cells(args.seed, args.count, parts, folder),
            "clutter": clutter_cells.clutter_cells(args.seed, args.count, folder),
            "clutter under a roof": clutter_cells.clutter_cells(
                args.seed, args.count, folder, roofed=True
            ),
        }
        families = [measure(name, paths, args.search) for name, paths in sources.items()]
    print(table(families, args.search is not None))


if __name__ == "__main__":
    main()
