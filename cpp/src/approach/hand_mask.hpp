// Which points of a lattice the hand, turned some way, may not take: the filled cells of each layer
// dilated by the reflected footprint of that layer's piece (algorithms of image morphology, on rows
// of bits). The lattice has the grid's spacing, so one footprint serves all its points. Touched
// cells against touched cells err on the full side: what is not masked is free. Cells wholly inside
// against cells wholly inside err on the free side: what is masked collides, if the pieces are
// prisms along the closing axis.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

/// Square of lattice points anchor + (i, j) * cell for |i|, |j| <= half.
class PointMask {
 public:
  explicit PointMask(int half)
      : half_(half), words_((2 * half + 1 + 63) / 64), bits_(size(half) * words(), 0) {}
  int half() const { return half_; }
  bool is_set(int i, int j) const {
    const std::size_t column = static_cast<std::size_t>(i + half_);
    return (row(j)[column / 64] >> (column % 64) & 1) != 0;
  }
  std::size_t words() const { return static_cast<std::size_t>(words_); }
  std::uint64_t* row(int j) { return &bits_[static_cast<std::size_t>(j + half_) * words()]; }
  const std::uint64_t* row(int j) const {
    return &bits_[static_cast<std::size_t>(j + half_) * words()];
  }

 private:
  static std::size_t size(int half) { return static_cast<std::size_t>(2 * half + 1); }
  int half_, words_;
  std::vector<std::uint64_t> bits_;
};

/// Asked for one direction of the hand after another.
class HandMasks {
 public:
  /// @param inside  footprints are the cells wholly inside a piece, not all that it touches
  HandMasks(const MotionGrid& grid, const GripperOutline& outline, const Eigen::Vector2d& anchor,
            int half, bool inside);

  PointMask at(double theta) const;

 private:
  struct Span {
    int row, first, last;  // cells, from the anchor's cell
  };
  std::vector<Span> footprint(const Polygon& piece, double theta) const;
  void dilate(std::size_t layer, const std::vector<Span>& spans, PointMask& mask) const;
  const std::uint64_t* row_of(std::size_t layer, int power, int row) const;

  const GripperOutline& outline_;
  int half_;
  bool inside_;
  double cell_;
  Eigen::Vector2d offset_;          // of the anchor in its cell, in [0, 1) cells
  int anchor_column_, anchor_row_;  // the anchor's cell
  int side_;
  double reach_;       // of the outline [m]
  int margin_;         // columns of bits before the grid's first, so that spans stay inside
  std::size_t words_;  // per row
  static constexpr int kPowers = 8;
  // bits_[layer][power][row]: bit c is set if any of the cells c .. c + 2^power - 1 is filled.
  std::vector<std::uint64_t> bits_;
};

}  // namespace handey
