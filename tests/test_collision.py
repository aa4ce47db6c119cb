"""World and collision from Python: the border, and one hand-made case of each function."""

from __future__ import annotations

import math
import threading
from pathlib import Path

import numpy as np
import pytest

_core = pytest.importorskip("handey._core")
from handey.errors import InvalidInput  # noqa: E402

MODELS = Path(__file__).parents[1] / "models"


def at(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def box(name: str, size: list[float], pose: np.ndarray, **more):
    return _core.Body(name=name, shapes=[_core.Shape(geometry=_core.Box(size))], X_WB=pose, **more)


@pytest.fixture(scope="module")
def robot():
    from handey.robot_file import load_robot

    return load_robot(MODELS / "robots/puma560/robot.yaml")[0]


@pytest.fixture
def cell(robot):
    return _core.Cell(
        name="test",
        robot=robot,
        start=_core.Configuration(q=robot.home, opening=0.1),
        fixtures=[box("table", [1.6, 1.2, 0.05], at(0.55, 0, -0.025), support=True)],
        parts=[
            box("block", [0.04, 0.06, 0.03], at(0.45, -0.1, 0.015)),
            box("bracket", [0.02, 0.02, 0.02], at(0.45, 0.2, 0.01), mass=0.1),
        ],
    )


def test_a_cell_tells_what_it_was_given(cell):
    assert [body.name for body in cell.fixtures] == ["table"]
    assert cell.fixtures[0].support and not cell.parts[0].support
    assert cell.parts[1].mass == 0.1 and cell.parts[0].mass is None
    assert cell.part_index("bracket") == 1
    assert cell.held is None
    assert np.allclose(_core.centre_of_mass(cell.parts[0]), 0.0)


def test_an_unknown_part_is_named_with_the_legal_ones(cell):
    with pytest.raises(InvalidInput, match=r"did you mean 'bracket'.*block, bracket"):
        cell.part_index("braket")


def test_edits_return_new_cells(cell):
    moved = cell.with_part_at(0, at(0.5, 0, 0.015))
    assert np.allclose(moved.parts[0].X_WB, at(0.5, 0, 0.015))
    assert np.allclose(cell.parts[0].X_WB, at(0.45, -0.1, 0.015))
    held = cell.with_held(1, np.eye(4))
    assert held.held.part == 1 and cell.held is None
    assert held.with_released(at(0, 0.3, 0.01)).held is None
    with pytest.raises(InvalidInput):
        cell.with_released(np.eye(4))


def test_every_fault_of_a_cell_is_reported(robot):
    with pytest.raises(InvalidInput) as caught:
        _core.Cell(
            robot=robot,
            start=_core.Configuration(q=[9.0] * 6, opening=0.5),
            fixtures=[box("table", [1, 1, 1], np.eye(4))],
            parts=[box("table", [1, 1, 1], np.eye(4), mass=-1.0)],
        )
    codes = [fault.code for fault in caught.value.faults]
    assert codes == ["E_LIMIT", "E_LIMIT", "E_RANGE", "E_DUP"]


def test_a_part_must_be_a_closed_solid(robot):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    skin = _core.TriangleMesh(corners, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]]))
    shape = _core.Shape(geometry=_core.MeshShape(mesh=skin, solid=False))
    body = _core.Body(name="skin", shapes=[shape])
    start = _core.Configuration(q=robot.home, opening=0.1)
    _core.Cell(robot=robot, start=start, fixtures=[body])
    with pytest.raises(InvalidInput, match="closed"):
        _core.Cell(robot=robot, start=start, parts=[body])


@pytest.mark.parametrize("bad", ["x", [["a"] * 4] * 4, np.full((4, 4), True), np.eye(4) * 1j])
def test_what_is_not_a_pose_is_a_type_error(cell, bad):
    with pytest.raises(TypeError):
        cell.with_part_at(0, bad)


def test_a_pose_must_be_rigid_and_finite(cell):
    for bad in (2.0 * np.eye(4), np.full((4, 4), math.nan), np.eye(3)):
        with pytest.raises(InvalidInput):
            cell.with_part_at(0, bad)


def test_unknown_keywords_are_type_errors(cell):
    with pytest.raises(TypeError):
        _core.CertificateOptions(clearence=1e-3)
    with pytest.raises(TypeError):
        _core.Body(name="a", shapes=[], colour="red")


def test_the_checker_names_what_is_in_the_way(cell):
    model = _core.make_collision_model(cell)
    checker = _core.CollisionChecker(model, cell)
    assert checker.is_free(cell.start) and checker.find_hit(cell.start) is None
    hand = _core.hand_in_world(cell, cell.start.q)
    held = cell.with_part_at(0, hand)
    hit = _core.CollisionChecker(model, held).find_hit(_core.Configuration(cell.start.q, 0.05))
    assert hit.b == "block" and hit.distance <= 0.0
    closed = _core.Allowance(closed_on=0)
    allowed = _core.CollisionChecker(model, held, closed)
    assert allowed.is_free(_core.Configuration(cell.start.q, 0.05))


def test_an_edge_is_proved_or_refused_with_its_reason(cell):
    model = _core.make_collision_model(cell)
    checker = _core.CollisionChecker(model, cell)
    turned = _core.Configuration(cell.start.q + np.array([0.5, 0, 0, 0, 0, 0]), 0.1)
    assert _core.certify_edge(checker, cell.start, turned).is_free
    down = _core.Configuration([0.0, -0.75, -1.5708, 0, 0, 0], 0.1)
    result = _core.certify_edge(checker, cell.start, down)
    assert result.status == _core.EdgeStatus.Colliding
    assert result.hit.b == "table" and 0.0 < result.at <= 1.0
    path = _core.certify_path(checker, [cell.start, turned, cell.start, down])
    assert 2.0 < path.at <= 3.0
    assert _core.motion_bound(checker, cell.start, cell.start) == 0.0


def test_overlaps_and_contacts_at_rest(cell):
    model = _core.make_collision_model(cell)
    assert _core.find_overlaps(model, cell) == []
    assert _core.touching_bodies(model, cell, 0) == [_core.BodyRef(_core.BodyRef.Kind.Fixture, 0)]
    sunk = cell.with_part_at(0, at(0.45, -0.1, 0.013))
    (overlap,) = _core.find_overlaps(model, sunk)
    assert (overlap.name_a, overlap.name_b) == ("table", "block")
    assert overlap.depth == pytest.approx(0.002)
    assert _core.robot_overlaps(_core.CollisionChecker(model, sunk), cell.start) == []


def test_threads_with_own_checkers_share_a_model(cell):
    model = _core.make_collision_model(cell)
    answers = []

    def work():
        checker = _core.CollisionChecker(model, cell)
        target = _core.Configuration(cell.start.q + 0.3, 0.1)
        answers.append(_core.certify_edge(checker, cell.start, target).evaluations)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and len(set(answers)) == 1


def test_nan_is_refused(cell):
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    with pytest.raises(InvalidInput):
        checker.find_hit(_core.Configuration([math.nan] * 6, 0.1))
    with pytest.raises(InvalidInput):
        checker.is_free(cell.start, math.nan)
