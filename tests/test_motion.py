"""Motion from Python: the Puma over a wall, timed within its limits; and the border."""

from __future__ import annotations

import itertools
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


@pytest.fixture(scope="module")
def robot():
    from handey.robot_file import load_robot

    return load_robot(MODELS / "robots/puma560/robot.yaml")[0]


@pytest.fixture(scope="module")
def checker(robot):
    """The Puma before a wall 0.8 m high that the stretched arm must be lifted over."""
    wall = _core.Body(
        name="wall",
        shapes=[_core.Shape(geometry=_core.Box([0.5, 0.02, 0.8]))],
        X_WB=at(0.75, 0, 0.4),
    )
    start = _core.Configuration(q=robot.home, opening=0.1)
    cell = _core.Cell(name="wall", robot=robot, start=start, fixtures=[wall], parts=[])
    return _core.CollisionChecker(_core.make_collision_model(cell), cell)


def stretched(joint1: float, opening: float = 0.1):
    return _core.Configuration(q=[joint1, 0, -1.5708, 0, 0, 0], opening=opening)


def rows(path) -> np.ndarray:
    return np.array([np.append(c.q, c.opening) for c in path])


def velocity_limits(robot) -> np.ndarray:
    arm = [joint.limit.velocity for joint in robot.joints]
    return np.array([*arm, 2 * min(finger.velocity for finger in robot.gripper.fingers)])


def test_lifts_the_arm_over_a_wall(checker):
    result = _core.plan_gross_motion(checker, stretched(0.9), [stretched(-1.2), stretched(-0.9)])
    assert result.found and result
    assert result.status == _core.MotionStatus.Found
    assert (result.planner, result.goal) == ("slices", 1)
    path = rows(result.path)
    assert np.array_equal(path[0], rows([stretched(0.9)])[0])
    assert np.array_equal(path[-1], rows([stretched(-0.9)])[0])
    assert _core.certify_path(checker, result.path).is_free
    for a, b in itertools.pairwise(path):
        for share in np.linspace(0, 1, 300):
            row = a + share * (b - a)
            assert checker.is_free(_core.Configuration(q=row[:-1], opening=row[-1]), 5e-5)


def test_the_same_seed_gives_the_same_path_and_another_another(checker):
    def plan(seed: int) -> np.ndarray:
        options = _core.SamplingOptions(seed=seed)
        return rows(
            _core.plan_by_sampling(checker, stretched(0.9), [stretched(-0.9)], options).path
        )

    first, other = plan(3), plan(4)
    assert np.array_equal(first, plan(3))
    assert not np.array_equal(first, other)


def test_shortening_keeps_the_ends_and_saves_time(checker, robot):
    options = _core.SamplingOptions(seed=1, range=0.2)
    found = _core.plan_by_sampling(checker, stretched(0.9), [stretched(-0.9)], options)
    short = _core.shorten_path(checker, found.path)
    assert np.array_equal(rows(short)[[0, -1]], rows(found.path)[[0, -1]])
    assert _core.travel_time(robot, short) < _core.travel_time(robot, found.path)
    assert _core.certify_path(checker, short).is_free


def test_a_shortened_path_keeps_the_clearance_asked_for(checker):
    way = [stretched(0.9), stretched(1.4), stretched(0.9), stretched(1.2)]
    shorter = _core.shorten_path(checker, way, _core.ShortcutOptions(clearance=0.01))
    assert np.array_equal(rows(shorter), rows([way[0], way[-1]]))
    assert checker.closest(shorter[0]).distance > 0.01
    with pytest.raises(InvalidInput, match="clearance"):
        _core.shorten_path(checker, way, _core.ShortcutOptions(clearance=-0.01))


