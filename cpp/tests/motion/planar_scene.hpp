// A small scene of boxes for the tests of this floor: an arm of three joints in the horizontal
// plane, 0.8 m long, and walls that stand in its way. In the plane it is plain to see what is free.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "handey/collision/certificate.hpp"
#include "handey/errors.hpp"

namespace handey::test {

inline Pose at(double x, double y, double z = 0.0) {
  return pose_from_xyz_rpy({x, y, z}, {0.0, 0.0, 0.0});
}

inline RobotBody box_body(const std::string& name, const Eigen::Vector3d& size, const Pose& X_BS) {
  return {name, {name}, {Shape{Box{size}, X_BS}}};
}

// Links along x of 0.3, 0.3 and 0.15 m; the hand ends in two fingers 0.05 m long.
inline std::shared_ptr<const Robot> planar_arm() {
  auto robot = std::make_shared<Robot>();
  robot->name = "planar";
  robot->bodies = {box_body("base", {0.05, 0.05, 0.02}, at(0.0, 0.0, -0.06)),
                   box_body("upper_arm", {0.24, 0.03, 0.03}, at(0.15, 0.0)),
                   box_body("forearm", {0.24, 0.03, 0.03}, at(0.15, 0.0)),
                   box_body("hand", {0.10, 0.03, 0.03}, at(0.08, 0.0)),
                   box_body("left_finger", {0.05, 0.01, 0.02}, at(0.16, 0.005)),
                   box_body("right_finger", {0.05, 0.01, 0.02}, at(0.16, -0.005))};
  for (int j = 0; j < 3; ++j) {
    ArmJoint joint;
    joint.name = "joint" + std::to_string(j + 1);
    joint.parent = j;
    joint.child = j + 1;
    joint.X_PJ = at(j == 0 ? 0.0 : 0.3, 0.0);
    joint.limit = {-2.5, 2.5, 1.0 + j, 5.0};
    robot->joints.push_back(joint);
  }
  Gripper& gripper = robot->gripper;
  gripper.body = 3;
  // z of H along the hand, y in the plane: x of H is up.
  gripper.X_BH.linear() << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  gripper.X_BH.translation() << 0.16, 0.0, 0.0;
  for (int f = 0; f < 2; ++f) {
    FingerJoint& finger = gripper.fingers[static_cast<std::size_t>(f)];
    finger.name = f == 0 ? "left_finger_joint" : "right_finger_joint";
    finger.parent = 3;
    finger.child = 4 + f;
    finger.axis = (f == 0 ? 1.0 : -1.0) * Eigen::Vector3d::UnitY();
  }
  gripper.min_opening = 0.0;
  gripper.max_opening = 0.06;
  robot->home = Eigen::Vector3d::Zero();
  return robot;
}

inline Body wall(const std::string& name, const Eigen::Vector2d& size, double x, double y) {
  Body body;
  body.name = name;
  body.shapes = {Shape{Box{{size.x(), size.y(), 0.1}}, Pose::Identity()}};
  body.X_WB = at(x, y);
  return body;
}

inline Configuration configuration(double q1, double q2, double q3, double opening = 0.04) {
  return {Eigen::Vector3d(q1, q2, q3), opening};
}

inline Cell planar_cell(std::vector<Body> fixtures) {
  Cell cell;
  cell.name = "planar";
  cell.robot = planar_arm();
  cell.fixtures = std::move(fixtures);
  cell.start = configuration(-1.2, 0.0, 0.0);
  return cell;
}

// The arm must fold to pass a post that stands 0.45 m from its axis.
inline Cell cell_with_post() { return planar_cell({wall("post", {0.06, 0.06}, 0.45, 0.0)}); }
inline Configuration below_post() { return configuration(-1.0, 0.2, 0.0); }
inline Configuration above_post() { return configuration(1.0, -0.2, 0.0); }

inline CollisionChecker checker_of(const Cell& cell) {
  return CollisionChecker(make_collision_model(cell), cell);
}

// Dense sampling, another method than the certificate: 400 configurations per edge.
inline void expect_free(CollisionChecker& checker, const std::vector<Configuration>& path) {
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    for (int i = 0; i <= 400; ++i) {
      const double share = i / 400.0;
      const Configuration between{
          path[k].q + share * (path[k + 1].q - path[k].q),
          path[k].opening + share * (path[k + 1].opening - path[k].opening)};
      ASSERT_TRUE(checker.is_free(between, 5e-5)) << "edge " << k << " at " << share;
    }
  }
}

inline void expect_equal(const std::vector<Configuration>& a, const std::vector<Configuration>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].q, b[k].q) << k;
    EXPECT_EQ(a[k].opening, b[k].opening) << k;
  }
}

/// The code of the fault that `call` throws, "" if it throws none.
template <class Call>
std::string code_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.faults().front().code;
  }
  return "";
}

}  // namespace handey::test
