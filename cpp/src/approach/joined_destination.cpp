// A part that stands near the destination becomes a fixture of the joined cell.
#include "handey/approach/joined_destination.hpp"

#include <utility>

#include "handey/collision/hand_only.hpp"

namespace handey {

JoinedScene join_destination(const GraspScene& scene, double radius) {
  JoinedScene joined;
  joined.cell = scene.cell;
  const Pose& X_WP = scene.cell.parts.at(static_cast<std::size_t>(scene.part)).X_WB;
  for (const NearbyBody& near : nearby_bodies(scene.cell, scene.part, scene.X_WP_goal, radius)) {
    if (!near.at_destination) continue;
    Body copy = scene.cell.body(near.body);
    copy.name += " (destination)";
    copy.X_WB = X_WP * near.X_PB;
    const int index = static_cast<int>(joined.cell.fixtures.size());
    joined.copies.push_back({BodyRef::Kind::Fixture, index});
    joined.cell.fixtures.push_back(std::move(copy));
  }
  joined.model = make_collision_model(joined.cell, scene.model);
  return joined;
}

CollisionChecker make_checker(const JoinedScene& joined) {
  CollisionChecker checker(joined.model, joined.cell);
  keep_hand_only(checker, joined.copies);
  return checker;
}

}  // namespace handey
