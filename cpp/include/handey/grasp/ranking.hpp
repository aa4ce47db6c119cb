// Which feature pair to try first: the one whose common area stays unobstructed when what is near
// the part at its origin and, moved by T^-1, near it at its destination is projected on it. And
// where in that area to put the fingertips. Obstacles count that reach into the layer outside a
// face which a finger fills, the part's own protrusions too. Errs on the large side: what is called
// unobstructed is (obstacles are grown by the clearance, mitred). Not guaranteed: that palm and arm
// find room; that is legality. Article, grasp planning steps 1-3, Figure 4. T takes the part from
// its origin to its destination.
#pragma once

#include <string>
#include <vector>

#include "handey/grasp/backproject.hpp"
#include "handey/grasp/features.hpp"
#include "handey/grasp/target.hpp"

namespace handey {

enum class PairChoice { All, TwoFaces, BeyondFaces };

struct RankingOptions {
  FeatureOptions features;
  double finger_clearance = 0.002;  ///< obstacles this near the finger's layer obstruct it [m]
  double open_clearance =
      0.008;  ///< the open pads stand this far from the faces: the layer is thicker by it [m]
  bool use_destination = true;  ///< false: look at the origin only (what the article warns of)
  double least_share = 0.02;    ///< pairs with less unobstructed are dropped
  int most_targets = 5;         ///< fingertip targets per pair
  /// Which pairs are ranked: those with edges and vertices cost more to look at and are worth less,
  /// so that it pays to ask for them only when two faces do not serve.
  PairChoice pairs = PairChoice::All;
};

struct RankedPair {
  FeaturePair pair;
  Region unobstructed;  ///< of the overlap, in (x, y) of G [m]
  /// What obstructs the fingers' layers on and around the overlap, grown [m]. Its loops may
  /// overlap, so that `area` counts twice; `contains` and the booleans are right.
  Region blocked;
  double share = 0.0;            ///< unobstructed / overlap area
  double share_at_origin = 0.0;  ///< looking at the origin's obstacles only
  /// share * min(1, unobstructed area / area of a pad) for two faces. With edges: share * min(1,
  /// unobstructed length / pad length), at a point: share; that times 0.10 (face and edge), 0.05
  /// (parallel edges), 0.03 (face and vertex), 0.02 (crossed edges). Choice: two faces are tried
  /// first unless next to nothing of them is free.
  double score = 0.0;
  Region contact_a, contact_b;  ///< FeaturePair's, unobstructed; empty for two faces
  std::vector<std::string>
      obstructing;  ///< names: "block", "rack (destination)", "the part itself"
  std::vector<std::string> obstructing_at_origin;            ///< names of bodies
  std::vector<std::string> obstructing_at_destination;       ///< the same
  std::vector<Eigen::Vector2d> targets;                      ///< fingertip targets, best first
  Eigen::Vector2d centre_of_mass = Eigen::Vector2d::Zero();  ///< of the part, in (x, y) of G [m]
};

struct Ranking {
  std::vector<RankedPair> ranked;          ///< best first
  std::vector<RankedPair> obstructed;      ///< dropped for want of unobstructed area
  std::vector<RejectedPair> rejected;      ///< too wide, ...
  int faces = 0, edges = 0, vertices = 0;  ///< that the part has (edges and vertices: if asked for)
  int beyond_faces = 0;                    ///< pairs with edges or vertices, ranked or not
};

/// Order: by `score`. Choice: the article's percentage, times how much of a pad the unobstructed
/// area could hold, so that a small free face does not come before a large one that is nearly free;
/// ties by area, then by face indices.
/// @param X_WP_goal the part at its destination
/// @throws InvalidInput (E_RANGE, E_NUMBER, E_REF)
Ranking rank_grasps(const Cell& cell, int part, const Pose& X_WP_goal,
                    const RankingOptions& options = {});

/// The same with the part's pairs found before (they do not depend on where it stands);
/// options.features is not used.
Ranking rank_grasps(const Cell& cell, int part, const Pose& X_WP_goal, const FeaturePairs& features,
                    const RankingOptions& options = {});

}  // namespace handey
