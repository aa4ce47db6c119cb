// Which face pair to try first: the one whose common area stays unobstructed when what is near the part at its origin
// and, moved by T^-1, near it at its destination is projected on it. And where in that area to put the fingertips.
// Article, grasp planning steps 1-3, Figure 4. T takes the part from its origin to its destination.
#pragma once

#include <string>
#include <vector>

#include "handey/grasp/backproject.hpp"
#include "handey/grasp/features.hpp"

namespace handey {

struct RankingOptions {
  FeatureOptions features;
  double finger_clearance = 0.002;  ///< obstacles this near the finger's layer obstruct it [m]
  bool use_destination = true;      ///< false: look at the origin only (what the article warns of)
  double least_share = 0.02;        ///< pairs with less unobstructed are dropped
  int most_targets = 5;             ///< fingertip targets per pair
};

struct RankedPair {
  FacePair pair;
  Region unobstructed;                     ///< of the overlap, in (x, y) of G [m]
  double share = 0.0;                      ///< unobstructed / overlap area
  double share_at_origin = 0.0;            ///< looking at the origin's obstacles only
  std::vector<std::string> obstructing;    ///< names: "block", "rack (destination)"
  std::vector<Eigen::Vector2d> targets;    ///< fingertip targets, best first
};

struct Ranking {
  std::vector<RankedPair> ranked;          ///< best first
  std::vector<RankedPair> obstructed;      ///< dropped for want of unobstructed area
  std::vector<RejectedPair> rejected;      ///< too wide, ...
  int faces = 0;
};

/// @param X_WP_goal the part at its destination
Ranking rank_grasps(const Cell& cell, int part, const Pose& X_WP_goal, const RankingOptions& options = {});

}  // namespace handey
