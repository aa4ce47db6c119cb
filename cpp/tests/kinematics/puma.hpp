// The project's own Puma 560 with its jaw, as models/robots/puma560/robot.yaml describes it.
#pragma once

#include <memory>
#include <string>

#include "handey/kinematics/urdf.hpp"

namespace handey::testing {

/// Loaded once.
inline std::shared_ptr<const Robot> puma() {
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

}  // namespace handey::testing
