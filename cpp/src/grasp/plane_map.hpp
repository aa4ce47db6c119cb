// Plane regions carried from one plane to a parallel one (or one seen from behind).
#pragma once

#include <algorithm>

#include "handey/geometry/polyhedron.hpp"
#include "handey/geometry/pose.hpp"

namespace handey::grasp {

/// The plane frame of a face in the part: x, y = u, v; z outward.
inline Pose face_frame(const PlanarFace& face) {
  Pose X_PF = Pose::Identity();
  X_PF.linear().col(0) = face.u;
  X_PF.linear().col(1) = face.v;
  X_PF.linear().col(2) = face.normal;
  X_PF.translation() = face.origin;
  return X_PF;
}

/// A region of the x-y plane of S seen along z of T. Loops keep their sense: seen from behind they
/// are turned round.
inline Region map_region(const Region& region, const Pose& X_TS) {
  Region result;
  result.loops.reserve(region.loops.size());
  const bool seen_from_behind = X_TS.linear()(2, 2) < 0.0;
  for (const Polygon& loop : region.loops) {
    Polygon mapped;
    mapped.reserve(loop.size());
    for (const Eigen::Vector2d& point : loop) {
      const Eigen::Vector3d in_T = X_TS * Eigen::Vector3d(point.x(), point.y(), 0.0);
      mapped.emplace_back(in_T.x(), in_T.y());
    }
    if (seen_from_behind) std::reverse(mapped.begin(), mapped.end());
    result.loops.push_back(std::move(mapped));
  }
  return result;
}

/// A right-handed rotation with columns z and x made normal to z.
inline Eigen::Matrix3d rotation_with_z(const Eigen::Vector3d& z, const Eigen::Vector3d& x_hint) {
  Eigen::Matrix3d rotation;
  rotation.col(2) = z.normalized();
  rotation.col(0) = (x_hint - x_hint.dot(rotation.col(2)) * rotation.col(2)).normalized();
  rotation.col(1) = rotation.col(2).cross(rotation.col(0));
  return rotation;
}

}  // namespace handey::grasp
