"""What a regrasp costs, beside HPP: one block on an open table, moved or turned upside down.

The same Puma, table, block and places from a seed for both (hpp_peer.py tells what HPP was given:
it asks for its grasps by hand, and moves no fingers). Each task runs in a process of its own. Times
are of planning, without reading files and building models; handey's whole plan has a certificate
and is checked. The motion is timed for both by the same limits of velocity and acceleration, at
rest where the gripper closes or opens, whose own time is left out; a carry is one time that the
block is held. Tables on disk are kept, made by another task with the block, or not. With --cells
also random cells that no single grasp solves (tests/regrasp_cells.py), handey alone.
Usage: regrasp_benchmark.py [--hpp PYTHON] [--count N] [--cells N] [--seed N] [--deadline SECONDS]
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import yaml

import handey
from handey import _core

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
import random_cells
import regrasp_cells

PEER = Path(__file__).resolve().parent / "hpp_peer.py"
BLOCK = [0.04, 0.06, 0.05]
APART = 0.12  # of start and goal, at least [m]
UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0, 1.0])
STILL = ("grasp", "release")
PLANNERS = ("ManipulationPlanner", "StatesPathFinder")


@dataclass(frozen=True)
class Task:
    """Two poses of the block; the cell that says so."""

    start: np.ndarray
    goal: np.ndarray

    def cell(self) -> dict[str, Any]:
        """As a cell file holds it."""

        def entry(X_WP: np.ndarray) -> dict[str, Any]:
            turn = [float(v) for v in _core.quaternion_xyzw(X_WP)]
            return {"xyz": X_WP[:3, 3].tolist(), "quat_xyzw": turn}

        return {
            "handey_cell": 1,
            "name": "block",
            "robot": {"file": str(random_cells.ROBOT)},
            "fixtures": {"table": random_cells.TABLE},
            "parts": {"block": {"box": BLOCK, "pose": entry(self.start)}},
            "task": [{"place": "block", "at": entry(self.goal)}],
        }


@dataclass
class Row:
    """What came of one planner on all tasks of a kind."""

    kind: str
    planner: str
    asked: int = 0
    solved: int = 0
    valid: int | None = None
    cpu_s: list[float] = field(default_factory=list)
    wall_s: list[float] = field(default_factory=list)
    shorten_s: list[float] = field(default_factory=list)
    carries: list[int] = field(default_factory=list)
    motion_s: list[float] = field(default_factory=list)
    shortened_s: list[float] = field(default_factory=list)
    refusals: Counter[str] = field(default_factory=Counter)


def random_task(rng: np.random.Generator, last_turn: np.ndarray) -> Task:
    """Two places on the table where the arm works well."""

    def pose() -> np.ndarray:
        while True:
            radius, angle = rng.uniform(0.36, 0.66), rng.uniform(-1.8, 1.8)
            if radius > random_cells.BASE_RADIUS + max(BLOCK):
                break
        yaw, X_WP = rng.uniform(-np.pi, np.pi), np.eye(4)
        X_WP[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
        X_WP[:3, 3] = radius * np.cos(angle), radius * np.sin(angle), BLOCK[2] / 2
        return X_WP

    start, goal = pose(), pose()
    while np.linalg.norm(goal[:3, 3] - start[:3, 3]) < APART:
        goal = pose()
    return Task(start, goal @ last_turn)


def in_own_process(call: Callable[..., Any], *args: Any) -> Any:
    """A call's result from a fresh interpreter."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=1, mp_context=spawn) as pool:
        return pool.submit(call, *args).result()


def plan_once(path: Path, cache: Path | None, deadline: float) -> dict[str, Any]:
    """Plan a cell file with the tables of a folder, or without any; check the plan."""
    if cache is None:
        with tempfile.TemporaryDirectory() as empty:
            return plan_once(path, Path(empty), deadline)
    os.environ["HANDEY_CACHE"] = str(cache)
    result = handey.plan(handey.load_cell(path), handey.PlanOptions(deadline=deadline))
    report = result.report
    told = {"cpu_s": report.cpu_s, "wall_s": report.wall_s, "message": ""}
    if result.plan is None:
        return {**told, "message": report.verdict}
    out = path.with_suffix(".plan.json")
    result.plan.save(out)
    steps = result.plan.steps
    moving = [step.time[-1] - step.time[0] for step in steps if step.action not in STILL]
    carries = sum(step.action == "grasp" for step in steps)
    valid = handey.check(path, out).ok
    return {**told, "carries": carries, "motion_s": float(sum(moving)), "valid": valid}


