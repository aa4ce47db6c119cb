// Bit maps of what a small piece of the arm's plane forbids: the cells of (theta2, theta3) in which
// a link can meet it, and the cells in which the wrist can lie in it. They depend on the robot
// alone, so they are made once, kept on disk under a key of their content, and a slice for any
// scene is the union of the maps of the filled pieces. The pieces are cut from rings about axis 2,
// not from squares: a turn of the second joint then only shifts a map by whole rows, and one
// direction's maps serve for all (0.7 MB at 8 degrees; squares of 2 cm with their runs would take
// more than 10). Errs on the safe side: whatever a link can reach anywhere within a cell is marked.
// After Lozano-Perez and O'Donnell, "Parallel robot motion planning", ICRA 1991.
#pragma once

#include <memory>
#include <string>

#include "handey/cspace/cross_section.hpp"
#include "handey/cspace/lattice.hpp"

namespace handey {

struct ArmTableOptions {
  int level = 0;          ///< of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1
  double square = 0.02;   ///< width of a ring at level 0 [m]; half at level 1, a quarter beyond
  std::string directory;  ///< where tables are kept; empty: in memory only
};

/// Immutable, shared.
class ArmTable {
 public:
  struct Impl;  // for this floor's sources
  explicit ArmTable(std::unique_ptr<const Impl> impl);
  ~ArmTable();
  const Impl& impl() const { return *impl_; }
  const Lattice& lattice() const;
  int level() const;

 private:
  std::unique_ptr<const Impl> impl_;
};

/// Read from the directory if it is kept there, else made (and kept, if the directory can be
/// written). A file that does not fit its key is made anew.
/// @return null, and why in `reason`, for arms whose second and third axes are not parallel, or
/// whose hand the third joint does not move
/// @throws InvalidInput (E_RANGE) for options out of range
std::shared_ptr<const ArmTable> make_arm_table(const Robot& robot,
                                               const ArmTableOptions& options = {},
                                               std::string* reason = nullptr);

}  // namespace handey
