// The robot as a tree of rigid bodies: its arm joints, its gripper, where every body is at a
// configuration. Links joined by fixed joints are one body. Body 0 is the base (all that no joint
// moves). Frames: R is the URDF's root link (the robot frame); H is the grasp frame (hand).
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "handey/geometry/shape.hpp"
#include "handey/kinematics/gripper.hpp"

namespace handey {

/// What is to be driven: the arm joints and the distance between the pads.
struct Configuration {
  Eigen::VectorXd q;     ///< arm joints [rad]
  double opening = 0.0;  ///< distance between the pads [m]
};

struct JointLimit {
  double lower = 0.0;         ///< [rad]; -infinity for a continuous joint
  double upper = 0.0;         ///< [rad]; +infinity for a continuous joint
  double velocity = 1.0;      ///< [rad/s]
  double acceleration = 5.0;  ///< [rad/s2]
};

/// A revolute arm joint: child = parent * X_PJ * Rot(axis, q).
struct ArmJoint {
  std::string name;
  int parent = 0;  ///< body index
  int child = 0;   ///< body index
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit, in the joint frame
  JointLimit limit;
};

struct RobotBody {
  std::string name;                ///< of its first link
  std::vector<std::string> links;  ///< all links that are this body
  std::vector<Shape>
      shapes;  ///< collision geometry, in the body frame (the frame of its first link)
};

/// A robot as URDF and robot file describe it. A value.
struct Robot {
  std::string name;
  std::vector<RobotBody> bodies;  ///< bodies[0] is the base; parents come before children
  std::vector<ArmJoint>
      joints;  ///< serial, base to flange; a joint's parent is the child of the one before
  Gripper gripper;
  Eigen::VectorXd home;  ///< [rad]
  std::vector<std::pair<int, int>>
      ignored_pairs;  ///< bodies never checked against each other, from the robot file
};

/// Pose of every body in R.
/// @throws InvalidInput (E_DOF, E_NUMBER) if q has the wrong length or is not finite
std::vector<Pose> body_poses(const Robot& robot, const Configuration& configuration);

/// The same into a vector that is used again, for inner loops.
void body_poses(const Robot& robot, const Configuration& configuration, std::vector<Pose>& poses);

/// Pose of the grasp frame in R: X_RH.
Pose hand_pose(const Robot& robot, const Eigen::VectorXd& q);

/// Empty if q is within the limits (tolerance 1e-9 rad), else what is wrong: "joint5 = 1.9 rad
/// exceeds 1.745".
std::string limit_violation(const Robot& robot, const Eigen::VectorXd& q);

}  // namespace handey
