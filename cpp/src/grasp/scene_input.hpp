// The check of a scene at the public functions of this floor that place hands in it.
#pragma once

#include "handey/errors.hpp"
#include "handey/geometry/pose.hpp"
#include "handey/grasp/legality.hpp"
#include "ranges.hpp"

namespace handey::grasp {

/// @throws InvalidInput if model or robot are missing, the part is none of the cell's, the hand is
///     not empty, or the goal is no pose
inline void require_valid_scene(const GraspScene& scene) {
  if (!scene.model) throw InvalidInput("E_MISSING", "scene.model", "is missing");
  if (!scene.cell.robot) throw InvalidInput("E_MISSING", "scene.cell.robot", "is missing");
  require_in_range(scene.part, 0, static_cast<double>(scene.cell.parts.size()) - 1, "scene.part");
  if (scene.cell.held) {
    throw InvalidInput("E_RANGE", "scene.cell.held", "holds a part, expected an empty hand");
  }
  require_rigid(scene.X_WP_goal, "scene.X_WP_goal");
}

}  // namespace handey::grasp
