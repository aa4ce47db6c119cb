// Cells and their proofs, from within: which pairs of solids can block a cell, and the test of one
// cell. What depends on the first joint or the first two alone is tested once for all cells that
// share them.
#pragma once

#include <vector>

#include "handey/cspace/separation.hpp"
#include "overlap_proof.hpp"

namespace handey {

namespace cspace {

/// A solid of a mover against one of an obstacle, or of another mover that fewer joints move.
struct SolidPair {
  int mover = 0, other = 0;  ///< other: a mover, or -1
  int obstacle = -1;         ///< if other is -1
  const InnerSolid* a = nullptr;
  const InnerSolid* b = nullptr;
  int depth = 0, other_depth = 0;  ///< number of arm joints that move them
};

constexpr int kNoPair = -1;

}  // namespace cspace

struct BlockedCells::Impl {
  Impl(CollisionChecker& checker, double opening);

  /// The pair that collides everywhere in the cell, or kNoPair.
  int proving_pair(int level, const CellIndex& cell);
  /// Can any pair meet within the cell? If not, no part of it can be proved blocked.
  bool can_be_blocked(int level, const CellIndex& cell);
  BlockedProof named(int pair) const;

  std::shared_ptr<const Robot> robot;
  SolidScene scene;
  Lattice lattice;
  std::vector<cspace::SolidPair> pairs;

 private:
  /// What is known of the cells that share their first 1, 2 or 3 indices.
  struct Known {
    std::vector<std::vector<int>> near;  ///< at level 0: pairs that can meet
    std::vector<char> has_near;
    std::array<std::vector<int>, Lattice::kLevels> proof;  ///< per level: pair, or not yet looked
  };
  void add_pairs();
  void add_pair(int mover, int other, int obstacle, const std::vector<InnerSolid>& solids);
  double wrist_slack(int mover, const InnerSolid& solid);
  void place(int level, const CellIndex& cell);
  std::size_t key(int level, const CellIndex& cell, int joints) const;
  cspace::RelativeMotion motion_of(const cspace::SolidPair& pair) const;
  bool can_meet(const cspace::SolidPair& pair) const;
  const std::vector<int>& near_pairs(const CellIndex& coarse, int joints);
  int prove_shared(int level, const CellIndex& cell, int joints);
  cspace::PlacedSolid placed_a(const cspace::SolidPair& pair) const;
  cspace::PlacedSolid placed_b(const cspace::SolidPair& pair) const;

  std::array<Known, 3> known_;
  Configuration middle_;  ///< the joints after the third stay here
  std::vector<cspace::AxisMotion> axes_;
  std::vector<Pose> X_RB_, X_RM_;
  int placed_level_ = -1;
  CellIndex placed_cell_{};
};

}  // namespace handey
