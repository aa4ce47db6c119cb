// The cells of the lattice as a forest: each coarse cell can be cut into eight, where that may
// help. Leaves tile the joints' ranges; two leaves are neighbours if their closed boxes share so
// much as a corner, so a path that stays out of blocked cells goes from neighbour to neighbour.
#pragma once

#include <vector>

#include "blocked_cells.hpp"

namespace handey::cspace {

enum class CellState : unsigned char {
  Unknown,  ///< not yet looked at
  Blocked,  ///< proved
  Open,     ///< not proved, and cutting it cannot help
  Doubt,    ///< not proved; parts of it may be
  Cut       ///< no leaf
};

struct TreeCell {
  CellIndex index{};
  signed char level = 0;
  CellState state = CellState::Unknown;
  int proof = kNoPair;
  int children = -1;  ///< first of eight, if cut
};

class CellTree {
 public:
  CellTree(BlockedCells::Impl& proofs, int finest_level);

  const TreeCell& cell(int id) const { return cells_[static_cast<std::size_t>(id)]; }
  std::size_t size() const { return cells_.size(); }
  std::size_t cells_looked_at() const { return looked_at_; }
  int finest_looked_at() const { return finest_looked_at_; }

  /// The state of a leaf; looks at it if need be.
  CellState look(int id);
  /// Cuts a leaf in doubt.
  void cut(int id);
  /// Leaves that hold the configuration, its neighbourhood of rounding included.
  void leaves_at(const Eigen::VectorXd& q, std::vector<int>& leaves) const;
  /// Leaves that share at least a corner with a leaf.
  void neighbours(int id, std::vector<int>& leaves) const;
  /// How far a cell's centre is from a configuration, in the joint with the widest gap [rad].
  double gap(int id, const Eigen::VectorXd& q) const;
  /// The middle of a cell, the joints after the third as in q.
  Eigen::VectorXd middle(int id, const Eigen::VectorXd& q) const;

 private:
  /// In halves of the finest cells' edges; may pass the range of a joint that wraps around.
  struct Span {
    std::array<int, 3> lower, upper;
  };
  void collect(const Span& span, std::vector<int>& leaves) const;
  void descend(int id, const Span& span, const std::array<int, 3>& shift,
               std::vector<int>& leaves) const;

  BlockedCells::Impl& proofs_;
  const Lattice& lattice_;
  int finest_;
  std::vector<TreeCell> cells_;  ///< coarse cells first, in order
  std::size_t looked_at_ = 0;
  int finest_looked_at_ = 0;
};

}  // namespace handey::cspace
