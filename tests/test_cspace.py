"""Configuration space from Python: cells, the arm's plane, sections, and two links in a plane."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

_core = pytest.importorskip("handey._core")
from handey.errors import InvalidInput  # noqa: E402

MODELS = Path(__file__).parents[1] / "models"
IRB120 = Path(__file__).parents[2] / "shared" / "data" / "robots" / "abb_irb120"
TURN = 2.0 * math.pi


@pytest.fixture(scope="module")
def robot():
    from handey.robot_file import load_robot

    return load_robot(MODELS / "robots/puma560/robot.yaml")[0]


def rectangle(left: float, right: float, low: float, high: float) -> np.ndarray:
    return np.array([[left, low], [right, low], [right, high], [left, high]])


def turned(polygon: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return polygon @ np.array([[c, s], [-s, c]])


def meet(a: np.ndarray, b: np.ndarray) -> bool:
    """Convex polygons meet unless a line along an edge of one parts them."""
    for polygon in (a, b):
        edges = np.roll(polygon, -1, axis=0) - polygon
        for normal in np.column_stack([edges[:, 1], -edges[:, 0]]):
            if (a @ normal).max() < (b @ normal).min() or (b @ normal).max() < (a @ normal).min():
                return False
    return True


def is_in(intervals: np.ndarray, angle: float) -> bool:
    return bool(np.any((intervals[:, 0] <= angle) & (angle <= intervals[:, 1])))


def test_the_slice_of_two_links_agrees_with_brute_force():
    random = np.random.default_rng(5)
    upper, lower = rectangle(-0.1, 0.45, -0.05, 0.05), rectangle(-0.05, 0.4, -0.03, 0.03)
    elbow = np.array([0.4, 0.0])
    obstacles = []
    for _ in range(4):
        obstacles.append(
            turned(rectangle(0, 0.2, 0, 0.1), random.uniform(0, TURN))
            + random.uniform(-0.8, 0.8, 2)
        )
    arm = _core.PlanarArm(upper=[upper], lower=[lower], elbow=elbow)
    columns = random.uniform(0, TURN, 60)
    forbidden = _core.planar_slice(arm, obstacles, columns)
    verdicts = []
    for theta2, intervals in zip(columns, forbidden, strict=True):
        at = turned(elbow[None, :], theta2)
        for theta3 in random.uniform(0, TURN, 40):
            if intervals.size and np.abs(intervals - theta3).min() < 1e-9:
                continue
            links = [turned(upper, theta2), turned(lower, theta2 + theta3) + at]
            truth = any(meet(link, obstacle) for link in links for obstacle in obstacles)
            assert truth == is_in(intervals, theta3), (theta2, theta3)
            verdicts.append(truth)
    assert 200 < sum(verdicts) < len(verdicts) - 200


def test_forbidden_angles_are_contact_angles():
    rod, wall = rectangle(0, 1, -0.01, 0.01), rectangle(-2, 2, 0.5, 0.6)
    (limits,) = _core.forbidden_angles([rod], [wall])
    first = math.asin(0.5 / math.hypot(1, 0.01)) - math.atan(0.01)
    assert limits == pytest.approx([first, math.pi - first], abs=1e-12)
    assert _core.forbidden_angles([rod], [wall + np.array([0, 1])]).shape == (0, 2)


def test_polygons_are_refused_with_their_place():
    good = rectangle(0, 1, 0, 1)
    with pytest.raises(InvalidInput) as error:
        _core.forbidden_angles([good, good[:2]], [good])
    assert error.value.faults[0].code == "E_EMPTY"
    with pytest.raises(InvalidInput):
        _core.forbidden_angles([good * np.nan], [good])
    with pytest.raises(TypeError):
        _core.forbidden_angles([[["a", "b"]]], [good])
    with pytest.raises(TypeError):
        _core.PlanarArm(upper=[good], lower=[good], elbow=[1, 0], wrist=1)


def test_the_lattice_of_the_puma_has_cells_of_eight_degrees(robot):
    lattice = _core.make_lattice(robot)
    assert lattice.count == [40, 34, 34]
    assert not any(lattice.wraps)
    low, high = robot.joints[1].limit.lower, robot.joints[1].limit.upper
    assert lattice.cells(3, 1) * lattice.cell_width(3, 1) == pytest.approx(high - low)
    assert lattice.index_of(2, 1, lattice.centre(2, 1, 17)) == 17
    assert lattice.index_of(2, 1, high + 0.01) == -1
    for wrong in (0.0, -1.0, math.nan):
        with pytest.raises(InvalidInput):
            _core.make_lattice(robot, wrong)
    with pytest.raises(InvalidInput):
        lattice.cells(4, 0)


def test_a_section_contains_what_reaches_the_slab(robot):
    plane, reason = _core.arm_plane(robot)
    assert reason == ""
    random = np.random.default_rng(1)
    slab = _core.Slab(0.1, 0.2)
    inside = 0
    for _ in range(100):
        corners = random.uniform(-0.8, 0.8, 3) + random.uniform(-0.3, 0.3, (6, 3))
        q1, half = random.uniform(-3, 3), random.uniform(0, 0.1)
        section = _core.cross_section(plane, _core.SceneHull(corners), slab, q1, half)
        weights = random.dirichlet(np.full(6, 0.4), 200)
        for angle in random.uniform(q1 - half, q1 + half, 5):
            x_er = np.linalg.inv(plane.X_RE(angle))
            points = weights @ corners @ x_er[:3, :3].T + x_er[:3, 3]
            for point in points[(points[:, 2] >= 0.1) & (points[:, 2] <= 0.2)]:
                edges = np.roll(section, -1, axis=0) - section
                to = point[:2] - section
                assert np.all(edges[:, 0] * to[:, 1] - edges[:, 1] * to[:, 0] > -1e-9)
                inside += 1
    assert inside > 1000


def test_a_post_is_two_tori(robot):
    plane, _ = _core.arm_plane(robot)
    corners = [[x, y, z] for x in (0.5, 0.55) for y in (0, 0.05) for z in (0, 1.2)]
    tori = _core.torus_of(plane, _core.SceneHull(corners), _core.Slab(0.1, 0.2))
    assert len(tori) == 2
    for torus in tori:
        assert 0 < torus.upper - torus.lower < 0.5
        assert torus.section.shape[0] >= 4


def test_the_irb_120_has_a_plane(tmp_path):
    from test_kinematics import irb120_with_gripper

    description = _core.RobotDescription(
        name="irb120",
        arm=[f"joint_{i}" for i in range(1, 7)],
        home=[0, 0, 0, 0, 0.5, 0],
        gripper_link="tool0",
        X_LH=np.eye(4),
        fingers=["left_joint", "right_joint"],
        max_opening=0.08,
        packages={"abb_irb120_support": str(IRB120 / "abb_irb120_support")},
    )
    irb120 = _core.load_robot(str(irb120_with_gripper(tmp_path)), description).robot
    plane, reason = _core.arm_plane(irb120)
    assert reason == ""
    assert plane.elbow == pytest.approx([0, 0.27], abs=1e-9)
    assert plane.waist_axis == pytest.approx([0, 1, 0], abs=1e-9)
    assert plane.X_RE(0.0)[:3, 3] == pytest.approx([0, 0, 0.29], abs=1e-9)


def test_a_scene_names_what_moves_and_what_stands(robot):
    table = _core.Body(name="table", shapes=[_core.Shape(geometry=_core.Box([1, 1, 0.1]))])
    cell = _core.Cell(
        name="test",
        robot=robot,
        fixtures=[table],
        start=_core.Configuration(q=robot.home, opening=0.1),
    )
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    scene = _core.describe_scene(checker)
    assert [mover.depth for mover in scene.movers][:4] == [0, 1, 2, 3]
    assert sum(mover.finger for mover in scene.movers) == 2
    (obstacle,) = scene.obstacles
    assert obstacle.name == "table"
    assert obstacle.checked == [False] + [True] * (len(scene.movers) - 1)
    assert np.abs(obstacle.hulls[0].points).max(axis=0) == pytest.approx([0.5, 0.5, 0.05])
    assert len(obstacle.hulls[0].edges) == 12
    with pytest.raises(InvalidInput):
        _core.describe_scene(checker, _core.SceneOptions(patch_triangles=0))


def walled_cell(robot, height: float):
    """The arm among a wall that leads outwards from its waist, and a table."""
    wall = np.eye(4)
    c, s = math.cos(-1.0), math.sin(-1.0)
    wall[:3, :3] = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
    wall[:3, 3] = [0.97 * c, 0.97 * s, 0.5 * height]
    body = _core.Body(name="wall", shapes=[_core.Shape(_core.Box([1.5, 0.1, height]))], X_WB=wall)
    start = _core.Configuration(robot.home, 0.1)
    return _core.Cell(name="walled", robot=robot, fixtures=[body], start=start)


def test_a_wall_that_the_arm_cannot_pass_is_told(robot) -> None:
    start = _core.Configuration([-1.5, 2.0, -2.6, 0.0, 0.0, 0.0], 0.1)
    goal = _core.Configuration([2.2, 2.0, -2.6, 0.0, 0.0, 0.0], 0.1)
    answers = []
    for height in (2.6, 0.3):
        cell = walled_cell(robot, height)
        checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
        assert checker.is_free(start) and checker.is_free(goal)
        answers.append(_core.prove_apart(checker, start, [goal]))
    assert answers[0] and answers[0].apart and answers[0].goal_apart == [True]
    assert "goal 0 is walled off" in answers[0].reason and "wall" in answers[0].reason
    assert not answers[1] and answers[1].goal_apart == [False]
    with pytest.raises(InvalidInput):
        _core.prove_apart(checker, start, [])
    with pytest.raises(TypeError):
        _core.SeparationOptions(cells=3)


def test_a_cell_of_the_lattice_in_a_wall_is_blocked(robot) -> None:
    cell = walled_cell(robot, 2.6)
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)
    blocked = _core.BlockedCells(checker, 0.1)
    inside = [blocked.lattice.index_of(1, j, angle) for j, angle in enumerate((0.5, 0.0, 0.0))]
    proof = blocked.prove(1, inside)
    assert proof and (proof.mover, proof.other) == ("link2", "wall")
    with pytest.raises(InvalidInput):
        blocked.prove(1, [0, 0, -1])
