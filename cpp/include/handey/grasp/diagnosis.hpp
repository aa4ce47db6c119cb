// Why no grasp is legal at both ends: not what hand poses fall by first, which is what they meet
// most often, but what alone keeps most of them from being legal. Hand poses are spread over the
// pairs of features of the part as if it stood alone, in jaws that open wider than they do; each is
// put to all tests at both ends, without stopping at the first, with the inverse solution of fewest
// obstacles, joint limits being one of them. What the jaws, the joints and the bodies of the cell
// have to give way by is told with each. Not guaranteed: that the obstacle told, taken away, leaves
// a plan; the hand poses are a sample, and neither approach nor gross motions are looked at.
#pragma once

#include <string>
#include <vector>

#include "handey/grasp/legality.hpp"
#include "handey/grasp/ranking.hpp"

namespace handey {

struct DiagnosisOptions {
  RankingOptions ranking;
  LegalityOptions legality;
  int most_poses = 2000;  ///< hand poses looked at
  int most_pairs = 24;    ///< pairs of features that they are spread over, the best
  double wider = 0.05;    ///< pairs are looked at that the jaws miss by so much [m]
};

/// Something that stands in the way of hand poses.
struct GraspObstacle {
  FallKind kind = FallKind::Collision;
  GraspEnd end = GraspEnd::Both;
  std::string mover;     ///< of a collision: link that met it first; "hand" for the hand's own body
  std::string body;      ///< of a collision: fixture, part, or a link of the robot
  int joint = -1;        ///< past its limit
  bool carries = false;  ///< the part stands on the body at that end, so it cannot be taken away
  int met = 0;           ///< hand poses in whose way it is
  int alone = 0;         ///< of these those that would be legal without it
  int in_fewest = 0;     ///< hand poses of fewest obstacles that have it among them
  /// By how much it is in the way at least, of the poses that it alone keeps from being legal, or
  /// else of all [m], of a joint [rad]; of a collision the depth, of a few of these; -1: not looked
  /// at.
  double least = -1.0;
  // The hand pose for which it is so.
  Pose X_PH = Pose::Identity();  ///< grasp frame in the part
  double opening = 0.0;          ///< as the hand comes [m]
  double width = 0.0;            ///< closed on the part [m]
};

struct Diagnosis {
  int looked_at = 0;  ///< hand poses that fit the part itself
  int misfits = 0;    ///< hand poses at which the hand meets the part
  int legal = 0;      ///< at both ends
  int fewest = 0;     ///< obstacles of the hand poses that have fewest
  int free_at_origin = 0, free_at_destination = 0;  ///< legal at one end, the other not looked at
  std::vector<GraspObstacle> obstacles;             ///< `alone` falling, then `in_fewest`
};

/// @throws InvalidInput as find_legal_grasps and rank_part_alone
Diagnosis diagnose_grasps(const GraspScene& scene, const DiagnosisOptions& options = {});

}  // namespace handey
