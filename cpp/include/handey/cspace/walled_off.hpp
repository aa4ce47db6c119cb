// Does the arm come to where a hand that holds a part must be? The wrist centre is then within the
// hand's length of the part. The first three joints decide where it is: their cells that are not
// proved blocked are flooded from the start; if they do not lead to any cell that may bring the
// wrist centre so near, no path does, whatever the grasp, the opening and the other joints.
// Not guaranteed: that a wall which shuts the arm out is found.
#pragma once

#include <string>
#include <vector>

#include "handey/cspace/separation.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

struct WalledOff {
  bool walled_off = false;
  bool within_limits = true;  ///< some configuration within the joints' limits comes so near
  double resolution = 0.0;    ///< widest cell edge of the finest cells that took part [rad]
  std::size_t cells_looked_at = 0;
  std::vector<std::string> bodies;  ///< at the border, those with most cells first
  std::vector<std::string> movers;  ///< what of the robot meets them, likewise
  std::string reason;               ///< why it is not proved; empty if it is
};

/// @param checker  of the cell with an empty hand, without the part
/// @param X_RP     the part in the robot frame
/// @throws InvalidInput (E_DOF, E_NUMBER, E_LIMIT, E_RANGE, E_GEOMETRY)
WalledOff prove_walled_off(CollisionChecker& checker, const Configuration& start,
                           const SphericalWristSolver& solver, const Body& part, const Pose& X_RP,
                           const SeparationOptions& options = {});

}  // namespace handey
