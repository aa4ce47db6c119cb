// Bodies near the part at either end, as poses in the part's own frame: X_PB = X_WP^-1 * X_WB, with
// the part at its origin and at its destination. The second is the first moved by T^-1.
#include "handey/grasp/backproject.hpp"

#include "bounds.hpp"
#include "ranges.hpp"

namespace handey {

std::vector<NearbyBody> nearby_bodies(const Cell& cell, int part, const Pose& X_WP_goal,
                                      double radius) {
  grasp::require_in_range(part, 0, static_cast<double>(cell.parts.size()) - 1, "part");
  grasp::require_in_range(radius, 0.0, 100.0, "radius");
  require_rigid(X_WP_goal, "X_WP_goal");

  const Body& held = cell.parts[static_cast<std::size_t>(part)];
  std::vector<NearbyBody> nearby;
  for (const bool at_destination : {false, true}) {
    const Pose& X_WP = at_destination ? X_WP_goal : held.X_WB;
    const Eigen::AlignedBox3d around = grasp::bounding_box(held, X_WP);
    const auto add = [&](BodyRef::Kind kind, int index, const Body& body) {
      if (around.exteriorDistance(grasp::bounding_box(body, body.X_WB)) > radius) return;
      nearby.push_back({{kind, index}, body.name, at_destination, X_WP.inverse() * body.X_WB});
    };
    for (int i = 0; i < static_cast<int>(cell.fixtures.size()); ++i) {
      add(BodyRef::Kind::Fixture, i, cell.fixtures[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; i < static_cast<int>(cell.parts.size()); ++i) {
      if (i == part || (cell.held && cell.held->part == i)) continue;
      add(BodyRef::Kind::Part, i, cell.parts[static_cast<std::size_t>(i)]);
    }
  }
  return nearby;
}

}  // namespace handey
