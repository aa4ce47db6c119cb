"""Grasp planning from Python: Figure 4 as a cell, legal grasps tested again, bad inputs."""

from __future__ import annotations

import inspect
from pathlib import Path

import numpy as np
import pytest

from handey import _core
from handey.errors import InvalidInput
from handey.robot_file import load_robot

PUMA = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560" / "robot.yaml"


def at(x: float, y: float, z: float, yaw: float = 0.0) -> np.ndarray:
    pose = np.eye(4)
    pose[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    pose[:3, 3] = x, y, z
    return pose


def box(name: str, size: list[float], pose: np.ndarray) -> _core.Body:
    return _core.Body(name=name, shapes=[_core.Shape(_core.Box(size))], X_WB=pose)


GOAL = at(0.475, -0.24, 0.025)


@pytest.fixture(scope="module")
def cell() -> _core.Cell:
    """Walls stand before the block's wide faces at the destination, not at the origin."""
    robot, _ = load_robot(PUMA)
    return _core.Cell(
        robot=robot,
        start=_core.Configuration(robot.home, robot.gripper.max_opening),
        fixtures=[
            box("table", [1.6, 1.4, 0.05], at(0.55, 0.0, -0.025)),
            box("left", [0.02, 0.10, 0.10], at(0.438, -0.24, 0.05)),
            box("right", [0.02, 0.10, 0.10], at(0.512, -0.24, 0.05)),
        ],
        parts=[box("block", [0.044, 0.06, 0.05], at(0.50, 0.22, 0.025))],
    )


@pytest.fixture(scope="module")
def model(cell) -> _core.CollisionModel:
    return _core.make_collision_model(cell)


@pytest.fixture(scope="module")
def scene(model, cell) -> _core.GraspScene:
    return _core.GraspScene(model=model, cell=cell, part=0, X_WP_goal=GOAL)


def test_the_destination_decides_the_ranking(cell):
    naive = _core.rank_grasps(cell, 0, GOAL, _core.RankingOptions(use_destination=False))
    ranking = _core.rank_grasps(cell, 0, GOAL)
    assert naive.ranked[0].pair.width == pytest.approx(0.044)
    assert ranking.ranked[0].pair.width == pytest.approx(0.06)
    blocked = [pair for pair in ranking.obstructed if abs(pair.pair.width - 0.044) < 1e-9]
    assert blocked and "left (destination)" in blocked[0].obstructing
    assert blocked[0].share < 0.02 < 0.9 < blocked[0].share_at_origin


def test_features_found_before_give_the_same_ranking(cell):
    features = _core.find_feature_pairs(cell.parts[0], cell.robot.gripper)
    # Largest overlap first: 60 x 50, 44 x 60, 44 x 50 mm2.
    assert [pair.width for pair in features.pairs[:3]] == pytest.approx([0.044, 0.05, 0.06])
    again = _core.rank_grasps(cell, 0, GOAL, features=features)
    ranking = _core.rank_grasps(cell, 0, GOAL)
    assert [pair.share for pair in again.ranked] == [pair.share for pair in ranking.ranked]


def test_bodies_at_the_destination_are_pulled_back(cell):
    for near in _core.nearby_bodies(cell, 0, GOAL):
        X_WP = GOAL if near.at_destination else cell.parts[0].X_WB
        assert np.allclose(X_WP @ near.X_PB, cell.fixtures[near.body.index].X_WB)


def test_targets_lie_in_the_unobstructed_area(cell):
    options = _core.RankingOptions(pairs=_core.PairChoice.TwoFaces)
    for pair in _core.rank_grasps(cell, 0, GOAL, options).ranked:
        assert 2 <= len(pair.targets) <= 5
        assert all(pair.unobstructed.contains(target) for target in pair.targets)
        assert pair.share == pytest.approx(pair.unobstructed.area / pair.pair.area)


def test_legal_grasps_are_legal_at_both_ends(cell, model, scene):
    solver = _core.SphericalWristSolver(cell.robot)
    pair = _core.rank_grasps(cell, 0, GOAL).ranked[0]
    legal = _core.find_legal_grasps(scene, solver, pair)
    assert legal.poses, legal.worst_reason
    for pose in legal.poses:
        assert np.allclose(
            pose.X_PH, pair.pair.X_PG @ _core.hand_in_plane(pose.in_plane, pose.flipped)
        )
        for X_WP, configurations in ((cell.parts[0].X_WB, pose.q_pick), (GOAL, pose.q_place)):
            there = cell.with_part_at(0, X_WP)
            checker = _core.CollisionChecker(model, there)
            for q in configurations:
                assert np.allclose(_core.hand_in_world(there, q), X_WP @ pose.X_PH, atol=1e-7)
                assert checker.is_free(_core.Configuration(q, pose.opening), 3e-4)
        again = _core.test_grasp_pose(scene, solver, pair, pose.in_plane, pose.flipped)
        assert len(again.poses) == 1


def test_a_grasp_out_of_reach_says_so(cell, model):
    far = _core.GraspScene(model=model, cell=cell, part=0, X_WP_goal=at(2.0, 0.0, 0.025))
    pair = _core.rank_grasps(cell, 0, far.X_WP_goal).ranked[0]
    legal = _core.find_legal_grasps(far, _core.SphericalWristSolver(cell.robot), pair)
    assert not legal.poses
    assert legal.unreachable_at_destination > 0
    assert "(destination)" in legal.worst_reason


def _poses(search: _core.LegalGraspSearch) -> set[tuple[float, float, float, bool, int, int]]:
    found = []
    while not search.is_done:
        found += search.next(200)
    return {
        (p.in_plane.x, p.in_plane.y, p.in_plane.theta, p.flipped, len(p.q_pick), len(p.q_place))
        for p in found
    }


def test_a_search_without_the_blocked_poses_finds_the_same(cell, scene):
    solver = _core.SphericalWristSolver(cell.robot)
    options = _core.LegalityOptions(
        directions=24, spacing=0.008, least_contact_share=0.1, most_poses=10000, spread=True
    )
    blocked = _core.BlockedPoses(scene)
    legal = 0
    for pair in _core.rank_grasps(cell, 0, GOAL).ranked[:4]:
        pruned = _core.LegalGraspSearch(scene, solver, pair, options, blocked)
        poses = _poses(pruned)
        assert poses == _poses(_core.LegalGraspSearch(scene, solver, pair, options))
        told = pruned.result()
        assert sum(fallen.count for fallen in told.fallen) + len(told.poses) == told.tried
        legal += len(poses)
    assert legal > 20


def test_a_block_names_the_end_and_the_bodies(cell, scene):
    blocked = _core.BlockedPoses(scene)
    solver = _core.SphericalWristSolver(cell.robot)
    named = set()
    for pair in _core.rank_grasps(cell, 0, GOAL).ranked:
        for turn in np.arange(0.0, 2 * np.pi, np.pi / 8):
            pose = _core.PlanarPose(0.0, 0.0, turn)
            found = blocked.find(pair, pose, False, shift=0.004, half_turn=0.04)
            if found is None:
                continue
            named.add((found.end, found.body))
            assert not _core.test_grasp_pose(scene, solver, pair, pose, False).poses
    assert (_core.GraspEnd.Origin, "table") in named
    assert {end for end, _ in named} == {_core.GraspEnd.Origin, _core.GraspEnd.Destination}
    with pytest.raises(InvalidInput, match="shift"):
        blocked.find(pair, pose, False, shift=float("nan"))


def test_unknown_options_and_wrong_types_are_type_errors(cell):
    with pytest.raises(TypeError):
        _core.RankingOptions(clearence=0.1)
    with pytest.raises(TypeError):
        _core.LegalityOptions(12)
    with pytest.raises(TypeError):
        _core.PlanarPose("0", 0.0, 0.0)
    with pytest.raises(TypeError):
        _core.rank_grasps(cell, 0, np.eye(4).astype(str))
    with pytest.raises(TypeError):
        _core.GraspScene(model=None, cell=cell, part=0, X_WP_goal=GOAL)


def test_wrong_numbers_are_invalid_input(cell):
    with pytest.raises(InvalidInput):
        _core.rank_grasps(cell, 1, GOAL)
    with pytest.raises(InvalidInput):
        _core.rank_grasps(cell, 0, np.full((4, 4), np.nan))
    with pytest.raises(InvalidInput):
        _core.rank_grasps(cell, 0, GOAL, _core.RankingOptions(least_share=2.0))
    with pytest.raises(InvalidInput):
        _core.PlanarPose(float("nan"), 0.0, 0.0)


def test_every_function_has_a_docstring():
    for name in ("find_feature_pairs", "nearby_bodies", "rank_grasps", "find_legal_grasps"):
        text = inspect.getdoc(getattr(_core, name))
        assert "Args:" in text and "Returns:" in text and "Raises:" in text
