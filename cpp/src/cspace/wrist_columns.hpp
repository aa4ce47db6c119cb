// Where can a point that the forearm carries be? A ring holds it at few cells of theta3 only, and
// there between two directions. So instead of bit maps, which would be nearly empty, what a polar
// cell blocks is kept as intervals, and marked for a whole span at once.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/cspace/cross_section.hpp"
#include "ring_maps.hpp"

namespace handey::cspace {

class WristColumns {
 public:
  WristColumns() = default;
  /// @param point at q2 = q3 = 0, in the plane about the elbow [m]
  WristColumns(const PolarGrid& grid, const Lattice& lattice, int level, const ArmPlane& plane,
               const Eigen::Vector2d& point);

  int first_ring() const { return first_ring_; }
  int last_ring() const { return last_ring_; }  ///< the last one is not among them
  int words() const { return words_; }          ///< of a column: a bit per cell of theta2
  /// Marks, in one row of words per cell of theta3, the cells in which the point can be in a span.
  void mark(const PolarGrid& grid, const RingSpan& span, std::vector<std::uint64_t>& columns) const;

 private:
  struct Stay {
    int column;
    double lower, upper;  ///< directions at theta2 = 0, in cells of theta2
  };
  void add(int ring, const Stay& stay);

  int first_ring_ = 0, last_ring_ = 0, words_ = 0;
  std::vector<std::vector<Stay>> rings_;  ///< by ring
};

}  // namespace handey::cspace
