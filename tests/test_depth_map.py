"""Depth maps as obstacles: the fixture that planning sees against the solid that the check sees."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hand_made import write_cell

import handey
from handey.check.camera import explained_pixels
from handey.check.cell_reader import read_cell
from handey.errors import InvalidInput
from handey.formats.pose import pose_from_xyz_rpy

_core = pytest.importorskip("handey._core")

MODELS = Path(__file__).resolve().parents[1] / "models"
LENS = {"fx": 100.0, "fy": 100.0, "cx": 40.0, "cy": 30.0}
DOWN = {"xyz": [0.5, 0.0, 1.0], "rpy": [np.pi, 0, 0]}
X_WC = pose_from_xyz_rpy(DOWN["xyz"], DOWN["rpy"])


def heap(folder: Path, heights, cell=0.01, at=(0.4, -0.05, 0.0)) -> dict:
    """A `depth_maps` entry of heights, whose file is written."""
    np.save(folder / "heap.npy", np.asarray(heights, dtype=float))
    return {"heights": "heap.npy", "cell": cell, "pose": {"xyz": list(at)}}


def camera(folder: Path, depths, **changes) -> dict:
    """A `depth_maps` entry of depths, seen from 1 m above the table."""
    np.save(folder / "depth.npy", np.asarray(depths, dtype=float))
    return {"depth": "depth.npy", "intrinsics": LENS, "pose": DOWN, "far": 0.15, **changes}


def holds(body: _core.Body, points: np.ndarray, slack: float = 1e-9) -> np.ndarray:
    """Which points (n, 3) of the body's frame lie in one of its convex shapes?"""
    found = np.zeros(len(points), dtype=bool)
    for shape in body.shapes:
        mesh = _core.tessellate(shape)
        corners = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        offsets = np.sum(normals * corners[:, 0], axis=1)
        found |= np.all(points @ normals.T <= offsets + slack, axis=1)
    return found


def rough_depths(random: np.random.Generator) -> np.ndarray:
    """A table seen from 1 m above with noise, things on it, and holes."""
    depths = 1.0 + 0.012 * random.uniform(-1, 1, (60, 80))
    for _ in range(8):
        v, u = random.integers(0, 50, 2)
        depths[v : v + 12, u : u + 12] -= random.uniform(0.02, 0.15)
    depths[random.uniform(size=depths.shape) < 0.05] = np.nan
    return depths


def planned_and_checked(path: Path, name: str):
    """A depth map as the planner has it, and as the check has it."""
    fixtures = handey.load_cell(path).cell.fixtures
    planned = next(body for body in fixtures if body.name == name)
    return planned, next(body for body in read_cell(path).fixtures if body.name == name)


@pytest.mark.parametrize("seed", range(5))
def test_the_check_explains_the_same_pixels_by_its_own_code(seed, tmp_path):
    random = np.random.default_rng(seed)

    def somewhere():
        x, y = random.uniform((0.3, 0.1), (0.7, 0.25)).tolist()
        return {"xyz": [x, y, 0.05], "rpy": random.uniform(-3, 3, 3).tolist()}

    block = str(MODELS / "parts" / "l_block.stl")
    fixtures = {
        "stand": {"cylinder": {"radius": 0.05, "length": 0.08}, "pose": somewhere()},
        "ball": {"sphere": {"radius": 0.06}, "pose": somewhere()},
        "thing": {"mesh": block, "scale": 0.001, "pose": somewhere()},
    }
    parts = {"block": {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.5, -0.2, 0.025]}}}
    low = {"start": [0.3, 0.9, -2.9, 0.0, -1.0, 0.0]}  # the arm hangs into the picture
    path = write_cell(tmp_path, fixtures=fixtures, parts=parts, robot=low, task=[])
    depths = rough_depths(random)
    image = _core.DepthImage(depths, **LENS, X_WD=X_WC, explained=0.02, far=0.15)
    ours = _core.explained_pixels(image, handey.load_cell(path).cell)
    v, u = np.nonzero(np.isfinite(depths))
    z = depths[v, u]
    rays = np.c_[(u - LENS["cx"]) / LENS["fx"], (v - LENS["cy"]) / LENS["fy"], np.ones_like(z)]
    points = rays * z[:, None] @ X_WC[:3, :3].T + X_WC[:3, 3]
    known = read_cell(path)
    theirs, surely = (explained_pixels(points, known, limit) for limit in (0.02, 0.02 - 1e-6))
    assert 100 < ours.sum() < len(z) - 100
    assert not ours[~np.isfinite(depths)].any()
    assert np.all(ours[v, u] <= theirs), "the check would see an obstacle that planning does not"
    assert np.all(ours[v, u] >= surely)


