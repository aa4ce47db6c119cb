// What of a solid lies between two parallel planes, seen along their normal: the way obstacles
// enter the grasp plane and the obstructed part of a face. Errs on the large side: the region
// returned contains the true projection (to 1e-6 m).
#pragma once

#include "handey/geometry/polygon.hpp"
#include "handey/geometry/shape.hpp"

namespace handey {

/// Projection onto the x-y plane of G of the part of `shape` with lower <= z <= upper in G.
/// Interiors count: a slab wholly inside a solid is full there.
/// @param X_GB pose of the shape's body in G
Region slab_projection(const Shape& shape, const Pose& X_GB, double lower, double upper);

}  // namespace handey
