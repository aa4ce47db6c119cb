// The checked form: intervals wider than WaistCell allows are cut, the hull of the parts' sections
// is the whole's.
#include "handey/cspace/cross_section.hpp"

#include <algorithm>
#include <cmath>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

void require_finite(double value, const char* place) {
  if (std::isfinite(value)) return;
  throw InvalidInput("E_NUMBER", place,
                     "found " + std::to_string(value) + ", expected a finite number");
}

void require_valid(const SceneHull& hull) {
  for (const Vector3d& point : hull.points) {
    if (!point.allFinite()) throw InvalidInput("E_NUMBER", "hull.points", "a point is not finite");
  }
  const int count = static_cast<int>(hull.points.size());
  for (const std::pair<int, int>& edge : hull.edges) {
    for (const int end : {edge.first, edge.second}) {
      if (end >= 0 && end < count) continue;
      throw InvalidInput("E_INDEX", "hull.edges",
                         "found point " + std::to_string(end) + ", the hull has " +
                             std::to_string(count) + " points");
    }
  }
}

}  // namespace

Polygon cross_section(const ArmPlane& plane, const SceneHull& hull, const Slab& slab, double q1,
                      double half_width) {
  require_finite(q1, "q1");
  require_valid(hull);
  if (!(slab.lower <= slab.upper)) {
    throw InvalidInput("E_RANGE", "slab",
                       "found " + std::to_string(slab.lower) + " to " + std::to_string(slab.upper) +
                           ", expected lower <= upper [m]");
  }
  if (!(half_width >= 0.0 && half_width <= kPi)) {
    throw InvalidInput("E_RANGE", "half_width",
                       "found " + std::to_string(half_width) + ", expected 0 to pi [rad]");
  }
  const int parts = std::max(1, static_cast<int>(std::ceil(half_width / WaistCell::kWidest)));
  const double part = half_width / parts;
  Polygon section;
  std::vector<Vector2d> points;
  for (int i = 0; i < parts; ++i) {
    WaistCell cell(plane, q1 - half_width + (2 * i + 1) * part, part);
    cell.cross_section(hull, slab, section);
    points.insert(points.end(), section.begin(), section.end());
  }
  return parts == 1 ? section : convex_hull(points);
}

}  // namespace handey
