// Turns about a unit axis.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace handey::kinematics {

/// The matrix of a turn by `angle` about a unit axis (Rodrigues).
inline Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), v = 1.0 - c;
  const double x = axis.x(), y = axis.y(), z = axis.z();
  Eigen::Matrix3d rotation;
  rotation << c + x * x * v, x * y * v - z * s, x * z * v + y * s,  //
      y * x * v + z * s, c + y * y * v, y * z * v - x * s,          //
      z * x * v - y * s, z * y * v + x * s, c + z * z * v;
  return rotation;
}

/// The part of `vector` perpendicular to a unit axis.
inline Eigen::Vector3d across(const Eigen::Vector3d& axis, const Eigen::Vector3d& vector) {
  return vector - axis * axis.dot(vector);
}

/// The angle about `axis` that turns `from` to `to`, both seen along the axis; in (-pi, pi].
inline double angle_about(const Eigen::Vector3d& axis, const Eigen::Vector3d& from,
                          const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = across(axis, from), b = across(axis, to);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

}  // namespace handey::kinematics
