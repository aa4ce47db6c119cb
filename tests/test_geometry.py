"""The geometry floor from Python: conversions are strict, arrays are copies, faults have codes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from handey import _core
from handey.errors import InvalidInput


def box(size=(0.1, 0.2, 0.3)):
    return _core.tessellate(_core.Shape(_core.Box(size)))


def code_of(call):
    with pytest.raises(InvalidInput) as caught:
        call()
    assert isinstance(caught.value, ValueError)
    return caught.value.faults[0].code


def test_a_pose_is_a_4x4_array_and_comes_back():
    pose = _core.pose_from_xyz_rpy([1, 2, 3], [0.1, 0.2, 0.3])
    assert pose.shape == (4, 4)
    again = _core.pose_from_xyz_quat(pose[:3, 3], _core.quaternion_xyzw(pose))
    np.testing.assert_allclose(again, pose, atol=1e-12)


def test_a_box_is_measured_and_has_six_faces():
    mesh = box()
    assert mesh.vertices.shape == (8, 3) and mesh.triangles.shape == (12, 3)
    report = _core.inspect_surface(mesh)
    assert report.closed and report.manifold and report.consistently_oriented
    assert report.volume == pytest.approx(0.006)
    faces = _core.planar_faces(mesh, least_area=0.025)
    assert [round(face.area, 6) for face in faces] == [0.06, 0.06, 0.03, 0.03]
    np.testing.assert_allclose(np.cross(faces[0].u, faces[0].v), faces[0].normal, atol=1e-12)
    assert _core.contains_point(mesh, [0, 0, 0.14])
    assert not _core.contains_point(mesh, [0, 0, 0.16])


def test_arrays_are_copies():
    mesh = box()
    mesh.vertices[0, 0] = 9.0
    assert mesh.vertices[0, 0] != 9.0
    vertices = mesh.vertices
    other = _core.TriangleMesh(vertices, mesh.triangles)
    vertices[:] = 0
    assert _core.inspect_surface(other).volume == pytest.approx(0.006)


def test_regions_have_holes():
    outer = [[0, 0], [1, 0], [1, 1], [0, 1]]
    inner = [[0.2, 0.2], [0.4, 0.2], [0.4, 0.4], [0.2, 0.4]]
    ring = _core.subtract(_core.Region([outer]), _core.Region([inner]))
    assert ring.area == pytest.approx(0.96)
    assert len(ring.loops) == 2
    assert not ring.contains([0.3, 0.3])
    assert _core.slab_projection(
        _core.Shape(_core.Cylinder(0.1, 0.2)), np.eye(4), -0.05, 0.05
    ).area == pytest.approx(np.pi * 0.01, rel=2e-3)


@pytest.mark.parametrize(
    "bad", [["a", "b", "c"], [True, False, True], [1j, 0, 0], [None, 0, 0], "abc"]
)
def test_what_is_not_a_number_is_a_type_error(bad):
    with pytest.raises(TypeError):
        _core.pose_from_xyz_rpy(bad, [0, 0, 0])
    with pytest.raises(TypeError):
        _core.Box(bad)
    with pytest.raises(TypeError):
        _core.planar_faces(box(), epsilon=1)


def test_bad_numbers_and_shapes_have_codes():
    triangle = [[0, 1, 2]]
    points = np.eye(3)
    assert code_of(lambda: _core.Box([1, np.nan, 1])) == "E_NUMBER"
    assert code_of(lambda: _core.Box([1, 1])) == "E_SHAPE"
    assert code_of(lambda: _core.Shape(_core.Box([1, -1, 1]))) == "E_GEOMETRY"
    assert code_of(lambda: _core.Shape(_core.Sphere(1), 2 * np.eye(4))) == "E_NUMBER"
    assert code_of(lambda: _core.TriangleMesh(points, [[0, 1, 3]])) == "E_INDEX"
    assert code_of(lambda: _core.TriangleMesh(points, [[0, 1, -1]])) == "E_INDEX"
    assert code_of(lambda: _core.TriangleMesh(np.full((3, 3), np.inf), triangle)) == "E_NUMBER"
    assert code_of(lambda: _core.convex_hull(points)) == "E_MESH_DEGENERATE"
    with pytest.raises(TypeError):
        _core.TriangleMesh(points, [[0.0, 1.0, 2.0]])


def test_a_mesh_file_is_read_and_its_faults_named(tmp_path: Path):
    path = tmp_path / "cube.obj"
    mesh = box((100, 100, 100))
    lines = ["v {} {} {}".format(*vertex) for vertex in mesh.vertices]
    lines += ["f {} {} {}".format(*(triangle + 1)) for triangle in mesh.triangles]
    path.write_text("\n".join(lines))
    loaded = _core.load_mesh(path, scale=0.001, must_be_closed=True)
    assert loaded.surface.volume == pytest.approx(1e-3)
    assert loaded.warnings == []
    assert code_of(lambda: _core.load_mesh(path)) == "E_UNITS"
    assert code_of(lambda: _core.load_mesh(path, scale=0)) == "E_SCALE"
    assert code_of(lambda: _core.load_mesh(str(tmp_path))) == "E_PATH"
    path.write_text("\n".join(lines[:-1]))
    open_cube = lambda: _core.load_mesh(path, scale=0.001, must_be_closed=True)  # noqa: E731
    assert code_of(open_cube) == "E_NOT_CLOSED"
