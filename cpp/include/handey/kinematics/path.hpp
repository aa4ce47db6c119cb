// Joint configurations along a path of hand poses: at each pose the inverse solution nearest to the
// one before, without a change of branch or a jump. Not guaranteed: the motion between two poses is
// a straight joint line, which leaves the straight hand line a little.
#pragma once

#include <vector>

#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

struct HandPathOptions {
  double largest_jump = 0.15;  ///< most a joint may turn from one pose to the next [rad]
};

struct HandPathResult {
  std::vector<Eigen::VectorXd> path;  ///< one per pose, as far as it went
  bool complete = false;
  std::string reason;  ///< why it stopped
};

/// @param X_RH_path hand poses in the robot frame, the first reached from `q_start`
HandPathResult follow_hand_path(const SphericalWristSolver& solver,
                                const std::vector<Pose>& X_RH_path, const Eigen::VectorXd& q_start,
                                const HandPathOptions& options = {});

}  // namespace handey
