// From the triangles of a file to a surface: corners at one place become one vertex, triangles
// without area go, neighbours agree which side is out. Private to the library.
#pragma once

#include "handey/geometry/polyhedron.hpp"

namespace handey {

/// Joins vertices nearer than `tolerance` [m] and drops those that no triangle uses, and triangles
/// that name a vertex twice.
TriangleMesh weld(const TriangleMesh& mesh, double tolerance);

/// Drops triangles without area where the surface stays as closed as it was.
TriangleMesh drop_flat_triangles(const TriangleMesh& mesh);

/// Turns triangles until neighbours agree, and each piece turned this way outward; false if
/// impossible (more than two triangles at an edge, or a one-sided surface); then the mesh is
/// unchanged.
bool orient_consistently(TriangleMesh& mesh);

}  // namespace handey
