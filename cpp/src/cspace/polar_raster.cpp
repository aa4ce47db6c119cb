// Seen from the origin a convex polygon has a far side, along which the angle grows, and, unless
// the origin is inside, a near side, along which it falls. A ring is met at the angles at which the
// far side is beyond its inner radius and the near side within its outer one. The first set is
// nested ring in ring, so the far side is walked like a stack; the second is one interval, for what
// a disc cuts from a convex set is convex.
#include "polar_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handey::cspace {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadial = 1e-14;    // |a x b| of an edge that points at the origin [m2]
constexpr double kAtOrigin = 1e-4;   // a vertex this near has no angle to be sure of [m]
constexpr double kBackwards = 3e-5;  // an angle this far back is one turn on [rad]

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

double fast_angle(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  const double high = std::max(ax, ay), low = std::min(ax, ay);
  if (high == 0.0) return 0.0;
  const double z = low / high, s = z * z;
  // Minimax in powers of s = z^2 for atan(z) / z (Abramowitz and Stegun, 4.4.47).
  double angle =
      z * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
  if (ay > ax) angle = 0.5 * kPi - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

/// An edge as a walk along a line: `normal` is the point of the line next to the origin.
struct PolarRaster::Edge {
  Vector2d along, normal;
  double from = 0.0, to = 0.0;                 ///< of its ends from `normal`
  double squared = 0.0;                        ///< distance of the line from the origin, squared
  double least = 0.0, begin = 0.0, end = 0.0;  ///< radius where it is nearest, and at its ends
  int side = 0;                                ///< 1 far, -1 near, 0 points at the origin

  Edge(const Vector2d& a, const Vector2d& b, double radius_a, double radius_b) {
    along = (b - a).normalized();
    from = along.dot(a);
    to = along.dot(b);
    normal = a - from * along;
    squared = normal.squaredNorm();
    const bool passes = from < 0.0 && to > 0.0;
    least = passes ? std::sqrt(squared) : std::min(radius_a, radius_b);
    begin = radius_a;
    end = radius_b;
    const double turn = cross(a, b);
    side = turn > kRadial ? 1 : turn < -kRadial ? -1 : 0;
  }
  double falling(double radius) const {
    return std::clamp(-std::sqrt(std::max(0.0, radius * radius - squared)), from, to);
  }
  double rising(double radius) const {
    return std::clamp(std::sqrt(std::max(0.0, radius * radius - squared)), from, to);
  }
};

PolarRaster::PolarRaster(double width, int rings)
    : width_(width),
      rings_(rings),
      opened_(static_cast<std::size_t>(rings)),
      near_lower_(static_cast<std::size_t>(rings)),
      near_upper_(static_cast<std::size_t>(rings)) {}

PolarRaster::~PolarRaster() = default;

double PolarRaster::angle_at(const Edge& edge, double along) const {
  const Vector2d point = edge.normal + along * edge.along;
  const double angle = fast_angle(point.y(), point.x());
  return angle < floor_angle_ ? angle + 2.0 * kPi * std::ceil((floor_angle_ - angle) / (2.0 * kPi))
                              : angle;
}

void PolarRaster::add_circles(double farthest, std::vector<RingSpan>& spans) const {
  for (int ring = first_; ring < last_ && ring * width_ <= farthest; ++ring) {
    spans.push_back({ring, -kPi, kPi});
  }
}

void PolarRaster::close(int ring, double angle, std::vector<RingSpan>& spans) const {
  const std::size_t i = static_cast<std::size_t>(ring);
  double lower = opened_[i], upper = angle;
  if (has_near_side_) {
    lower = std::max(lower, near_lower_[i]);
    upper = std::min(upper, near_upper_[i]);
  }
  if (lower <= upper + 2.0 * kAnglePad) {
    spans.push_back({ring, lower - kAnglePad, std::max(lower, upper) + kAnglePad});
  }
}

void PolarRaster::start_far_side(double radius, double angle) {
  top_ = std::min(last_ - 1, static_cast<int>(radius / width_));
  for (int ring = first_; ring <= top_; ++ring) opened_[static_cast<std::size_t>(ring)] = angle;
}

void PolarRaster::walk_far_edge(const Edge& edge, std::vector<RingSpan>& spans) {
  while (top_ >= first_ && top_ * width_ > edge.least) {
    close(top_, angle_at(edge, edge.falling(top_ * width_)), spans);
    --top_;
  }
  while (top_ + 1 < last_ && (top_ + 1) * width_ <= edge.end) {
    ++top_;
    if (top_ < first_) continue;
    opened_[static_cast<std::size_t>(top_)] = angle_at(edge, edge.rising(top_ * width_));
  }
}

void PolarRaster::note(int ring, double angle) {
  const std::size_t i = static_cast<std::size_t>(ring);
  near_lower_[i] = std::min(near_lower_[i], angle);
  near_upper_[i] = std::max(near_upper_[i], angle);
}

void PolarRaster::note_from(double radius, double angle) {
  const int first = std::max(first_, static_cast<int>(radius / width_));
  for (int ring = first; ring < last_; ++ring) note(ring, angle);
}

void PolarRaster::walk_near_edge(const Edge& edge) {
  const int nearest = std::max(first_, static_cast<int>(edge.least / width_));
  for (int ring = nearest; ring < last_ && (ring + 1) * width_ < edge.begin; ++ring) {
    note(ring, angle_at(edge, edge.falling((ring + 1) * width_)));
  }
  for (int ring = nearest; ring < last_ && (ring + 1) * width_ < edge.end; ++ring) {
    note(ring, angle_at(edge, edge.rising((ring + 1) * width_)));
  }
}

bool PolarRaster::measure(const Polygon& polygon, double& nearest, double& farthest) {
  const std::size_t count = polygon.size();
  edges_.clear();
  bool has_near_side = false;
  nearest = std::numeric_limits<double>::infinity();
  farthest = 0.0;
  double begin = polygon.front().norm();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& next = polygon[i + 1 < count ? i + 1 : 0];
    const double end = next.norm();
    edges_.emplace_back(polygon[i], next, begin, end);
    nearest = std::min(nearest, edges_.back().least);
    farthest = std::max(farthest, begin);
    has_near_side = has_near_side || edges_.back().side < 0;
    begin = end;
  }
  return has_near_side;
}

