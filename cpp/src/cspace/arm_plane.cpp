// The arm's plane from the first three joints' axes as they lie in the body that the waist moves.
#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include "handey/cspace/cross_section.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-6;  // of axes 2 and 3, as the header says [rad]
constexpr double kUpright = 1e-3;   // sine of the angle between axes 1 and 2 that tells y

/// A line in the body that joint 1 moves; axis 1 goes through that body's origin.
struct Line {
  Vector3d point, direction;
};

Vector3d across(const Vector3d& axis, const Vector3d& vector) {
  return vector - axis * axis.dot(vector);
}

/// The point of `line` that is nearest to the line through the origin along `axis`.
Vector3d nearest_point(const Line& line, const Vector3d& axis) {
  const double cosine = axis.dot(line.direction);
  const double squared_sine = line.direction.cross(axis).squaredNorm();
  if (squared_sine < kUpright * kUpright) return line.point;
  const double along =
      (cosine * axis.dot(line.point) - line.direction.dot(line.point)) / squared_sine;
  return line.point + along * line.direction;
}

Eigen::Matrix3d plane_axes(const Line& shoulder, const Line& elbow, const Vector3d& waist) {
  const Vector3d z = shoulder.direction;
  const Vector3d up = across(z, waist);
  Eigen::Matrix3d axes;
  axes.col(2) = z;
  if (up.norm() > kUpright) {
    axes.col(1) = up.normalized();
    axes.col(0) = axes.col(1).cross(z);
    return axes;
  }
  const Vector3d reach = across(z, elbow.point - shoulder.point);
  axes.col(0) = reach.norm() > 1e-9 ? Vector3d(reach.normalized()) : z.unitOrthogonal();
  axes.col(1) = z.cross(axes.col(0));
  return axes;
}

void explain(std::string* reason, const std::string& text) {
  if (reason != nullptr) *reason = text;
}

}  // namespace

Pose ArmPlane::X_RE(double q1) const {
  Pose turn = Pose::Identity();
  turn.linear() = Eigen::AngleAxisd(q1, waist_axis).toRotationMatrix();
  turn.translation() = waist_point - turn.linear() * waist_point;
  return X_R1 * X_1E * turn;
}

std::optional<ArmPlane> arm_plane(const Robot& robot, std::string* reason) {
  if (robot.joints.size() < 3) {
    explain(reason, "the arm has " + std::to_string(robot.joints.size()) +
                        " joints, its plane needs three");
    return std::nullopt;
  }
  const Pose& X_12 = robot.joints[1].X_PJ;
  const Pose X_13 = X_12 * robot.joints[2].X_PJ;
  const Vector3d waist = robot.joints[0].axis.normalized();
  const Line shoulder{X_12.translation(), (X_12.linear() * robot.joints[1].axis).normalized()};
  const Line elbow{X_13.translation(), (X_13.linear() * robot.joints[2].axis).normalized()};
  const double sine = shoulder.direction.cross(elbow.direction).norm();
  if (!(sine <= kParallel)) {
    std::ostringstream text;
    text << "axes 2 and 3 (" << robot.joints[1].name << ", " << robot.joints[2].name << ") are "
         << std::atan2(sine, std::abs(shoulder.direction.dot(elbow.direction)))
         << " rad from parallel, at most " << kParallel << " is allowed";
    explain(reason, text.str());
    return std::nullopt;
  }
  ArmPlane plane;
  plane.X_1E.linear() = plane_axes(shoulder, elbow, waist);
  plane.X_1E.translation() = nearest_point(shoulder, waist);
  const Configuration zero{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size())),
                           0.0};
  plane.X_R1 = body_poses(robot, zero)[static_cast<std::size_t>(robot.joints[0].child)];
  const Pose X_E1 = plane.X_1E.inverse();
  plane.waist_point = X_E1.translation();
  plane.waist_axis = X_E1.linear() * waist;
  plane.elbow = (X_E1 * elbow.point).head<2>();
  plane.elbow_sense = shoulder.direction.dot(elbow.direction) > 0.0 ? 1.0 : -1.0;
  return plane;
}

}  // namespace handey
