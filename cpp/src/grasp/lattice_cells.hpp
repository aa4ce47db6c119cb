// The lattice of candidates of one pair, cell by cell: a cell of 4 x 4 places and 4 directions is
// looked at when the first of its candidates is asked for, then one of its parts of 2 x 2 x 2, then
// the candidate alone. What is blocked with its cell costs next to nothing.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "handey/grasp/blocked_poses.hpp"

namespace handey::grasp {

/// Places at centre + spacing (column, row), in directions that rise.
struct PoseLattice {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< in (x, y) of G [m]
  double spacing = 0.0;                              ///< [m]
  int columns = 0, rows = 0;                         ///< counted from the middle to either side
  std::vector<double> directions;                    ///< rising [rad]
};

/// One of them.
struct LatticePoint {
  int column = 0, row = 0, turn = -1;  ///< turn: index of the direction, -1: not on the lattice
};

class LatticeCells {
 public:
  /// Keeps references.
  LatticeCells(const FeaturePair& pair, const PoseLattice& lattice, BlockedPoses& blocked);
  /// What blocks the candidate, with its cell or alone; null where that is not proved.
  const PoseBlock* find(const LatticePoint& point, bool flipped);

 private:
  static constexpr int kLevels = 3;  ///< cells of 4, of 2, of 1 in each direction

  std::optional<PoseBlock> look(const LatticePoint& point, bool flipped, int size) const;

  const FeaturePair& pair_;
  const PoseLattice& lattice_;
  BlockedPoses& blocked_;
  std::unordered_map<std::uint64_t, std::optional<PoseBlock>> known_[kLevels];
};

}  // namespace handey::grasp
