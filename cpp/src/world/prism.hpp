// A convex polygon between two planes: what measured columns are covered by.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "handey/geometry/shape.hpp"

namespace handey::world {

/// Corners of the lower end and of the upper, counter-clockwise with u to the right and v up.
struct Prism {
  std::vector<Eigen::Vector3d> lower, upper;
};

/// The box along the axes round it.
Eigen::AlignedBox3d extent(const Prism& solid);

/// A box at a place.
struct PlaceBox {
  Pose X_OD;             // map in the box's frame
  Eigen::Vector3d half;  // [m]
};

/// Does a plane of the box or of the solid part them? If not they may still be apart.
bool may_meet(const Prism& solid, const PlaceBox& box);

/// As a box where it is one, else as a convex mesh.
Shape shape_of(const Prism& solid);

}  // namespace handey::world
