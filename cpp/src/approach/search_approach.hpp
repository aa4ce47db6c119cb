// The planner that does not give up: the search in the grasp plane, over a coarse lattice and then
// finer ones, first out of the aim, then out of poses near it that are legal grasps of the pair as
// well.
#pragma once

#include "approach_task.hpp"
#include "hand_search.hpp"
#include "obstacle_layers.hpp"

namespace handey {

class SearchApproach {
 public:
  SearchApproach(const ApproachTask& task, HandReach& reach);

  ApproachResult run();

 private:
  bool try_aim(HandSearch& search, ApproachResult& result);
  bool try_neighbours(HandSearch& search, ApproachResult& result);
  std::vector<LatticePoint> neighbours(const HandSearch& search) const;
  void take(SearchedWay&& way, const GraspPose& grasp, ApproachResult& result) const;
  std::string enclosing();

  const ApproachTask& task_;
  const ObstacleLayers obstacles_;  // in the frame of the aim
  HandReach& reach_;
};

}  // namespace handey