@pytest.mark.parametrize("seed", range(4))
def test_planning_sees_all_that_the_check_sees(seed, tmp_path):
    random = np.random.default_rng(10 + seed)
    parts = {
        "block": {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.5, -0.45, 0.025]}},
        "bystander": {"box": [0.04, 0.04, 0.04], "pose": {"xyz": [0.3, 0.45, 0.02]}},
    }
    heights = 0.08 * random.uniform(0, 1, (12, 12)).round(1)
    heights[3:5, 6:9] = np.nan
    maps = {
        "camera": camera(tmp_path, rough_depths(random), explained=0.013),
        "heap": heap(tmp_path, heights),
    }
    path = write_cell(tmp_path, parts=parts, depth_maps=maps, task=[])
    for name in maps:
        planned, checked = planned_and_checked(path, name)
        surface = checked.shapes[0]
        low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
        points = random.uniform(low - 0.01, high + 0.01, (20_000, 3))
        exact, ours = surface.inside(points), holds(planned, points)
        assert exact.sum() > 300
        within_reach = np.linalg.norm(points @ planned.X_WB[:3, :3].T + planned.X_WB[:3, 3], axis=1)
        assert np.all(ours[exact & (within_reach < 1.0)])


def test_a_part_beside_what_was_measured_is_not_refused_for_what_stands_out(tmp_path):
    # A rough wall 0.3 mm from the block, and the same wall 1 mm into it.
    random = np.random.default_rng(1)
    heights = 0.1 + 0.03 * random.uniform(0, 1, (20, 20))
    block = {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.5, 0.15, 0.025]}}
    goal = [{"place": "block", "at": {"xyz": [0.50, -0.25, 0.025]}}]
    for gap, fine in ((3e-4, True), (-1e-3, False)):
        wall = heap(tmp_path, heights, 0.005, at=(0.45, 0.15 - 0.02 - gap - 0.0975, 0.0))
        path = write_cell(tmp_path, parts={"block": block}, depth_maps={"wall": wall}, task=goal)
        if fine:
            assert handey.load_cell(path).warnings == ()
        else:
            with pytest.raises(InvalidInput, match="'wall' and 'block' overlap at the start by 1"):
                handey.load_cell(path)


def test_a_part_is_taken_from_a_measured_plateau_and_put_on_another(tmp_path):
    # No table is known there: the block stands on heights alone.
    heights = np.full((90, 30), 0.02)
    heights[40:50, 10:20] = 0.09
    plateau = heap(tmp_path, heights, 0.005, at=(0.43, -0.22, 0.0))
    block = {"box": [0.06, 0.04, 0.05], "pose": {"xyz": [0.50, 0.15, 0.045]}}
    goal = [{"place": "block", "at": {"xyz": [0.50, -0.15, 0.045]}}]
    path = write_cell(tmp_path, parts={"block": block}, depth_maps={"plateau": plateau}, task=goal)
    loaded = handey.load_cell(path)
    assert loaded.warnings == ()
    result = handey.plan(loaded)
    assert result.plan is not None, result.report.reasons
    assert handey.check(path, result.plan).ok


def test_a_depth_map_in_the_way_is_named_in_the_reasons(tmp_path):
    # A wall all round the block, higher than the fingers are long and too near for them.
    heights = np.full((24, 24), 0.3)
    heights[8:16, 6:18] = 0.0
    wall = heap(tmp_path, heights, 0.006, at=(0.5 - 0.069, 0.15 - 0.069, 0.0))
    path = write_cell(tmp_path, depth_maps={"wall": wall})
    result = handey.plan(handey.load_cell(path))
    assert result.plan is None
    assert any("wall" in reason for reason in result.report.reasons)


