// Floor approach: the approach, its search, the article's joined obstacles.
#include "handey/approach/approach.hpp"

#include "configurations.hpp"
#include "handey/approach/joined_destination.hpp"
#include "handey/approach/plane_search.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/collision/checker.hpp"
#include "handey/grasp/legality.hpp"
#include "handey/grasp/ranking.hpp"
#include "handey/kinematics/arm.hpp"
#include "handey/kinematics/spherical_wrist.hpp"
#include "interruptible.hpp"

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
          "As the article: obstacles moved by T^-1 stand in the way of the approaching hand too.")
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
        const Unlock unlock;
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

void bind_joined_destination(py::module_& m) {
  py::class_<JoinedScene>(m, "JoinedScene",
                          "The origin with copies of what is near the part at its destination.")
      .def_readonly("model", &JoinedScene::model)
      .def_readonly("cell", &JoinedScene::cell, "The copies are fixtures: 'wall (destination)'.")
      .def_readonly("copies", &JoinedScene::copies, "BodyRefs of the copies.")
      .def(
          "checker", [](const JoinedScene& joined) { return make_checker(joined); },
          "A CollisionChecker of that cell in which the hand alone is kept apart from the copies.");
  m.def("join_destination", &join_destination, Unlocked(), "scene"_a, "radius"_a = 0.4,
        R"(The article's obstacles: those near the destination, moved by T^-1, join the origin's.

Args:
    scene: GraspScene.
    radius: of bodies within that distance of the part's bounding box copies are made [m].

Returns:
    JoinedScene.

Raises:
    InvalidInput: for a part that the scene does not have, a radius out of range.
)");
}

}  // namespace

void bind_approach(py::module_& m) {
  bind_plane_search(m);
  bind_plan_approach(m);
  bind_joined_destination(m);
  bind_departure(m);
}

}  // namespace handey::bindings
