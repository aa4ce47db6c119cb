// The hand with what it holds, seen in the grasp plane: the part is one more body of the hand. Two
// outlines: one that contains it, for what may touch, and prisms that lie within it, for what must
// collide.
#pragma once

#include "handey/approach/bump_lines.hpp"
#include "handey/collision/checker.hpp"

namespace handey {

/// The gripper's pieces and the hulls of the held part's shapes; the gripper's alone if nothing is
/// held. Coordinates as in OutlinePiece.
GripperOutline outline_with_part(const GripperOutline& gripper, const Cell& cell);

/// The gripper's pieces and prisms along the closing axis that lie within the held part, the
/// largest few.
GripperOutline core_with_part(const GripperOutline& gripper, CollisionChecker& checker);

}  // namespace handey
