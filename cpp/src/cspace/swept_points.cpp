#include "swept_points.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

using Eigen::Vector3d;

constexpr double kArc = 0.7;  // Choice: an arc in parts of at most this stands out by 6 % [rad]

/// Through one joint, into the body before it.
std::vector<Vector3d> swept(const ArmJoint& joint, double lower, double upper,
                            const std::vector<Vector3d>& points) {
  const int parts = std::max(1, static_cast<int>(std::ceil((upper - lower) / kArc)));
  const double part = (upper - lower) / parts, outwards = 1.0 / std::cos(0.5 * part);
  struct Corner {
    double cosine, sine;
  };
  std::vector<Corner> corners;
  const auto add = [&corners](double angle, double scale) {
    corners.push_back({scale * std::cos(angle), scale * std::sin(angle)});
  };
  // Where two parts of the arc meet lies half way between the points out of their middles.
  add(lower, 1.0);
  for (int i = 0; i < parts && part > 0.0; ++i) add(lower + (i + 0.5) * part, outwards);
  if (part > 0.0) add(upper, 1.0);
  std::vector<Vector3d> all;
  all.reserve(points.size() * corners.size());
  for (const Vector3d& point : points) {
    const Vector3d along = joint.axis * joint.axis.dot(point);
    const Vector3d base = joint.X_PJ * along;
    const Vector3d radial = joint.X_PJ.linear() * (point - along);
    const Vector3d sideways = joint.X_PJ.linear() * joint.axis.cross(point);
    for (const Corner& corner : corners) {
      all.push_back(base + corner.cosine * radial + corner.sine * sideways);
    }
  }
  return all;
}

}  // namespace

std::vector<Vector3d> sweep_points(const Robot& robot, int from, int depth,
                                   const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                   std::vector<Vector3d> points) {
  for (int j = depth; j-- > from;) {
    points = swept(robot.joints[static_cast<std::size_t>(j)], lower(j - 3), upper(j - 3), points);
  }
  return points;
}

std::size_t sweep_growth(int from, int depth, const Eigen::VectorXd& lower,
                         const Eigen::VectorXd& upper) {
  double count = 1.0;
  for (int j = from; j < depth; ++j) {
    const double range = upper(j - 3) - lower(j - 3);
    if (range > 0.0) count *= 2.0 + std::ceil(range / kArc);
  }
  return static_cast<std::size_t>(std::min(count, 1e9));
}

}  // namespace handey::cspace
