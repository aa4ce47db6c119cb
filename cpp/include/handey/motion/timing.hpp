// When to be where: the shortest time along a polyline in joint space (and in the opening) within the velocity and
// acceleration limits. The rows lie exactly on the polyline, every corner is a row, so what was certified is what is driven.
// At a corner the speed is such that no joint's velocity jumps by more than its acceleration limit allows in one row
// interval; the motion starts and ends at rest.
#pragma once

#include <vector>

#include "handey/kinematics/arm.hpp"

namespace handey {

struct TimingOptions {
  double interval = 0.008;      ///< longest time between rows while the speed changes [s]
  double speed_scale = 1.0;     ///< of the velocity limits, in (0, 1]
};

struct TimedPath {
  std::vector<double> time;                  ///< from 0, strictly increasing [s]
  std::vector<Configuration> configurations; ///< one per time
  double duration() const { return time.empty() ? 0.0 : time.back(); }
};

/// @throws InvalidInput (E_DOF, E_NUMBER, E_LIMIT) for wrong lengths, numbers, or a path outside the joint limits
TimedPath time_path(const Robot& robot, const std::vector<Configuration>& path, const TimingOptions& options = {});

}  // namespace handey