def test_what_stands_out_keeps_clear_of_the_robot_at_its_start(tmp_path):
    # Rough stuff comes up to 3 mm below the fingers.
    low = {"start": [0.0, 0.7854, -3.1416, 0.0, -0.7854, 0.0]}
    plain = handey.load_cell(write_cell(tmp_path, task=[], robot=low)).cell
    pose = _core.body_poses(plain.robot, plain.start)[-1]
    shapes = plain.robot.bodies[-1].shapes
    corners = np.vstack([np.asarray(_core.tessellate(shape).vertices) for shape in shapes])
    world = corners @ pose[:3, :3].T + pose[:3, 3]
    tip = world[np.argmin(world[:, 2])]
    heights = tip[2] - 0.003 - 0.03 * np.random.default_rng(4).uniform(0, 1, (60, 60))
    at = (float(tip[0]) - 0.15, float(tip[1]) - 0.15, 0.0)
    stuff = heap(tmp_path, heights, 0.005, at=at)
    loaded = handey.load_cell(write_cell(tmp_path, task=[], robot=low, depth_maps={"stuff": stuff}))
    checker = _core.CollisionChecker(_core.make_collision_model(loaded.cell), loaded.cell)
    assert checker.is_free(loaded.cell.start, 1e-3)
    assert not checker.is_free(loaded.cell.start, 4e-3)


def test_what_is_explained_altogether_is_no_obstacle(tmp_path):
    seen = camera(tmp_path, np.full((60, 80), 1.0), explained=0.06)
    path = write_cell(tmp_path, depth_maps={"camera": seen})
    assert "camera" not in {fixture.name for fixture in handey.load_cell(path).cell.fixtures}
    assert "camera" not in {body.name for body in read_cell(path).fixtures}
    nothing = heap(tmp_path, np.zeros((5, 5)))
    path = write_cell(tmp_path, depth_maps={"heap": nothing})
    assert "heap" not in {fixture.name for fixture in handey.load_cell(path).cell.fixtures}
    assert "heap" not in {body.name for body in read_cell(path).fixtures}


def test_one_depth_map_explains_nothing_of_another(tmp_path):
    # The scanner saw the same block as the camera.
    maps = {
        "heap": heap(tmp_path, np.full((10, 10), 0.1), at=(0.55, -0.045, 0.0)),
        "camera": camera(tmp_path, np.where(np.arange(80) > 45, 0.9, 1.0) * np.ones((60, 1))),
    }
    planned, checked = planned_and_checked(write_cell(tmp_path, depth_maps=maps), "camera")
    behind = np.array([[0.09, 0.0, 0.92], [0.12, 0.01, 0.95]])  # in the camera's frame
    assert holds(planned, behind).all() and checked.shapes[0].inside(behind).all()


def test_nothing_measured_at_all_is_refused_by_both(tmp_path):
    blind = camera(tmp_path, np.zeros((60, 80)))
    path = write_cell(tmp_path, depth_maps={"camera": blind})
    for read in (handey.load_cell, read_cell):
        with pytest.raises(InvalidInput) as caught:
            read(path)
        assert [fault.code for fault in caught.value.faults] == ["E_IMAGE"]


def test_the_page_shows_a_coarse_picture_of_a_depth_map(tmp_path):
    from handey.view import write_page

    seen = camera(tmp_path, rough_depths(np.random.default_rng(2)), explained=0.013)
    path = write_cell(tmp_path, depth_maps={"camera": seen})
    write_page(path, None, tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    assert '"name":"camera"' in page
    solid = next(body for body in read_cell(path).fixtures if body.name == "camera").shapes[0]
    picture = solid.picture
    assert np.all(np.abs(picture.vertices.min(axis=0) - solid.vertices.min(axis=0)) < 0.05)
    assert np.all(np.abs(picture.vertices.max(axis=0) - solid.vertices.max(axis=0)) < 0.05)


def test_a_picture_stands_where_the_heights_do(tmp_path):
    heights = np.zeros((200, 300))
    heights[40:80, 100:140] = 0.1
    path = write_cell(tmp_path, depth_maps={"heap": heap(tmp_path, heights, 0.001)})
    solid = next(body for body in read_cell(path).fixtures if body.name == "heap").shapes[0]
    assert len(solid.picture.faces) < len(solid.faces) / 4
    assert np.allclose(solid.picture.vertices.min(axis=0), solid.vertices.min(axis=0), atol=0.004)
    assert np.allclose(solid.picture.vertices.max(axis=0), solid.vertices.max(axis=0), atol=0.004)
