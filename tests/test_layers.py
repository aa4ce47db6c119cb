"""Layers of slices through Python: shapes, agreement with the tables, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import handey
from handey import _core
from handey.errors import InvalidInput

CELLS = Path(__file__).resolve().parent.parent / "models/cells"


@pytest.fixture
def checker() -> _core.CollisionChecker:
    cell = handey.load_cell(CELLS / "demo.yaml").cell
    return _core.CollisionChecker(_core.make_collision_model(cell), cell)


def wrist(lower: float = -0.1, upper: float = 0.2) -> _core.WristRange:
    return _core.WristRange(lower=[lower] * 3, upper=[upper] * 3)


def test_a_cell_free_in_the_slice_does_not_collide_at_its_centre(
    checker: _core.CollisionChecker,
) -> None:
    table, _ = _core.make_arm_table(checker.cell.robot)
    assert table is not None
    cells = _core.Slice(checker, table, wrist(), 0.05)
    for angle in (-0.5, 0.9):
        blocked = cells.blocked(cells.lattice.index_of(cells.level, 0, angle)).T
        options = _core.LayerOptions(level=cells.level)
        layer = _core.prove_layer(checker, angle, wrist(), 0.05, options)
        assert blocked.shape == layer.kinds.shape
        assert 0.3 < np.mean(~blocked) < 1.0
        assert not np.any(~blocked & (layer.kinds == int(_core.CellKind.Collides)))


def test_a_fine_layer_with_a_fixed_wrist_proves_most(checker: _core.CollisionChecker) -> None:
    layer = _core.prove_layer(checker, 0.4, wrist(0.1, 0.1), 0.05)
    lattice = _core.make_lattice(checker.cell.robot)
    assert layer.kinds.shape == (lattice.cells(3, 2), lattice.cells(3, 1))
    assert layer.kinds.dtype == np.uint8
    assert abs(layer.theta1 - 0.4) <= lattice.cell_width(3, 0) / 2 + 1e-12
    assert np.mean(layer.kinds == int(_core.CellKind.Free)) > 0.7
    assert np.mean(layer.kinds == int(_core.CellKind.NotProved)) < 0.05


def test_wrong_numbers_are_refused(checker: _core.CollisionChecker) -> None:
    short = _core.WristRange(lower=[0.0], upper=[0.0])
    for opening, values in ((0.5, wrist()), (0.05, short), (0.05, wrist(0.2, -0.1))):
        with pytest.raises(InvalidInput):
            _core.prove_layer(checker, 0.0, values, opening)
    with pytest.raises(InvalidInput, match="outside the limits"):
        _core.prove_layer(checker, 3.1, wrist(), 0.05)
    with pytest.raises(InvalidInput, match="level"):
        _core.prove_layer(checker, 0.0, wrist(), 0.05, _core.LayerOptions(level=4))
    with pytest.raises(InvalidInput, match="clearance"):
        _core.prove_layer(checker, 0.0, wrist(), 0.05, _core.LayerOptions(clearance=-1.0))
    with pytest.raises(TypeError):
        _core.LayerOptions(levels=1)
