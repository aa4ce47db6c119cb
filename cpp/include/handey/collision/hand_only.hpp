// Obstacles that only the hand is kept apart from: stand-ins for what the hand will meet elsewhere,
// where the arm is not.
#pragma once

#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

/// From now on the checker keeps only the gripper and what it holds apart from these bodies.
/// @throws InvalidInput (E_REF) for a body that does not stand in the checker's cell
void keep_hand_only(CollisionChecker& checker, const std::vector<BodyRef>& bodies);

}  // namespace handey
