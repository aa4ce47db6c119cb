// Convex polyhedra: hulls of points, and the test whether a mesh is convex.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "handey/geometry/polyhedron.hpp"

namespace handey {

/// A convex solid; faces counter-clockwise seen from outside, planar.
struct ConvexPolyhedron {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;
};

/// @throws InvalidInput (E_MESH_DEGENERATE) for fewer than four points or points in one plane
ConvexPolyhedron convex_hull(const std::vector<Eigen::Vector3d>& points);

/// True if every vertex lies within `tolerance` [m] of or below every triangle's plane, and the
/// mesh is closed.
bool is_convex(const TriangleMesh& mesh, double tolerance = 1e-6);

/// The hull as triangles.
TriangleMesh triangulate(const ConvexPolyhedron& polyhedron);

}  // namespace handey
