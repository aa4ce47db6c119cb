// The Puma at a table, for tests of grasps where a part stands.
#pragma once

#include <memory>
#include <string>

#include "handey/kinematics/urdf.hpp"
#include "handey/world/cell.hpp"
#include "parts.hpp"

namespace handey::testing {

inline std::shared_ptr<const Robot> load_puma() {
  static const std::shared_ptr<const Robot> robot = [] {
    RobotDescription description;
    description.name = "puma560";
    description.arm = {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6"};
    description.home = {0.0, 1.5708, -1.5708, 0.0, 0.0, 0.0};
    description.gripper_link = "gripper";
    description.X_LH.translation() = Eigen::Vector3d(0, 0, 0.125);
    description.fingers = {"left_finger_joint", "right_finger_joint"};
    description.ignore_collisions = {{"link4", "link6"}, {"left_finger", "right_finger"}};
    const std::string urdf = std::string(HANDEY_MODELS_DIR) + "/robots/puma560/puma560.urdf";
    return std::make_shared<const Robot>(load_robot(urdf, description).robot);
  }();
  return robot;
}

/// A table whose top is z = 0, and a block on it as part 0.
inline Cell block_on_bench() {
  Cell cell;
  cell.name = "bench";
  cell.robot = load_puma();
  cell.fixtures.push_back(box_body("table", {1.6, 1.4, 0.05}, translation(0.55, 0, -0.025)));
  cell.parts.push_back(box_body("block", {0.04, 0.06, 0.05}, translation(0.50, 0.20, 0.025)));
  cell.start = {load_puma()->home, 0.1};
  return cell;
}

}  // namespace handey::testing
