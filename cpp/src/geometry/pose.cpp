// Rigid transforms from and to the numbers that files hold. Everything is checked for finiteness
// here, since a NaN pose means "no collision" to most engines.
#include "handey/geometry/pose.hpp"

#include <cmath>
#include <sstream>

#include "handey/errors.hpp"

namespace handey {
namespace {

constexpr double kNormTolerance = 1e-3;   // a quaternion written with four digits still passes
constexpr double kRigidTolerance = 1e-6;  // greatest error of R^T R - I and of the last row

template <typename Vector>
void require_finite(const Vector& values, const std::string& place) {
  if (values.allFinite()) return;
  std::ostringstream text;
  text << "found [" << values.transpose() << "], expected finite numbers";
  throw InvalidInput("E_NUMBER", place, text.str());
}

}  // namespace

Pose pose_from_xyz_rpy(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  require_finite(xyz, "xyz");
  require_finite(rpy, "rpy");
  Pose pose = Pose::Identity();
  pose.linear() = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() = xyz;
  return pose;
}

Pose pose_from_xyz_quat(const Eigen::Vector3d& xyz, const Eigen::Vector4d& quat_xyzw) {
  require_finite(xyz, "xyz");
  require_finite(quat_xyzw, "quat_xyzw");
  const double norm = quat_xyzw.norm();
  if (!(std::abs(norm - 1.0) <= kNormTolerance)) {
    std::ostringstream text;
    text << "found [" << quat_xyzw.transpose() << "] of norm " << norm
         << ", expected a unit quaternion (x, y, z, w), norm 1 within " << kNormTolerance;
    throw InvalidInput("E_QUATERNION", "quat_xyzw", text.str());
  }
  const Eigen::Vector4d unit = quat_xyzw / norm;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(unit.w(), unit.x(), unit.y(), unit.z()).toRotationMatrix();
  pose.translation() = xyz;
  return pose;
}

Eigen::Vector4d quaternion_xyzw(const Pose& pose) {
  require_rigid(pose, "pose");
  Eigen::Quaterniond rotation(pose.linear());
  rotation.normalize();
  const Eigen::Vector4d xyzw = rotation.coeffs();
  return xyzw.w() < 0.0 ? Eigen::Vector4d(-xyzw) : xyzw;
}

void require_rigid(const Pose& pose, const std::string& place) {
  const Eigen::Matrix4d matrix = pose.matrix();
  if (!matrix.allFinite()) {
    throw InvalidInput("E_NUMBER", place,
                       "found a number that is not finite, expected a rigid transform");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d defect = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
  const double error = defect.cwiseAbs().maxCoeff();
  const Eigen::RowVector4d last = matrix.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  const bool is_reflection = rotation.determinant() < 0.0;
  const bool is_rigid =
      error <= kRigidTolerance && !is_reflection && last.cwiseAbs().maxCoeff() <= kRigidTolerance;
  if (is_rigid) return;  // a stream takes longer to make than all of the tests
  std::ostringstream text;
  if (error > kRigidTolerance) {
    text << "found axes that are not orthonormal (R^T R differs from the identity by " << error
         << "), expected at most " << kRigidTolerance;
  } else if (is_reflection) {
    text << "found a reflection (determinant -1), expected a right-handed rotation";
  } else {
    text << "found last row [" << matrix.row(3) << "], expected [0 0 0 1]";
  }
  throw InvalidInput("E_NUMBER", place, text.str());
}

}  // namespace handey
