// The geometry floor in Python: poses, plane regions, meshes, planar faces, shapes, sections, mesh
// files.
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "arrays.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/geometry/mesh_file.hpp"
#include "handey/geometry/polygon.hpp"
#include "handey/geometry/polyhedron.hpp"
#include "handey/geometry/section.hpp"
#include "handey/geometry/shape.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

using TriangleRows = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

std::vector<Eigen::Vector3i> triangle_rows(const py::handle& object) {
  const py::array given = py::array::ensure(object);
  if (!given || (given.size() > 0 && given.dtype().kind() != 'i' && given.dtype().kind() != 'u')) {
    PyErr_Clear();
    throw py::type_error("triangles: expected an (m, 3) array of integers");
  }
  const py::array_t<long long, py::array::c_style | py::array::forcecast> values(given);
  std::vector<Eigen::Vector3i> triangles;
  if (values.size() == 0) return triangles;
  if (values.ndim() != 2 || values.shape(1) != 3) {
    throw InvalidInput("E_SHAPE", "triangles", "expected shape (m, 3)");
  }
  const auto index = [&values](py::ssize_t row, py::ssize_t column) {
    // Out of the range of int is out of the range of the vertices too; the mesh check names it.
    const long long value = values.at(row, column);
    return value < 0 || value > 2147483646 ? -1 : static_cast<int>(value);
  };
  for (py::ssize_t i = 0; i < values.shape(0); ++i)
    triangles.emplace_back(index(i, 0), index(i, 1), index(i, 2));
  return triangles;
}

Region region_from(const py::handle& loops) {
  Region region;
  for (const py::handle loop : loops) region.loops.push_back(real_rows<2>(loop, "loops"));
  return region;
}

void bind_poses(py::module_& m) {
  m.def(
      "pose_from_xyz_rpy",
      [](const py::object& xyz, const py::object& rpy) {
        return matrix(pose_from_xyz_rpy(real_vector<3>(xyz, "xyz"), real_vector<3>(rpy, "rpy")));
      },
      py::arg("xyz"), py::arg("rpy"),
      R"(A pose from a position and roll, pitch, yaw about the fixed axes.

Args:
    xyz: position (3,) [m].
    rpy: roll, pitch, yaw (3,) [rad]; R = Rz(yaw) Ry(pitch) Rx(roll).

Returns:
    4 x 4 matrix.

Raises:
    InvalidInput: E_NUMBER if a number is not finite.)");
  m.def(
      "pose_from_xyz_quat",
      [](const py::object& xyz, const py::object& quat_xyzw) {
        return matrix(
            pose_from_xyz_quat(real_vector<3>(xyz, "xyz"), real_vector<4>(quat_xyzw, "quat_xyzw")));
      },
      py::arg("xyz"), py::arg("quat_xyzw"), R"(A pose from a position and a unit quaternion.

Args:
    xyz: position (3,) [m].
    quat_xyzw: quaternion x, y, z, w, of norm 1 within 1e-3.

Returns:
    4 x 4 matrix.

Raises:
    InvalidInput: E_NUMBER, E_QUATERNION.)");
  m.def(
      "quaternion_xyzw",
      [](const py::object& pose) { return quaternion_xyzw(real_pose(pose, "pose")); },
      py::arg("pose"), "The rotation of a 4 x 4 pose as a unit quaternion (x, y, z, w), w >= 0.");
}

