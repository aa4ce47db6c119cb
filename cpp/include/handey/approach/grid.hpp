// The motion grid: filled cells of the grasp plane, one layer for each piece of the gripper,
// because the gripper is not flat: a piece meets only what lies within its own extent along the
// plane's normal. Errs on the full side: a cell that an obstacle touches is filled. Article: "Local
// planning", the grid.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/geometry/section.hpp"

namespace handey {

/// Square grid over |x|, |y| <= half_size about `centre` in G. Where half_size is not a whole
/// number of half cells, the cells reach a little past it.
class MotionGrid {
 public:
  /// @param centre of the square in G [m]
  /// @param half_size, cell  [m]
  /// @throws InvalidInput (E_NUMBER, E_RANGE) for sizes that are not finite and positive or more
  /// than 4096 cells a side
  MotionGrid(const Eigen::Vector2d& centre, double half_size, double cell, int layers);

  double cell() const { return cell_; }
  int side() const { return side_; }
  int layers() const { return layers_; }
  const Eigen::Vector2d& centre() const { return centre_; }
  /// Lowest x and y of cell (0, 0) [m].
  const Eigen::Vector2d& corner() const { return corner_; }
  double half_size() const { return half_size_; }
  bool is_inside(const Eigen::Vector2d& point) const;
  /// Fills every cell of `layer` that the region touches.
  /// @throws InvalidInput (E_RANGE) for a layer that the grid does not have, (E_NUMBER) for a point
  /// that is not finite
  void fill(int layer, const Region& region);
  /// Fills every cell of `layer` that lies wholly inside the region: what is full for certain.
  /// @throws InvalidInput as fill does
  void fill_inside(int layer, const Region& region);
  /// @param column along x of G, @param row along y; both 0..side-1, unchecked
  bool is_filled(int layer, int column, int row) const {
    return filled_[index(layer, column, row)] != 0;
  }
  /// Does the segment touch a filled cell of `layer`? (supercover: cells met at a corner or along a
  /// border count; outside the grid is free)
  bool touches(int layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;

 private:
  std::size_t index(int layer, int column, int row) const {
    const std::size_t side = static_cast<std::size_t>(side_);
    return (static_cast<std::size_t>(layer) * side + static_cast<std::size_t>(row)) * side +
           static_cast<std::size_t>(column);
  }
  /// Calls visit(column, row) for each cell that the segment touches, until visit returns true.
  template <typename Visit>
  bool visit_cells(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Visit& visit) const;
  void require_fits(int layer, const Region& region) const;
  /// Calls visit(first column, last column, row) for each run of cells whose centres are inside.
  template <typename Visit>
  void visit_interior(const Region& region, const Visit& visit) const;

  Eigen::Vector2d centre_, corner_;  // corner_: of cell (0, 0), lowest x and y
  double half_size_, cell_;
  int side_, layers_;
  std::vector<std::uint8_t> filled_;
};

}  // namespace handey
