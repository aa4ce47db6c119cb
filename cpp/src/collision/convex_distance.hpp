// How far apart are two convex solids, at least? The answer is proved, not trusted: a direction n
// gives the bound min n.a - max n.b over the two solids, exact to rounding whatever the iteration
// did that found n. Method: Gilbert-Johnson-Keerthi in double precision, stopped as soon as the
// question asked is settled.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "handey/geometry/pose.hpp"

namespace handey::collision {

/// A convex solid given by what is farthest in a direction. Boxes, cylinders and spheres are exact.
struct ConvexSolid {
  enum class Kind { Box, Cylinder, Points };
  Kind kind = Kind::Points;
  Pose X_BC = Pose::Identity();  ///< box or cylinder in the body; not used for points
  Eigen::Vector3d half =
      Eigen::Vector3d::Zero();          ///< box: half edges; cylinder: (radius, -, half length) [m]
  std::vector<Eigen::Vector3d> points;  ///< vertices in the body frame [m]
  double rounding = 0.0;  ///< radius of a ball added all round: a sphere is one point with it [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< a point inside, in the body frame [m]

  /// The point farthest along `direction` (body frame), rounding left out.
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const;
};

/// A lower bound of the distance of A from B; negative or zero where they overlap or nearly so [m].
/// Above `enough` it may be any bound that is; below `least` it may be any number below `least`.
/// Between the two it is exact to about 1e-8 m + 1e-6 of itself.
/// @param apart  if given: the unit direction along which A lies beyond B by what is returned, if
/// that is positive
double convex_distance(const ConvexSolid& a, const Pose& X_WA, const ConvexSolid& b,
                       const Pose& X_WB, double least, double enough,
                       Eigen::Vector3d* apart = nullptr);

/// How far A lies beyond B along a unit direction; negative where their extents along it overlap
/// [m].
double convex_distance_along(const ConvexSolid& a, const Pose& X_WA, const ConvexSolid& b,
                             const Pose& X_WB, const Eigen::Vector3d& direction);

}  // namespace handey::collision
