// The article's way with the destination's obstacles: moved by T^-1 to where they will be seen from
// the part, they join those of the origin, and the hand keeps off both while it comes in. Sound
// for the grasp, but it forbids ways in that the hand will never need again: plan_approach does it
// only where asked to. The copies concern the hand alone; the arm will be elsewhere.
// Article: "Grasp planning", Figure 4.
#pragma once

#include <memory>
#include <vector>

#include "handey/grasp/legality.hpp"

namespace handey {

/// The origin with copies of what is near the part at its destination.
struct JoinedScene {
  std::shared_ptr<const CollisionModel> model;
  Cell cell;                    ///< the copies are fixtures: "wall (destination)"
  std::vector<BodyRef> copies;  ///< which
};

/// @param radius  copies are made of bodies within that distance of the part's bounding box [m]
/// @throws InvalidInput as nearby_bodies does
JoinedScene join_destination(const GraspScene& scene, double radius = 0.4);

/// A checker of that cell in which the hand alone is kept apart from the copies.
CollisionChecker make_checker(const JoinedScene& joined);

}  // namespace handey
