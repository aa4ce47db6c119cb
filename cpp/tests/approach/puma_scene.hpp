// The Puma over a table with a block on it, for the tests of the local planners.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "../kinematics/puma.hpp"
#include "handey/collision/checker.hpp"
#include "handey/grasp/legality.hpp"

namespace handey::test {

using testing::puma;

inline Pose at(double x, double y, double z, double yaw = 0.0) {
  return pose_from_xyz_rpy({x, y, z}, {0, 0, yaw});
}

inline Body box(const std::string& name, const Eigen::Vector3d& size, const Pose& X_WB) {
  Body body;
  body.name = name;
  body.shapes.push_back({Box{size}, Pose::Identity()});
  body.X_WB = X_WB;
  return body;
}

/// A table with its top at z = 0 and a block 40 x 60 x 50 mm on it.
inline Cell block_on_table(const std::vector<Body>& more_fixtures = {}) {
  Cell cell;
  cell.name = "test";
  cell.robot = puma();
  cell.start = {puma()->home, 0.1};
  cell.fixtures.push_back(box("table", {1.6, 1.4, 0.05}, at(0.55, 0, -0.025)));
  for (const Body& fixture : more_fixtures) cell.fixtures.push_back(fixture);
  cell.parts.push_back(box("block", {0.04, 0.06, 0.05}, at(0.5, 0.2, 0.025)));
  return cell;
}

inline GraspScene scene_of(const Cell& cell, const Pose& X_WP_goal) {
  return {make_collision_model(cell), cell, 0, X_WP_goal};
}

/// Each edge looked at every few hundredths of a millimetre.
inline void expect_free(CollisionChecker& checker, const std::vector<Configuration>& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double largest = (path[i + 1].q - path[i].q).cwiseAbs().maxCoeff();
    const int samples = static_cast<int>(largest / 2e-4) + 2;
    for (int k = 0; k <= samples; ++k) {
      const double part = static_cast<double>(k) / samples;
      const Configuration between{path[i].q + part * (path[i + 1].q - path[i].q),
                                  path[i].opening + part * (path[i + 1].opening - path[i].opening)};
      const std::optional<Hit> hit = checker.find_hit(between, 5e-5);
      ASSERT_FALSE(hit.has_value()) << hit->a << " meets " << hit->b << " on edge " << i;
    }
  }
}

}  // namespace handey::test
