// Cells and their proofs, from within: which pairs of solids can block a cell, and the test of one
// cell. What depends on the first joint or the first two alone is tested once for all cells that
// share them.
#pragma once

#include <vector>

#include "handey/collision/overlap_proof.hpp"
#include "handey/cspace/separation.hpp"

namespace handey {

namespace cspace {

/// A solid of a mover against one of an obstacle, or of another mover that fewer joints move.
struct SolidPair {
  int moving = 0;            ///< index of A among the moving solids
  int mover = 0, other = 0;  ///< other: a mover, or -1
  int obstacle = -1;         ///< if other is -1
  const InnerSolid* a = nullptr;
  const InnerSolid* b = nullptr;
  int depth = 0, other_depth = 0;  ///< number of arm joints that move them
  double slack = 0.0;  ///< greatest depth in A less what the joints after the third can move it [m]
};

constexpr int kNoPair = -1;

constexpr double kMostCoarseCells = 1e6;  ///< Choice: three joints of a turn and more either way
double coarse_cells(const Lattice& lattice);

}  // namespace cspace

struct BlockedCells::Impl {
  /// @param finest_level of the cells that will be asked for
  /// @param fingers  false: the fingers count for nothing, so that the opening does not matter
  Impl(CollisionChecker& checker, double opening, int finest_level = Lattice::kLevels - 1,
       bool fingers = true);

  /// The pair that collides everywhere in the cell, or kNoPair.
  int proving_pair(int level, const CellIndex& cell);
  /// Can any cell within this one be proved blocked, as far as is plain?
  bool can_be_blocked(int level, const CellIndex& cell);
  BlockedProof named(int pair) const;

  std::shared_ptr<const Robot> robot;
  SolidScene scene;
  Lattice lattice;
  std::vector<cspace::SolidPair> pairs;

 private:
  /// A solid of a mover; where its ball is, and how far it can move in the placed cell against what
  /// stands.
  struct Moving {
    int mover = 0;
    const InnerSolid* solid = nullptr;
    double slack = 0.0;  ///< greatest depth less what the joints after the third can move it [m]
    bool known = false;
    Eigen::Vector3d centre;
    double reach = 0.0, least = 0.0;
  };
  const Moving& moving(int index);
  void set_reach(Moving& moving, int first_joint) const;
  /// Pairs that can meet in a coarse cell of the first 1, 2 or 3 joints.
  struct Near {
    bool known = false;
    std::vector<int> own;      ///< that no further joint of the cell moves
    std::vector<int> further;  ///< the others, wherever the further joints go
  };
  void add_pairs();
  void add_pair(int mover, int other, int obstacle, const std::vector<InnerSolid>& solids);
  double wrist_slack(int mover, const InnerSolid& solid);
  void place(int level, const CellIndex& cell, int joints);
  std::size_t key(int level, const CellIndex& cell, int joints) const;
  RelativeMotion motion_of(const cspace::SolidPair& pair) const;
  bool can_meet(const cspace::SolidPair& pair);
  const Near& near_pairs(const CellIndex& coarse, int joints);
  int prove_shared(int level, const CellIndex& cell, int joints);
  bool proves(const cspace::SolidPair& pair) const;
  PlacedSolid placed_a(const cspace::SolidPair& pair) const;
  PlacedSolid placed_b(const cspace::SolidPair& pair) const;

  std::array<std::vector<Near>, 3> near_;  ///< by the number of joints, then the coarse cell
  /// Of the cells that share their first 1 or 2 indices: per level the pair, or not yet looked.
  std::array<std::array<std::vector<int>, Lattice::kLevels>, 2> shared_proofs_;
  int finest_level_;
  double finer_ = 1.0;    ///< chord of the finest cells' joints over that of the placed cell's
  Configuration middle_;  ///< the joints after the third stay here
  std::vector<double> range_middle_, range_half_;  ///< of all joints [rad]
  std::vector<AxisMotion> axes_;
  std::vector<Pose> X_RB_, X_RM_;
  std::vector<Moving> moving_;
  int placed_level_ = -1, placed_joints_ = 0;
  CellIndex placed_cell_{};
};

}  // namespace handey
