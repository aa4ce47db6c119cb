// The Puma 560 of models/robots/puma560 and a table before it, as all the examples use them. What
// the robot file says in YAML is said here in C++: a program without Python needs no other file
// than the URDF.
#pragma once

#include <memory>
#include <string>

#include "handey/handey.hpp"

namespace example {

inline std::shared_ptr<const handey::Robot> load_puma560(const std::string& models) {
  handey::RobotDescription description;
  description.name = "puma560";
  description.arm = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"};
  description.home = {0.0, 1.5708, -1.5708, 0.0, 0.0, 0.0};
  description.gripper_link = "gripper";
  description.X_LH.translation().z() = 0.125;  // 15 mm behind the finger tips
  description.fingers = {"left_finger_joint", "right_finger_joint"};
  description.ignore_collisions = {{"link4", "link6"}, {"left_finger", "right_finger"}};
  const std::string urdf = models + "/robots/puma560/puma560.urdf";
  return std::make_shared<handey::Robot>(handey::load_robot(urdf, description).robot);
}

inline handey::Pose at(double x, double y, double z, double yaw = 0.0) {
  return handey::pose_from_xyz_rpy({x, y, z}, {0.0, 0.0, yaw});
}

inline handey::Body box(const std::string& name, const Eigen::Vector3d& size,
                        const handey::Pose& X_WB) {
  handey::Body body;
  body.name = name;
  body.shapes = {handey::Shape{handey::Box{size}, handey::Pose::Identity()}};
  body.X_WB = X_WB;
  return body;
}

/// The robot at home beside a table whose top is z = 0.
inline handey::Cell table_cell(const std::string& models) {
  handey::Cell cell;
  cell.name = "table";
  cell.robot = load_puma560(models);
  cell.fixtures = {box("table", {1.6, 1.4, 0.05}, at(0.55, 0.0, -0.025))};
  cell.start = {cell.robot->home, cell.robot->gripper.max_opening};
  return cell;
}

}  // namespace example
