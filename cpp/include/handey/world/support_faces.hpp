// On which faces of a body can a part be put down? The upward horizontal ones, at all heights;
// faces of several shapes in one plane are one face. And what walls stand round about on such a
// face? Not looked at: what stands on a face, or whether there is room over it. Round shapes are
// polyhedra.
#pragma once

#include <vector>

#include "handey/geometry/polygon.hpp"
#include "handey/geometry/pose.hpp"
#include "handey/world/body.hpp"

namespace handey {

struct SupportFaceOptions {
  double level = 0.0174533;  ///< a normal leaves the vertical by no more [rad]. Choice: one degree
  double least_area = 4e-6;  ///< smaller faces are left out [m2]. Choice: 2 mm by 2 mm
  /// A wall rises at least so far over the face [m]. Choice: a lip that holds a part.
  double least_wall = 2e-3;
};

/// A face with its own frame S: z along the outward normal, x and y as those of the world, the
/// origin at the middle of the region's box.
struct SupportFace {
  Pose X_WS = Pose::Identity();
  Region region;      ///< in x, y of S [m]
  double area = 0.0;  ///< [m2]
  /// What the body's walls enclose: the holes of its section `least_wall` over the face, in x, y
  /// of S. Walls with gaps enclose nothing.
  Region enclosed;
  Region outline;  ///< of all of the body seen from above, holes filled, in x, y of S [m]
};

/// Highest first; at one height the largest first.
/// @throws InvalidInput (E_RANGE, E_GEOMETRY, E_NUMBER)
std::vector<SupportFace> support_faces(const Body& body, const SupportFaceOptions& options = {});

}  // namespace handey
