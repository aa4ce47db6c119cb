// A fixture or a part: shapes in one rigid body, where it is, and what may be done with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "handey/geometry/shape.hpp"

namespace handey {

struct Body {
  std::string name;
  std::vector<Shape> shapes;
  Pose X_WB = Pose::Identity();   ///< in the world
  bool support = false;           ///< parts may be put down on its upward faces between regrasps
  double friction = 0.4;          ///< with the pads (parts)
  std::optional<double> mass;     ///< [kg]
  std::optional<double> density;  ///< [kg/m3]
  bool may_move = false;          ///< may be moved although no goal names it (parts)
};

/// Centre of mass in the body frame, uniform density over the union of the shapes' volumes (summed)
/// [m].
Eigen::Vector3d centre_of_mass(const Body& body);

}  // namespace handey
