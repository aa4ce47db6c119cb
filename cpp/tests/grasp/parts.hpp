// Parts, a bare jaw and cells for the tests of this floor.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "handey/geometry/mesh_file.hpp"
#include "handey/world/cell.hpp"

namespace handey::testing {

inline Pose translation(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

inline Body box_body(const std::string& name, const Eigen::Vector3d& size,
                     const Pose& X_WB = Pose::Identity()) {
  Body body;
  body.name = name;
  body.shapes.push_back({Box{size}, Pose::Identity()});
  body.X_WB = X_WB;
  return body;
}

/// A gripper on no arm: palm, two fingers 10 mm thick, 20 mm wide, tips 15 mm beyond the pads'
/// centre; opens 100 mm.
inline std::shared_ptr<const Robot> jaw_robot() {
  auto robot = std::make_shared<Robot>();
  robot->name = "jaw";
  robot->bodies.resize(3);
  robot->bodies[0].name = "palm";
  robot->bodies[0].shapes.push_back({Box{{0.05, 0.13, 0.02}}, translation(0.0, 0.0, -0.06)});
  for (const int side : {1, 2}) {
    const double sign = side == 1 ? 1.0 : -1.0;
    robot->bodies[side].name = side == 1 ? "left" : "right";
    robot->bodies[side].shapes.push_back(
        {Box{{0.02, 0.01, 0.065}}, translation(0.0, 0.005 * sign, -0.0175)});
    FingerJoint& finger = robot->gripper.fingers[side - 1];
    finger.name = robot->bodies[side].name;
    finger.child = side;
    finger.axis = Eigen::Vector3d(0.0, sign, 0.0);
  }
  return robot;
}

inline Cell jaw_cell() {
  Cell cell;
  cell.name = "bench";
  cell.robot = jaw_robot();
  cell.start.q = Eigen::VectorXd(0);
  return cell;
}

/// A U of three boxes, open upwards: 60 x 20 x 40 mm, walls and floor 10 mm thick.
inline Body u_part() {
  Body body;
  body.name = "u";
  body.shapes.push_back({Box{{0.06, 0.02, 0.01}}, translation(0.0, 0.0, 0.005)});
  body.shapes.push_back({Box{{0.01, 0.02, 0.03}}, translation(-0.025, 0.0, 0.025)});
  body.shapes.push_back({Box{{0.01, 0.02, 0.03}}, translation(0.025, 0.0, 0.025)});
  return body;
}

/// A mesh of the shared test data; nothing if the data are not there.
inline std::optional<Body> shared_part(const std::string& file, double scale) {
  const std::string path = std::string(HANDEY_SOURCE_DIR) + "/../shared/data/parts/" + file;
  if (!std::filesystem::exists(path)) return std::nullopt;
  MeshFileOptions options;
  options.scale.setConstant(scale);
  Body body;
  body.name = file.substr(0, file.find('.'));
  MeshShape shape;
  shape.mesh = std::make_shared<const TriangleMesh>(load_mesh(path, options).mesh);
  body.shapes.push_back({shape, Pose::Identity()});
  return body;
}

}  // namespace handey::testing