def run_handey(row: Row, paths: Iterable[Path], cache: Path | None, deadline: float) -> Row:
    """Plan and check all cells."""
    row.valid = 0
    for path in paths:
        told = in_own_process(plan_once, path, cache, deadline)
        row.asked += 1
        row.cpu_s.append(told["cpu_s"])
        row.wall_s.append(told["wall_s"])
        if told["message"]:
            row.refusals[told["message"]] += 1
            continue
        row.solved += 1
        row.valid += told["valid"]
        row.carries.append(told["carries"])
        row.motion_s.append(told["motion_s"])
    return row


def ask_hpp(python: str, given: dict[str, Any]) -> dict[str, Any]:
    """What HPP's process answers to one task."""
    where = [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    site = subprocess.run(where, capture_output=True, text=True, check=True).stdout.strip()
    libraries = [f"{site}/cmeel.prefix/lib", os.environ.get("LD_LIBRARY_PATH", "")]
    env = {**os.environ, "LD_LIBRARY_PATH": ":".join(filter(None, libraries))}
    env.pop("PYTHONPATH", None)
    asked = [python, str(PEER)]
    ran = subprocess.run(
        asked, input=json.dumps(given), capture_output=True, text=True, env=env, check=False
    )
    if not ran.stdout:
        return {"message": f"ended with {ran.returncode}: {ran.stderr.strip()[-200:]}"}
    answer: dict[str, Any] = json.loads(ran.stdout)
    return answer


def for_hpp(task: Task, cell: handey.CellFile, **more: Any) -> dict[str, Any]:
    """A task as HPP's process reads it."""
    file = yaml.safe_load(random_cells.ROBOT.read_text())
    X_WT = np.eye(4)
    X_WT[:3, 3] = random_cells.TABLE["pose"]["xyz"]  # type: ignore[index]
    X_LG = np.eye(4)
    X_LG[:3, 3] = file["gripper"]["grasp_frame"]["xyz"]
    return {
        "urdf": str(random_cells.ROBOT.parent / file["urdf"]),
        "gripper_link": file["gripper"]["link"],
        "grasp_frame": X_LG.tolist(),
        "fingers": file["gripper"]["fingers"],
        "opening": file["gripper"]["opening"][1],
        "ignore_collisions": file["ignore_collisions"],
        "home": file["home"],
        "table": {"box": random_cells.TABLE["box"], "pose": X_WT.tolist()},
        "block": BLOCK,
        "start": task.start.tolist(),
        "goal": task.goal.tolist(),
        **more,
    }


def motion_seconds(robot: _core.Robot, runs: list[tuple[bool, list[list[float]]]]) -> float:
    """The time of all runs, each from rest to rest."""
    total = 0.0
    for _, rows in runs:
        path = [_core.Configuration(q=row, opening=0.1) for row in rows]
        total += float(_core.time_path(robot, path).duration)
    return total


def run_hpp(
    row: Row, tasks: list[Task], cell: handey.CellFile, python: str, args: argparse.Namespace
) -> Row:
    """Ask HPP all tasks; one answer is enough where it is not installed."""
    for index, task in enumerate(tasks):
        more = {"planner": row.planner, "deadline": args.deadline, "seed": args.seed + index}
        told = ask_hpp(python, for_hpp(task, cell, **more))
        row.asked += 1
        row.cpu_s += [told["cpu_s"]] if "cpu_s" in told else []
        row.wall_s += [told["wall_s"]] if "wall_s" in told else []
        if told["message"]:
            row.refusals[told["message"]] += 1
            if told["message"].startswith("not installed"):
                break
            continue
        row.solved += 1
        row.shorten_s.append(told["shorten_s"])
        row.carries.append(sum(held for held, _ in told["raw"]))
        row.motion_s.append(motion_seconds(cell.cell.robot, told["raw"]))
        row.shortened_s.append(motion_seconds(cell.cell.robot, told["shortened"]))
    return row


def spread(values: list[float], digits: int) -> str:
    """Median / p95."""
    if not values:
        return ""
    median, p95 = np.percentile(values, [50, 95])
    return f"{median:.{digits}f} / {p95:.{digits}f}"


def counted(carries: list[int]) -> str:
    """Median, least to most."""
    return f"{np.median(carries):g}, {min(carries)} to {max(carries)}" if carries else ""


def table(rows: list[Row]) -> str:
    """A line for each row."""
    heads = [
        "task", "planner", "solved", "valid", "CPU s", "wall s", "carries", "motion s",
        "shortened: CPU s", "motion s",
    ]  # fmt: skip
    lines = ["| " + " | ".join(heads) + " |", "| --- " * len(heads) + "|"]
    for row in rows:
        valid = "not checked" if row.valid is None else f"{row.valid} of {row.solved}"
        solved = f"{row.solved} of {row.asked}"
        if any(message.startswith("not installed") for message in row.refusals):
            solved, valid = "not installed", ""
        cells = [
            row.kind, row.planner, solved, valid, spread(row.cpu_s, 2),
            spread(row.wall_s, 2), counted(row.carries), spread(row.motion_s, 1),
            spread(row.shorten_s, 2), spread(row.shortened_s, 1),
        ]  # fmt: skip
        lines.append("| " + " | ".join(cells) + " |")
    for row in rows:
        for message, times in row.refusals.items():
            lines.append(f"\n{row.kind}, {row.planner}: {times} times: {message}")
    return "\n".join(lines)


def write_cells(folder: Path, tasks: list[Task], name: str) -> list[Path]:
    """The cell files of tasks."""
    paths = [folder / f"{name}_{index}.yaml" for index in range(len(tasks))]
    for path, task in zip(paths, tasks, strict=True):
        path.write_text(yaml.safe_dump(task.cell(), sort_keys=False))
    return paths


def both_caches(
    kind: str, paths: list[Path], first: list[Path], folder: Path, deadline: float
) -> list[Row]:
    """Plan with tables on disk that other tasks made, and without."""
    cache = folder / "cache"
    for path in first:
        in_own_process(plan_once, path, cache, deadline)
    return [
        run_handey(Row(kind, "handey"), paths, cache, deadline),
        run_handey(Row(kind, "handey, no tables kept"), paths, None, deadline),
    ]


def main() -> None:
    """Run all and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hpp", default=sys.executable, metavar="PYTHON", help="that has pyhpp")
    parser.add_argument("--count", type=int, default=20, help="tasks of each kind")
    parser.add_argument("--cells", type=int, default=0, help="random regrasp cells, handey alone")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--deadline", type=float, default=30.0, metavar="S", help="of each task")
    args = parser.parse_args()
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        kinds = {"moved": np.eye(4), "upside down": UPSIDE_DOWN}
        for number, (kind, last_turn) in enumerate(kinds.items()):
            rng = np.random.default_rng([args.seed, number])
            warming, *tasks = (random_task(rng, last_turn) for _ in range(args.count + 1))
            first, *paths = write_cells(folder, [warming, *tasks], kind.replace(" ", "_"))
            rows += both_caches(kind, paths, [first], folder, args.deadline)
            cell = handey.load_cell(first)
            for planner in PLANNERS:
                rows.append(run_hpp(Row(kind, planner), tasks, cell, args.hpp, args))
        if args.cells:
            found = list(regrasp_cells.regrasp_cells(args.seed, args.cells, folder))
            rows += both_caches("random cells", found, found, folder, args.deadline)
    for row in rows:
        row.planner = row.planner if row.planner.startswith("handey") else f"HPP {row.planner}"
    print(table(rows))


if __name__ == "__main__":
    main()
