// Convex polyhedra that contain a piece, or, for a mesh that is not convex, its surface. Errs on
// the large side: cylinders and spheres become polyhedra round them, flat patches thin prisms.
#pragma once

#include <vector>

#include "handey/collision/scene.hpp"
#include "piece.hpp"

namespace handey::collision {

/// A convex polyhedron that contains the points, also where they lie in a plane, a line or a point
/// (then it is 2e-9 m thick).
SceneHull hull_of_points(const std::vector<Eigen::Vector3d>& points);

/// One convex polyhedron that contains the piece, body frame.
SceneHull hull_of_piece(const Piece& piece);

/// Convex polyhedra whose union contains a convex piece, or the surface of one that is not convex.
std::vector<SceneHull> hulls_of_piece(const Piece& piece, const SceneOptions& options);

}  // namespace handey::collision
