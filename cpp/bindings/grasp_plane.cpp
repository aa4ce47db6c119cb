// Floor approach, in the grasp plane: motion grid, gripper outline and bump lines, the slide, the
// way of greatest clearance.
#include <pybind11/functional.h>

#include <algorithm>

#include "configurations.hpp"
#include "handey/approach/bump_lines.hpp"
#include "handey/approach/clearance_path.hpp"
#include "handey/approach/grid.hpp"
#include "handey/approach/quasipotential.hpp"
#include "handey/collision/checker.hpp"

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

}  // namespace

void bind_grasp_plane(py::module_& m) {
  bind_grid(m);
  bind_bump_lines(m);
  bind_slide(m);
  bind_clearance_path(m);
}

}  // namespace handey::bindings