void bind_regions(py::module_& m) {
  py::class_<Region>(m, "Region",
                     "A plane region: outer loops counter-clockwise, holes clockwise [m].")
      .def(py::init(&region_from), py::arg("loops") = py::list(),
           "Args:\n    loops: closed polygons, each (n, 2) [m]; counter-clockwise outside, "
           "clockwise holes.")
      .def_property_readonly(
          "loops",
          [](const Region& region) {
            py::list loops;
            for (const Polygon& loop : region.loops) loops.append(rows_of<2>(loop));
            return loops;
          },
          "The loops, each (n, 2) [m].")
      .def_property_readonly(
          "area", [](const Region& region) { return area(region); }, "Holes taken off [m2].")
      .def("empty", &Region::empty, "True if there is no loop.")
      .def(
          "contains",
          [](const Region& region, const py::object& point) {
            return contains(region, real_vector<2>(point, "point"));
          },
          py::arg("point"), "True if the point (2,) lies inside.")
      .def("__repr__", [](const Region& region) {
        std::ostringstream text;
        text << "Region(" << region.loops.size() << " loops, " << area(region) << " m2)";
        return text.str();
      });
  py::class_<InscribedCircle>(m, "InscribedCircle", "A circle inside a region.")
      .def_readonly("centre", &InscribedCircle::centre, "(2,) [m]")
      .def_readonly("radius", &InscribedCircle::radius, "[m]; 0 for an empty region");
  m.def("unite", &unite, py::arg("regions"), "The union of regions.");
  m.def("intersect", &intersect, py::arg("a"), py::arg("b"), "What two regions have in common.");
  m.def("subtract", &subtract, py::arg("a"), py::arg("b"), "Region a without region b.");
  m.def("offset", &offset, py::arg("region"), py::arg("delta"),
        "A region grown (delta > 0) or shrunk by delta [m], corners mitred: grown, it contains the "
        "true offset.");
  m.def("connected_parts", &connected_parts, py::arg("region"),
        "One region per connected piece, with its holes, largest first.");
  m.def(
      "boundary_distance",
      [](const Region& region, const py::object& point) {
        return boundary_distance(region, real_vector<2>(point, "point"));
      },
      py::arg("region"), py::arg("point"), "Distance of a point (2,) to the nearest edge [m].");
  m.def("largest_inscribed_circle", &largest_inscribed_circle, py::arg("region"),
        py::arg("precision") = 1e-4, "The largest circle inside a region, to `precision` [m].");
}

void bind_meshes(py::module_& m) {
  py::class_<TriangleMesh>(m, "TriangleMesh", "Triangles counter-clockwise seen from outside.")
      .def(py::init([](const py::object& vertices, const py::object& triangles) {
             TriangleMesh mesh{real_rows<3>(vertices, "vertices"), triangle_rows(triangles)};
             require_valid(mesh, "TriangleMesh");
             return mesh;
           }),
           py::arg("vertices"), py::arg("triangles"), R"(A mesh from arrays, which are copied.

Args:
    vertices: (n, 3) [m].
    triangles: (m, 3) integers, indices of vertices.

Raises:
    InvalidInput: E_NUMBER, E_SHAPE, E_INDEX.
    TypeError: for strings, booleans, complex numbers.)")
      .def_property_readonly(
          "vertices", [](const TriangleMesh& mesh) { return rows_of<3>(mesh.vertices); },
          "(n, 3) [m], a copy.")
      .def_property_readonly(
          "triangles",
          [](const TriangleMesh& mesh) {
            TriangleRows rows(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
              rows.row(static_cast<Eigen::Index>(i)) = mesh.triangles[i].transpose();
            }
            return rows;
          },
          "(m, 3) indices, a copy.")
      .def("__repr__", [](const TriangleMesh& mesh) {
        return "TriangleMesh(" + std::to_string(mesh.vertices.size()) + " vertices, " +
               std::to_string(mesh.triangles.size()) + " triangles)";
      });
  py::class_<SurfaceReport>(m, "SurfaceReport", "What a surface is.")
      .def_readonly("closed", &SurfaceReport::closed,
                    "Every edge is shared by an even number of triangles.")
      .def_readonly("manifold", &SurfaceReport::manifold,
                    "No edge is shared by more than two triangles.")
      .def_readonly("consistently_oriented", &SurfaceReport::consistently_oriented,
                    "Neighbours run along their common edge in opposite directions.")
      .def_readonly("components", &SurfaceReport::components, "Pieces not connected by an edge.")
      .def_readonly("open_edges", &SurfaceReport::open_edges)
      .def_readonly("overfull_edges", &SurfaceReport::overfull_edges)
      .def_readonly("volume", &SurfaceReport::volume, "Signed [m3]; negative: inside out.")
      .def_readonly("centroid", &SurfaceReport::centroid, "Of the solid, uniform density (3,) [m].")
      .def_readonly("lower", &SurfaceReport::lower, "Bounding box (3,) [m].")
      .def_readonly("upper", &SurfaceReport::upper, "Bounding box (3,) [m].");
  m.def("inspect_surface", &inspect_surface, py::arg("mesh"), Unlocked(),
        "What a mesh's surface is: closed, volume, box.");
  m.def(
      "contains_point",
      [](const TriangleMesh& mesh, const py::object& point) {
        return contains_point(mesh, real_vector<3>(point, "point"));
      },
      py::arg("mesh"), py::arg("point"), "True if the point (3,) [m] is inside the solid.");
  m.def("connected_components", &connected_components, py::arg("mesh"), Unlocked(),
        "The pieces of a mesh that share no edge.");
  m.def("is_convex", &is_convex, py::arg("mesh"), py::arg("tolerance") = 1e-6, Unlocked(),
        "True if a mesh is a closed convex solid to `tolerance` [m].");
  m.def(
      "convex_hull",
      [](const py::object& points) {
        return triangulate(convex_hull(real_rows<3>(points, "points")));
      },
      py::arg("points"), R"(The convex hull of points (n, 3) [m] as a mesh.

Raises:
    InvalidInput: E_MESH_DEGENERATE for fewer than four points or points in one plane.)");
}

