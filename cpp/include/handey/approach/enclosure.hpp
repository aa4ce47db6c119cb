// What stands round the hand where no way out was found, or in? The hand is led along straight
// lines away from where it is: back along its approach axis, tilted from it to both sides in its
// grasp plane, and up. Counted are the bodies that it meets first on each, most on the way that
// planners try first: straight back, or up with a part in the hand. Not guaranteed: that a
// way exists without them; it is for telling people.
#pragma once

#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

/// Pairs of bodies, those first that end most of the ways; `distance` is how far the hand came, at
/// most [m]. What is in contact at the start is left out.
/// @param checker   of the cell, with what is held
/// @param distance  length of the ways [m]
/// @throws InvalidInput (E_DOF, E_NUMBER, E_RANGE)
std::vector<Hit> find_enclosing(CollisionChecker& checker, const SphericalWristSolver& solver,
                                const Configuration& start, double distance = 0.1);

}  // namespace handey
