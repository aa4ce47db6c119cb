// Pairs of features with an edge or a vertex among them.
#pragma once

#include "handey/grasp/features.hpp"
#include "part_faces.hpp"

namespace handey::grasp {

/// Adds to `features`, whose faces are found already: edges, vertices, pairs, rejected ones.
void add_pairs_beyond_faces(const Body& part, const Gripper& gripper, ExposedFaces& exposed,
                            const FeatureOptions& options, FeaturePairs& features);

}  // namespace handey::grasp
