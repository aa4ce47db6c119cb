// A slice of configuration space over the first three joints: which cells are free for every
// configuration in them and every wrist value of a range. Built layer by layer of the waist angle,
// when asked for. The hand with what it holds counts as a few balls that the forearm carries: what
// it sweeps while the wrist turns through its range; at most the ball about the wrist centre.
// Conservative: a cell called free is free; a cell not called free may be free.
// Article: "Global planning", Figures 7 and 8.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "handey/cspace/arm_table.hpp"

namespace handey {

enum class SliceMode {
  Cells,   ///< a cross section of every obstacle for every cell of the waist angle
  Article  ///< tori: one cross section of every obstacle for all waist angles
};

/// Values of the joints after the third [rad].
struct WristRange {
  Eigen::VectorXd lower, upper;
};

struct SliceOptions {
  SliceMode mode = SliceMode::Cells;
  double clearance = 1e-4;  ///< least distance of free configurations from everything [m]
};

/// One worker; keeps a reference to the checker.
class Slice {
 public:
  /// @throws InvalidInput (E_DOF, E_RANGE, E_REF) for a wrist range of the wrong length or not in
  /// order, an opening that is not the gripper's, or a table of another robot
  Slice(CollisionChecker& checker, std::shared_ptr<const ArmTable> table, const WristRange& wrist,
        double opening, const SliceOptions& options = {});
  ~Slice();
  Slice(Slice&&) noexcept;

  const Lattice& lattice() const;
  int level() const;
  /// Why no cell can be free whatever the first three joints do (the hand meets the forearm
  /// somewhere in the wrist range); empty if there is no such reason.
  const std::string& reason() const;

  /// @param cell within the lattice's cells at this level
  bool is_free(const CellIndex& cell);
  /// Blocked cells of one layer of the waist angle as bits: theta3 runs along words, one row of
  /// words_per_row() words for each theta2.
  const std::vector<std::uint64_t>& blocked(int waist_cell);
  int words_per_row() const;
  int layers_built() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace handey
