"""What carries a part, by hand: boxes, tilts, balls, gaps."""

from __future__ import annotations

import numpy as np
import pytest

from handey import placement
from handey.formats.pose import pose_from_xyz_rpy
from handey.placement import CONTACT_GAP, contact_points, convex_hull, distance_outside, least_width

trimesh = pytest.importorskip("trimesh")


def surfaces(mesh, up: bool, xyz=(0, 0, 0), rpy=(0, 0, 0)) -> np.ndarray:
    moved = mesh.copy()
    moved.apply_transform(pose_from_xyz_rpy(np.array(xyz), np.array(rpy)))
    return placement._facing(np.array(moved.triangles), up)


TABLE = surfaces(trimesh.creation.box((1, 1, 0.05)), True, (0, 0, -0.025))
BOX = trimesh.creation.box((0.04, 0.06, 0.03))


def hull_of(downward: np.ndarray, upward: np.ndarray = TABLE) -> np.ndarray:
    return convex_hull(contact_points(downward, upward))


def test_a_box_stands_on_its_whole_face():
    hull = hull_of(surfaces(BOX, False, (0.1, 0, 0.015)))
    assert sorted(map(tuple, np.round(hull, 9))) == [
        (0.08, -0.03),
        (0.08, 0.03),
        (0.12, -0.03),
        (0.12, 0.03),
    ]
    assert least_width(hull) == pytest.approx(0.04)
    assert distance_outside(hull, np.array([0.1, 0])) == pytest.approx(-0.02)
    assert distance_outside(hull, np.array([0.13, 0])) == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("gap", "touches"), [(5.9e-4, True), (6.1e-4, False), (-5e-4, True), (-7e-4, False)]
)
def test_contact_ends_at_the_gap_of_the_format(gap, touches):
    points = contact_points(surfaces(BOX, False, (0, 0, 0.015 + gap)), TABLE)
    assert (len(points) > 0) == touches


def test_a_tilted_box_stands_on_the_strip_that_is_near():
    tilt = 0.02
    tilted = surfaces(BOX, False, (0, 0, 0.03 * np.sin(tilt) + 0.015 * np.cos(tilt)), (tilt, 0, 0))
    hull = hull_of(tilted)
    assert np.ptp(hull[:, 1]) == pytest.approx(CONTACT_GAP / np.tan(tilt), rel=1e-6)
    assert np.ptp(hull[:, 0]) == pytest.approx(0.04)


def test_a_wedge_on_its_edge_has_no_region_to_stand_on():
    turned = surfaces(BOX, False, (0, 0, (0.015 + 0.03) * np.sqrt(0.5)), (np.pi / 4, 0, 0))
    assert least_width(hull_of(turned)) == pytest.approx(2 * CONTACT_GAP, rel=1e-6)


def test_a_ball_stands_on_its_cap():
    ball = trimesh.creation.icosphere(6, 0.05)
    hull = hull_of(surfaces(ball, False, (0, 0, 0.05)))
    radius = np.sqrt(0.05**2 - (0.05 - CONTACT_GAP) ** 2)
    assert least_width(hull) == pytest.approx(2 * radius, rel=0.01)


def test_fine_meshes_give_the_region_of_coarse_ones():
    fine, coarse = BOX, hull_of(surfaces(BOX, False, (0.1, 0.2, 0.015), (0, 0, 0.7)))
    for _ in range(4):
        fine = fine.subdivide()
    table = trimesh.creation.box((1, 1, 0.05)).subdivide().subdivide().subdivide()
    ground = surfaces(table, True, (0, 0, -0.025))
    hull = hull_of(surfaces(fine, False, (0.1, 0.2, 0.015), (0, 0, 0.7)), ground)
    assert least_width(hull) == pytest.approx(least_width(coarse), abs=1e-8)
    for angle in np.linspace(0, 2 * np.pi, 50):
        direction = np.array([np.cos(angle), np.sin(angle)])
        assert (hull @ direction).max() == pytest.approx((coarse @ direction).max(), abs=1e-8)


def test_a_box_over_the_edge_stands_on_what_is_below_it():
    hull = hull_of(surfaces(BOX, False, (0.5, 0, 0.015)))
    assert hull[:, 0].max() == pytest.approx(0.5)
    assert distance_outside(hull, np.array([0.5, 0])) == pytest.approx(0, abs=1e-9)
    assert distance_outside(hull, np.array([0.505, 0])) == pytest.approx(0.005)


def test_two_rails_carry_what_lies_across_them():
    rail = trimesh.creation.box((0.01, 0.1, 0.02))
    rails = [surfaces(rail, True, (x, 0, -0.01)) for x in (-0.015, 0.015)]
    points = [contact_points(surfaces(BOX, False, (0, 0, 0.015)), ground) for ground in rails]
    hull = convex_hull(np.concatenate(points))
    assert distance_outside(hull, np.zeros(2)) < 0
    assert distance_outside(convex_hull(points[0]), np.zeros(2)) == pytest.approx(0.01)


def test_hulls_agree_with_another_library():
    scipy = pytest.importorskip("scipy.spatial")
    random = np.random.default_rng(5)
    for _ in range(20):
        points = random.normal(size=(40, 2)).round(6)
        ours, theirs = convex_hull(points), points[scipy.ConvexHull(points).vertices]
        assert {tuple(p) for p in ours} == {tuple(p) for p in theirs}
