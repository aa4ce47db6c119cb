// What all planners of one approach share.
#pragma once

#include <algorithm>

#include "handey/approach/approach.hpp"

namespace handey {

struct ApproachTask {
  const GraspScene& scene;
  const SphericalWristSolver& solver;
  const RankedPair& pair;
  const GraspPose& aim;
  const Eigen::VectorXd& q_pick;
  const ApproachOptions& options;
  Pose X_WG;  ///< grasp plane in the world
  GripperOutline outline;

  /// What makes a pose beside the aim a grasp, the hand as wide open as at the aim.
  LegalityOptions legality_at(const PlanarPose& pose) const {
    LegalityOptions legality = options.legality;
    legality.least_contact_share = options.contact_share;
    const double width = pair.pair.width_at({pose.x, pose.y});
    legality.open_clearance = std::max(0.0, 0.5 * (aim.opening - width));
    return legality;
  }
  /// Side of the square round the aim that obstacles are wanted from, halved [m].
  double half_size() const {
    return options.run_in + outline.radius + std::max(options.slide.clearance, 2.0 * options.cell);
  }
};

}  // namespace handey
