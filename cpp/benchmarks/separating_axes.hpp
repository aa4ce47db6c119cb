// How deep do two convex solids overlap? Separating axes: the normals of the faces of both and the
// cross products of their edges. For polyhedra the least overlap along these is exactly the depth;
// nothing is iterated. Cylinders and spheres count as inscribed 64-sided polyhedra, a mesh that is
// not convex as its triangles: what is wholly inside it is not seen.
#pragma once

#include <vector>

#include "handey/handey.hpp"

namespace benchmark {

/// A convex solid or a triangle.
struct Solid {
  std::vector<Eigen::Vector3d> points;   ///< [m]
  std::vector<Eigen::Vector3d> normals;  ///< of the faces, one of every direction
  std::vector<Eigen::Vector3d> edges;    ///< unit, one of every direction
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< of the ball that contains it [m]
};

/// In the body's frame.
std::vector<Solid> solids_of(const std::vector<handey::Shape>& shapes);
/// The solid moved, into one that is used again.
void place_solid(const Solid& solid, const handey::Pose& X, Solid& placed);

/// 0 unless it is more than 0.01 mm [m].
double overlap_depth(const Solid& a, const Solid& b);
/// The largest of all pairs.
double deepest(const std::vector<Solid>& a, const std::vector<Solid>& b);

}  // namespace benchmark
