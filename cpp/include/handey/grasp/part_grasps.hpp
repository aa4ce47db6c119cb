// Grasps of a part that do not depend on where it stands: hand poses in the part frame that hold
// it, with an eye on nothing but the part itself. Candidates are those of legality (targets x
// directions x the hand's half-turns x pads drawn back), for pairs ranked without neighbours; those
// fall at which the hand, the jaws opened little, meets the part, and every direction keeps its
// best. Which of them fit where the part stands: compatibility. Not guaranteed: that the finite set
// holds every grasp that is needed. Article: "Regrasping", the grasps of a part.
#pragma once

#include <memory>
#include <vector>

#include "handey/grasp/legality.hpp"
#include "handey/grasp/ranking.hpp"

namespace handey {

/// A hand pose on a pair of features.
struct PartGrasp {
  Feature a, b;  ///< the pair: indices as in FeaturePairs of the part
  PlanarPose in_plane;
  bool flipped = false;
  Pose X_PH = Pose::Identity();  ///< grasp frame in the part
  double width = 0.0;            ///< opening when closed on the part [m]
  /// GraspPose's without what the arm and the world add: contact, lever, edge, 0..0.7.
  double merit = 0.0;
};

struct PartGraspOptions {
  RankingOptions ranking;
  LegalityOptions legality;  ///< directions, spacing, contact, hold and clearances count
  /// Grasps, shared evenly by pairs and directions; more only where else a direction of a pair
  /// would have none.
  int most = 6000;
};

/// The pairs of a part that stands alone: obstructed by its own protrusions only.
/// @throws InvalidInput (E_MISSING, E_RANGE, E_GEOMETRY)
Ranking rank_part_alone(const Body& part, const std::shared_ptr<const Robot>& robot,
                        const RankingOptions& options = {});

/// Pair after pair, best first; in each the most promising first.
/// @throws InvalidInput as rank_part_alone
std::vector<PartGrasp> sample_part_grasps(const Body& part,
                                          const std::shared_ptr<const Robot>& robot,
                                          const PartGraspOptions& options = {});

/// Per grasp: does the hand, the jaws opened by `open_clearance` / 4 each side [m], stay above the
/// plane z = 0 with the part at X_SP? Necessary wherever the part stands so on a plane that is wide
/// enough.
/// @throws InvalidInput (E_MISSING, E_NUMBER)
std::vector<char> clears_plane(const std::shared_ptr<const Robot>& robot,
                               const std::vector<PartGrasp>& grasps, const Pose& X_SP,
                               const LegalityOptions& options = {});

}  // namespace handey
