// Floor approach: the ways out, straight and in the grasp plane.
#include "handey/approach/departure.hpp"

#include "configurations.hpp"
#include "handey/approach/retreat.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/collision/checker.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/kinematics/spherical_wrist.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

void bind_retreat(py::module_& m) {
  const RetreatOptions defaults;
  py::class_<RetreatOptions>(m, "RetreatOptions", "Options of plan_retreat.")
      .def(py::init([](double least, double most, double step, double contact_travel, double room,
                       const CertificateOptions& certificate) {
             return RetreatOptions{least, most, step, contact_travel, room, certificate};
           }),
           py::kw_only(), "least"_a = defaults.least, "most"_a = defaults.most,
           "step"_a = defaults.step, "contact_travel"_a = defaults.contact_travel,
           "room"_a = defaults.room, "certificate"_a = defaults.certificate)
      .def_readwrite("least", &RetreatOptions::least, "A shorter retreat is a failure [m].")
      .def_readwrite("most", &RetreatOptions::most, "Where it stops [m].")
      .def_readwrite("step", &RetreatOptions::step, "Between two hand poses [m].")
      .def_readwrite("contact_travel", &RetreatOptions::contact_travel,
                     "First step, with contacts allowed [m].")
      .def_readwrite("room", &RetreatOptions::room,
                     "Ends at the farthest point where the first three joints are free by so much "
                     "[rad]; 0: not asked.")
      .def_readwrite("certificate", &RetreatOptions::certificate);
  py::class_<RetreatResult>(m, "RetreatResult", "A retreat, or why there is none; true if found.")
      .def_readonly("found", &RetreatResult::found)
      .def_readonly("path", &RetreatResult::path,
                    "Configurations from the contact outwards; every edge certified.")
      .def_readonly("travelled", &RetreatResult::travelled, "[m]")
      .def_readonly("has_room", &RetreatResult::has_room,
                    "It ends where RetreatOptions.room is free; false if that was not asked.")
      .def_readonly("reason", &RetreatResult::reason, "What stopped it, with names and numbers.")
      .def("__bool__", [](const RetreatResult& result) { return result.found; });
  m.def(
      "plan_retreat",
      [](CollisionChecker& in_contact, CollisionChecker& clear, const SphericalWristSolver& solver,
         const Configuration& start, const py::object& direction, const RetreatOptions& options) {
        const Eigen::Vector3d along = real_vector<3>(direction, "direction");
        const Unlock unlock;
        return plan_retreat(in_contact, clear, solver, start, along, options);
      },
      "in_contact"_a, "clear"_a, "solver"_a, "start"_a, "direction"_a, "options"_a = defaults,
      R"(Move the hand straight out of contact, with what it holds.

The first short step may touch what was touched before, if no contact deepens; from there on every edge is
certified against everything. Reversed it is a deposit.

Args:
    in_contact: CollisionChecker with the contacts allowed; may be the same as clear.
    clear: CollisionChecker without them.
    solver: SphericalWristSolver of the robot.
    start: Configuration in contact.
    direction: (3,) unit vector of the hand's motion in the world.
    options: RetreatOptions.

Returns:
    RetreatResult.

Raises:
    InvalidInput: for wrong lengths, numbers or options.
)");
}

void bind_plan_departure(py::module_& m) {
  const DepartureOptions defaults;
  py::class_<DepartureOptions>(m, "DepartureOptions", "Options of plan_departure.")
      .def(py::init([](double cell, double least, double most, double clearance, double room,
                       int most_slides, const QuasipotentialOptions& slide,
                       const PlaneSearchOptions& search, int search_levels,
                       const CertificateOptions& certificate) {
             return DepartureOptions{cell,        least, most,   clearance,     room,
                                     most_slides, slide, search, search_levels, certificate};
           }),
           py::kw_only(), "cell"_a = defaults.cell, "least"_a = defaults.least,
           "most"_a = defaults.most, "clearance"_a = defaults.clearance, "room"_a = defaults.room,
           "most_slides"_a = defaults.most_slides, "slide"_a = defaults.slide,
           "search"_a = defaults.search, "search_levels"_a = defaults.search_levels,
           "certificate"_a = defaults.certificate)
      .def_readwrite("cell", &DepartureOptions::cell, "Of grid and lattice [m].")
      .def_readwrite("least", &DepartureOptions::least, "It ends no nearer to its start [m].")
      .def_readwrite("most", &DepartureOptions::most,
                     "Out is that far from the start; it may then end before [m].")
      .def_readwrite("clearance", &DepartureOptions::clearance,
                     "Of the whole robot at the poses tried [m].")
      .def_readwrite(
          "room", &DepartureOptions::room,
          "Ends at the last pose where the first three joints are free by so much [rad]; "
          "0: not asked.")
      .def_readwrite("most_slides", &DepartureOptions::most_slides, "0: none.")
      .def_readwrite("slide", &DepartureOptions::slide)
      .def_readwrite("search", &DepartureOptions::search)
      .def_readwrite("search_levels", &DepartureOptions::search_levels,
                     "Lattices searched where no slide comes in, each half as wide; 0: no search.")
      .def_readwrite("certificate", &DepartureOptions::certificate);
  py::class_<DepartureResult>(m, "DepartureResult",
                              "A way out in the grasp plane, or why there is none; true if found.")
      .def_readonly("found", &DepartureResult::found)
      .def_readonly("planner", &DepartureResult::planner,
                    "ApproachPlanner that found it, or was asked last.")
      .def_readonly("path", &DepartureResult::path,
                    "Configurations from the start outwards; every edge certified.")
      .def_readonly("poses", &DepartureResult::poses,
                    "PlanarPose of the hand before the path was shortened; the start is (0, 0, 0).")
      .def_readonly("has_room", &DepartureResult::has_room,
                    "It ends where DepartureOptions.room is free; false if that was not asked.")
      .def_readonly("reason", &DepartureResult::reason, "Why not found, with names and numbers.")
      .def("__bool__", [](const DepartureResult& result) { return result.found; });
  m.def("plan_departure", &plan_departure, Unlocked(), "checker"_a, "solver"_a, "start"_a,
        "options"_a = defaults,
        R"(The way out in the grasp plane, for a hand that holds a part or is open round one.

The planners of the approach with the held part as part of the hand: the slide in from where there is room,
driven backwards; then the complete search in (x, y, theta). A way out of the plane is not looked for.

Args:
    checker: CollisionChecker of the cell with what is held.
    solver: SphericalWristSolver of the robot.
    start: Configuration, free; its hand's x and z axes span the plane.
    options: DepartureOptions.

Returns:
    DepartureResult.

Raises:
    InvalidInput: for wrong lengths, numbers or options, a start that is not free.
)");
}

}  // namespace

void bind_departure(py::module_& m) {
  bind_retreat(m);
  bind_plan_departure(m);
}

}  // namespace handey::bindings
