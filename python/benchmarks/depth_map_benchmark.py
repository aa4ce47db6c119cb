"""What a depth image of 640 x 480 pixels costs: to take in, and in planning.

The scene is that of models/cells/depth_map.yaml: boxes, cans, a ball and a heap of stones about a
part and its goal, seen by one camera. The same tasks are planned three times: with what the camera
measured, with the same things given as shapes, and with nothing but the table. Goals come from a
seed. To take in: `load_cell` of the file with the image, less that of the file without.
Usage: depth_map_benchmark.py [--count N] [--seed N]
"""

from __future__ import annotations

import argparse
import copy
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import yaml

import handey

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "models" / "cells" / "depth"))
import make_depth_maps as scene

CELLS = Path(__file__).resolve().parents[2] / "models" / "cells"
WAYS = ("depth image", "the same as shapes", "table only")
REPEATS = 5  # of reading and planning; the median counts


def cells(folder: Path) -> dict[str, dict[str, Any]]:
    """The cell with the image, with the things in it as shapes, and without them."""
    bare = yaml.safe_load((CELLS / "depth_map.yaml").read_text())
    camera = bare.pop("depth_maps")["camera"]
    bare["robot"]["file"] = str((CELLS / bare["robot"]["file"]).resolve())
    mesh = bare["parts"]["l_block"]
    mesh["mesh"] = str((CELLS / mesh["mesh"]).resolve())
    scene.ROWS, scene.COLUMNS, scene.FOCAL = 480, 640, 600.0
    scene.write_png(folder / "camera.png", scene.depth_image())
    seen = copy.deepcopy(bare)
    lens = {"fx": 600, "fy": 600, "cx": 320, "cy": 240}
    seen["depth_maps"] = {"camera": {**camera, "depth": "camera.png", "intrinsics": lens}}
    known = copy.deepcopy(bare)
    known["fixtures"] |= shapes()
    return dict(zip(WAYS, (seen, known, bare), strict=True))


def shapes() -> dict[str, dict[str, Any]]:
    """What the camera saw, as fixtures."""
    fixtures: dict[str, dict[str, Any]] = {}
    for i, (centre, size) in enumerate(scene.BOXES):
        fixtures[f"box_{i}"] = {"box": size, "pose": {"xyz": centre}}
    for i, (base, radius, height) in enumerate(scene.CANS):
        at = [base[0], base[1], base[2] + height / 2]
        can = {"radius": radius, "length": height}
        fixtures[f"can_{i}"] = {"cylinder": can, "pose": {"xyz": at}}
    for i, (centre, radius) in enumerate(scene.BALLS + scene.STONES):
        fixtures[f"ball_{i}"] = {"sphere": {"radius": radius}, "pose": {"xyz": centre}}
    return fixtures


def goals(count: int, seed: int) -> list[dict[str, Any]]:
    """Poses on the table about that of the cell."""
    random = np.random.default_rng(seed)
    places = random.uniform([0.44, -0.25, -np.pi], [0.50, -0.19, np.pi], (count, 3)).round(4)
    return [
        {"place": "l_block", "at": {"xyz": [float(x), float(y), 0.0], "rpy": [0, 0, float(yaw)]}}
        for x, y, yaw in places
    ]


def median_cpu(call: Any) -> tuple[Any, float]:
    """The last result, and the median CPU seconds of the repeats."""
    seconds = []
    for _ in range(REPEATS):
        begin = time.process_time()
        result = call()
        seconds.append(time.process_time() - begin)
    return result, float(np.median(seconds))


def measure(folder: Path, count: int, seed: int) -> str:
    """Read and plan every task in the three ways; a table."""
    read: dict[str, list[float]] = {way: [] for way in WAYS}
    planned: dict[str, list[float]] = {way: [] for way in WAYS}
    tasks = 0
    made = cells(folder)
    for goal in goals(count, seed):
        results = {}
        for way, cell in made.items():
            path = folder / "cell.yaml"
            path.write_text(yaml.safe_dump({**cell, "task": [goal]}))
            try:
                cell_file, read_s = median_cpu(lambda path=path: handey.load_cell(path))
            except handey.InvalidInput:
                break  # the goal is in one of the things
            result, plan_s = median_cpu(lambda cell_file=cell_file: handey.plan(cell_file))
            results[way] = (result.plan is not None, read_s, plan_s)
        if len(results) < len(WAYS) or not all(found for found, _, _ in results.values()):
            continue
        tasks += 1
        for way, (_, read_s, plan_s) in results.items():
            read[way].append(read_s)
            planned[way].append(plan_s)
    lines = [
        "| median CPU ms | read | to take in | plan | times that of shapes |",
        "|" + " --- |" * 5,
    ]
    for way in WAYS:
        own, without = 1e3 * np.array(read[way]), 1e3 * np.array(read["table only"])
        plan_ms, shape_ms = np.array(planned[way]), np.array(planned["the same as shapes"])
        lines.append(
            f"| {way} | {np.median(own):.1f} | {np.median(own - without):.1f} | "
            f"{1e3 * np.median(plan_ms):.1f} | {np.median(plan_ms / shape_ms):.2f} |"
        )
    return "\n".join([f"{tasks} tasks of {count} planned in all three ways", "", *lines])


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20, help="tasks")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        print(measure(Path(scratch), args.count, args.seed))


if __name__ == "__main__":
    main()
