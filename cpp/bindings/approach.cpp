// Floor approach: the approach, its search, the retreat.
#include "handey/approach/approach.hpp"

#include "configurations.hpp"
#include "handey/approach/plane_search.hpp"
#include "handey/approach/retreat.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/collision/checker.hpp"
#include "handey/grasp/legality.hpp"
#include "handey/grasp/ranking.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

void bind_plane_search(py::module_& m) {
  const PlaneSearchOptions defaults;
  py::class_<PlaneSearchOptions>(m, "PlaneSearchOptions",
                                 "Options of the complete search in the grasp plane.")
      .def(py::init([](int directions, double close_cost, int most_tests) {
             return PlaneSearchOptions{directions, close_cost, most_tests};
           }),
           py::kw_only(), "directions"_a = defaults.directions,
           "close_cost"_a = defaults.close_cost, "most_tests"_a = defaults.most_tests)
      .def_readwrite("directions", &PlaneSearchOptions::directions,
                     "Of the hand, evenly spaced; 4 to 3600.")
      .def_readwrite("close_cost", &PlaneSearchOptions::close_cost,
                     "A step to a point where the hand shares a cell with an obstacle costs so "
                     "much more; 1 to 20.")
      .def_readwrite("most_tests", &PlaneSearchOptions::most_tests,
                     "Poses of the arm tried in one search.");
}

void bind_plan_approach(py::module_& m) {
  const ApproachOptions defaults;
  py::class_<ApproachOptions>(m, "ApproachOptions", "Options of plan_approach.")
      .def(py::init([](double cell, double run_in, double least_run_in, int most_slides,
                       const QuasipotentialOptions& slide, const LegalityOptions& legality,
                       const CertificateOptions& certificate, double contact_share,
                       bool destination_obstacles_join, const PlaneSearchOptions& search,
                       int search_levels) {
             return ApproachOptions{cell,        run_in,        least_run_in,
                                    most_slides, slide,         legality,
                                    certificate, contact_share, destination_obstacles_join,
                                    search,      search_levels};
           }),
           py::kw_only(), "cell"_a = defaults.cell, "run_in"_a = defaults.run_in,
           "least_run_in"_a = defaults.least_run_in, "most_slides"_a = defaults.most_slides,
           "slide"_a = defaults.slide, "legality"_a = defaults.legality,
           "certificate"_a = defaults.certificate, "contact_share"_a = defaults.contact_share,
           "destination_obstacles_join"_a = defaults.destination_obstacles_join,
           "search"_a = defaults.search, "search_levels"_a = defaults.search_levels)
      .def_readwrite("cell", &ApproachOptions::cell, "Of the motion grid [m].")
      .def_readwrite("run_in", &ApproachOptions::run_in,
                     "Distance of the start from the grasp [m].")
      .def_readwrite("least_run_in", &ApproachOptions::least_run_in, "The shortest one tried [m].")
      .def_readwrite("most_slides", &ApproachOptions::most_slides)
      .def_readwrite("slide", &ApproachOptions::slide)
      .def_readwrite("legality", &ApproachOptions::legality)
      .def_readwrite("certificate", &ApproachOptions::certificate)
      .def_readwrite("contact_share", &ApproachOptions::contact_share,
                     "Accepted overlap of the pad with the unobstructed faces.")
      .def_readwrite(
          "destination_obstacles_join", &ApproachOptions::destination_obstacles_join,
          "As the article: obstacles moved by T^-1 hinder the approach; only slides are tried.")
      .def_readwrite("search", &ApproachOptions::search)
      .def_readwrite("search_levels", &ApproachOptions::search_levels,
                     "Lattices searched where the slides stall, each half as wide; 0: no search.");
  py::enum_<ApproachStatus>(m, "ApproachStatus", "How an approach ended.")
      .value("Found", ApproachStatus::Found)
      .value("StartBlocked", ApproachStatus::StartBlocked)
      .value("Stalled", ApproachStatus::Stalled)
      .value("PoorOverlap", ApproachStatus::PoorOverlap)
      .value("IllegalAtDestination", ApproachStatus::IllegalAtDestination)
      .value("NotCertified", ApproachStatus::NotCertified);
  py::enum_<ApproachPlanner>(m, "ApproachPlanner",
                             "Which planner found the way in, in the order they are asked.")
      .value("Straight", ApproachPlanner::Straight)
      .value("Quasipotential", ApproachPlanner::Quasipotential)
      .value("PlaneSearch", ApproachPlanner::PlaneSearch)
      .value("Arm", ApproachPlanner::Arm);
  py::class_<ApproachResult>(m, "ApproachResult",
                             "An approach, or why there is none; true if found.")
      .def_readonly("status", &ApproachResult::status)
      .def_readonly("planner", &ApproachResult::planner,
                    "ApproachPlanner that found it; the last one asked, if none did.")
      .def_readonly("reason", &ApproachResult::reason, "Why not found, with names and numbers.")
      .def_readonly("grasp", &ApproachResult::grasp,
                    "GraspPose where the slide ended; its q_pick is the path's end alone.")
      .def_readonly("path", &ApproachResult::path,
                    "Configurations from the start to the grasp, hand open; every edge certified.")
      .def_readonly("slide", &ApproachResult::slide, "SlideResult in the grasp plane.")
      .def_property_readonly("found", &ApproachResult::found)
      .def("__bool__", &ApproachResult::found);
  m.def(
      "plan_approach",
      [](const GraspScene& scene, const SphericalWristSolver& solver, const RankedPair& pair,
         const GraspPose& aim, const py::object& q_pick, const ApproachOptions& options) {
        const Eigen::VectorXd q = joint_vector(q_pick, "q_pick");
        const py::gil_scoped_release release;
        return plan_approach(scene, solver, pair, aim, q, options);
      },
      "scene"_a, "solver"_a, "pair"_a, "aim"_a, "q_pick"_a, "options"_a = defaults,
      R"(Plan how the open hand comes to a grasp: step 4 of the article.

The hand slides in the grasp plane from a start off the part to the fingertip target, the arm follows.
Incomplete: a slide may stall; then other starts are taken.

Args:
    scene: GraspScene.
    solver: SphericalWristSolver of the scene's robot.
    pair: RankedPair whose grasp plane is slid in.
    aim: GraspPose to reach; where the slide stops short of it, the stop is tested as a grasp.
    q_pick: (joints,) one of aim.q_pick; the arm stays in its branch [rad].
    options: ApproachOptions.

Returns:
    ApproachResult.

Raises:
    InvalidInput: for options out of range, a hand that is not empty, a q_pick not at the aim.
)");
}

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
      .def_readonly("reason", &RetreatResult::reason, "What stopped it, with names and numbers.")
      .def("__bool__", [](const RetreatResult& result) { return result.found; });
  m.def(
      "plan_retreat",
      [](CollisionChecker& in_contact, CollisionChecker& clear, const SphericalWristSolver& solver,
         const Configuration& start, const py::object& direction, const RetreatOptions& options) {
        const Eigen::Vector3d along = real_vector<3>(direction, "direction");
        const py::gil_scoped_release release;
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

}  // namespace

void bind_approach(py::module_& m) {
  bind_plane_search(m);
  bind_plan_approach(m);
  bind_retreat(m);
}

}  // namespace handey::bindings
