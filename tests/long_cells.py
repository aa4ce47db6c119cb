"""Cells and budgets with which planning is at work for longer than 5 s: in every stage some.

A stop can only be tried while something is going on. Most tasks are solved or given up in less than
a second; here the budgets are far beyond the usual ones, meshes are fine, goals many, so that a
deadline or a cancelling meets each stage at its work. Whether there is a way does not matter.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import hard_cells
import numpy as np
import yaml
from hard_cells import GOAL, START

import handey
from handey import _core

PARTS = hard_cells.ROBOT.parents[2] / "parts"


@dataclass(frozen=True)
class LongCell:
    """How to write the cell, and what planning is allowed.

    Attributes:
        make: the document, given the folder for its files.
        options: of planning.
    """

    make: Callable[[Path], dict[str, Any]]
    options: handey.PlanOptions = field(default_factory=handey.PlanOptions)


def _box(size: list[float], xyz: list[float]) -> dict[str, Any]:
    return {"box": size, "pose": {"xyz": xyz}}


def _walled(folder: Path) -> dict[str, Any]:
    """No way is found between the walls, and there is no proof that there is none."""
    cell = hard_cells.parted(folder)
    cell["fixtures"]["wall"] = _box([1.2, 0.02, 0.98], [1.02, 0.0, 0.49])
    return cell


def _many(_: Path) -> dict[str, Any]:
    """Eight blocks in any order; where the last is to go, a wall stands in the arm's way."""
    cell = hard_cells.parted(Path())
    cell["parts"], cell["task"], cell["order"] = {}, [], "any"
    for i in range(8):
        x, y = 0.4 + 0.1 * (i % 4), 0.18 + 0.12 * (i // 4)
        cell["parts"][f"block_{i}"] = {"box": [0.04, 0.05, 0.04], "pose": {"xyz": [x, y, 0.02]}}
        cell["task"].append({"place": f"block_{i}", "at": {"xyz": [x, -y, 0.02]}})
    return cell


def _turned(_: Path) -> dict[str, Any]:
    """A block to be turned over, with little room about either end."""
    cell = hard_cells.roofed(Path())
    for end in ("start", "goal"):
        for name in [name for name in cell["fixtures"] if name.startswith(f"{end}_post")]:
            del cell["fixtures"][name]
    cell["task"][0]["at"]["rpy"] = [3.141592653589793, 0.0, 0.0]
    cell["fixtures"]["shelf"] = {
        "box": [0.3, 0.3, 0.02],
        "pose": {"xyz": [0.25, 0.55, 0.2]},
        "support": True,
    }
    return cell


def _fine(folder: Path) -> dict[str, Any]:
    """Rings of 60000 triangles round both ends, and one to be moved."""
    path = folder / "fine_ring.stl"
    hard_cells._write_ring(path, 0.10, 0.016, 300, 100)
    small = folder / "fine_part.stl"
    hard_cells._write_ring(small, 0.03, 0.008, 300, 100)
    cell = hard_cells.ringed(folder)
    for fixture in cell["fixtures"].values():
        if "mesh" in fixture:
            fixture["mesh"] = str(path)
    cell["parts"] = {"ring": {"mesh": str(small), "pose": {"xyz": [*START, 0.008]}}}
    cell["task"] = [{"place": "ring", "at": {"xyz": [*GOAL, 0.008], "rpy": [0, 0, 0.4]}}]
    return cell


def _somewhere(folder: Path) -> dict[str, Any]:
    """A finely meshed ring is to be put anywhere on the table: how it may stand is asked first."""
    cell = _fine(folder)
    cell["task"] = [{"place": "ring", "on": "table"}]
    return cell


def _measured(folder: Path) -> dict[str, Any]:
    """A heap between the ends and round them, known by a map of heights with small columns."""
    random = np.random.default_rng(3)
    heights = 0.05 * random.random((320, 240))
    x, y = np.meshgrid(np.arange(240) * 0.002 + 0.26, np.arange(320) * 0.002 - 0.32)
    heights[heights < 0.035] = 0.0
    for at in (START, GOAL):
        heights[np.hypot(x - at[0], y - at[1]) < 0.06] = 0.0
    np.save(folder / "heap.npy", heights)
    cell = hard_cells.roofed(folder)
    cell["depth_maps"] = {
        "heap": {"heights": "heap.npy", "cell": 0.002, "pose": {"xyz": [0.26, -0.32, 0]}}
    }
    return cell


def _closed(_: Path) -> dict[str, Any]:
    """No grasp is legal: the goal lies under a roof, within walls."""
    cell = hard_cells.crowded(Path())
    x, y = GOAL
    cell["fixtures"]["lid"] = _box([0.3, 0.3, 0.02], [x, y, 0.2])
    return cell


def _caged(_: Path) -> dict[str, Any]:
    """Boards all about the block, with gaps that the hand does not pass: for the approach."""
    cell = hard_cells.roofed(Path())
    for i, across in enumerate((-0.12, 0.12)):
        for end, (x, y) in {"start": START, "goal": GOAL}.items():
            cell["fixtures"][f"{end}_side_{i}"] = _box([0.2, 0.012, 0.16], [x, y + across, 0.08])
    return cell


FREE = handey.PlanOptions(prove=False, diagnosis=False, advice=False)
DENSE = _core.LegalityOptions(directions=720, spacing=0.001, least_contact_share=0.05)
SPREAD = _core.LegalityOptions(directions=360, spacing=0.001, least_contact_share=0.05, spread=True)


def _wide_search() -> handey.PlanOptions:
    direct = replace(FREE.direct, approach=_core.ApproachOptions(cell=0.001, search_levels=3))
    return replace(FREE, direct=direct, denser=())


CELLS: dict[str, LongCell] = {
    "sampled": LongCell(_walled, replace(FREE, sampling_rounds=(10_000_000,), thorough=False)),
    "sliced": LongCell(_walled, replace(FREE, sampling_rounds=(50, 150, 500, 10_000_000))),
    "by_arm": LongCell(
        hard_cells.roofed, replace(FREE, sampling_rounds=(50, 3_000_000), most_by_arm=1000)
    ),
    "any_order": LongCell(_many, replace(FREE, sampling_rounds=(50, 150, 20_000))),
    "any_order_proved": LongCell(_many),
    "turned": LongCell(
        _turned,
        replace(
            FREE,
            regrasp=replace(FREE.regrasp, samples=(4000, 40_000), places=(60, 400), grasps=200),
        ),
    ),
    "fine": LongCell(_fine, replace(FREE, legality=DENSE)),
    "fine_usual": LongCell(_fine),
    "somewhere": LongCell(_somewhere, FREE),
    "measured": LongCell(_measured, replace(FREE, legality=DENSE)),
    "dense": LongCell(_closed, replace(FREE, legality=DENSE)),
    "spread": LongCell(_closed, replace(FREE, denser=(SPREAD,))),
    "closed": LongCell(_closed, handey.PlanOptions(advice_seconds=30.0, denser=(SPREAD,))),
    "advised": LongCell(_walled, handey.PlanOptions(advice_seconds=60.0)),
    "caged": LongCell(_caged, _wide_search()),
}


def write_cell(name: str, folder: Path) -> Path:
    """The cell of that name as a file."""
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(CELLS[name].make(folder), sort_keys=False))
    return path
