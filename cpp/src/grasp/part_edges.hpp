// The convex edges and corners of a whole part: where a flat pad can rest without lying on a face.
#pragma once

#include <vector>

#include "handey/grasp/features.hpp"

namespace handey::grasp {

struct EdgesAndVertices {
  std::vector<PartEdge> edges;  // longest first
  std::vector<PartVertex> vertices;
};

EdgesAndVertices part_edges(const Body& part, const FeatureOptions& options);

}  // namespace handey::grasp
