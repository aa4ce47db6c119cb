// Seen from the origin a convex polygon has a far side, along which the angle grows, and, unless
// the origin is inside, a near side, along which it falls. A ring is met at the angles at which the
// far side is beyond its inner radius and the near side within its outer one. The first set is
// nested ring in ring, so the far side is walked like a stack; the second is one interval, for what
// a disc cuts from a convex set is convex.
#include "polar_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#if defined(__GNUC__) && defined(__x86_64__) && defined(__gnu_linux__)
#define HANDEY_INLINE inline __attribute__((always_inline))
#define HANDEY_WIDEST __attribute__((target_clones("avx2", "default")))
#else
#define HANDEY_INLINE inline
#define HANDEY_WIDEST
#endif

namespace handey::cspace {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadial = 1e-14;    // |a x b| of an edge that points at the origin [m2]
constexpr double kAtOrigin = 1e-4;   // a vertex this near has no angle to be sure of [m]
constexpr double kBackwards = 3e-5;  // an angle this far back is one turn on [rad]

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// atan2 to 1.2e-5 rad. No branches, so that several are found at once.
HANDEY_INLINE double fast_angle(double y, double x) {
  constexpr double kQuarter = 0.25 * kPi, kHalf = 0.5 * kPi;
  const double ax = std::abs(x), ay = std::abs(y);
  const double z = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-300), s = z * z;
  // Minimax in powers of s = z^2 for atan(z) / z (Abramowitz and Stegun, 4.4.47).
  const double low = 0.9998660 - 0.3302995 * s, high = 0.1801410 - 0.0851330 * s;
  double angle = z * (low + s * s * (high + 0.0208351 * s * s));
  angle = kQuarter - std::copysign(kQuarter - angle, ax - ay);
  angle = kHalf - std::copysign(kHalf - angle, x);
  return std::copysign(angle, y);
}

HANDEY_WIDEST void find_angles(const double* x, const double* y, const double* floor,
                               std::size_t count, double* angle) {
  for (std::size_t i = 0; i < count; ++i) {
    // Floors are up to a turn above an angle from -pi to pi.
    double at = fast_angle(y[i], x[i]);
    at += at < floor[i] ? 2.0 * kPi : 0.0;
    angle[i] = at + (at < floor[i] ? 2.0 * kPi : 0.0);
  }
}

}  // namespace

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

void PolarRaster::Crossings::clear(std::size_t most) {
  count = 0;
  if (most <= x.size()) return;
  for (std::vector<double>* values : {&x, &y, &floor, &angle}) values->resize(most);
}

int PolarRaster::meet(const Edge& edge, double along) {
  return crossings_.add(edge.normal + along * edge.along, floor_angle_);
}

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

/// @param start angle at which the far side begins
void PolarRaster::walk_far_side(std::size_t begin, double start) {
  const std::size_t count = edges_.size();
  top_ = std::min(last_ - 1, static_cast<int>(edges_[begin].begin / width_));
  const int opened = meet(edges_[begin], edges_[begin].from);
  for (int ring = first_; ring <= top_; ++ring) opened_[static_cast<std::size_t>(ring)] = opened;
  std::size_t last = begin;
  for (std::size_t k = 0; k < count; ++k) {
    const Edge& edge = edges_[(begin + k) % count];
    if (edge.side <= 0) continue;
    walk_far_edge(edge);
    floor_angle_ = angle_at(edge, edge.to) - kBackwards;
    last = (begin + k) % count;
  }
  // Round the origin the walk ends where it began, one turn on.
  if (!has_near_side_) floor_angle_ = start + 2.0 * kPi - kBackwards;
  const int end = meet(edges_[last], edges_[last].to);
  for (int ring = first_; ring <= top_; ++ring) {
    far_.emplace_back(ring, opened_[static_cast<std::size_t>(ring)], end);
  }
}

void PolarRaster::walk_far_edge(const Edge& edge) {
  while (top_ >= first_ && top_ * width_ > edge.least) {
    far_.emplace_back(top_, opened_[static_cast<std::size_t>(top_)],
                      meet(edge, edge.falling(top_ * width_)));
    --top_;
  }
  while (top_ + 1 < last_ && (top_ + 1) * width_ <= edge.end) {
    ++top_;
    if (top_ < first_) continue;
    opened_[static_cast<std::size_t>(top_)] = meet(edge, edge.rising(top_ * width_));
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
    near_.emplace_back(ring, meet(edge, edge.falling((ring + 1) * width_)));
  }
  for (int ring = nearest; ring < last_ && (ring + 1) * width_ < edge.end; ++ring) {
    near_.emplace_back(ring, meet(edge, edge.rising((ring + 1) * width_)));
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

void PolarRaster::take_spans(std::vector<RingSpan>& spans) {
  find_angles(crossings_.x.data(), crossings_.y.data(), crossings_.floor.data(), crossings_.count,
              crossings_.angle.data());
  const auto angle = [this](int i) { return crossings_.angle[static_cast<std::size_t>(i)]; };
  for (const NearCrossing& near : near_) note(near.ring, angle(near.crossing));
  for (const FarSpan& far : far_) {
    const std::size_t ring = static_cast<std::size_t>(far.ring);
    double lower = angle(far.from), upper = angle(far.to);
    if (has_near_side_) {
      lower = std::max(lower, near_lower_[ring]);
      upper = std::min(upper, near_upper_[ring]);
    }
    if (lower > upper + 2.0 * kAnglePad) continue;
    spans.emplace_back(far.ring, lower - kAnglePad, std::max(lower, upper) + kAnglePad);
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
  // An edge meets a circle twice at most.
  crossings_.clear(2 * count * static_cast<std::size_t>(last_ - first_ + 1) + 2);
  near_.clear();
  far_.clear();
  if (has_near_side_) walk_near_side(begin);
  walk_far_side(begin, start);
  take_spans(spans);
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