void bind_planar_faces(py::module_& m) {
  py::class_<PlanarFace>(m, "PlanarFace",
                         "A planar face of a solid with its own plane coordinates.")
      .def_readonly("normal", &PlanarFace::normal, "Outward (3,).")
      .def_readonly("origin", &PlanarFace::origin, "A point of the plane (3,) [m].")
      .def_readonly("u", &PlanarFace::u, "In-plane axis (3,); u x v = normal.")
      .def_readonly("v", &PlanarFace::v, "In-plane axis (3,).")
      .def_readonly("region", &PlanarFace::region, "The face in (u, v) about origin.")
      .def_readonly("area", &PlanarFace::area, "[m2]")
      .def_readonly("triangles", &PlanarFace::triangles, "Indices of the triangles merged.")
      .def("__repr__", [](const PlanarFace& face) {
        std::ostringstream text;
        text << "PlanarFace(" << face.area << " m2, normal [" << face.normal.transpose() << "], "
             << face.triangles.size() << " triangles)";
        return text.str();
      });
  const PlanarFaceOptions defaults;
  m.def(
      "planar_faces",
      [](const TriangleMesh& mesh, double angle, double distance, double least_area) {
        return planar_faces(mesh, {angle, distance, least_area});
      },
      py::arg("mesh"), py::kw_only(), py::arg("angle") = defaults.angle,
      py::arg("distance") = defaults.distance, py::arg("least_area") = defaults.least_area,
      Unlocked(),
      R"(The planar faces of a solid, largest first.

Args:
    mesh: a welded mesh.
    angle: most a triangle's normal leaves the face's [rad].
    distance: most a vertex leaves the face's plane [m].
    least_area: smaller faces are left out [m2].

Raises:
    InvalidInput: E_RANGE for negative or non-finite options.)");
}

