// Height maps and depth images as columns, and their covers as bodies.
#include "handey/world/depth_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "column_cover.hpp"
#include "depth_image.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

void require_valid(const DepthMapOptions& options) {
  const auto require = [](double value, double least, const char* place) {
    if (std::isfinite(value) && value >= least) return;
    throw InvalidInput("E_RANGE", place,
                       "found " + std::to_string(value) +
                           ", expected a finite number >= " + std::to_string(least));
  };
  require(options.excess, 1e-6, "excess");
  require(options.growth, 0.0, "growth");
  require(options.most_excess, 1e-6, "most_excess");
  require(options.exact_within, 0.0, "exact_within");
  require(options.most_solids, 1, "most_solids");
  if (options.reach) require(*options.reach, 0.0, "reach");
  if (!options.reach_centre.allFinite()) {
    throw InvalidInput("E_NUMBER", "reach_centre", "is not finite");
  }
  for (const Body& place : options.places) {
    require_rigid(place.X_WB, "places." + place.name);
    for (const Shape& shape : place.shapes) require_valid(shape, "places." + place.name);
  }
}

/// Heights as they count: NaN as high as the highest. @throws InvalidInput
std::vector<double> solid_heights(const HeightMap& map) {
  if (map.rows < 1 || map.columns < 1 ||
      map.heights.size() !=
          static_cast<std::size_t>(map.rows) * static_cast<std::size_t>(map.columns)) {
    throw InvalidInput("E_IMAGE", "heights",
                       std::to_string(map.heights.size()) + " heights for " +
                           std::to_string(map.rows) + " rows and " + std::to_string(map.columns) +
                           " columns");
  }
  if (!std::isfinite(map.cell) || !(map.cell > 0.0)) {
    throw InvalidInput("E_RANGE", "cell",
                       "found " + std::to_string(map.cell) + ", expected a length > 0 [m]");
  }
  require_rigid(map.X_WD, "X_WD");
  double highest = -std::numeric_limits<double>::infinity();
  for (const double height : map.heights) {
    if (std::isinf(height)) throw InvalidInput("E_NUMBER", "heights", "a height is infinite");
    if (height > highest) highest = height;
  }
  if (!std::isfinite(highest)) throw InvalidInput("E_IMAGE", "heights", "no entry is measured");
  std::vector<double> heights = map.heights;
  for (double& height : heights) {
    if (std::isnan(height)) height = highest;
  }
  return heights;
}

MeasuredBody cover(const std::string& name, world::Columns columns, const Pose& X_WD,
                   const DepthMapOptions& options) {
  const world::Cover found = world::cover_columns(std::move(columns), X_WD, options);
  MeasuredBody measured;
  measured.body.name = name;
  measured.body.X_WB = X_WD;
  measured.excess = found.excess;
  measured.exact_at_places = found.exact_at_places;
  for (const world::Prism& solid : found.solids) {
    measured.body.shapes.push_back(world::shape_of(solid));
  }
  return measured;
}

}  // namespace

MeasuredBody cover_heights(const std::string& name, const HeightMap& map,
                           const DepthMapOptions& options) {
  require_valid(options);
  world::Columns columns{map.rows, map.columns, solid_heights(map), {}, {}};
  columns.lower.assign(columns.upper.size(), 0.0);
  columns.space.cell = map.cell;
  for (double& height : columns.upper) {
    if (!(height > 0.0)) height = kNothing;
  }
  return cover(name, std::move(columns), map.X_WD, options);
}

MeasuredBody cover_depths(const std::string& name, const DepthImage& image,
                          const std::vector<char>& explained, const DepthMapOptions& options) {
  require_valid(options);
  world::require_valid(image);
  if (!explained.empty() && explained.size() != image.depths.size()) {
    throw InvalidInput("E_IMAGE", "explained",
                       std::to_string(explained.size()) + " entries for " +
                           std::to_string(image.depths.size()) + " pixels");
  }
  world::Columns columns{image.rows, image.columns, world::closed_holes(image), {}, {}};
  columns.space = {true, 0.0, image.fx, image.fy, image.cx, image.cy};
  columns.lower.resize(columns.upper.size());
  for (std::size_t i = 0; i < columns.upper.size(); ++i) {
    const double depth = columns.upper[i];
    const bool taken_out = !explained.empty() && explained[i] != 0;
    columns.upper[i] = taken_out ? kNothing : 1.0 / depth;
    columns.lower[i] = taken_out ? kNothing : 1.0 / (depth + image.far);
  }
  return cover(name, std::move(columns), image.X_WD, options);
}

ReachBall reach_ball(const Cell& cell) {
  require_valid(cell);
  const Robot& robot = *cell.robot;
  ReachBall ball;
  if (robot.joints.empty()) return ball;
  const auto extent = [](const std::vector<Shape>& shapes) {
    double radius = 0.0;
    for (const Shape& shape : shapes) {
      for (const Eigen::Vector3d& point : hull_points(shape))
        radius = std::max(radius, point.norm());
    }
    return radius;
  };
  double parts = 0.0;  // of what may be held: it hangs somewhere within the jaws
  for (const Body& part : cell.parts) parts = std::max(parts, 2.0 * extent(part.shapes));
  // From the second joint outward: the first turns the ball about a line near its centre.
  double chain = 0.0;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (j > 0) chain += robot.joints[j].X_PJ.translation().norm();
    const std::size_t child = static_cast<std::size_t>(robot.joints[j].child);
    ball.radius = std::max(ball.radius, chain + extent(robot.bodies[child].shapes));
  }
  const Gripper& gripper = robot.gripper;
  for (const FingerJoint& finger : gripper.fingers) {
    const std::size_t child = static_cast<std::size_t>(finger.child);
    ball.radius =
        std::max(ball.radius, chain + finger.X_PJ.translation().norm() + 0.5 * gripper.max_opening +
                                  extent(robot.bodies[child].shapes));
  }
  ball.radius = std::max(ball.radius,
                         chain + gripper.X_BH.translation().norm() + gripper.max_opening + parts);
  // The first joint's frame stands still in the base.
  ball.centre = cell.X_WR * robot.joints.front().X_PJ.translation();
  return ball;
}

}  // namespace handey
