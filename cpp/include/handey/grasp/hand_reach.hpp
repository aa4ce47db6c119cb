// Is a part so far away that no hand pose whatever lets the jaws close on it? Of two contacts, one
// on each pad, the point midway between them lies in the convex hull of the part and, in the grasp
// frame, on the pads' middle plane; so the wrist centre is within a length of the hull that the
// hand gives, and within reach of the arm. What is called beyond reach is; not that the rest is
// within.
#pragma once

#include "handey/kinematics/spherical_wrist.hpp"
#include "handey/world/body.hpp"

namespace handey {

/// How far the wrist centre can be from the point midway between two contacts of a valid grasp [m].
double hand_length(const WristReach& reach, const Gripper& gripper);

/// By how much the part at X_RP is farther than the arm reaches, at least [m]; zero or less where
/// that is not proved.
/// @param X_RP the part in the robot frame
/// @throws InvalidInput (E_NUMBER, E_GEOMETRY)
double beyond_reach(const WristReach& reach, const Gripper& gripper, const Body& part,
                    const Pose& X_RP);

}  // namespace handey
