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

  // To be made in place: a copy from the stack would wait for the stores of its parts.
  RingSpan(int ring_in, double lower_in, double upper_in)
      : ring(ring_in), lower(lower_in), upper(upper_in) {}
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
  /// Points whose angles are found all at once, side by side in the processor's registers.
  struct Crossings {
    std::vector<double> x, y;   ///< [m]
    std::vector<double> floor;  ///< the angle is taken to be at least this [rad]
    std::vector<double> angle;  ///< [rad]
    std::size_t count = 0;

    void clear(std::size_t most);
    int add(const Eigen::Vector2d& point, double floor_angle) {
      x[count] = point.x();
      y[count] = point.y();
      floor[count] = floor_angle;
      return static_cast<int>(count++);
    }
  };
  /// Of a ring: crossings where the far side begins and ceases to be beyond it.
  struct FarSpan {
    int ring, from, to;
    FarSpan(int ring_in, int from_in, int to_in) : ring(ring_in), from(from_in), to(to_in) {}
  };
  /// A crossing of the near side with a ring's outer circle.
  struct NearCrossing {
    int ring, crossing;
    NearCrossing(int ring_in, int crossing_in) : ring(ring_in), crossing(crossing_in) {}
  };

  /// @return false: the origin is inside
  bool measure(const Polygon& polygon, double& nearest, double& farthest);
  void add_circles(double farthest, std::vector<RingSpan>& spans) const;
  int meet(const Edge& edge, double along);
  void walk_far_side(std::size_t begin, double start);
  void walk_far_edge(const Edge& edge);
  void walk_near_side(std::size_t begin);
  void walk_near_edge(const Edge& edge);
  void note(int ring, double angle);
  void note_from(double radius, double angle);
  void take_spans(std::vector<RingSpan>& spans);
  double angle_at(const Edge& edge, double along) const;

  double width_;
  int rings_;
  std::vector<Edge> edges_;
  double floor_angle_ = 0.0;  ///< angles are taken to be at least this
  Crossings crossings_;
  // The rings looked at: first_ .. last_ - 1. The far side as it is walked: rings first_ .. top_
  // are met from the crossing opened_[ring] on.
  int first_ = 0, last_ = 0, top_ = -1;
  std::vector<int> opened_;
  std::vector<FarSpan> far_;
  // The near side: the angles at which it lies within the ring's outer radius.
  bool has_near_side_ = false;
  std::vector<NearCrossing> near_;
  std::vector<double> near_lower_, near_upper_;
};

/// A convex polygon that contains all points within `distance` of a convex counter-clockwise
/// polygon (or point, or segment); corners are rounded by tangents no more than `widest` apart
/// [rad].
void grow(const Polygon& polygon, double distance, double widest, Polygon& grown);

}  // namespace handey::cspace
