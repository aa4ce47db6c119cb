// Local planning near obstacles. The gripper slides in the grasp plane toward the target; bump lines that
// touch filled cells forbid motion that way and turn it.
// Incomplete: may stall in a local minimum, and says so.
// Article: "Local planning: the quasipotential method", Figure 5.
#pragma once

#include <functional>
#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

struct QuasipotentialOptions {
  double clearance = 0.006;      ///< bump-line distance d from the gripper [m]
  int max_iterations = 2000;     ///< then the status is IterationLimit
  int progress_interval = 20;    ///< iterations between two looks at the progress
  double torque_gain = 0.5;      ///< turn per torque, before the one-cell limit
};

enum class SlideStatus { Reached, Stalled, IterationLimit, StartBlocked };

struct SlideResult {
  SlideStatus status = SlideStatus::Stalled;
  std::vector<PlanarPose> path;  ///< (x, y, theta) in the grasp plane G, no point moves more than a cell between two
  int iterations = 0;
  int refusals = 0;              ///< steps that the reach test refused
};

/// Asked once per step: may the hand be there? On false another direction is tried.
using ReachTest = std::function<bool(const PlanarPose&)>;

/// Slide the gripper from `start` toward `target`.
/// @throws InvalidInput if `start` lies outside the grid
SlideResult slide_to_target(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& start,
                            const Eigen::Vector2d& target, const ReachTest& reachable,
                            const QuasipotentialOptions& options = {});

}  // namespace handey
