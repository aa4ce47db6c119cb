// The cells of a slice: the first three joints cut into equal intervals, level by level each half
// as wide: coarse (8 degrees or a little less), then 4, 2 and 1. Cells of one level tile the
// joints' ranges exactly. Joints without limits wrap around. Article: "Global planning": low
// resolution 8 degrees, high resolution 1 degree.
#pragma once

#include <array>

#include "handey/kinematics/arm.hpp"

namespace handey {

using CellIndex = std::array<int, 3>;

struct Lattice {
  static constexpr int kLevels = 4;  ///< 8, 4, 2 and 1 degree
  std::array<double, 3> lower{};     ///< of the joints' ranges [rad]
  std::array<double, 3> width{};     ///< of a cell of level 0 [rad], at most 8 degrees
  std::array<int, 3> count{};        ///< cells of level 0
  std::array<bool, 3> wraps{};  ///< the joint has no limits: the last cell's neighbour is the first

  int cells(int level, int joint) const { return count[static_cast<std::size_t>(joint)] << level; }
  double cell_width(int level, int joint) const {
    return width[static_cast<std::size_t>(joint)] / (1 << level);
  }
  double centre(int level, int joint, int index) const {
    return lower[static_cast<std::size_t>(joint)] + (index + 0.5) * cell_width(level, joint);
  }
  /// The cell that holds an angle; -1 if it is out of the joint's range by more than 1e-9 rad.
  int index_of(int level, int joint, double angle) const;
};

/// @param coarse widest cell of level 0 [rad]
/// @throws InvalidInput (E_DOF, E_RANGE) for fewer than three joints, limits of which only one is
/// finite, or a width outside 1e-4 to pi
Lattice make_lattice(const Robot& robot, double coarse = 0.13962634015954636);

}  // namespace handey
