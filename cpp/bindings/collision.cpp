// The floor collision: checker, certificate, overlaps at rest.
#include <memory>
#include <optional>

#include "configurations.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/collision/checker.hpp"
#include "handey/collision/solids.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

void bind_model(py::module_& m) {
  py::class_<CollisionModel, std::shared_ptr<CollisionModel>>(
      m, "CollisionModel",
      "Collision geometry of a cell's robot, fixtures and parts. Immutable; shared by checkers.");
  m.def(
      "make_collision_model",
      [](const Cell& cell, const std::shared_ptr<CollisionModel>& known) {
        return std::const_pointer_cast<CollisionModel>(make_collision_model(cell, known));
      },
      py::arg("cell"), py::arg("known") = py::none(), Unlocked(),
      R"(Prepare a cell's shapes for collision checking.

Args:
    cell: the cell.
    known: a model of any cell, or None; the robot, if it is this very one, and bodies of the same
        name and shapes are taken from it.

Raises:
    InvalidInput: for invalid cells.)");
}

void bind_checker(py::module_& m) {
  py::class_<Allowance>(m, "Allowance", R"(Contacts that are part of the work.

Args:
    closed_on: index of the part that the fingers close on without it being held yet, or None.
    held_touches: list of BodyRef that the held part may touch where it stands.)")
      .def(py::init([](std::optional<int> closed_on, const std::vector<BodyRef>& held_touches) {
             return Allowance{closed_on, held_touches};
           }),
           py::kw_only(), py::arg("closed_on") = py::none(),
           py::arg("held_touches") = std::vector<BodyRef>())
      .def_readwrite("closed_on", &Allowance::closed_on)
      .def_readwrite("held_touches", &Allowance::held_touches);
  py::class_<Hit>(m, "Hit",
                  "The pair that is in the way; distance [m] is 0 or less where they overlap.")
      .def_readonly("a", &Hit::a)
      .def_readonly("b", &Hit::b)
      .def_readonly("distance", &Hit::distance)
      .def("__repr__", [](const Hit& self) {
        return py::str("Hit('{}', '{}', {})").format(self.a, self.b, self.distance);
      });
  py::class_<CollisionChecker>(m, "CollisionChecker",
                               R"(Is the robot free of the cell and of itself?

One worker: not to be shared between threads.

Args:
    model: of the same robot, fixtures and parts.
    cell: where the parts are and what is held now.
    allowance: contacts that are part of the work.)")
      .def(py::init([](const std::shared_ptr<CollisionModel>& model, const Cell& cell,
                       const Allowance& allowance) {
             return std::make_unique<CollisionChecker>(model, cell, allowance);
           }),
           py::arg("model").none(false), py::arg("cell"), py::arg("allowance") = Allowance())
      .def_property_readonly("cell", [](const CollisionChecker& self) { return self.cell(); })
      .def("find_hit", &CollisionChecker::find_hit, py::arg("configuration"),
           py::arg("clearance") = 1e-4,
           "The first pair found not farther apart than clearance [m], or None.")
      .def("is_free", &CollisionChecker::is_free, py::arg("configuration"),
           py::arg("clearance") = 1e-4)
      .def("closest", &CollisionChecker::closest, py::arg("configuration"),
           py::arg("horizon") = 0.1,
           "The closest checked pair within the horizon [m]; names are empty if there is none.");
}

void bind_certificate(py::module_& m) {
  py::class_<CertificateOptions>(m, "CertificateOptions", "Options of certify_edge.")
      .def(py::init([](double clearance, double resolution) {
             return CertificateOptions{clearance, resolution};
           }),
           py::kw_only(), py::arg("clearance") = CertificateOptions().clearance,
           py::arg("resolution") = CertificateOptions().resolution)
      .def_readwrite("clearance", &CertificateOptions::clearance,
                     "Least distance proved along the edge [m].")
      .def_readwrite("resolution", &CertificateOptions::resolution,
                     "A stretch that moves no point farther and is not proved is given up [m].");
  py::enum_<EdgeStatus>(m, "EdgeStatus")
      .value("Free", EdgeStatus::Free)
      .value("Colliding", EdgeStatus::Colliding)
      .value("GivenUp", EdgeStatus::GivenUp);
  py::class_<EdgeResult>(m, "EdgeResult", "Whether an edge is proved free, and what is in the way.")
      .def_readonly("status", &EdgeResult::status)
      .def_readonly("hit", &EdgeResult::hit, "The pair in the way, unless free.")
      .def_readonly("at", &EdgeResult::at,
                    "Where along the edge, 0 to 1; on a path it counts edges.")
      .def_readonly("evaluations", &EdgeResult::evaluations, "Configurations looked at.")
      .def_property_readonly("is_free", &EdgeResult::is_free);
  m.def("certify_edge", &certify_edge, py::arg("checker"), py::arg("a"), py::arg("b"),
        py::arg("options") = CertificateOptions(), Unlocked(),
        R"(Prove that the straight joint-space edge from a to b is free.

An edge that is not proved is never called free.

Raises:
    InvalidInput: for wrong lengths or numbers that are not finite.)");
  m.def("certify_path", &certify_path, py::arg("checker"), py::arg("path"),
        py::arg("options") = CertificateOptions(), Unlocked(),
        "All edges of a path; the result is of the first that is not free.");
  m.def("motion_bound", &motion_bound, py::arg("checker"), py::arg("a"), py::arg("b"),
        "Upper bound on how far any point of robot and held part travels along the edge [m].");
}

void bind_overlaps(py::module_& m) {
  py::class_<Overlap>(m, "Overlap", "Two resting bodies that overlap.")
      .def_readonly("a", &Overlap::a)
      .def_readonly("b", &Overlap::b)
      .def_readonly("name_a", &Overlap::name_a)
      .def_readonly("name_b", &Overlap::name_b)
      .def_readonly("depth", &Overlap::depth,
                    "How far one must be moved to part them, at least [m].");
  m.def(
      "find_overlaps",
      [](const std::shared_ptr<CollisionModel>& model, const Cell& cell, double tolerance) {
        return find_overlaps(*model, cell, tolerance);
      },
      py::arg("model").none(false), py::arg("cell"), py::arg("tolerance") = 5e-4, Unlocked(),
      "Pairs of fixtures and parts, a part among them, that overlap deeper than tolerance [m].");
  m.def(
      "touching_bodies",
      [](const std::shared_ptr<CollisionModel>& model, const Cell& cell, int part, double gap) {
        return touching_bodies(*model, cell, part, gap);
      },
      py::arg("model").none(false), py::arg("cell"), py::arg("part"), py::arg("gap") = 6e-4,
      Unlocked(), "The bodies that a part touches where it stands, or nearly: within gap [m].");
  m.def("robot_overlaps", &robot_overlaps, py::arg("checker"), py::arg("configuration"),
        py::arg("tolerance") = 5e-4, Unlocked(),
        "Pairs of robot or held part and others that overlap deeper than tolerance [m].");
}

}  // namespace

void bind_collision(py::module_& m) {
  bind_model(m);
  bind_checker(m);
  bind_certificate(m);
  bind_overlaps(m);
}

}  // namespace handey::bindings
