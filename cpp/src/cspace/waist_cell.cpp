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
#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/cspace/cross_section.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-9;    // [m]
constexpr double kSameLevel = 1e-12;  // heights that differ by rounding only [m]

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

/// A step of Andrew's monotone chain, which begins at the point `first`.
void extend_chain(Polygon& chain, std::size_t first, const Vector2d& point) {
  while (chain.size() >= first + 2 &&
         cross(chain.back() - chain[chain.size() - 2], point - chain.back()) <= 0.0) {
    chain.pop_back();
  }
  chain.push_back(point);
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
  outwards_ = 1.0 / cosine_;
  edge_on_ = std::abs(axis_.z()) < 1e-10 && std::abs(axis_.x()) < 1e-10;
}

void WaistCell::place(const SceneHull& hull) {
  hull_ = &hull;
  has_whole_ = false;
  corners_.resize(hull.points.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    corners_[i].at = R_ER_ * (hull.points[i] - p_R_);
  }
  set_reaches();
}

/// How far up and down the corners are to be taken to reach, for clipping.
void WaistCell::set_reaches() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double least = kInfinite, most = -kInfinite;                // of m.v
  double least_across = kInfinite, most_across = -kInfinite;  // of n.v
  for (Corner& corner : corners_) {
    const double ahead = forward_.dot(corner.at), aside = across_.dot(corner.at);
    corner.upmost = ahead;
    least = std::min(least, ahead);
    most = std::max(most, ahead);
    least_across = std::min(least_across, aside);
    most_across = std::max(most_across, aside);
  }
  rise_ = (1.0 - cosine_) * std::max(0.0, -least_across) + kRounding;
  sink_ = (1.0 - cosine_) * std::max(0.0, most_across) + kRounding;
  // The chord of |m.v|, a constant where the hull has no extent along m.
  const double extent = most - least;
  const double slope = extent > kRounding ? (std::abs(most) - std::abs(least)) / extent : 0.0;
  const double base = std::max(std::abs(most) - slope * most, std::abs(least) - slope * least);
  highest_ = most_downmost_ = -kInfinite;
  lowest_ = least_upmost_ = kInfinite;
  for (Corner& corner : corners_) {
    const double widening = sine_ * (slope * corner.upmost + base);
    corner.upmost = corner.at.z() + widening;
    corner.downmost = corner.at.z() - widening;
    highest_ = std::max(highest_, corner.upmost);
    lowest_ = std::min(lowest_, corner.downmost);
    least_upmost_ = std::min(least_upmost_, corner.upmost);
    most_downmost_ = std::max(most_downmost_, corner.downmost);
  }
}

void WaistCell::cross_section(const Slab& slab, Polygon& section) {
  section.clear();
  const double lower = slab.lower - waist_lateral_ - rise_;
  const double upper = slab.upper - waist_lateral_ + sink_;
  if (!(highest_ >= lower && lowest_ <= upper)) return;
  if (least_upmost_ < lower || most_downmost_ > upper) {
    swept_.clear();
    levels_.clear();
    add_clipped(lower, upper);
    take_hull(section);
    return;
  }
  if (!has_whole_) {
    swept_.clear();
    levels_.clear();
    for (const Corner& corner : corners_) add_swept(corner.at);
    whole_.clear();
    take_hull(whole_);
    has_whole_ = true;
  }
  section = whole_;
}

/// What the hull's part between the two clipping planes sweeps.
void WaistCell::add_clipped(double lower, double upper) {
  for (const Corner& corner : corners_) {
    if (corner.upmost >= lower && corner.downmost <= upper) add_swept(corner.at);
  }
  const auto add_crossing = [this](const Corner& a, const Corner& b, double at_a, double at_b) {
    if ((at_a < 0.0) == (at_b < 0.0)) return;
    add_swept(a.at + (at_a / (at_a - at_b)) * (b.at - a.at));
  };
  for (const std::pair<int, int>& edge : hull_->edges) {
    const Corner& a = corners_[static_cast<std::size_t>(edge.first)];
    const Corner& b = corners_[static_cast<std::size_t>(edge.second)];
    add_crossing(a, b, a.upmost - lower, b.upmost - lower);
    add_crossing(a, b, upper - a.downmost, upper - b.downmost);
  }
}

/// The triangle that contains the arc of a corner, seen along z.
void WaistCell::add_swept(const Vector3d& corner) {
  if (edge_on_) {
    // One line, along x: the axis is along y.
    const double middle = cosine_ * corner.x(), apex = corner.x() * outwards_;
    const double reach = std::abs(sine_ * corner.z());
    levels_.emplace_back(waist_.y() + corner.y(), waist_.x() + std::min(middle - reach, apex),
                         waist_.x() + std::max(middle + reach, apex));
    return;
  }
  const Vector3d on_axis = axis_ * axis_.dot(corner);
  const Vector3d radial = corner - on_axis;
  const Vector3d sideways = axis_.cross(corner);
  const Vector2d centre = waist_ + on_axis.head<2>();
  const Vector2d middle = cosine_ * radial.head<2>(), swing = sine_ * sideways.head<2>();
  swept_.push_back(centre + middle + swing);
  swept_.push_back(centre + middle - swing);
  swept_.push_back(centre + radial.head<2>() * outwards_);
}

/// Andrew's monotone chain.
void WaistCell::take_hull(Polygon& section) {
  if (edge_on_) return take_hull_of_levels(section);
  if (swept_.empty()) return;
  std::sort(swept_.begin(), swept_.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  swept_.erase(std::unique(swept_.begin(), swept_.end()), swept_.end());
  for (const Vector2d& point : swept_) extend_chain(section, 0, point);
  const std::size_t upper = section.size() - 1;
  for (std::size_t i = swept_.size(); i-- > 1;) extend_chain(section, upper, swept_[i - 1]);
  if (section.size() > 1) section.pop_back();  // the first point again
  thicken(section);
}

/// The same where it is known which points can be on the right side and which on the left.
void WaistCell::take_hull_of_levels(Polygon& section) {
  if (levels_.empty()) return;
  std::sort(levels_.begin(), levels_.end(),
            [](const Level& a, const Level& b) { return a.y < b.y; });
  std::size_t count = 1;
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    Level& last = levels_[count - 1];
    if (levels_[i].y - last.y > kSameLevel) {
      levels_[count++] = levels_[i];
      continue;
    }
    last.lower = std::min(last.lower, levels_[i].lower);
    last.upper = std::max(last.upper, levels_[i].upper);
  }
  for (std::size_t i = 0; i < count; ++i) {
    extend_chain(section, 0, {levels_[i].upper, levels_[i].y});
  }
  const bool pointed = levels_[count - 1].lower == levels_[count - 1].upper;
  const std::size_t left = section.size() - (pointed ? 1 : 0);
  for (std::size_t i = count - (pointed ? 1 : 0); i-- > 0;) {
    extend_chain(section, left, {levels_[i].lower, levels_[i].y});
  }
  if (section.size() > 1 && section.back() == section.front()) section.pop_back();
  thicken(section);
}

}  // namespace handey
