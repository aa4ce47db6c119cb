// The floor world: bodies, cells, what is held.
#include <memory>
#include <optional>

#include "configurations.hpp"
#include "handey/collision/checker.hpp"
#include "handey/geometry/polyhedron.hpp"
#include "handey/geometry/shape.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/world/body.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

std::optional<double> optional_number(const py::object& number, const std::string& place) {
  if (number.is_none()) return std::nullopt;
  return real_number(number, place);
}

Pose pose_or_identity(const py::object& pose_like, const std::string& place) {
  return pose_like.is_none() ? Pose::Identity() : real_pose(pose_like, place);
}

void bind_body(py::module_& m) {
  py::class_<Body>(m, "Body", R"(A fixture or a part: shapes in one rigid body.

Args:
    name: unique in its cell.
    shapes: list of Shape.
    X_WB: pose in the world, (4, 4); identity by default.
    support: parts may be put down on its upward faces between regrasps.
    friction: with the pads (parts).
    mass: [kg], or None.
    density: [kg/m3], or None.
    may_move: may be moved although no goal names it (parts).)")
      .def(py::init([](const std::string& name, const std::vector<Shape>& shapes,
                       const py::object& X_WB, bool support, const py::object& friction,
                       const py::object& mass, const py::object& density, bool may_move) {
             Body body;
             body.name = name;
             body.shapes = shapes;
             body.X_WB = pose_or_identity(X_WB, "X_WB");
             body.support = support;
             body.friction = real_number(friction, "friction");
             body.mass = optional_number(mass, "mass");
             body.density = optional_number(density, "density");
             body.may_move = may_move;
             return body;
           }),
           py::kw_only(), py::arg("name"), py::arg("shapes"), py::arg("X_WB") = py::none(),
           py::arg("support") = Body().support, py::arg("friction") = Body().friction,
           py::arg("mass") = py::none(), py::arg("density") = py::none(),
           py::arg("may_move") = Body().may_move)
      .def_readonly("name", &Body::name)
      .def_readonly("shapes", &Body::shapes)
      .def_property_readonly(
          "X_WB", [](const Body& self) { return matrix(self.X_WB); }, "In the world, (4, 4).")
      .def_readonly("support", &Body::support)
      .def_readonly("friction", &Body::friction)
      .def_readonly("mass", &Body::mass, "[kg] or None.")
      .def_readonly("density", &Body::density, "[kg/m3] or None.")
      .def_readonly("may_move", &Body::may_move)
      .def("__repr__", [](const Body& self) { return "Body('" + self.name + "')"; });
  m.def("centre_of_mass", &centre_of_mass, py::arg("body"), Unlocked(),
        "Centre of mass in the body frame, uniform density, (3,) [m].");
}

void bind_references(py::module_& m) {
  py::class_<BodyRef> reference(m, "BodyRef", "A fixture or a part of a cell, by kind and index.");
  py::enum_<BodyRef::Kind>(reference, "Kind")
      .value("Fixture", BodyRef::Kind::Fixture)
      .value("Part", BodyRef::Kind::Part);
  reference
      .def(py::init([](BodyRef::Kind kind, int index) {
             return BodyRef{kind, index};
           }),
           py::arg("kind"), py::arg("index"))
      .def_readonly("kind", &BodyRef::kind)
      .def_readonly("index", &BodyRef::index)
      .def("__eq__",
           [](const BodyRef& self, const py::object& other) {
             return py::isinstance<BodyRef>(other) && self == other.cast<BodyRef>();
           })
      .def("__hash__",
           [](const BodyRef& self) {
             return py::hash(py::make_tuple(static_cast<int>(self.kind), self.index));
           })
      .def("__repr__", [](const BodyRef& self) {
        const std::string kind = self.kind == BodyRef::Kind::Fixture ? "Fixture" : "Part";
        return "BodyRef(" + kind + ", " + std::to_string(self.index) + ")";
      });
  py::class_<HeldPart>(m, "HeldPart", R"(What is in the hand.

Args:
    part: index in Cell.parts.
    X_HP: the part in the grasp frame, (4, 4).)")
      .def(py::init([](int part, const py::object& X_HP) {
             return HeldPart{part, pose_or_identity(X_HP, "X_HP")};
           }),
           py::kw_only(), py::arg("part"), py::arg("X_HP") = py::none())
      .def_readonly("part", &HeldPart::part)
      .def_property_readonly(
          "X_HP", [](const HeldPart& self) { return matrix(self.X_HP); }, "(4, 4)");
}