def test_a_blocked_start_and_blocked_goals_are_told_by_name(checker):
    start = _core.plan_gross_motion(checker, stretched(0.2), [stretched(-0.9)])
    assert start.status == _core.MotionStatus.StartBlocked and not start
    assert "wall" in start.reason
    goals = _core.plan_gross_motion(checker, stretched(0.9), [stretched(0.2)])
    assert goals.status == _core.MotionStatus.GoalsBlocked
    assert "wall" in goals.reason and goals.goal == -1 and goals.path == []


def test_timing_keeps_to_the_limits_and_to_the_path(checker, robot):
    corners = [stretched(0.9, 0.1), stretched(0.2, 0.1), stretched(0.2, 0.02), stretched(0.5, 0.06)]
    timed = _core.time_path(robot, corners, _core.TimingOptions(interval=0.01))
    assert timed.time[0] == 0 and timed.time[-1] == timed.duration
    assert timed.positions.shape == (len(timed), 6) and timed.opening.shape == (len(timed),)
    assert (np.diff(timed.time) > 0).all()
    driven = np.column_stack([timed.positions, timed.opening])
    speed = np.abs(np.diff(driven, axis=0)) / np.diff(timed.time)[:, None]
    assert (speed <= velocity_limits(robot) * (1 + 1e-9)).all()
    assert (speed.max(axis=0) > 0.5 * velocity_limits(robot))[[0, 6]].all()
    for corner in rows(corners):
        assert (driven == corner).all(axis=1).any()
    assert timed.duration > _core.travel_time(robot, corners)
    slow = _core.time_path(robot, corners, _core.TimingOptions(speed_scale=0.1))
    assert slow.duration > 2 * timed.duration


def test_a_path_that_stays_is_one_row(robot):
    timed = _core.time_path(robot, [stretched(0.9), stretched(0.9)])
    assert timed.time.tolist() == [0.0] and timed.duration == 0.0


def test_arrays_are_copies(robot):
    timed = _core.time_path(robot, [stretched(0.9), stretched(0.2)])
    timed.positions[:] = 0
    assert timed.positions[0, 0] == 0.9


def test_wrong_numbers_are_named(checker, robot):
    with pytest.raises(InvalidInput, match="path: no waypoint"):
        _core.time_path(robot, [])
    with pytest.raises(InvalidInput, match=r"path\[1\].*joint1"):
        _core.time_path(robot, [stretched(0.9), stretched(3.0)])
    with pytest.raises(InvalidInput, match="interval"):
        _core.time_path(robot, [stretched(0.9)], _core.TimingOptions(interval=0))
    with pytest.raises(InvalidInput, match=r"goals\[0\].*opening"):
        _core.plan_gross_motion(checker, stretched(0.9), [stretched(0.9, 0.05)])
    with pytest.raises(InvalidInput, match="range"):
        options = _core.GrossOptions(sampling=_core.SamplingOptions(range=float("nan")))
        _core.plan_gross_motion(checker, stretched(0.9), [stretched(-0.9)], options)
    with pytest.raises(ValueError):
        _core.shorten_path(checker, [])


def test_wrong_types_and_unknown_options_are_type_errors(checker, robot):
    with pytest.raises(TypeError):
        _core.SamplingOptions(sed=1)
    with pytest.raises(TypeError):
        _core.SamplingOptions(seed=-1)
    with pytest.raises(TypeError):
        _core.TimingOptions(interval="0.01")
    with pytest.raises(TypeError):
        _core.time_path(robot, [[0, 0, 0, 0, 0, 0]])
    with pytest.raises(TypeError):
        _core.plan_gross_motion(checker, stretched(0.9), stretched(-0.9))


def test_options_nest_and_can_be_changed():
    options = _core.GrossOptions(sampling=_core.SamplingOptions(max_iterations=7))
    options.shortcut.attempts = 3
    options.sampling.certificate.clearance = 1e-3
    assert options.sampling.max_iterations == 7
    assert options.shortcut.attempts == 3
    assert options.shortcut.clearance == 0.005
    assert options.sampling.certificate.clearance == 1e-3
