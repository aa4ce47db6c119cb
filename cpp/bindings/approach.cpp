// Floor approach: motion grid, gripper outline and bump lines, the slide, the approach, the
// retreat.
#include <pybind11/functional.h>

#include <algorithm>

#include "configurations.hpp"
#include "handey/approach/clearance_path.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

py::array_t<bool> filled(const MotionGrid& grid, int layer) {
  if (layer < 0 || layer >= grid.layers()) {
    throw InvalidInput(
        "E_RANGE", "layer",
        std::to_string(layer) + "; the grid has layers 0 to " + std::to_string(grid.layers() - 1));
  }
  py::array_t<bool> cells({grid.side(), grid.side()});
  for (int row = 0; row < grid.side(); ++row) {
    for (int column = 0; column < grid.side(); ++column) {
      cells.mutable_at(row, column) = grid.is_filled(layer, column, row);
    }
  }
  return cells;
}

void bind_grid(py::module_& m) {
  py::class_<MotionGrid>(m, "MotionGrid",
                         R"(Filled cells of the grasp plane, one layer a gripper piece.

A cell that an obstacle touches is filled; outside the grid all is free.

Args:
    centre: (2,) centre of the square in the grasp plane [m].
    half_size: the grid covers |x|, |y| <= half_size about it [m].
    cell: side of a cell [m].
    layers: number of layers, 1 to 256.

Raises:
    InvalidInput: for sizes that are not positive or more than 4096 cells a side.
)")
      .def(py::init([](const py::object& centre, double half_size, double cell, int layers) {
             return MotionGrid(real_vector<2>(centre, "centre"), half_size, cell, layers);
           }),
           "centre"_a, "half_size"_a, "cell"_a, "layers"_a)
      .def_property_readonly("cell", &MotionGrid::cell, "Side of a cell [m].")
      .def_property_readonly("side", &MotionGrid::side, "Cells a side.")
      .def_property_readonly("layers", &MotionGrid::layers)
      .def_property_readonly("half_size", &MotionGrid::half_size, "[m]")
      .def_property_readonly(
          "centre", [](const MotionGrid& grid) { return Eigen::Vector2d(grid.centre()); },
          "(2,) [m].")
      .def(
          "is_inside",
          [](const MotionGrid& grid, const py::object& point) {
            return grid.is_inside(real_vector<2>(point, "point"));
          },
          "point"_a, "Whether the point (2,) [m] lies on the grid.")
      .def("fill", &MotionGrid::fill, "layer"_a, "region"_a,
           R"(Fill every cell of a layer that a region touches.

Args:
    layer: index of the layer.
    region: Region in the grasp plane [m].
)")
      .def("filled", &filled, "layer"_a,
           "Cells of a layer as (side, side) bools, row along y, column along x.")
      .def(
          "touches",
          [](const MotionGrid& grid, int layer, const py::object& a, const py::object& b) {
            if (layer < 0 || layer >= grid.layers()) {
              throw InvalidInput("E_RANGE", "layer", "no such layer");
            }
            return grid.touches(layer, real_vector<2>(a, "a"), real_vector<2>(b, "b"));
          },
          "layer"_a, "a"_a, "b"_a,
          "Whether the segment from a (2,) to b (2,) [m] touches a filled cell of the layer.");
}

