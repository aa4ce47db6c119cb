// In E the obstacle turns about the waist's line. Let v be a point of it at the interval's middle,
// from a point of that line along a. After a turn by phi
//   v(phi) = v - sin(phi) a x v - (1 - cos(phi)) (v - a (a.v)),
// which is linear in v for each phi. Two things follow, for |phi| <= eta.
// Clip: with m = z x a, n = z - a (a.z) the lateral coordinate changes by
//   -sin(phi) m.v - (1 - cos(phi)) n.v, no more than sin(eta) |m.v| + (1 - cos(eta)) |n.v|,
// and over the hull |m.v| lies below its chord, which is linear in v: what reaches the slab at some
// phi lies between two planes, tilted so that far points are clipped later than near ones. The
// planes do not meet within the hull, so the corners between them are vertices, and points of
// edges.
// Sweep: at each phi the section is in the hull of the corners' positions, and a corner's arc is in
// the triangle of its ends and the point where the tangents at the ends meet, a / cos(eta) out. For
// axes 1 and 2 at right angles these are three points of a line along x, of height a.v: no growth
// in height, and sin(eta) times the lateral coordinate (and 1 / cos(eta)) in x.
#include "handey/cspace/cross_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-9;  // [m]
constexpr double kPi = 3.14159265358979323846;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A point or a segment, made into a polygon.
void thicken(Polygon& section) {
  if (section.empty() || section.size() > 2) return;
  const Vector2d a = section.front(), b = section.back();
  const Vector2d along =
      kRounding * (section.size() == 2 ? Vector2d((b - a).normalized()) : Vector2d::UnitX());
  const Vector2d left(-along.y(), along.x());
  section = {a - along - left, b + along - left, b + along + left, a - along + left};
}

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

WaistCell::WaistCell(const ArmPlane& plane, double q1, double half_width)
    : axis_(plane.waist_axis) {
  if (!(half_width >= 0.0 && half_width <= kWidest)) {
    throw InvalidInput("E_RANGE", "half_width",
                       "found " + std::to_string(half_width) + ", expected 0 to " +
                           std::to_string(kWidest) + " [rad]");
  }
  const Pose X_RE = plane.X_RE(q1);
  R_ER_ = X_RE.linear().transpose();
  p_R_ = X_RE * plane.waist_point;
  forward_ = Vector3d::UnitZ().cross(axis_);
  across_ = Vector3d::UnitZ() - axis_ * axis_.z();
  waist_ = plane.waist_point.head<2>();
  waist_lateral_ = plane.waist_point.z();
  sine_ = std::sin(half_width);
  cosine_ = std::cos(half_width);
  edge_on_ = std::abs(axis_.z()) < 1e-10 && std::abs(axis_.x()) < 1e-10;
}

/// Corners in E, and where they are to the two clipping planes. @return false: none between them
bool WaistCell::place(const SceneHull& hull, const Slab& slab) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double least = kInfinite, most = -kInfinite;                // of m.v
  double least_across = kInfinite, most_across = -kInfinite;  // of n.v
  double lowest = kInfinite, highest = -kInfinite;            // of z.v
  corners_.resize(hull.points.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector3d at = R_ER_ * (hull.points[i] - p_R_);
    corners_[i].at = at;
    const double ahead = forward_.dot(at), aside = across_.dot(at);
    least = std::min(least, ahead);
    most = std::max(most, ahead);
    least_across = std::min(least_across, aside);
    most_across = std::max(most_across, aside);
    lowest = std::min(lowest, at.z());
    highest = std::max(highest, at.z());
  }
  const double rise = (1.0 - cosine_) * std::max(0.0, -least_across) + kRounding;
  const double sink = (1.0 - cosine_) * std::max(0.0, most_across) + kRounding;
  const double farthest = sine_ * std::max(std::abs(least), std::abs(most));
  const double lower = slab.lower - waist_lateral_ - rise;
  const double upper = slab.upper - waist_lateral_ + sink;
  if (highest + farthest < lower || lowest - farthest > upper) return false;
  // The chord of |m.v|, a constant where the hull has no extent along m.
  const double extent = most - least;
  const double slope = extent > kRounding ? (std::abs(most) - std::abs(least)) / extent : 0.0;
  const double base = std::max(std::abs(most) - slope * most, std::abs(least) - slope * least);
  bool some_above = false, some_below = false;
  for (Corner& corner : corners_) {
    const double widening = sine_ * (slope * forward_.dot(corner.at) + base);
    corner.above = corner.at.z() + widening - lower;
    corner.below = upper - corner.at.z() + widening;
    some_above = some_above || corner.above >= 0.0;
    some_below = some_below || corner.below >= 0.0;
  }
  return some_above && some_below;
}

/// The triangle that contains the arc of a corner, seen along z.
void WaistCell::add_swept(const Vector3d& corner) {
  const Vector3d on_axis = axis_ * axis_.dot(corner);
  const Vector3d radial = corner - on_axis;
  const Vector3d sideways = axis_.cross(corner);
  const Vector2d centre = waist_ + on_axis.head<2>();
  const Vector2d middle = cosine_ * radial.head<2>(), swing = sine_ * sideways.head<2>();
  const Vector2d apex = radial.head<2>() / cosine_;
  if (!edge_on_) {
    swept_.push_back(centre + middle + swing);
    swept_.push_back(centre + middle - swing);
    swept_.push_back(centre + apex);
    return;
  }
  // One line, along x: its two ends.
  const double reach = std::abs(swing.x());
  const double y = centre.y();
  swept_.emplace_back(centre.x() + std::min(middle.x() - reach, apex.x()), y);
  swept_.emplace_back(centre.x() + std::max(middle.x() + reach, apex.x()), y);
}

/// Andrew's monotone chain.
void WaistCell::take_hull(Polygon& section) {
  std::sort(swept_.begin(), swept_.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  swept_.erase(std::unique(swept_.begin(), swept_.end()), swept_.end());
  const auto add = [&section](const Vector2d& point, std::size_t first) {
    while (section.size() >= first + 2 &&
           cross(section.back() - section[section.size() - 2], point - section.back()) <= 0.0) {
      section.pop_back();
    }
    section.push_back(point);
  };
  for (const Vector2d& point : swept_) add(point, 0);
  const std::size_t upper = section.size() - 1;
  for (std::size_t i = swept_.size(); i-- > 1;) add(swept_[i - 1], upper);
  if (section.size() > 1) section.pop_back();  // the first point again
  thicken(section);
}

void WaistCell::cross_section(const SceneHull& hull, const Slab& slab, Polygon& section) {
  section.clear();
  if (!place(hull, slab)) return;
  swept_.clear();
  for (const Corner& corner : corners_) {
    if (corner.above >= 0.0 && corner.below >= 0.0) add_swept(corner.at);
  }
  const auto add_crossing = [this](const Corner& a, const Corner& b, double at_a, double at_b) {
    if ((at_a < 0.0) == (at_b < 0.0)) return;
    add_swept(a.at + (at_a / (at_a - at_b)) * (b.at - a.at));
  };
  for (const std::pair<int, int>& edge : hull.edges) {
    const Corner& a = corners_[static_cast<std::size_t>(edge.first)];
    const Corner& b = corners_[static_cast<std::size_t>(edge.second)];
    add_crossing(a, b, a.above, b.above);
    add_crossing(a, b, a.below, b.below);
  }
  if (!swept_.empty()) take_hull(section);
}

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
