// What all planners of one approach share.
#pragma once

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

  /// Side of the square round the aim that obstacles are wanted from, halved [m].
  double half_size() const {
    return options.run_in + outline.radius + std::max(options.slide.clearance, 2.0 * options.cell);
  }
};

}  // namespace handey
