// Cells of candidates: a cell's motion holds the candidates in it, no more.
#include "lattice_cells.hpp"

#include <algorithm>
#include <cmath>

namespace handey::grasp {

LatticeCells::LatticeCells(const FeaturePair& pair, const PoseLattice& lattice,
                           BlockedPoses& blocked)
    : pair_(pair), lattice_(lattice), blocked_(blocked) {}

const PoseBlock* LatticeCells::find(const LatticePoint& point, bool flipped) {
  if (point.turn < 0) return nullptr;
  const auto column = static_cast<std::uint64_t>(point.column + lattice_.columns);
  const auto row = static_cast<std::uint64_t>(point.row + lattice_.rows);
  const auto turn = static_cast<std::uint64_t>(point.turn);
  for (int level = 0; level < kLevels; ++level) {
    const int shift = kLevels - 1 - level;
    const std::uint64_t key = ((column >> shift) << 40) | ((row >> shift) << 16) |
                              ((turn >> shift) << 1) | (flipped ? 1U : 0U);
    auto known = known_[level].find(key);
    if (known == known_[level].end()) {
      known = known_[level].emplace(key, look(point, flipped, 1 << shift)).first;
    }
    if (known->second) return &*known->second;
  }
  return nullptr;
}

std::optional<PoseBlock> LatticeCells::look(const LatticePoint& point, bool flipped,
                                            int size) const {
  // The first and the last of the cell, each way.
  const auto span = [size](int index, int most) {
    const int first = index - index % size;
    return std::pair<int, int>(first, std::min(first + size - 1, most));
  };
  const auto [west, east] = span(point.column + lattice_.columns, 2 * lattice_.columns);
  const auto [south, north] = span(point.row + lattice_.rows, 2 * lattice_.rows);
  const auto [first, last] = span(point.turn, static_cast<int>(lattice_.directions.size()) - 1);
  const double from = lattice_.directions[static_cast<std::size_t>(first)];
  const double to = lattice_.directions[static_cast<std::size_t>(last)];
  const Eigen::Vector2d middle(0.5 * (west + east) - lattice_.columns,
                               0.5 * (south + north) - lattice_.rows);
  const Eigen::Vector2d at = lattice_.centre + lattice_.spacing * middle;
  HandMotion motion;
  motion.shift = 0.5 * lattice_.spacing * std::hypot(east - west, north - south);
  motion.half_turn = 0.5 * (to - from);
  return blocked_.find(pair_, {at.x(), at.y(), 0.5 * (from + to)}, flipped, motion);
}

}  // namespace handey::grasp
