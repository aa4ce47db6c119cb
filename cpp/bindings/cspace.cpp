// The floor cspace: cells, the arm's plane, cross sections, planar arms.
#include <cmath>
#include <optional>

#include "arrays.hpp"
#include "handey/collision/box_certificate.hpp"
#include "handey/collision/checker.hpp"
#include "handey/collision/scene.hpp"
#include "handey/collision/solids.hpp"
#include "handey/cspace/arm_table.hpp"
#include "handey/cspace/cross_section.hpp"
#include "handey/cspace/lattice.hpp"
#include "handey/cspace/planar_arm.hpp"
#include "handey/cspace/separation.hpp"
#include "handey/cspace/slice.hpp"
#include "handey/geometry/polygon.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

using Rows2 = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

std::vector<Polygon> polygons_from(const py::iterable& polygons, const std::string& place) {
  std::vector<Polygon> result;
  for (const py::handle polygon : polygons) {
    result.push_back(real_rows<2>(polygon, place + "[" + std::to_string(result.size()) + "]"));
  }
  return result;
}

std::vector<Rows2> rows_of_all(const std::vector<Polygon>& polygons) {
  std::vector<Rows2> rows;
  for (const Polygon& polygon : polygons) rows.push_back(rows_of<2>(polygon));
  return rows;
}

Rows2 interval_rows(const std::vector<AngleInterval>& intervals) {
  std::vector<Eigen::Vector2d> rows;
  for (const AngleInterval& interval : intervals) rows.emplace_back(interval.lower, interval.upper);
  return rows_of<2>(rows);
}

int level_of(int level) {
  if (level < 0 || level >= Lattice::kLevels) {
    throw InvalidInput("E_RANGE", "level",
                       "found " + std::to_string(level) + ", expected 0 to " +
                           std::to_string(Lattice::kLevels - 1));
  }
  return level;
}

int joint_of(int joint) {
  if (joint < 0 || joint > 2) {
    throw InvalidInput("E_RANGE", "joint", "found " + std::to_string(joint) + ", expected 0 to 2");
  }
  return joint;
}

void bind_scene(py::module_& m) {
  py::class_<SceneHull>(m, "SceneHull", R"(A convex polyhedron.

Args:
    points: vertices (n, 3) [m].
    edges: pairs of indices of points; more than the polyhedron's edges are allowed. None: all
        pairs.)")
      .def(py::init([](const py::object& points,
                       const std::optional<std::vector<std::pair<int, int>>>& edges) {
             SceneHull hull{real_rows<3>(points, "points"), {}};
             const int count = static_cast<int>(hull.points.size());
             if (edges) hull.edges = *edges;
             for (int i = 0; i < count && !edges; ++i) {
               for (int j = 0; j < i; ++j) hull.edges.emplace_back(j, i);
             }
             return hull;
           }),
           py::arg("points"), py::arg("edges") = py::none())
      .def_property_readonly(
          "points", [](const SceneHull& self) { return rows_of<3>(self.points); },
          "Vertices (n, 3) [m].")
      .def_readonly("edges", &SceneHull::edges, "Pairs of indices of points.");
  py::class_<SceneMover>(m, "SceneMover", "A body that moves: of the robot, or what it holds.")
      .def_readonly("name", &SceneMover::name)
      .def_readonly("depth", &SceneMover::depth, "Number of arm joints that move it.")
      .def_readonly("finger", &SceneMover::finger, "Is it moved by the opening besides?")
      .def_readonly("body", &SceneMover::body, "Robot body that it is or is held by.")
      .def_property_readonly(
          "X_BM", [](const SceneMover& self) { return matrix(self.X_BM); },
          "Its frame in that body, (4, 4).")
      .def_readonly("hulls", &SceneMover::hulls, "In its frame.");
  py::class_<SceneObstacle>(m, "SceneObstacle", "A body that stands: a fixture or a part.")
      .def_readonly("name", &SceneObstacle::name)
      .def_readonly("hulls", &SceneObstacle::hulls, "In the robot frame.")
      .def_property_readonly(
          "checked",
          [](const SceneObstacle& self) {
            return std::vector<bool>(self.checked.begin(), self.checked.end());
          },
          "Per mover: is it kept apart from this?");
  py::class_<Scene>(m, "Scene", "What a checker keeps apart, as convex hulls.")
      .def_readonly("movers", &Scene::movers, "Robot bodies, base first, then what is held.")
      .def_readonly("obstacles", &Scene::obstacles)
      .def_readonly("mover_pairs", &Scene::mover_pairs,
                    "Indices of movers that are kept apart from each other.");
  py::class_<SceneOptions>(m, "SceneOptions", "Options of describe_scene.")
      .def(py::init([](int patch_triangles, double patch_excess) {
             return SceneOptions{patch_triangles, patch_excess};
           }),
           py::kw_only(), py::arg("patch_triangles") = SceneOptions().patch_triangles,
           py::arg("patch_excess") = SceneOptions().patch_excess)
      .def_readwrite("patch_triangles", &SceneOptions::patch_triangles,
                     "Most triangles of a surface patch's hull.")
      .def_readwrite("patch_excess", &SceneOptions::patch_excess,
                     "How far a patch's hull may stand out of the solid [m].");
  m.def("describe_scene", &describe_scene, py::arg("checker"), py::arg("options") = SceneOptions(),
        Unlocked(), R"(What a checker keeps apart, as convex hulls.

A hull contains its piece. A mesh that is not convex is given by hulls of patches of its surface.

Raises:
    InvalidInput: for options that are not positive.)");
}

