// Local planning near obstacles. The gripper slides in the grasp plane toward the target; bump
// lines that touch filled cells forbid motion that way and turn it. Incomplete: may stall in a
// local minimum, and says so. Article: "Local planning: the quasipotential method", Figure 5.
#pragma once

#include <functional>
#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

struct QuasipotentialOptions {
  double clearance = 0.006;    ///< bump-line distance d from the gripper, at least 1.5 cells [m]
  int max_iterations = 2000;   ///< then the status is IterationLimit
  int progress_interval = 20;  ///< iterations between two looks at the progress
  double torque_gain = 0.5;    ///< turn per torque, before the one-cell limit [rad/m]
  double lead = 0.02;          ///< the attraction point of slide_along moves so far ahead [m]
};

enum class SlideStatus { Reached, Stalled, IterationLimit, StartBlocked };

struct SlideResult {
  SlideStatus status = SlideStatus::Stalled;
  /// (x, y, theta) in the grasp plane G; no point of gripper or bump lines moves more than a cell
  /// between two. Reached: ends with the finger grasp point exactly on the target. Else ends where
  /// it came nearest.
  std::vector<PlanarPose> path;
  int iterations = 0;
  int refusals = 0;  ///< steps that the reach test refused
};

/// Asked once per step: may the hand be there? On false another direction is tried.
using ReachTest = std::function<bool(const PlanarPose&)>;

/// Slide the gripper from `start` toward `target`. No pose of the path has a piece of the gripper
/// on a filled cell.
/// @param grid       one layer for each piece of the outline
/// @param target     of the finger grasp point in G [m]
/// @param reachable  may throw; what it throws comes out of here
/// @throws InvalidInput if start or target lie outside the grid, layers and pieces differ in
/// number, or an option is
///         out of range (E_NUMBER, E_RANGE)
SlideResult slide_to_target(const MotionGrid& grid, const GripperOutline& outline,
                            const PlanarPose& start, const Eigen::Vector2d& target,
                            const ReachTest& reachable, const QuasipotentialOptions& options = {});

/// The same with an attraction point that moves along a route (clearance_path gives good ones):
/// always the first point of the route, from where it was before, that is `lead` away from the
/// finger grasp point; in the end the last one, the target.
/// @param route  points in G, the last one the target; at least one, all on the grid [m]
SlideResult slide_along(const MotionGrid& grid, const GripperOutline& outline,
                        const PlanarPose& start, const std::vector<Eigen::Vector2d>& route,
                        const ReachTest& reachable, const QuasipotentialOptions& options = {});

}  // namespace handey
