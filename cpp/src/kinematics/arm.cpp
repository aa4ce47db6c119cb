// Where every body of the robot is: one walk along the arm's chain, then the two fingers on the
// hand. Joint values may lie outside the limits; limit_violation says so.
#include "handey/kinematics/arm.hpp"

#include <cmath>

#include "handey/errors.hpp"
#include "numbers.hpp"
#include "rotation.hpp"

namespace handey {
namespace {

constexpr double kLimitTolerance = 1e-9;  // [rad], stated in the header

Pose pose_of_child(const ArmJoint& joint, const Pose& X_RP, double q) {
  Pose X_RJ = X_RP * joint.X_PJ;
  X_RJ.linear() *= kinematics::rotation_about(joint.axis, q);
  return X_RJ;
}

void require_joint_values(const Robot& robot, const Eigen::VectorXd& q) {
  const auto dof = static_cast<Eigen::Index>(robot.joints.size());
  if (q.size() != dof) {
    throw InvalidInput("E_DOF", "q",
                       "has " + std::to_string(q.size()) + " values; the arm of '" + robot.name +
                           "' has " + std::to_string(dof) + " joints");
  }
  for (Eigen::Index i = 0; i < dof; ++i) {
    if (!std::isfinite(q[i])) {
      throw InvalidInput(
          "E_NUMBER", "q[" + std::to_string(i) + "]",
          "is " + kinematics::number_text(q[i]) + "; expected a finite number [rad]");
    }
  }
}

}  // namespace

void body_poses(const Robot& robot, const Configuration& configuration, std::vector<Pose>& poses) {
  require_joint_values(robot, configuration.q);
  if (!std::isfinite(configuration.opening)) {
    throw InvalidInput("E_NUMBER", "opening", "is not finite; expected a distance [m]");
  }
  poses.assign(robot.bodies.size(), Pose::Identity());
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const ArmJoint& joint = robot.joints[i];
    poses[static_cast<std::size_t>(joint.child)] =
        pose_of_child(joint, poses[static_cast<std::size_t>(joint.parent)],
                      configuration.q[static_cast<Eigen::Index>(i)]);
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    Pose X_RF = poses[static_cast<std::size_t>(finger.parent)] * finger.X_PJ;
    X_RF.translate(finger.axis * (0.5 * configuration.opening));
    poses[static_cast<std::size_t>(finger.child)] = X_RF;
  }
}

std::vector<Pose> body_poses(const Robot& robot, const Configuration& configuration) {
  std::vector<Pose> poses;
  body_poses(robot, configuration, poses);
  return poses;
}

Pose hand_pose(const Robot& robot, const Eigen::VectorXd& q) {
  require_joint_values(robot, q);
  Pose X_RB = Pose::Identity();
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    X_RB = pose_of_child(robot.joints[i], X_RB, q[static_cast<Eigen::Index>(i)]);
    if (robot.joints[i].child == robot.gripper.body) break;
  }
  return X_RB * robot.gripper.X_BH;
}

std::string limit_violation(const Robot& robot, const Eigen::VectorXd& q) {
  require_joint_values(robot, q);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const ArmJoint& joint = robot.joints[i];
    const double value = q[static_cast<Eigen::Index>(i)];
    const bool above = value > joint.limit.upper + kLimitTolerance;
    const bool below = value < joint.limit.lower - kLimitTolerance;
    if (!above && !below) continue;
    return joint.name + " = " + kinematics::number_text(value) + " rad " +
           (above ? "exceeds " : "is below ") +
           kinematics::number_text(above ? joint.limit.upper : joint.limit.lower);
  }
  return {};
}

}  // namespace handey
