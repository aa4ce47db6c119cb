// Is there no way at all from start to goal? A cell of the first three joints is proved blocked if
// every configuration in it collides, whatever the joints after the third do within their limits:
// a point lies deeper inside two solids than one of them can move against the other anywhere in the
// cell. If the cells that are not proved blocked do not link start and goal, even by their corners,
// no path exists. Not guaranteed: that a separation is found (the wrist may be what does not fit,
// or the proof may need finer cells). What is called apart is apart.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/cspace/lattice.hpp"

namespace handey {

/// The bodies that collide everywhere in a cell.
struct BlockedProof {
  bool blocked = false;
  std::string mover;  ///< "forearm_link", "held bracket" ...
  std::string other;  ///< "wall", "block", "base_link" ...
};

/// Proves cells blocked for one opening and what is held. One worker; takes what it needs from the
/// checker and does not keep it.
class BlockedCells {
 public:
  /// @throws InvalidInput (E_DOF, E_NUMBER, E_RANGE) for arms of fewer than three joints, an
  /// opening that is not finite, or ranges of the first three joints of more than 10^6 coarse cells
  BlockedCells(CollisionChecker& checker, double opening);
  ~BlockedCells();
  BlockedCells(BlockedCells&&) noexcept;

  const Lattice& lattice() const;
  /// @param cell within the lattice's cells at this level
  BlockedProof prove(int level, const CellIndex& cell);

  struct Impl;  // for this room's sources
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct SeparationOptions {
  int finest_level = 2;  ///< of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1
  /// Cells looked at before it is given up. Choice: a few tenths of a second.
  std::size_t most_cells = 60000;
};

struct Separation {
  bool apart = false;            ///< no path leads from the start to any of the goals
  std::vector<char> goal_apart;  ///< per goal: no path leads to it; 0 where that is not proved
  double resolution = 0.0;       ///< widest cell edge of the finest cells that took part [rad]
  std::size_t cells_looked_at = 0;
  std::string reason;  ///< what walls the goals off, or why they are not called apart
};

/// Cells are cut finer only where they link start and goal.
/// @param goals same opening as the start
/// @throws InvalidInput (E_EMPTY, E_DOF, E_NUMBER, E_LIMIT, E_RANGE) for no goal, wrong lengths,
///   numbers or options, configurations outside the limits, or a goal of another opening
Separation prove_apart(CollisionChecker& checker, const Configuration& start,
                       const std::vector<Configuration>& goals,
                       const SeparationOptions& options = {});

}  // namespace handey
