// Two features with an edge or a vertex among them, each with the closing direction in its normal
// cone: what is known before any region is cut.
#pragma once

#include <vector>

#include "handey/grasp/features.hpp"

namespace handey::grasp {

struct Draft {
  PairKind kind = PairKind::FaceEdge;
  Feature a, b;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< closing axis, toward a
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();   ///< of the edge; any normal to `normal`
  Eigen::Vector3d at = Eigen::Vector3d::Zero();       ///< midway between the contacts [m]
  double width = 0.0;                                 ///< [m]
  double length = 0.0;                                ///< of the contact, at most; 0 at a point [m]
  double merit = 0.0;
};

/// All drafts, in the order of their features.
std::vector<Draft> draft_pairs(const FeaturePairs& features, double friction,
                               const FeatureOptions& options);

}  // namespace handey::grasp
