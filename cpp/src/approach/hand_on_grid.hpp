// Is a piece of the hand on a filled cell?
#pragma once

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

/// A vector of the hand in the grasp plane.
Eigen::Vector2d turned(const PlanarPose& pose, const Eigen::Vector2d& in_hand);
/// A point of the hand in the grasp plane.
Eigen::Vector2d placed(const PlanarPose& pose, const Eigen::Vector2d& in_hand);

/// Does an edge of a piece touch a filled cell of its layer?
bool touches_filled(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& pose);

/// Does a piece lie on the centre of a filled cell? An obstacle wholly inside a piece meets none of
/// its edges. To be asked of a first pose only: later none can come in, if nothing moves more than
/// a cell at a time.
bool covers_filled(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& pose);

}  // namespace handey