void bind_lattice(py::module_& m) {
  py::class_<Lattice> lattice(m, "Lattice", "The cells of a slice over the first three joints.");
  lattice.def_readonly("lower", &Lattice::lower, "Of the joints' ranges [rad].")
      .def_readonly("width", &Lattice::width, "Of a cell of level 0 [rad].")
      .def_readonly("count", &Lattice::count, "Cells of level 0.")
      .def_readonly("wraps", &Lattice::wraps, "Has the joint no limits?")
      .def(
          "cells",
          [](const Lattice& self, int level, int joint) {
            return self.cells(level_of(level), joint_of(joint));
          },
          py::arg("level"), py::arg("joint"), "Number of cells.")
      .def(
          "cell_width",
          [](const Lattice& self, int level, int joint) {
            return self.cell_width(level_of(level), joint_of(joint));
          },
          py::arg("level"), py::arg("joint"), "Width of a cell [rad].")
      .def(
          "centre",
          [](const Lattice& self, int level, int joint, int index) {
            return self.centre(level_of(level), joint_of(joint), index);
          },
          py::arg("level"), py::arg("joint"), py::arg("index"), "Middle of a cell [rad].")
      .def(
          "index_of",
          [](const Lattice& self, int level, int joint, double angle) {
            if (!std::isfinite(angle)) throw InvalidInput("E_NUMBER", "angle", "is not finite");
            return self.index_of(level_of(level), joint_of(joint), angle);
          },
          py::arg("level"), py::arg("joint"), py::arg("angle"),
          "The cell that holds an angle [rad]; -1 if it is out of the joint's range.");
  m.def("make_lattice", &make_lattice, py::arg("robot"), py::arg("coarse") = 0.13962634015954636,
        R"(Cut the ranges of the first three joints into cells of 8, 4, 2 and 1 degree, or less.

Args:
    robot: of three joints or more.
    coarse: widest cell of level 0 [rad].

Raises:
    InvalidInput: for fewer joints, or a width outside 1e-4 to pi.)");
}

void bind_plane(py::module_& m) {
  py::class_<ArmPlane>(m, "ArmPlane", R"(The plane in which joints 2 and 3 move the arm.

Frame E turns with the waist: origin on axis 2, z along it, x and y in the plane.)")
      .def_property_readonly(
          "waist_point", [](const ArmPlane& self) { return self.waist_point; },
          "A point of axis 1 in E, (3,) [m].")
      .def_property_readonly(
          "waist_axis", [](const ArmPlane& self) { return self.waist_axis; },
          "Axis 1 in E, (3,), unit.")
      .def_property_readonly(
          "elbow", [](const ArmPlane& self) { return self.elbow; },
          "Axis 3 in (x, y) of E where joint 2 is 0, (2,) [m].")
      .def_readonly("elbow_sense", &ArmPlane::elbow_sense,
                    "1: joint 3 turns as joint 2 does; -1: the other way.")
      .def(
          "X_RE",
          [](const ArmPlane& self, double q1) {
            if (!std::isfinite(q1)) throw InvalidInput("E_NUMBER", "q1", "is not finite");
            return matrix(self.X_RE(q1));
          },
          py::arg("q1"), "E in the robot frame at a waist angle [rad], (4, 4).");
  m.def(
      "arm_plane",
      [](const Robot& robot) {
        std::string reason;
        const std::optional<ArmPlane> plane = arm_plane(robot, &reason);
        return std::make_pair(plane, reason);
      },
      py::arg("robot"),
      R"(The arm's plane, if its second and third axes are parallel.

Returns:
    The plane and "", or None and why there is none.)");
}

