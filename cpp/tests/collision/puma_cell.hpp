// Cells for the tests of the collision room: the Puma among boxes, and small worlds made by hand.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "../kinematics/puma.hpp"
#include "handey/geometry/mesh_file.hpp"
#include "handey/world/cell.hpp"

namespace handey::testing {

inline Pose at(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

inline Body box_body(const std::string& name, const Eigen::Vector3d& size, const Pose& X_WB) {
  Body body;
  body.name = name;
  body.shapes.push_back({Box{size}, Pose::Identity()});
  body.X_WB = X_WB;
  return body;
}

inline Body mesh_body(const std::string& name, TriangleMesh mesh, const Pose& X_WB,
                      bool solid = true) {
  Body body;
  body.name = name;
  body.shapes.push_back({MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), solid}});
  body.X_WB = X_WB;
  return body;
}

/// A box as a mesh of 12 triangles.
inline TriangleMesh box_mesh(const Eigen::Vector3d& size,
                             const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  Shape shape{Box{size}, Pose::Identity()};
  shape.X_BS.translation() = centre;
  return tessellate(shape);
}

/// An L of two legs along x and z, as one closed mesh that is not convex; corner at the origin.
inline TriangleMesh l_mesh(double length, double thickness) {
  const std::vector<Eigen::Vector2d> outline{
      {0, 0},     {length, 0}, {length, thickness}, {thickness, thickness}, {thickness, length},
      {0, length}};
  TriangleMesh mesh;
  for (const double y : {-0.5 * thickness, 0.5 * thickness}) {
    for (const Eigen::Vector2d& p : outline) mesh.vertices.emplace_back(p.x(), y, p.y());
  }
  const std::vector<Eigen::Vector3i> cap{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const Eigen::Vector3i& t : cap) {
    mesh.triangles.push_back(t);
    mesh.triangles.emplace_back(t[0] + 6, t[2] + 6, t[1] + 6);
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.emplace_back(i, i + 6, j);
    mesh.triangles.emplace_back(j, i + 6, j + 6);
  }
  return mesh;
}

/// An open box (tray): five walls of one closed mesh, inner size given, opening upwards.
inline TriangleMesh tray_mesh(const Eigen::Vector3d& inner, double wall) {
  TriangleMesh mesh;
  const Eigen::Vector3d o(0.5 * inner.x() + wall, 0.5 * inner.y() + wall, 0),
      i(0.5 * inner.x(), 0.5 * inner.y(), 0);
  const auto ring = [&](const Eigen::Vector3d& half, double z) {
    mesh.vertices.emplace_back(-half.x(), -half.y(), z);
    mesh.vertices.emplace_back(half.x(), -half.y(), z);
    mesh.vertices.emplace_back(half.x(), half.y(), z);
    mesh.vertices.emplace_back(-half.x(), half.y(), z);
  };
  ring(o, -wall);      // 0..3
  ring(o, inner.z());  // 4..7
  ring(i, inner.z());  // 8..11
  ring(i, 0.0);        // 12..15
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  quad(3, 2, 1, 0);
  quad(12, 13, 14, 15);
  for (int k = 0; k < 4; ++k) {
    const int n = (k + 1) % 4;
    quad(k, n, 4 + n, 4 + k);
    quad(4 + k, 4 + n, 8 + n, 8 + k);
    quad(8 + k, 8 + n, 12 + n, 12 + k);
  }
  return mesh;
}

inline Cell puma_cell() {
  Cell cell;
  cell.name = "test";
  cell.robot = puma();
  cell.start.q = cell.robot->home;
  cell.start.opening = 0.1;
  cell.fixtures.push_back(box_body("table", {1.6, 1.2, 0.05}, at(0.55, 0, -0.025)));
  cell.parts.push_back(box_body("block", {0.04, 0.06, 0.03}, at(0.45, -0.1, 0.015)));
  return cell;
}

/// Numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Pose pose(double size) {
    Pose pose = Pose::Identity();
    const Eigen::Vector3d axis = vector(1.0);
    pose.linear() = Eigen::AngleAxisd(uniform(-3.1, 3.1), axis.normalized()).toRotationMatrix();
    pose.translation() = vector(size);
    return pose;
  }
  Configuration configuration(const Robot& robot) {
    Configuration c;
    c.q.resize(static_cast<Eigen::Index>(robot.joints.size()));
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      c.q[static_cast<Eigen::Index>(j)] =
          uniform(robot.joints[j].limit.lower, robot.joints[j].limit.upper);
    }
    c.opening = uniform(robot.gripper.min_opening, robot.gripper.max_opening);
    return c;
  }

 private:
  std::mt19937_64 generator_;
};

/// The Puma on its table with `count` boxes of 4 to 20 cm about, clear of the base.
inline Cell cluttered_cell(int count, std::uint64_t seed = 25) {
  Cell cell = puma_cell();
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(-3.1, 3.1), radius = random.uniform(0.45, 0.85);
    Pose X = random.pose(0.0);
    X.translation() = Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle),
                                      random.uniform(0.1, 1.2));
    const Eigen::Vector3d size(random.uniform(0.04, 0.2), random.uniform(0.04, 0.2),
                               random.uniform(0.04, 0.2));
    cell.fixtures.push_back(box_body("box" + std::to_string(i), size, X));
  }
  return cell;
}

}  // namespace handey::testing