void bind_bump_lines(py::module_& m) {
  py::class_<OutlinePiece>(m, "OutlinePiece",
                           R"(A convex piece of the gripper seen in the grasp plane.

Args:
    polygon: (n, 2) convex, counter-clockwise, in hand coordinates: along z of H, along x of H
        (of a hand that is not flipped) [m].
    lower, upper: extent along the closing axis, from the grasp plane [m].
)")
      .def(py::init([](const py::object& polygon, double lower, double upper) {
             return OutlinePiece{real_rows<2>(polygon, "polygon"), lower, upper};
           }),
           "polygon"_a, py::kw_only(), "lower"_a = 0.0, "upper"_a = 0.0)
      .def_property_readonly(
          "polygon", [](const OutlinePiece& piece) { return rows_of<2>(piece.polygon); },
          "(n, 2) [m].")
      .def_readonly("lower", &OutlinePiece::lower, "[m]")
      .def_readonly("upper", &OutlinePiece::upper, "[m]");
  py::class_<GripperOutline>(m, "GripperOutline", "The gripper at one opening: its pieces.")
      .def(py::init([](const std::vector<OutlinePiece>& pieces) {
             GripperOutline outline{pieces, 0.0};
             for (const OutlinePiece& piece : pieces) {
               for (const Eigen::Vector2d& point : piece.polygon) {
                 outline.radius = std::max(outline.radius, point.norm());
               }
             }
             return outline;
           }),
           "pieces"_a)
      .def_readonly("pieces", &GripperOutline::pieces)
      .def_readonly("radius", &GripperOutline::radius,
                    "Farthest point from the finger grasp point [m].");
  m.def("gripper_outline", &gripper_outline, "robot"_a, "opening"_a, "flipped"_a, "depth"_a = 0.25,
        R"(Pieces of the fingers and of the hand's body in the grasp plane.

Args:
    robot: Robot.
    opening: distance between the pads [m].
    flipped: the hand turned half round about its approach axis.
    depth: what lies farther behind the finger grasp point is left out [m].

Returns:
    GripperOutline.

Raises:
    InvalidInput: for an opening outside the gripper's, a depth that is not positive.
)");
  py::class_<BumpLine>(m, "BumpLine",
                       "A segment off the gripper; its outward normal is its bump vector.")
      .def_property_readonly(
          "a", [](const BumpLine& line) { return Eigen::Vector2d(line.a); },
          "(2,) in the hand [m].")
      .def_property_readonly(
          "b", [](const BumpLine& line) { return Eigen::Vector2d(line.b); },
          "(2,) in the hand [m].")
      .def_property_readonly(
          "normal", [](const BumpLine& line) { return Eigen::Vector2d(line.normal); }, "(2,) unit.")
      .def_readonly("layer", &BumpLine::layer, "Index of its piece.");
  m.def("bump_lines", &bump_lines, "outline"_a, "clearance"_a,
        R"(The edges of each piece grown by the clearance.

Args:
    outline: GripperOutline.
    clearance: distance from the gripper [m].

Returns:
    List of BumpLine, counter-clockwise round each piece.

Raises:
    InvalidInput: for a clearance that is not positive, a piece that is not convex.
)");
}