void PolarRaster::walk_near_side(std::size_t begin) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::fill(near_lower_.begin() + first_, near_lower_.begin() + last_, kInfinite);
  std::fill(near_upper_.begin() + first_, near_upper_.begin() + last_, -kInfinite);
  const std::size_t count = edges_.size();
  bool walking = false;
  for (std::size_t k = 0; k < count; ++k) {
    const Edge& edge = edges_[(begin + k) % count];
    const bool near = edge.side < 0;
    // Beyond its two ends the near side counts as reached for all rings farther out.
    if (near != walking) note_from(edge.begin, angle_at(edge, edge.from));
    if (near) walk_near_edge(edge);
    walking = near;
  }
  if (walking) {
    const Edge& edge = edges_[begin];
    note_from(edge.begin, angle_at(edge, edge.from));
  }
}

void PolarRaster::add_spans(const Polygon& polygon, int first, int last,
                            std::vector<RingSpan>& spans) {
  double nearest = 0.0, farthest = 0.0;
  has_near_side_ = measure(polygon, nearest, farthest);
  first_ = std::max(0, first);
  last_ = std::min({last, rings_, static_cast<int>(farthest / width_) + 1});
  if (nearest < kAtOrigin) return add_circles(farthest, spans);
  if (has_near_side_) first_ = std::max(first_, static_cast<int>(nearest / width_));
  if (first_ >= last_) return;
  const std::size_t count = edges_.size();
  // The far side begins after the near side; without one, anywhere.
  std::size_t begin = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (edges_[i].side > 0 && edges_[(i + count - 1) % count].side <= 0) begin = i;
  }
  const double start = fast_angle(polygon[begin].y(), polygon[begin].x());
  floor_angle_ = start - kBackwards;
  if (has_near_side_) walk_near_side(begin);
  start_far_side(edges_[begin].begin, start);
  double end = start;
  for (std::size_t k = 0; k < count; ++k) {
    const Edge& edge = edges_[(begin + k) % count];
    if (edge.side <= 0) continue;
    walk_far_edge(edge, spans);
    end = angle_at(edge, edge.to);
    floor_angle_ = end - kBackwards;
  }
  // Round the origin the walk ends where it began, one turn on.
  if (!has_near_side_) end = start + 2.0 * kPi;
  for (int ring = first_; ring <= top_; ++ring) close(ring, end, spans);
}

void grow(const Polygon& polygon, double distance, double widest, Polygon& grown) {
  grown.clear();
  const double cosine = std::cos(widest);
  const std::size_t count = polygon.size();
  const auto corner = [&](const Vector2d& point, const Vector2d& from, const Vector2d& to,
                          const auto& self) -> void {
    const double dot = from.dot(to);
    if (dot >= cosine) {
      grown.push_back(point + distance / (1.0 + dot) * (from + to));
      return;
    }
    // Half way from the one normal to the other, turning left.
    Vector2d middle = from + to;
    if (middle.squaredNorm() < 1e-6) middle = Vector2d(-from.y(), from.x()) + 1e-3 * middle;
    middle.normalize();
    self(point, from, middle, self);
    self(point, middle, to, self);
  };
  const auto normal = [](const Vector2d& a, const Vector2d& b) {
    const Vector2d along = (b - a).normalized();
    return Vector2d(along.y(), -along.x());
  };
  if (count == 1) {
    const Vector2d x = Vector2d::UnitX();
    corner(polygon[0], x, -x, corner);
    corner(polygon[0], -x, x, corner);
    return;
  }
  Vector2d before = normal(polygon[count - 1], polygon[0]);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d after = normal(polygon[i], polygon[(i + 1) % count]);
    corner(polygon[i], before, after, corner);
    before = after;
  }
}

}  // namespace handey::cspace
