// Which rings about the origin does a convex polygon meet, and between which angles? Axis 2 is the
// origin: a turn about it shifts angles and leaves rings as they are, so one bit map serves a
// square of the plane in all directions. Errs on the large side by kAnglePad.
#pragma once

#include <vector>

#include "handey/geometry/polygon.hpp"

namespace handey::cspace {

/// The angles at which something meets a ring; lower <= upper < lower + 2 pi + 1e-3 [rad].
struct RingSpan {
  int ring = 0;
  double lower = 0.0, upper = 0.0;
};

/// Ring i holds the radii from i * width to (i + 1) * width, limits included.
class PolarRaster {
 public:
  /// More than the error of the angles [rad].
  static constexpr double kAnglePad = 3e-5;

  PolarRaster(double width, int rings);
  ~PolarRaster();
  /// Appends the spans, in the rings first .. last - 1, of a convex counter-clockwise polygon of
  /// three points or more.
  void add_spans(const Polygon& polygon, int first, int last, std::vector<RingSpan>& spans);
  void add_spans(const Polygon& polygon, std::vector<RingSpan>& spans) {
    add_spans(polygon, 0, rings_, spans);
  }

 private:
  struct Edge;
  /// @return false: the origin is inside
  bool measure(const Polygon& polygon, double& nearest, double& farthest);
  void add_circles(double farthest, std::vector<RingSpan>& spans) const;
  void start_far_side(double radius, double angle);
  void walk_far_edge(const Edge& edge, std::vector<RingSpan>& spans);
  void walk_near_side(std::size_t begin);
  void walk_near_edge(const Edge& edge);
  void note(int ring, double angle);
  void note_from(double radius, double angle);
  void close(int ring, double angle, std::vector<RingSpan>& spans) const;
  double angle_at(const Edge& edge, double along) const;

  double width_;
  int rings_;
  std::vector<Edge> edges_;
  double floor_angle_ = 0.0;  ///< angles are taken to be at least this
  // The rings looked at: first_ .. last_ - 1. The far side as it is walked: rings first_ .. top_
  // are met from the angle opened_[ring] on.
  int first_ = 0, last_ = 0, top_ = -1;
  std::vector<double> opened_;
  // The near side: the angles at which it lies within the ring's outer radius.
  bool has_near_side_ = false;
  std::vector<double> near_lower_, near_upper_;
};

/// A convex polygon that contains all points within `distance` of a convex counter-clockwise
/// polygon (or point, or segment); corners are rounded by tangents no more than `widest` apart
/// [rad].
void grow(const Polygon& polygon, double distance, double widest, Polygon& grown);

/// atan2 to 1.2e-5 rad.
double fast_angle(double y, double x);

}  // namespace handey::cspace
