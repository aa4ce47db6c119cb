// Rigid transforms. A pose says its frames: X_WG is G in W, so X_WP * X_PG == X_WG.
// Metres and radians. roll, pitch, yaw turn about the fixed x, y, z axes in that order (as in
// URDF): R = Rz(yaw) * Ry(pitch) * Rx(roll). Quaternions are written x, y, z, w.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace handey {

using Pose = Eigen::Isometry3d;

/// @param xyz [m]  @param rpy roll, pitch, yaw [rad]
/// @throws InvalidInput (E_NUMBER) if a number is not finite
Pose pose_from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy);

/// @param quat_xyzw of norm 1 within 1e-3; normalised exactly
/// @throws InvalidInput (E_NUMBER, E_QUATERNION)
Pose pose_from_xyz_quat(const Eigen::Vector3d& xyz, const Eigen::Vector4d& quat_xyzw);

/// The rotation as a unit quaternion (x, y, z, w) with w >= 0.
Eigen::Vector4d quaternion_xyzw(const Pose& pose);

/// @throws InvalidInput (E_NUMBER) naming `place` unless the pose is finite and orthonormal (1e-6),
/// right-handed
void require_rigid(const Pose& pose, const std::string& place);

}  // namespace handey
