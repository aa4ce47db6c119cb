// Does a surface pass through itself? Private to the library.
#pragma once

#include "handey/geometry/polyhedron.hpp"

namespace handey {

/// True if an edge of one triangle passes through the inside of another that shares no vertex with
/// it. Not found: surfaces that only touch, and crossings exactly through edges. Gives up, with
/// false, after a bounded number of pairs.
bool crosses_itself(const TriangleMesh& mesh);

}  // namespace handey