void bind_sections(py::module_& m) {
  py::class_<Slab>(m, "Slab", R"(Lateral extent, along z of E.

Args:
    lower: [m].
    upper: [m].)")
      .def(py::init([](double lower, double upper) {
             return Slab{lower, upper};
           }),
           py::arg("lower"), py::arg("upper"))
      .def_readwrite("lower", &Slab::lower, "[m]")
      .def_readwrite("upper", &Slab::upper, "[m]");
  m.def(
      "cross_section",
      [](const ArmPlane& plane, const SceneHull& hull, const Slab& slab, double q1,
         double half_width) {
        return rows_of<2>(cross_section(plane, hull, slab, q1, half_width));
      },
      py::arg("plane"), py::arg("hull"), py::arg("slab"), py::arg("q1"), py::arg("half_width"),
      R"(What of an obstacle is in the slab at any waist angle in q1 +- half_width.

Contains the true section.

Args:
    plane: of the arm.
    hull: in the robot frame.
    slab: of the link.
    q1: waist angle [rad].
    half_width: 0 to pi [rad].

Returns:
    A convex polygon (n, 2) in (x, y) of E, counter-clockwise [m]; n is 0 if the hull never reaches
    the slab.)");
  py::class_<Torus>(m, "Torus", "One section of an obstacle for a window of waist angles.")
      .def_readonly("lower", &Torus::lower, "[rad], in -pi to pi.")
      .def_readonly("upper", &Torus::upper, "[rad]; may pass pi: the window goes on round.")
      .def_property_readonly(
          "section", [](const Torus& self) { return rows_of<2>(self.section); },
          "A convex polygon (n, 2) in (x, y) of E [m].");
  m.def("torus_of", &torus_of, py::arg("plane"), py::arg("hull"), py::arg("slab"), Unlocked(),
        R"(The article's obstacles: for each window of waist angles at which a hull can reach the
slab, one section that contains those of all its angles.)");
}

void bind_planar_arm(py::module_& m) {
  m.def(
      "forbidden_angles",
      [](const py::iterable& links, const py::iterable& obstacles) {
        const std::vector<Polygon> turning = polygons_from(links, "links");
        const std::vector<Polygon> standing = polygons_from(obstacles, "obstacles");
        return interval_rows(forbidden_angles(turning, standing));
      },
      py::arg("links"), py::arg("obstacles"),
      R"(The angles at which convex polygons turned about the origin meet others. Exact.

Args:
    links: polygons (n, 2) at angle 0 [m].
    obstacles: polygons (n, 2) [m].

Returns:
    Rows of lower and upper limit within 0 to 2 pi, sorted (k, 2) [rad]; touching counts.

Raises:
    InvalidInput: for polygons of fewer than three points, or numbers that are not finite.)");
  py::class_<PlanarArm>(m, "PlanarArm", R"(Two links in a plane.

Args:
    upper: convex polygons (n, 2) where theta2 is 0, from the shoulder [m].
    lower: convex polygons (n, 2) where both angles are 0, from the elbow [m].
    elbow: where theta2 is 0, from the shoulder (2,) [m].)")
      .def(py::init(
               [](const py::iterable& upper, const py::iterable& lower, const py::object& elbow) {
                 return PlanarArm{polygons_from(upper, "upper"), polygons_from(lower, "lower"),
                                  real_vector<2>(elbow, "elbow")};
               }),
           py::kw_only(), py::arg("upper"), py::arg("lower"), py::arg("elbow"))
      .def_property_readonly("upper", [](const PlanarArm& self) { return rows_of_all(self.upper); })
      .def_property_readonly("lower", [](const PlanarArm& self) { return rows_of_all(self.lower); })
      .def_property_readonly("elbow", [](const PlanarArm& self) { return self.elbow; });
  m.def(
      "planar_slice",
      [](const PlanarArm& arm, const py::iterable& obstacles, const py::object& theta2) {
        const py::array_t<double> angles = real_array(theta2, "theta2");
        if (angles.ndim() != 1) throw InvalidInput("E_SHAPE", "theta2", "expected shape (n,)");
        std::vector<Rows2> columns;
        for (const std::vector<AngleInterval>& column :
             planar_slice(arm, polygons_from(obstacles, "obstacles"),
                          {angles.data(), angles.data() + angles.size()})) {
          columns.push_back(interval_rows(column));
        }
        return columns;
      },
      py::arg("arm"), py::arg("obstacles"), py::arg("theta2"),
      R"(The forbidden angles of the lower link, column by column of the upper's. Exact.

Args:
    arm: two links.
    obstacles: convex polygons (n, 2), from the shoulder [m].
    theta2: angles of the upper link (m,) [rad].

Returns:
    Per angle rows of lower and upper limit of theta3 within 0 to 2 pi, (k, 2) [rad]; the whole
    circle where the upper link itself meets an obstacle.)");
}

