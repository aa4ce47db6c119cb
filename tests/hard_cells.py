"""Cells that planning is long at: for tests of deadlines, of cancelling, and of Ctrl-C.

A block stands among many posts, under a roof, behind a wall that parts the arm's reach, or among
rings of thousands of triangles. Whether there is a way does not matter.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import yaml

ROBOT = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560" / "robot.yaml"
START, GOAL = (0.5, 0.25), (0.5, -0.25)


def _cell(name: str, fixtures: dict) -> dict:
    table = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
    return {
        "handey_cell": 1,
        "name": name,
        "robot": {"file": str(ROBOT)},
        "fixtures": {"table": table, **fixtures},
        "parts": {"block": {"box": [0.04, 0.06, 0.05], "pose": {"xyz": [*START, 0.025]}}},
        "task": [{"place": "block", "at": {"xyz": [*GOAL, 0.025]}}],
    }


def _box(size: list[float], xyz: list[float]) -> dict:
    return {"box": size, "pose": {"xyz": xyz}}


def crowded(_: Path) -> dict:
    """25 posts about either end, with little room for the hand between them."""
    fixtures = {}
    for end, (x, y) in {"start": START, "goal": GOAL}.items():
        for i in range(25):
            ring, angle = 0.06 + 0.06 * (i // 9), 2.4 * i
            at = [x + ring * np.cos(angle), y + ring * np.sin(angle), 0.09]
            fixtures[f"{end}_{i}"] = _box([0.02, 0.02, 0.18], [float(v) for v in at])
    return _cell("crowded", fixtures)


def roofed(_: Path) -> dict:
    """Low roofs over both ends, with posts before them."""
    fixtures = {}
    for end, (x, y) in {"start": START, "goal": GOAL}.items():
        fixtures[f"{end}_roof"] = _box([0.24, 0.24, 0.02], [x, y, 0.17])
        fixtures[f"{end}_back"] = _box([0.02, 0.24, 0.16], [x + 0.11, y, 0.08])
        for i, across in enumerate((-0.09, -0.03, 0.03, 0.09)):
            fixtures[f"{end}_post_{i}"] = _box([0.012, 0.012, 0.16], [x - 0.1, y + across, 0.08])
    return _cell("roofed", fixtures)


def parted(_: Path) -> dict:
    """Walls from near the arm's foot outwards, and a low ceiling: the arm can hardly pass."""
    fixtures = {
        "wall": _box([1.2, 0.02, 1.04], [1.02, 0.0, 0.52]),
        "wall_behind": _box([1.2, 0.02, 1.04], [-1.02, 0.0, 0.52]),
        "ceiling": _box([3.0, 3.0, 0.02], [0.0, 0.0, 1.05]),
    }
    cell = _cell("parted", fixtures)
    cell["robot"]["start"] = [0.859, 0.557, -3.104, 0.0, -0.595, -2.282]
    cell["finish"] = "anywhere"
    return cell


def ringed(folder: Path) -> dict:
    """Rings of 12000 triangles, lying one on the other round both ends."""
    path = folder / "ring.stl"
    _write_ring(path, 0.10, 0.016, 120, 50)
    fixtures = {
        f"{end}_{i}": {"mesh": str(path), "pose": {"xyz": [x, y, 0.018 + 0.034 * i]}}
        for end, (x, y) in {"start": START, "goal": GOAL}.items()
        for i in range(5)
    }
    return _cell("ringed", fixtures)


def _write_ring(path: Path, radius: float, thickness: float, around: int, across: int) -> None:
    u, v = np.meshgrid(
        np.linspace(0, 2 * np.pi, around, endpoint=False),
        np.linspace(0, 2 * np.pi, across, endpoint=False),
        indexing="ij",
    )
    out = radius + thickness * np.cos(v)
    points = np.stack([out * np.cos(u), out * np.sin(u), thickness * np.sin(v)], axis=-1)
    right, up = np.roll(points, -1, axis=0), np.roll(points, -1, axis=1)
    both = np.roll(right, -1, axis=1)
    one, other = np.stack([points, right, both], axis=2), np.stack([points, both, up], axis=2)
    triangles = np.concatenate([one.reshape(-1, 3, 3), other.reshape(-1, 3, 3)])
    record = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")])
    record["p"] = triangles
    path.write_bytes(b"\0" * 80 + np.uint32(len(triangles)).tobytes() + record.tobytes())


CELLS: dict[str, Callable[[Path], dict]] = {
    "crowded": crowded,
    "roofed": roofed,
    "parted": parted,
    "ringed": ringed,
}


def write_cell(name: str, folder: Path) -> Path:
    """The cell of that name as a file."""
    path = folder / f"{name}.yaml"
    path.write_text(yaml.safe_dump(CELLS[name](folder), sort_keys=False))
    return path
