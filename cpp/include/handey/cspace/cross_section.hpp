// What of an obstacle lies in the way of a link that moves in the arm's plane, while the waist
// turns through an interval: the obstacle's part within the link's lateral slab, projected into the
// plane, as a convex polygon that contains it for every waist angle of the interval. The arm's
// lateral offsets are respected. The article's own form is the torus: one polygon for the whole of
// the waist angles at which an obstacle can matter. Errs on the safe side: the polygon contains the
// true section. Article: "Global planning", Figure 8.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "handey/collision/scene.hpp"
#include "handey/geometry/polygon.hpp"

namespace handey {

/// The plane in which the second and third joint move the arm. Frame E turns with the waist: origin
/// on axis 2, z along axis 2 (lateral), x and y in the plane. At q2 = q3 = 0 the elbow (axis 3) is
/// at `elbow`.
struct ArmPlane {
  Pose X_1E = Pose::Identity();  ///< E in the body that joint 1 moves
  Pose X_R1 = Pose::Identity();  ///< that body in R at q1 = 0
  Eigen::Vector3d waist_point;   ///< a point of axis 1, in E [m]
  Eigen::Vector3d waist_axis;    ///< unit, in E
  Eigen::Vector2d elbow;         ///< axis 3 in the plane at q2 = 0 [m]
  double elbow_sense = 1.0;      ///< +1: q3 turns as q2 does, -1: the other way
  /// E in R at a waist angle.
  Pose X_RE(double q1) const;
};

/// @return nothing, and why in `reason`, unless the arm has three joints and its second and third
/// axes are parallel (1e-6)
std::optional<ArmPlane> arm_plane(const Robot& robot, std::string* reason = nullptr);

/// Lateral extent, along z of E [m].
struct Slab {
  double lower = 0.0, upper = 0.0;
};

/// The cross section of a convex obstacle for the waist angles q1 +- half_width, counter-clockwise
/// in (x, y) of E; empty if it never reaches the slab.
/// @param hull in R
Polygon cross_section(const ArmPlane& plane, const SceneHull& hull, const Slab& slab, double q1,
                      double half_width);

/// The article's obstacle: one polygon for all the waist angles in [lower, upper] at which the
/// obstacle can reach the slab (Figure 8).
struct Torus {
  double lower = 0.0, upper = 0.0;  ///< [rad]; upper may pass pi: the interval goes on round
  Polygon section;                  ///< in (x, y) of E [m]
};
/// Obstacles that surround the axis give one torus all the way round.
std::vector<Torus> torus_of(const ArmPlane& plane, const SceneHull& hull, const Slab& slab);

}  // namespace handey
