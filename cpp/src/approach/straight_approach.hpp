// Straight in along the approach axis: what costs least and is asked first. The arm is led from the
// grasp outwards in the grasp's branch; the joint path is certified as far as it goes.
#pragma once

#include "approach_task.hpp"
#include "hand_reach.hpp"

namespace handey {

struct StraightWay {
  std::vector<Configuration> path;  ///< certified, from the start to the grasp
  double length = 0.0;              ///< of the run-in that was proved [m]
  std::string obstacle;             ///< what ended it, if it is shorter than wanted
};

StraightWay straight_way(const ApproachTask& task, HandReach& reach);

}  // namespace handey
