// The motion grid: filled cells of the grasp plane, one layer for each piece of the gripper, because the gripper is not
// flat: a piece meets only what lies within its own extent along the plane's normal.
// Errs on the full side: a cell that an obstacle touches is filled.
// Article: "Local planning", the grid.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/geometry/section.hpp"

namespace handey {

/// Square grid over |x|, |y| <= half_size about `centre` in G.
class MotionGrid {
 public:
  /// @throws InvalidInput (E_RANGE) for sizes that are not positive or more than 4096 cells a side
  MotionGrid(const Eigen::Vector2d& centre, double half_size, double cell, int layers);

  double cell() const { return cell_; }
  int side() const { return side_; }
  int layers() const { return layers_; }
  const Eigen::Vector2d& centre() const { return centre_; }
  double half_size() const { return half_size_; }
  bool is_inside(const Eigen::Vector2d& point) const;
  /// Fills every cell of `layer` that the region touches.
  void fill(int layer, const Region& region);
  bool is_filled(int layer, int column, int row) const {
    return filled_[static_cast<std::size_t>((layer * side_ + row) * side_ + column)] != 0;
  }
  /// Does the segment touch a filled cell of `layer`? (supercover; outside the grid is free)
  bool touches(int layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

 private:
  Eigen::Vector2d centre_;
  double half_size_, cell_;
  int side_, layers_;
  std::vector<std::uint8_t> filled_;
};

}  // namespace handey
