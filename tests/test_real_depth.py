"""Real depth images: a part is carried from before boxes that only a Kinect saw to behind them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from real_depth import CENTRE, FOCAL, TABLE, camera_pose, read_cloud, write_cell

import handey

pytest.importorskip("handey._core")

DATA = Path(__file__).resolve().parents[1] / ".." / "shared" / "data" / "depth"
CLOUDS = {"mosd_learn0": (170, 475, 90, 560), "mosd_learn18": (85, 475, 150, 535)}
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="the depth images are not there")


@needs_data
@pytest.mark.parametrize("name", CLOUDS)
def test_the_table_of_a_real_image_lies_on_the_plane_found(name):
    depth, labels = read_cloud(DATA / f"{name}.pcd")
    assert depth.shape == (480, 640)
    v, u = np.nonzero(np.isfinite(depth) & (labels == TABLE))
    z = depth[v, u]
    points = np.stack([(u - CENTRE[0]) / FOCAL * z, (v - CENTRE[1]) / FOCAL * z, z], axis=1)
    X_WC = camera_pose(depth, labels)
    heights = (points @ X_WC[:3, :3].T + X_WC[:3, 3])[:, 2]
    assert np.percentile(np.abs(heights), 99) < 0.006
    assert np.allclose(X_WC[:3, :3] @ X_WC[:3, :3].T, np.eye(3), atol=1e-9)
    assert 0.5 < X_WC[2, 3] < 0.7


@needs_data
@pytest.mark.parametrize("name", CLOUDS)
def test_a_part_is_carried_past_what_a_real_camera_saw(name, tmp_path):
    path = write_cell(DATA / f"{name}.pcd", tmp_path, crop=CLOUDS[name])
    cell = handey.load_cell(path)
    assert cell.warnings == ()
    kinect = cell.cell.fixtures[-1]
    assert kinect.name == "kinect" and 20 < len(kinect.shapes) < 400
    result = handey.plan(cell)
    assert result.plan is not None, result.report.reasons
    report = handey.check(path, result.plan)
    assert report.ok, str(report)


@needs_data
@pytest.mark.parametrize("goal", [(0.5, 0.3), (0.4, 0.35)])
def test_a_part_is_carried_past_all_of_an_image_that_was_not_cropped(goal, tmp_path):
    path = write_cell(DATA / "mosd_learn18.pcd", tmp_path, goal=goal, crop=(0, 480, 0, 640))
    result = handey.plan(handey.load_cell(path))
    assert result.plan is not None, result.report.reasons
    report = handey.check(path, result.plan)
    assert report.ok, str(report)
