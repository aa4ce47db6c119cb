// The planar faces of a whole part: those of all its shapes, coplanar ones merged, and what of them
// is exposed.
#pragma once

#include <vector>

#include "handey/geometry/polyhedron.hpp"
#include "handey/world/body.hpp"

namespace handey::grasp {

/// Largest area first.
std::vector<PlanarFace> part_faces(const Body& part, double least_area);

/// True if no shape of the part can cover a face of it: one shape in one piece.
bool has_no_covered_faces(const Body& part);

/// What of the face is not covered by a shape of the part lying against it, in its own (u, v).
Region exposed_region(const Body& part, const PlanarFace& face);

}  // namespace handey::grasp
