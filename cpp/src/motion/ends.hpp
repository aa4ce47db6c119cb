// The ends of a motion that is to be planned: are they configurations of this robot, and free?
#pragma once

#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/motion/sampling.hpp"

namespace handey::motion {

/// @throws InvalidInput as require_configuration, and for no goal or one of another opening than
/// the start
void require_ends(const Robot& robot, const Configuration& start,
                  const std::vector<Configuration>& goals);

/// @throws InvalidInput (E_RANGE) for options out of range
void require_options(const SamplingOptions& options);

/// Which goals are free, in the order given; none if the start or all goals are blocked.
struct FreeEnds {
  MotionStatus status = MotionStatus::Found;
  std::string reason;
  std::vector<int> goals;
};
FreeEnds free_ends(CollisionChecker& checker, const Configuration& start,
                   const std::vector<Configuration>& goals, double clearance);

/// "forearm_link and table overlap", "forearm_link is 0.04 mm from table".
std::string describe(const Hit& hit);

}  // namespace handey::motion
