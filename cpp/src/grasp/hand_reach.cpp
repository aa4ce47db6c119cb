// The distance of a convex hull from a disc by Gilbert's method, which gives a lower bound at each
// step: that of the plane square to the line to the nearest point so far.
#include "handey/grasp/hand_reach.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "handey/errors.hpp"

namespace handey {
namespace {

// Of a valid plan: a pad lies within this of the part's surface [m]; twice, one for each pad.
constexpr double kPadGap = 2.0 * 5e-4;
constexpr int kSteps = 64;           // Choice: converges to micrometres long before
constexpr double kConverged = 1e-6;  // [m]

/// The point of the disc that is farthest along a direction.
Eigen::Vector3d farthest_of_disc(const WristReach& reach, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d across = direction - reach.axis * reach.axis.dot(direction);
  const double length = across.norm();
  if (length < 1e-12) return reach.centre;
  return reach.centre + across * (reach.radius / length);
}

double distance_at_least(const std::vector<Eigen::Vector3d>& points, const WristReach& reach) {
  Eigen::Vector3d nearest = points.front() - reach.centre;  // in the set of all differences
  double bound = 0.0;
  for (int step = 0; step < kSteps && nearest.norm() > kConverged; ++step) {
    const Eigen::Vector3d direction = nearest.normalized();
    const Eigen::Vector3d point = *std::min_element(
        points.begin(), points.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
          return direction.dot(a) < direction.dot(b);
        });
    const Eigen::Vector3d support = point - farthest_of_disc(reach, direction);
    bound = std::max(bound, direction.dot(support));
    if (nearest.norm() - bound < kConverged) break;
    // The point of the segment from `nearest` to `support` that is nearest to zero.
    const Eigen::Vector3d segment = support - nearest;
    const double share = std::clamp(-nearest.dot(segment) / segment.squaredNorm(), 0.0, 1.0);
    nearest += share * segment;
  }
  return bound;
}

}  // namespace

double hand_length(const WristReach& reach, const Gripper& gripper) {
  double longest = 0.0;
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.5, 0.5}) {
      const Eigen::Vector3d corner(x * gripper.pad_width, 0.0, z * gripper.pad_length);
      longest = std::max(longest, (corner - reach.p_HC).norm());
    }
  }
  return longest + kPadGap;
}

double beyond_reach(const WristReach& reach, const Gripper& gripper, const Body& part,
                    const Pose& X_RP) {
  require_rigid(X_RP, "X_RP");
  std::vector<Eigen::Vector3d> points;
  for (const Shape& shape : part.shapes) {
    require_valid(shape, part.name);
    for (const Eigen::Vector3d& point : hull_points(shape)) points.push_back(X_RP * point);
  }
  if (points.empty()) {
    throw InvalidInput("E_GEOMETRY", part.name, "has no shapes, expected at least one");
  }
  return distance_at_least(points, reach) - reach.farthest - hand_length(reach, gripper);
}

}  // namespace handey