void bind_shapes(py::module_& m) {
  py::class_<Box>(m, "Box", "A box about the origin.")
      .def(py::init([](const py::object& size) { return Box{real_vector<3>(size, "size")}; }),
           py::arg("size"), "Args:\n    size: full edge lengths (3,) [m].")
      .def_readonly("size", &Box::size, "Full edge lengths (3,) [m].");
  py::class_<Cylinder>(m, "Cylinder", "A cylinder along z about the origin.")
      .def(py::init<double, double>(), py::arg("radius"), py::arg("length"),
           "Args:\n    radius: [m].\n    length: along z [m].")
      .def_readonly("radius", &Cylinder::radius, "[m]")
      .def_readonly("length", &Cylinder::length, "[m]");
  py::class_<Sphere>(m, "Sphere", "A sphere about the origin.")
      .def(py::init<double>(), py::arg("radius"), "Args:\n    radius: [m].")
      .def_readonly("radius", &Sphere::radius, "[m]");
  py::class_<MeshShape>(m, "MeshShape", "A mesh as a solid or, for fixtures, an open skin.")
      .def(py::init([](const TriangleMesh& mesh, bool solid) {
             return MeshShape{std::make_shared<const TriangleMesh>(mesh), solid};
           }),
           py::arg("mesh"), py::arg("solid") = true,
           "Args:\n    mesh: copied.\n    solid: closed, what is inside collides; False: an open "
           "skin.")
      .def_property_readonly("mesh",
                             [](const MeshShape& shape) { return TriangleMesh(*shape.mesh); })
      .def_readonly("solid", &MeshShape::solid);
  py::class_<Shape>(m, "Shape", "A geometry at its pose in the body that has it.")
      .def(py::init([](const Geometry& geometry, const py::object& X_BS) {
             Shape shape{geometry, X_BS.is_none() ? Pose::Identity() : real_pose(X_BS, "X_BS")};
             require_valid(shape, "Shape");
             return shape;
           }),
           py::arg("geometry"), py::arg("X_BS") = py::none(), R"(A shape.

Args:
    geometry: Box, Cylinder, Sphere or MeshShape.
    X_BS: the shape in its body, 4 x 4; default identity.

Raises:
    InvalidInput: E_GEOMETRY, E_NUMBER for sizes that are not finite and positive.)")
      .def_readonly("geometry", &Shape::geometry)
      .def_property_readonly(
          "X_BS", [](const Shape& shape) { return matrix(shape.X_BS); }, "4 x 4");
  m.def("tessellate", &tessellate, py::arg("shape"), py::arg("segments") = 32,
        py::arg("outer") = true,
        R"(A shape as a closed triangle mesh in the body frame.

Args:
    shape: the shape.
    segments: sides of cylinders and spheres.
    outer: True: the polyhedron contains the round shape; False: it is contained in it.)");
  m.def(
      "hull_points", [](const Shape& shape) { return rows_of<3>(hull_points(shape)); },
      py::arg("shape"),
      "Points (n, 3) [m] in the body frame whose convex hull contains the shape.");
  m.def(
      "slab_projection",
      [](const Shape& shape, const py::object& X_GB, double lower, double upper) {
        const Pose pose_in_plane = real_pose(X_GB, "X_GB");
        const Unlock unlock;
        return slab_projection(shape, pose_in_plane, lower, upper);
      },
      py::arg("shape"), py::arg("X_GB"), py::arg("lower"), py::arg("upper"),
      R"(What of a shape lies between two planes, seen along their normal.

Args:
    shape: the shape; a solid's inside counts.
    X_GB: the shape's body in the frame whose z is the normal, 4 x 4.
    lower: [m]
    upper: [m]

Returns:
    Region in x, y of G; contains the true projection to 1e-6 m.)");
}

void bind_mesh_files(py::module_& m) {
  py::class_<LoadedMesh>(m, "LoadedMesh", "A mesh from a file and what was found out about it.")
      .def_readonly("mesh", &LoadedMesh::mesh)
      .def_readonly("surface", &LoadedMesh::surface)
      .def_readonly("warnings", &LoadedMesh::warnings, "What was mended or looks wrong.");
  const MeshFileOptions defaults;
  m.def(
      "load_mesh",
      [](const std::filesystem::path& path, const py::object& scale, bool must_be_closed,
         double greatest_size) {
        MeshFileOptions options;
        const py::array factors = py::array::ensure(scale);
        if (!factors || (factors.dtype().kind() != 'f' && factors.dtype().kind() != 'i')) {
          PyErr_Clear();
          throw py::type_error("scale: expected a number or three");
        }
        // Not checked for NaN here: a bad scale has its own code.
        const py::array_t<double, py::array::c_style | py::array::forcecast> values(factors);
        if (values.size() != 1 && values.size() != 3) {
          throw InvalidInput("E_SHAPE", "scale", "expected a number or three");
        }
        for (py::ssize_t k = 0; k < 3; ++k)
          options.scale[k] = values.data()[values.size() == 1 ? 0 : k];
        options.must_be_closed = must_be_closed;
        options.greatest_size = greatest_size;
        const Unlock unlock;
        return load_mesh(path.string(), options);
      },
      py::arg("path"), py::kw_only(), py::arg("scale") = 1.0, py::arg("must_be_closed") = false,
      py::arg("greatest_size") = defaults.greatest_size, R"(Reads an STL, OBJ or PLY mesh strictly.

Args:
    path: a regular file; what it holds decides its format.
    scale: file unit to metres, one number or one per axis.
    must_be_closed: an open surface is an error, as for parts.
    greatest_size: a larger bounding box is taken for a wrong unit [m].

Raises:
    InvalidInput: E_PATH, E_MESH_EMPTY, E_MESH_TRUNCATED, E_MESH_FORMAT, E_NUMBER, E_RANGE, E_MESH_DEGENERATE,
        E_NOT_CLOSED, E_NOT_MANIFOLD, E_INDEX, E_TOO_BIG, E_UNITS, E_UNSUPPORTED, E_SCALE.)");
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_poses(m);
  bind_regions(m);
  bind_meshes(m);
  bind_planar_faces(m);
  bind_shapes(m);
  bind_mesh_files(m);
}

}  // namespace handey::bindings
