"""What `handey inspect` tells of parts, against what is known of them."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from inspected import BOX, MM, PARTS, SHARED, box_corners, triangles, write_obj

from handey import _core
from handey.inspection import inspect_body, inspect_mesh
from handey.inspection.page import write_page
from handey.inspection.part_text import part_lines


def test_a_box_has_six_ways_to_stand_and_three_pairs_of_faces(tmp_path, robot):
    path = write_obj(tmp_path / "box.obj", box_corners(0.04, 0.06, 0.05), triangles(BOX))
    report = inspect_mesh(path, 1.0, robot)
    assert report.size == pytest.approx([0.04, 0.06, 0.05])
    assert report.volume == pytest.approx(0.04 * 0.06 * 0.05)
    assert report.centre == pytest.approx([0.02, 0.03, 0.025])
    assert report.closed and len(report.faces) == 6
    areas = sorted((face.area for face in report.faces), reverse=True)
    assert areas == pytest.approx([0.003, 0.003, 0.0024, 0.0024, 0.002, 0.002])
    widths = {round(p.width, 6): p.area for p in report.pairs if p.kind.name == "FaceFace"}
    assert widths == pytest.approx({0.04: 0.003, 0.05: 0.0024, 0.06: 0.002})
    assert len(report.rests) == 6
    assert sum(rest.probability for rest in report.rests) == pytest.approx(1.0)
    assert [r.probability for r in report.rests] == sorted(
        (r.probability for r in report.rests), reverse=True
    )
    for rest in report.rests:  # by hand: half the edge that it stands on, over the height
        assert rest.tip_angle == pytest.approx(math.atan2(rest.margin, rest.height))
    assert report.warnings == ()


def test_an_open_mesh_tells_where_it_is_open(tmp_path, robot):
    corners = box_corners(0.04, 0.06, 0.05)
    path = write_obj(tmp_path / "open.obj", corners, triangles([*BOX[:1], *BOX[2:]]))
    report = inspect_mesh(path, 1.0, robot)
    (hole,) = report.surfaces[0].holes
    assert not report.closed and report.volume is None and report.rests == ()
    assert (hole.edges, hole.length) == (4, pytest.approx(0.2))
    assert hole.centre == pytest.approx([0.02, 0.03, 0.05])
    assert {tuple(np.round(p, 6)) for p in hole.segments.reshape(-1, 3)} == set(corners[4:])
    told = "\n".join(part_lines(report))
    assert "NOT closed: 4 open edges" in told
    assert "4 open edges, 200.0 mm long, about (20.0, 30.0, 50.0) mm" in told
    assert told.count("the surface is not closed") == 2


def test_two_holes_are_two_and_the_longer_comes_first(tmp_path):
    faces = triangles([BOX[1], *BOX[2:]])[1:]  # without the bottom, and half of the top
    path = write_obj(tmp_path / "open.obj", box_corners(0.04, 0.06, 0.05), faces)
    surface = inspect_mesh(path).surfaces[0]
    assert [hole.edges for hole in surface.holes] == [4, 3]
    assert surface.open_edges == _core.inspect_surface(_core.load_mesh(path).mesh).open_edges == 7
    assert surface.holes[0].centre[2] == 0.0 and surface.holes[1].centre[2] == pytest.approx(0.05)


def test_an_edge_of_four_triangles_is_told(tmp_path):
    first = box_corners(0.04, 0.04, 0.04)
    second = [(x + 0.04, y + 0.04, z) for x, y, z in first]  # they share one edge
    quads = [*BOX, *[tuple(i + 8 for i in quad) for quad in BOX]]
    path = write_obj(tmp_path / "edge.obj", [*first, *second], triangles(quads))
    surface = inspect_mesh(path).surfaces[0]
    assert surface.closed and not surface.manifold
    assert surface.overfull == pytest.approx(np.array([[0.04, 0.04, 0.02]]))


@pytest.mark.parametrize(
    ("scale", "edge", "wanted"),
    [(1.0, 30.0, "0.001"), (1.0, 80.0, "0.001"), (MM, 0.03, "1"), (1e-6, 40.0, "0.001")],
)
def test_a_part_in_another_unit_is_told_with_the_scale_that_helps(tmp_path, scale, edge, wanted):
    path = write_obj(tmp_path / "box.obj", box_corners(edge, edge, edge), triangles(BOX))
    (warning,) = inspect_mesh(path, scale).warnings
    assert f"--scale {wanted} makes it" in warning
    assert inspect_mesh(path, float(wanted)).warnings == ()


def test_what_jaws_do_not_span_is_told_with_how_much_is_missing(robot):
    report = inspect_mesh(PARTS / "big_cube.stl", MM, robot)
    assert report.pairs == [] and len(report.rejected) == 9
    faces = report.rejected[:3]
    assert [str(pair)[:5] for pair in faces] == ["faces"] * 3
    assert [report.short(pair) for pair in faces] == pytest.approx([0.024] * 3)
    assert "faces 0/1: 120.0 mm wide, the jaws open 24.0 mm too little" in "\n".join(
        part_lines(report)
    )


def test_pairs_are_those_that_planning_looks_at(bracket, robot):
    mesh = _core.load_mesh(PARTS / "bracket.stl", scale=MM).mesh
    body = _core.Body(name="p", shapes=[_core.Shape(_core.MeshShape(mesh))])
    found = _core.find_feature_pairs(body, robot.gripper)
    assert [str(pair) for pair in bracket.pairs] == [str(pair) for pair in found.pairs]
    assert bracket.kinds() == {"two faces": 9, "parallel edges": 18}


def test_without_jaws_no_pair_is_told(tmp_path):
    report = inspect_mesh(PARTS / "bracket.stl", MM)
    assert report.features is None and report.as_dict()["jaws"] is None
    assert "--robot ROBOT.yaml" in "\n".join(part_lines(report))


def test_a_part_of_several_shapes_is_one_part(robot):
    half = _core.Box([0.04, 0.04, 0.02])
    X_up, X_down = np.eye(4), np.eye(4)
    X_up[2, 3], X_down[2, 3] = 0.01, -0.01
    body = _core.Body(name="two", shapes=[_core.Shape(half, X_up), _core.Shape(half, X_down)])
    report = inspect_body(body, robot)
    assert report.size == pytest.approx([0.04] * 3) and report.volume == pytest.approx(0.04**3)
    assert len(report.surfaces) == 2 and len(report.rests) == 6 and report.smaller_faces == 0
    assert {round(p.width, 6) for p in report.pairs if p.kind.name == "FaceFace"} == {0.04}


@pytest.mark.parametrize("path", sorted(PARTS.glob("*.stl")), ids=lambda path: path.stem)
def test_the_text_of_a_part_fits_a_screen(path, robot):
    report = inspect_mesh(path, MM, robot)
    lines = part_lines(report)
    assert len(lines) <= 40
    assert max(map(len, lines)) <= 80
    assert len(part_lines(report, verbose=True)) >= len(lines)
    assert sum(r.probability for r in report.rests) == pytest.approx(1.0)


@pytest.mark.skipif(not SHARED.is_dir(), reason="no shared parts")
@pytest.mark.parametrize("path", sorted(SHARED.glob("*.[so][tb][lj]")), ids=lambda path: path.name)
def test_real_parts_are_told(path, robot, tmp_path):
    report = inspect_mesh(path, MM, robot)
    summary = json.loads(json.dumps(report.as_dict(), allow_nan=False))
    report_closed = _core.load_mesh(path, scale=MM).surface.closed
    assert summary["closed"] == report_closed
    assert summary["closed"] == (summary["surfaces"][0]["open_edges"] == 0)
    if report.rests:
        assert sum(r["probability"] for r in summary["placements"]) == pytest.approx(1.0)
    write_page(report, tmp_path / "page.html")