void bind_slide(py::module_& m) {
  const QuasipotentialOptions defaults;
  py::class_<QuasipotentialOptions>(m, "QuasipotentialOptions", "Options of slide_to_target.")
      .def(py::init([](double clearance, int max_iterations, int progress_interval,
                       double torque_gain, double lead) {
             return QuasipotentialOptions{clearance, max_iterations, progress_interval, torque_gain,
                                          lead};
           }),
           py::kw_only(), "clearance"_a = defaults.clearance,
           "max_iterations"_a = defaults.max_iterations,
           "progress_interval"_a = defaults.progress_interval,
           "torque_gain"_a = defaults.torque_gain, "lead"_a = defaults.lead)
      .def_readwrite("clearance", &QuasipotentialOptions::clearance,
                     "Bump-line distance from the gripper, at least 1.5 cells [m].")
      .def_readwrite("max_iterations", &QuasipotentialOptions::max_iterations)
      .def_readwrite("progress_interval", &QuasipotentialOptions::progress_interval,
                     "Iterations between two looks at the progress.")
      .def_readwrite("torque_gain", &QuasipotentialOptions::torque_gain,
                     "Turn per torque, before the one-cell limit [rad/m].")
      .def_readwrite("lead", &QuasipotentialOptions::lead,
                     "The attraction point of slide_along moves so far ahead [m].");
  py::enum_<SlideStatus>(m, "SlideStatus", "How a slide ended.")
      .value("Reached", SlideStatus::Reached)
      .value("Stalled", SlideStatus::Stalled)
      .value("IterationLimit", SlideStatus::IterationLimit)
      .value("StartBlocked", SlideStatus::StartBlocked);
  py::class_<SlideResult>(m, "SlideResult", "The way of the hand in the grasp plane.")
      .def_readonly("status", &SlideResult::status)
      .def_readonly("path", &SlideResult::path,
                    "List of PlanarPose; ends on the target, or where it came nearest.")
      .def_readonly("iterations", &SlideResult::iterations)
      .def_readonly("refusals", &SlideResult::refusals, "Steps that the reach test refused.");
  // Called back with the GIL held; what it raises is raised here.
  const auto reach_test = [](const py::object& reachable) {
    if (!reachable.is_none() && !PyCallable_Check(reachable.ptr())) {
      throw py::type_error("reachable must be a callable or None");
    }
    return ReachTest([reachable](const PlanarPose& pose) {
      return reachable.is_none() || py::bool_(reachable(pose)).cast<bool>();
    });
  };
  m.def(
      "slide_to_target",
      [reach_test](const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& start,
                   const py::object& target, const py::object& reachable,
                   const QuasipotentialOptions& options) {
        return slide_to_target(grid, outline, start, real_vector<2>(target, "target"),
                               reach_test(reachable), options);
      },
      "grid"_a, "outline"_a, "start"_a, "target"_a, "reachable"_a = py::none(),
      "options"_a = defaults,
      R"(Slide the gripper from a start toward a target: the article's quasipotential method.

Bump lines that touch filled cells forbid motion their way and turn the gripper. May stall in a local
minimum, and says so. No pose of the path has a piece of the gripper on a filled cell.

Args:
    grid: MotionGrid with one layer for each piece of the outline.
    outline: GripperOutline.
    start: PlanarPose.
    target: (2,) where the finger grasp point is to go [m].
    reachable: called with each PlanarPose before it is taken; on False another direction is tried. What
        it raises is raised here. None: everything is reachable.
    options: QuasipotentialOptions.

Returns:
    SlideResult.

Raises:
    InvalidInput: if start or target lie outside the grid, layers and pieces differ in number, or an
        option is out of range.
)");
  m.def(
      "slide_along",
      [reach_test](const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& start,
                   const py::object& route, const py::object& reachable,
                   const QuasipotentialOptions& options) {
        return slide_along(grid, outline, start, real_rows<2>(route, "route"),
                           reach_test(reachable), options);
      },
      "grid"_a, "outline"_a, "start"_a, "route"_a, "reachable"_a = py::none(),
      "options"_a = defaults,
      R"(Slide the gripper with an attraction point that moves along a route.

As slide_to_target; clearance_path gives good routes.

Args:
    grid: MotionGrid with one layer for each piece of the outline.
    outline: GripperOutline.
    start: PlanarPose.
    route: (n, 2) points on the grid, the last one the target [m].
    reachable: as of slide_to_target.
    options: QuasipotentialOptions; `lead` tells how far ahead the attraction point is.

Returns:
    SlideResult.

Raises:
    InvalidInput: as slide_to_target.
)");
}

void bind_clearance_path(py::module_& m) {
  py::class_<ClearancePath>(m, "ClearancePath",
                            "The way of greatest clearance to a target; true if there is one.")
      .def_property_readonly(
          "points", [](const ClearancePath& path) { return rows_of<2>(path.points); },
          "(n, 2) from the border to the target [m].")
      .def_readonly("clearance", &ClearancePath::clearance,
                    "The least on the way, but for its last three cells [m].")
      .def_readonly("whole_hand", &ClearancePath::whole_hand,
                    "False: found for the finger tips alone.")
      .def("__bool__", &ClearancePath::found);
  m.def("clearance_path", &clearance_path, "grid"_a, "outline"_a, "target"_a, "exit"_a,
        "enough"_a = 0.02,
        R"(The way of greatest clearance for the hand that keeps its direction.

Args:
    grid: MotionGrid with one layer for each piece of the outline.
    outline: GripperOutline.
    target: PlanarPose.
    exit: the way begins that far from the target [m].
    enough: more clearance is worth nothing [m].

Returns:
    ClearancePath; where the whole hand has none, that of its finger tips.

Raises:
    InvalidInput: for layers and pieces that differ in number, a target off the grid, lengths that
        are not positive or more than 2 m.
)");
}

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
  bind_grid(m);
  bind_bump_lines(m);
  bind_slide(m);
  bind_clearance_path(m);
  bind_plane_search(m);
  bind_plan_approach(m);
  bind_retreat(m);
}

}  // namespace handey::bindings
