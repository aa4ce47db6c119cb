// How deep do two pieces overlap: how far must one be moved, at least, to part them?
// Convex pieces: the least overlap of their shadows on the normals of faces and the cross products
// of edges; exact for polyhedra, for cylinders and spheres at most a percent of the radius too
// large. Other meshes: from points inside both; the balls that fit round such a point in either
// solid must be drawn apart, so it never says too much.
#pragma once

#include "piece.hpp"

namespace handey::collision {

/// 0 for pieces that do not overlap [m].
double overlap_depth(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB);

}  // namespace handey::collision
