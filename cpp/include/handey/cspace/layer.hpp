// One layer of a slice for those who look at it: at one waist angle, which cells of (theta2,
// theta3) are proved free for every configuration in them and every wrist value of a range, and
// what the centres of the others say. Boxes of cells are proved, and split where they are not; all
// are as thick in the waist angle as one finest cell.
// Conservative: a cell called free is free. Not for planning: all of the layer is looked at.
// Article: the pictures of Figure 7.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/collision/box_certificate.hpp"
#include "handey/cspace/lattice.hpp"
#include "handey/cspace/slice.hpp"

namespace handey {

enum class CellKind : std::uint8_t {
  Free,       ///< proved
  NotProved,  ///< its centre is free, with the wrist in the middle of its range
  Collides    ///< its centre is not free
};

struct SliceLayer {
  double theta1 = 0.0;          ///< middle of the layer [rad]
  int columns = 0, rows = 0;    ///< cells of theta2, cells of theta3
  std::vector<CellKind> kinds;  ///< of cell (theta2 c, theta3 r) at r * columns + c
};

struct LayerOptions {
  int level = 3;            ///< of the lattice: 3 is 1 degree
  double clearance = 1e-4;  ///< least distance proved [m]
};

/// @param theta1 any angle of the layer [rad]
/// @throws InvalidInput (E_DOF, E_NUMBER, E_LIMIT, E_RANGE) for arms of fewer than three joints, a
/// waist angle outside its limits, a wrist range of the wrong length or not in order, an opening
/// that is not the gripper's, or options out of range
SliceLayer prove_layer(CollisionChecker& checker, double theta1, const WristRange& wrist,
                       double opening, const LayerOptions& options = {});

}  // namespace handey
