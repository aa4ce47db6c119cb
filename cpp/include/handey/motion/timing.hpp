// When to be where: the shortest time along a polyline in joint space (and in the opening) within
// the velocity and acceleration limits. The rows lie exactly on the polyline, every corner is a
// row, so what was certified is what is driven. The motion starts and ends at rest and stops at
// every corner, because no finite acceleration takes a straight edge round one; edges in line are
// driven through.
#pragma once

#include <vector>

#include "handey/kinematics/arm.hpp"

namespace handey {

struct TimingOptions {
  double interval = 0.008;   ///< longest time between rows while the speed changes, 1e-4 to 1 [s]
  double speed_scale = 1.0;  ///< of the velocity limits, in (0, 1]
};

struct TimedPath {
  std::vector<double> time;                   ///< from 0, strictly increasing [s]
  std::vector<Configuration> configurations;  ///< one per time
  double duration() const { return time.empty() ? 0.0 : time.back(); }
};

/// Waypoints that repeat the one before are dropped; a path that stays at one configuration is one
/// row at time 0.
/// @throws InvalidInput (E_EMPTY, E_DOF, E_NUMBER, E_RANGE, E_LIMIT) for an empty path, wrong
/// lengths, numbers or
///   options, limits that are not positive, or a path outside the limits of the joints or of the
///   opening
TimedPath time_path(const Robot& robot, const std::vector<Configuration>& path,
                    const TimingOptions& options = {});

/// Least time along a path at the velocity limits alone: sum over the edges of max_j |dq_j| / v_j
/// [s]. Never more than time_path takes. The inputs are not checked.
double travel_time(const Robot& robot, const std::vector<Configuration>& path);

}  // namespace handey
