// Tolerances are wide enough for URDFs whose right angles are written 1.5708, and such arms are
// then told apart from exact ones, for which the closed form needs no refinement.
#include "arm_axes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "numbers.hpp"
#include "rotation.hpp"

namespace handey::kinematics {
namespace {

constexpr double kMeetTolerance = 1e-6;  // of the wrist axes [m]
constexpr double kParallelTolerance =
    1e-5;                            // axes 2 and 3: URDFs say 1.5708 for a right angle [rad]
constexpr double kRounding = 1e-11;  // deviations below need no refinement

double distance_from_axis(const ArmAxes& axes, Eigen::Index i, const Eigen::Vector3d& point) {
  return across(axes.directions.col(i), point - axes.points.col(i)).norm();
}

double sine_between(const ArmAxes& axes, Eigen::Index i, Eigen::Index j) {
  return axes.directions.col(i).cross(axes.directions.col(j)).norm();
}

}  // namespace

ArmAxes axes_at_zero(const Robot& robot) {
  ArmAxes axes;
  Pose X_RB = Pose::Identity();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const ArmJoint& joint = robot.joints[static_cast<std::size_t>(i)];
    X_RB = X_RB * joint.X_PJ;
    axes.directions.col(i) = (X_RB.linear() * joint.axis).normalized();
    axes.points.col(i) = X_RB.translation();
  }
  axes.X_RH_zero = X_RB * robot.gripper.X_BH;
  return axes;
}

Eigen::Vector3d wrist_centre(const ArmAxes& axes) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 3; i < 6; ++i) {
    const Eigen::Vector3d w = axes.directions.col(i);
    const Eigen::Matrix3d projector = Eigen::Matrix3d::Identity() - w * w.transpose();
    sum += projector;
    right += projector * axes.points.col(i);
  }
  return sum.inverse() * right;
}

std::string objection(const Robot& robot) {
  if (robot.joints.size() != 6) {
    return "the arm has " + std::to_string(robot.joints.size()) + " joints; expected 6";
  }
  const ArmAxes axes = axes_at_zero(robot);
  if (sine_between(axes, 1, 2) > kParallelTolerance) {
    return "axes 2 and 3 are " +
           number_text(std::asin(std::min(1.0, sine_between(axes, 1, 2))), 3) +
           " rad from parallel; expected parallel axes";
  }
  if (sine_between(axes, 0, 1) < 1e-3) return "axes 1 and 2 are parallel; expected them not to be";
  if (sine_between(axes, 3, 4) < 1e-3) return "axes 4 and 5 are parallel; expected them not to be";
  if (sine_between(axes, 4, 5) < 1e-3) return "axes 5 and 6 are parallel; expected them not to be";
  const Eigen::Vector3d centre = wrist_centre(axes);
  for (Eigen::Index i = 3; i < 6; ++i) {
    const double miss = distance_from_axis(axes, i, centre);
    if (miss > kMeetTolerance) {
      return "axis " + std::to_string(i + 1) + " misses the wrist's centre by " +
             number_text(miss, 3) + " m; expected axes 4, 5 and 6 to meet in a point";
    }
  }
  if (distance_from_axis(axes, 1, axes.points.col(2)) < 1e-3) return "axes 2 and 3 are one line";
  if (distance_from_axis(axes, 2, centre) < 1e-3) return "the wrist's centre lies on axis 3";
  return {};
}

bool is_exact(const ArmAxes& axes) {
  bool exact = sine_between(axes, 1, 2) < kRounding;
  const Eigen::Vector3d centre = wrist_centre(axes);
  for (Eigen::Index i = 3; i < 6; ++i) {
    exact = exact && distance_from_axis(axes, i, centre) < kRounding;
  }
  return exact;
}

Vector6 refine(const ArmAxes& axes, const Vector6& start, const Pose& motion) {
  Vector6 q = start;
  for (int step = 0; step < 3; ++step) {
    Pose reached = Pose::Identity();
    Eigen::Matrix<double, 6, 6> jacobian;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Eigen::Vector3d w = reached.linear() * axes.directions.col(i);
      const Eigen::Vector3d p = reached * Eigen::Vector3d(axes.points.col(i));
      jacobian.col(i) << p.cross(w), w;
      const Eigen::Matrix3d turn = rotation_about(axes.directions.col(i), q[i]);
      const Eigen::Vector3d point = axes.points.col(i);
      Pose e = Pose::Identity();
      e.linear() = turn;
      e.translation() = point - turn * point;
      reached = reached * e;
    }
    // The twist, about the origin of R, that takes what is reached to what is wanted.
    const Pose rest = motion * reached.inverse();
    const Eigen::AngleAxisd turn(rest.linear());
    const Eigen::Vector3d omega = turn.angle() * turn.axis();
    Vector6 twist;
    twist << rest.translation() - 0.5 * omega.cross(rest.translation()), omega;
    const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(jacobian);
    const Vector6 change = lu.solve(twist);
    // Near a singularity the step may be wild; the closed form is then the better answer.
    if (!change.allFinite() || change.cwiseAbs().maxCoeff() > 1e-2) return q;
    q += change;
    if (change.cwiseAbs().maxCoeff() < 1e-13) break;
  }
  return q;
}

}  // namespace handey::kinematics
