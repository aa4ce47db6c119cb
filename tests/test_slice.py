"""Slices from Python: tables, ranges of the wrist, layers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

_core = pytest.importorskip("handey._core")
from handey.errors import InvalidInput  # noqa: E402

MODELS = Path(__file__).parents[1] / "models"


@pytest.fixture(scope="module")
def checker():
    from handey.cell_file import load_cell

    cell = load_cell(MODELS / "cells/open_table.yaml").cell
    return _core.CollisionChecker(_core.make_collision_model(cell), cell)


@pytest.fixture(scope="module")
def table(checker):
    made, reason = _core.make_arm_table(checker.cell.robot)
    assert reason == ""
    return made


def wrist_round(middle: list[float], half: float):
    return _core.WristRange(np.array(middle) - half, np.array(middle) + half)


def test_configurations_in_free_cells_are_free(checker, table):
    wrist = wrist_round([0.2, 0.3, 0.0], 0.2)
    made = _core.Slice(checker, table, wrist, opening=0.05)
    assert made.reason == ""
    random = np.random.default_rng(1)
    asked = 0
    for layer in range(12, 28):
        blocked = made.blocked(layer)
        assert blocked.shape == (made.lattice.cells(0, 1), made.lattice.cells(0, 2))
        assert blocked.dtype == bool
        free = np.argwhere(~blocked)
        for row, column in free[random.integers(0, len(free), 40)]:
            cell = [layer, int(row), int(column)]
            assert made.is_free(cell)
            first = [
                made.lattice.centre(0, j, cell[j])
                + random.uniform(-0.5, 0.5) * made.lattice.cell_width(0, j)
                for j in range(3)
            ]
            q = np.concatenate([first, random.uniform(wrist.lower, wrist.upper)])
            assert checker.is_free(_core.Configuration(q, 0.05))
            asked += 1
    assert asked == 640
    assert made.layers_built == 16


def test_the_tori_of_the_article_are_coarser(checker, table):
    wrist = wrist_round([0.2, 0.3, 0.0], 0.2)
    free = {}
    for mode in (_core.SliceMode.Cells, _core.SliceMode.Article):
        made = _core.Slice(checker, table, wrist, 0.05, _core.SliceOptions(mode=mode))
        layers = range(made.lattice.cells(0, 0))
        free[mode] = sum(int((~made.blocked(layer)).sum()) for layer in layers)
    assert 0 < free[_core.SliceMode.Article] <= free[_core.SliceMode.Cells]


def test_wrong_cells_and_ranges_are_refused(checker, table):
    made = _core.Slice(checker, table, wrist_round([0.2, 0.3, 0.0], 0.2), 0.05)
    for cell in ([-1, 0, 0], [0, 34, 0], [40, 0, 0]):
        with pytest.raises(InvalidInput):
            made.is_free(cell)
    with pytest.raises(InvalidInput):
        made.blocked(40)
    with pytest.raises(InvalidInput):
        _core.Slice(checker, table, wrist_round([0.2, 0.3, 0.0], -0.2), 0.05)
    with pytest.raises(InvalidInput):
        _core.WristRange([0.0, float("nan"), 0.0], [0.0, 0.0, 0.0])
    with pytest.raises(TypeError):
        _core.Slice(checker, None, wrist_round([0.2, 0.3, 0.0], 0.2), 0.05)
    with pytest.raises(TypeError):
        _core.SliceOptions(margin=1.0)


def test_tables_are_kept_in_a_folder(checker, tmp_path):
    options = _core.ArmTableOptions(directory=str(tmp_path / "tables"))
    _core.make_arm_table(checker.cell.robot, options)
    (kept,) = (tmp_path / "tables").iterdir()
    written = kept.stat().st_mtime_ns
    assert _core.make_arm_table(checker.cell.robot, options)[0].level == 0
    assert kept.stat().st_mtime_ns == written
