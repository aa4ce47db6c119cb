// Two links in a plane among polygons: at which angles does a link that turns about a point meet an
// obstacle? Exact: the limits of the forbidden ranges are contact angles, of a vertex of one with
// an edge of the other, and between them a midpoint decides. Article: Figure 3; Lozano-Perez, "A
// simple motion-planning algorithm for general robot manipulators", IEEE J. Robotics and Automation
// RA-3(3), 1987 (one-dimensional slices).
#pragma once

#include <vector>

#include "handey/geometry/polygon.hpp"

namespace handey {

/// An interval of angles, lower <= upper [rad].
struct AngleInterval {
  double lower = 0.0, upper = 0.0;
};

/// The angles in [0, 2 pi) at which `link`, turned about the origin, meets `obstacle` (touching
/// counts), merged and sorted; a range that passes 2 pi is given in two.
/// @param link  convex, at angle 0, relative to its joint  @param obstacle convex, relative to the
/// joint
/// @throws InvalidInput (E_EMPTY, E_NUMBER) for polygons of fewer than three points or numbers that
/// are not finite
std::vector<AngleInterval> forbidden_angles(const Polygon& link, const Polygon& obstacle);
std::vector<AngleInterval> forbidden_angles(const std::vector<Polygon>& links,
                                            const std::vector<Polygon>& obstacles);

/// Two links in a plane: the upper about the origin, the lower about the elbow, which the upper
/// carries. Angles add up: the lower link's direction is theta2 + theta3.
struct PlanarArm {
  std::vector<Polygon> upper;  ///< convex pieces at theta2 = 0, relative to the shoulder [m]
  std::vector<Polygon> lower;  ///< convex pieces at theta2 = theta3 = 0, relative to the elbow [m]
  Eigen::Vector2d elbow = Eigen::Vector2d::UnitX();  ///< at theta2 = 0, relative to the shoulder
};

/// Column by column of theta2: the exact forbidden ranges of theta3 in [0, 2 pi); the whole circle
/// where the upper link itself is forbidden.
std::vector<std::vector<AngleInterval>> planar_slice(const PlanarArm& arm,
                                                     const std::vector<Polygon>& obstacles,
                                                     const std::vector<double>& theta2);

}  // namespace handey
