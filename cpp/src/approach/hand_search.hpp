// The search in the grasp plane with the arm behind the hand: a way out of the grasp is searched
// for the hand, the arm follows point by point, the joint path is certified; an edge that is not
// proved free is forbidden and the search goes on, a bounded number of times.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "hand_reach.hpp"
#include "handey/approach/approach.hpp"
#include "handey/approach/plane_search.hpp"
#include "obstacle_layers.hpp"

namespace handey {

/// A certified way in, or why there is none.
struct SearchedWay {
  bool found = false;
  std::vector<Configuration> path;  ///< from the start to the grasp
  std::vector<PlanarPose> poses;    ///< of the hand in G, likewise; before the path was shortened
  std::string reason;
};

class HandSearch {
 public:
  /// @param obstacles  in the frame of the aim: the grasp plane, x along the approach from the aim
  HandSearch(const GripperOutline& outline, const ObstacleLayers& obstacles, HandReach& reach,
             const PlanarPose& aim, const ApproachOptions& options, double cell);

  /// @param q  the arm at the start, free
  SearchedWay way_from(const LatticePoint& start, const Eigen::VectorXd& q);

  const PlaneSearch& plane() const { return plane_; }
  /// Of the hand in G.
  PlanarPose pose(const LatticePoint& point) const;

 private:
  struct Stand {
    bool is_free;
    Eigen::VectorXd q;
  };
  StepAnswer step(const LatticePoint& from, const LatticePoint& to);
  int key(const LatticePoint& point) const;
  /// @return false if an edge was refused, which is then forbidden
  bool certify(const PlaneSearchResult& found, SearchedWay& way);
  std::string explain(const PlaneSearchResult& found) const;

  HandReach& reach_;
  const PlanarPose aim_;
  const ApproachOptions& options_;
  PlaneSearch plane_;
  std::unordered_map<int, Stand> stands_;  // where the arm was asked to be
  std::string refusal_;                    // the last
};

}  // namespace handey
