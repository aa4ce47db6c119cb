"""Cells in clutter: what is planned is valid; the search that judges the planner finds ways."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("handey._core")

import clutter_cells
import exhaustive
import random_cells
from hand_made import write_cell

import handey

BOX_IN_A_PIT = {
    f"wall_{i}": {
        "box": [0.01, 0.24, 0.20] if i < 2 else [0.24, 0.01, 0.20],
        "pose": {"xyz": [0.50 + dx, 0.15 + dy, 0.10]},
    }
    for i, (dx, dy) in enumerate([(-0.04, 0), (0.04, 0), (0, -0.032), (0, 0.032)])
}


def test_plans_in_clutter_are_valid(tmp_path: Path) -> None:
    tally = random_cells.run(clutter_cells.clutter_cells(seed=1, count=4, folder=tmp_path))
    assert tally.tried == 4
    assert tally.planned >= 3, tally.failed
    assert tally.valid == tally.repeated == tally.planned, tally.failed


def test_the_same_seed_gives_the_same_cells(tmp_path: Path) -> None:
    texts = []
    for folder in (tmp_path / "a", tmp_path / "b"):
        folder.mkdir()
        cells = clutter_cells.clutter_cells(seed=5, count=4, folder=folder)
        texts.append([path.read_bytes() for path in cells])
    assert len(set(texts[0])) == 4
    assert texts[0] == texts[1]


def test_the_nearest_neighbour_leaves_a_gap_of_one_to_four_fingers(tmp_path: Path) -> None:
    for path in clutter_cells.clutter_cells(seed=11, count=6, folder=tmp_path):
        cell = handey.load_cell(path).cell
        part = clutter_cells.hull_from_above(cell.parts[0])
        gaps = [
            part.distance(clutter_cells.hull_from_above(body))
            for body in [*cell.fixtures, *cell.parts[1:]]
            if body.name.startswith("neighbour_0")
        ]
        assert 3 <= len(gaps) <= 10
        fingers = min(gaps) / clutter_cells.FINGER
        assert 0.95 <= fingers <= 4.05, f"{path.stem}: {fingers:.2f}"


def test_the_search_finds_a_way_that_is_valid(tmp_path: Path) -> None:
    path = write_cell(tmp_path)
    verdict = exhaustive.search(path, seconds=60)
    assert verdict.solvable and verdict.plan is not None
    verdict.plan.save(tmp_path / "plan.json")
    assert handey.check(path, tmp_path / "plan.json").ok


def test_the_search_finds_no_way_into_a_pit(tmp_path: Path) -> None:
    verdict = exhaustive.search(write_cell(tmp_path, fixtures=BOX_IN_A_PIT), seconds=120)
    assert not verdict.solvable and not verdict.cut_off
    assert verdict.counts["tried"] > 10_000
    assert verdict.counts["in collision at the origin"] > 0
