// Arms for tests, built from published parameters and without files.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "handey/kinematics/arm.hpp"

namespace handey::testing {

constexpr double kPi = 3.14159265358979323846;
inline double degrees(double value) { return value * kPi / 180.0; }

inline Pose translation(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}
inline Pose turn_x(double angle) {
  return Pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
}
inline Pose turn_z(double angle) {
  return Pose(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

/// Adds a joint and its body behind the last one.
inline void add_joint(Robot& robot, const Pose& X_PJ, const Eigen::Vector3d& axis, double lower,
                      double upper) {
  const int parent = static_cast<int>(robot.bodies.size()) - 1;
  ArmJoint joint;
  joint.name = "joint" + std::to_string(parent + 1);
  joint.parent = parent;
  joint.child = parent + 1;
  joint.X_PJ = X_PJ;
  joint.axis = axis;
  joint.limit.lower = lower;
  joint.limit.upper = upper;
  robot.joints.push_back(joint);
  robot.bodies.push_back({"link" + std::to_string(parent + 1), {}, {}});
}

inline void add_gripper(Robot& robot, const Pose& X_BH) {
  Gripper& gripper = robot.gripper;
  gripper.body = static_cast<int>(robot.bodies.size()) - 1;
  gripper.X_BH = X_BH;
  for (std::size_t i = 0; i < 2; ++i) {
    gripper.fingers[i].name = i == 0 ? "left" : "right";
    gripper.fingers[i].parent = gripper.body;
    gripper.fingers[i].child = static_cast<int>(robot.bodies.size());
    gripper.fingers[i].X_PJ = X_BH;
    gripper.fingers[i].axis = Eigen::Vector3d::UnitY() * (i == 0 ? 1.0 : -1.0);
    robot.bodies.push_back({gripper.fingers[i].name, {}, {}});
  }
  robot.home = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
}

/// One row of a standard DH table [m, rad].
struct DhRow {
  double d, a, alpha;
};
constexpr double kShoulderHeight = 0.67183, kA2 = 0.4318, kA3 = 0.0203, kD3 = 0.15005, kD4 = 0.4318;
inline const DhRow kPumaTable[6] = {{kShoulderHeight, 0.0, kPi / 2},
                                    {0.0, kA2, 0.0},
                                    {kD3, kA3, -kPi / 2},
                                    {kD4, 0.0, kPi / 2},
                                    {0.0, 0.0, -kPi / 2},
                                    {0.0, 0.0, 0.0}};

inline Pose dh_rest(const DhRow& row) { return translation(row.a, 0, row.d) * turn_x(row.alpha); }

/// The Puma 560 after its standard DH table; the hand is at `reach` from the wrist centre.
inline Robot puma(double reach = 0.05625, bool limited = true) {
  Robot robot;
  robot.name = "puma560";
  robot.bodies.push_back({"base", {}, {}});
  const double low[6] = {-160, -45, -225, -110, -100, -266};
  const double high[6] = {160, 225, 45, 170, 100, 266};
  Pose rest = Pose::Identity();
  for (int i = 0; i < 6; ++i) {
    add_joint(robot, rest, Eigen::Vector3d::UnitZ(), limited ? degrees(low[i]) : -kPi,
              limited ? degrees(high[i]) : kPi);
    rest = dh_rest(kPumaTable[i]);
  }
  add_gripper(robot, translation(0, 0, reach));
  return robot;
}

/// ABB IRB 120 after its URDF.
inline Robot irb120() {
  Robot robot;
  robot.name = "irb120";
  robot.bodies.push_back({"base", {}, {}});
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  add_joint(robot, Pose::Identity(), Eigen::Vector3d::UnitZ(), -2.87979, 2.87979);
  add_joint(robot, translation(0, 0, 0.29), y, -1.91986, 1.91986);
  add_joint(robot, translation(0, 0, 0.27), y, -1.91986, 1.22173);
  add_joint(robot, translation(0, 0, 0.07), x, -2.79253, 2.79253);
  add_joint(robot, translation(0.302, 0, 0), y, -2.094395, 2.094395);
  add_joint(robot, translation(0.072, 0, 0), x, -6.98132, 6.98132);
  add_gripper(robot, Pose(Eigen::AngleAxisd(kPi / 2, y)) * translation(0, 0, 0.12));
  return robot;
}

/// An ortho-parallel arm with all seven parameters different from 0 (KUKA-like, shoulder offset b).
inline Robot ortho_parallel() {
  Robot robot;
  robot.name = "ortho_parallel";
  robot.bodies.push_back({"base", {}, {}});
  const double a1 = 0.15, a2 = -0.11, b = 0.07, c1 = 0.45, c2 = 0.6, c3 = 0.64, c4 = 0.09;
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  add_joint(robot, Pose::Identity(), z, -kPi, kPi);
  add_joint(robot, translation(a1, b, c1), y, -kPi, kPi);
  add_joint(robot, translation(0, 0, c2), y, -kPi, kPi);
  add_joint(robot, translation(a2, 0, c3), z, -kPi, kPi);
  add_joint(robot, Pose::Identity(), y, -kPi, kPi);
  add_joint(robot, Pose::Identity(), z, -kPi, kPi);
  add_gripper(robot, translation(0.01, 0.02, c4));
  return robot;
}

inline Eigen::VectorXd random_configuration(const Robot& robot, std::mt19937& random) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(robot.joints.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const JointLimit& limit = robot.joints[static_cast<std::size_t>(i)].limit;
    q[i] = std::uniform_real_distribution<double>(limit.lower, limit.upper)(random);
  }
  return q;
}

}  // namespace handey::testing