Cell make_cell(const std::string& name, const std::shared_ptr<Robot>& robot,
               const Configuration& start, const std::vector<Body>& fixtures,
               const std::vector<Body>& parts, const py::object& X_WR,
               const std::optional<HeldPart>& held) {
  Cell cell;
  cell.name = name;
  cell.robot = robot;
  cell.X_WR = pose_or_identity(X_WR, "X_WR");
  cell.fixtures = fixtures;
  cell.parts = parts;
  cell.held = held;
  cell.start = start;
  require_valid(cell);
  return cell;
}

void bind_cell(py::module_& m) {
  py::class_<Cell>(
      m, "Cell",
      R"(Robot, fixtures, parts, and which part is in the hand. A value: an edit returns a new cell.

Args:
    robot: Robot.
    start: Configuration of the robot at the start.
    name: of the cell.
    fixtures: list of Body; they never move.
    parts: list of Body that can be picked up; their meshes must be closed.
    X_WR: the URDF's root link in the world, (4, 4); identity by default.
    held: HeldPart or None.

Raises:
    InvalidInput: with every body, pose or number that is wrong.)")
      .def(py::init(&make_cell), py::kw_only(), py::arg("name") = "cell",
           py::arg("robot").none(false), py::arg("start"),
           py::arg("fixtures") = std::vector<Body>(), py::arg("parts") = std::vector<Body>(),
           py::arg("X_WR") = py::none(), py::arg("held") = py::none())
      .def_readonly("name", &Cell::name)
      .def_property_readonly(
          "robot", [](const Cell& self) { return std::const_pointer_cast<Robot>(self.robot); })
      .def_property_readonly(
          "X_WR", [](const Cell& self) { return matrix(self.X_WR); }, "(4, 4)")
      .def_readonly("fixtures", &Cell::fixtures, "List of Body; a copy.")
      .def_readonly("parts", &Cell::parts, "List of Body; a held part's X_WB is not used. A copy.")
      .def_readonly("held", &Cell::held, "HeldPart or None.")
      .def_readonly("start", &Cell::start)
      .def("body", &Cell::body, py::arg("ref"), py::return_value_policy::copy)
      .def("part_index", &Cell::part_index, py::arg("name"),
           "Index of the part of this name. Raises InvalidInput with the legal names.")
      .def(
          "with_part_at",
          [](const Cell& self, int part, const py::object& X_WP) {
            return self.with_part_at(part, real_pose(X_WP, "X_WP"));
          },
          py::arg("part"), py::arg("X_WP"), "The same cell with a part at another pose.")
      .def(
          "with_held",
          [](const Cell& self, int part, const py::object& X_HP) {
            return self.with_held(part, real_pose(X_HP, "X_HP"));
          },
          py::arg("part"), py::arg("X_HP"), "The same cell with the part in the hand.")
      .def(
          "with_released",
          [](const Cell& self, const py::object& X_WP) {
            return self.with_released(real_pose(X_WP, "X_WP"));
          },
          py::arg("X_WP"), "The held part stands at X_WP, nothing is held.")
      .def("__repr__", [](const Cell& self) { return "Cell('" + self.name + "')"; });
  m.def(
      "hand_in_world",
      [](const Cell& cell, const py::object& q) {
        return matrix(hand_in_world(cell, joint_vector(q, "q")));
      },
      py::arg("cell"), py::arg("q"), "Grasp frame in the world, (4, 4).");
}

}  // namespace

void bind_world(py::module_& m) {
  bind_references(m);
  bind_body(m);
  bind_cell(m);
  bind_depth_map(m);
}

}  // namespace handey::bindings