void bind_separation(py::module_& m) {
  py::class_<BlockedProof>(m, "BlockedProof", "The bodies that collide everywhere in a cell.")
      .def_readonly("blocked", &BlockedProof::blocked, "Is the cell proved blocked?")
      .def_readonly("mover", &BlockedProof::mover, "A robot body, or 'held ...'.")
      .def_readonly("other", &BlockedProof::other, "What it collides with.")
      .def("__bool__", [](const BlockedProof& self) { return self.blocked; });
  py::class_<BlockedCells>(m, "BlockedCells",
                           R"(Proves cells blocked, for one opening and what is held.

A blocked cell has no free configuration, whatever the joints after the third do.

Args:
    checker: CollisionChecker of the cell, with what is held; it is not kept.
    opening: between the pads [m].

Raises:
    InvalidInput: for arms of fewer than three joints, joints of too wide ranges, or an opening
        that is not finite.)")
      .def(py::init<CollisionChecker&, double>(), py::arg("checker"), py::arg("opening"),
           Unlocked())
      .def_property_readonly("lattice", &BlockedCells::lattice)
      .def("prove", &BlockedCells::prove, py::arg("level"), py::arg("cell"), Unlocked(),
           R"(Is a cell proved blocked, and by which bodies?

Args:
    level: of the lattice.
    cell: indices along the first three joints.

Returns:
    BlockedProof, true if it is.)");
  const SeparationOptions defaults;
  py::class_<SeparationOptions>(m, "SeparationOptions", "Options of prove_apart.")
      .def(py::init([](int finest_level, std::size_t most_cells) {
             return SeparationOptions{finest_level, most_cells};
           }),
           py::kw_only(), py::arg("finest_level") = defaults.finest_level,
           py::arg("most_cells") = defaults.most_cells)
      .def_readwrite("finest_level", &SeparationOptions::finest_level,
                     "Of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1.")
      .def_readwrite("most_cells", &SeparationOptions::most_cells,
                     "Cells looked at before it is given up.");
  py::class_<Separation>(m, "Separation", "Is there no way at all? True if that is proved.")
      .def_readonly("apart", &Separation::apart, "No path leads to any of the goals.")
      .def_property_readonly(
          "goal_apart",
          [](const Separation& self) {
            return std::vector<bool>(self.goal_apart.begin(), self.goal_apart.end());
          },
          "Per goal: is it proved that no path leads to it?")
      .def_readonly("resolution", &Separation::resolution,
                    "Widest edge of the finest cells looked at [rad].")
      .def_readonly("cells_looked_at", &Separation::cells_looked_at)
      .def_readonly("reason", &Separation::reason,
                    "What walls the goals off, or why they are not called apart.")
      .def("__bool__", [](const Separation& self) { return self.apart; });
  m.def("prove_apart", &prove_apart, py::arg("checker"), py::arg("start"), py::arg("goals"),
        py::arg("options") = defaults, Unlocked(),
        R"(Prove that no path leads from start to goal, whatever the joints after the third do.

What is called apart is apart. What is not may be so all the same.

Args:
    checker: CollisionChecker of the cell, with what is held.
    start: Configuration.
    goals: list of Configuration with the start's opening.
    options: SeparationOptions.

Returns:
    Separation.

Raises:
    InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
)");
}

}  // namespace

void bind_slice(py::module_& m);  // slice.cpp

void bind_cspace(py::module_& m) {
  bind_scene(m);
  bind_lattice(m);
  bind_plane(m);
  bind_sections(m);
  bind_planar_arm(m);
  bind_separation(m);
  bind_slice(m);
  bind_layer(m);
  bind_free_space(m);
}

}  // namespace handey::bindings
