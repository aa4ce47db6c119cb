// Everything that stands in the way of a configuration, or of the hand alone at a pose that the arm
// need not reach: what a planner that stops at the first hit does not ask, and a diagnosis does.
#pragma once

#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

/// Which bodies of the robot are looked at.
enum class HitsOf {
  Everything,
  Hand,  ///< the gripper, its fingers and what is held, against what stands in the cell
  Arm    ///< everything else
};

/// All pairs of bodies that are checked and not farther apart than `clearance` [m], each once; at
/// what distance is not looked at: `distance` is `clearance`.
/// @throws InvalidInput (E_DOF, E_NUMBER)
std::vector<Hit> find_all_hits(CollisionChecker& checker, const Configuration& configuration,
                               HitsOf of = HitsOf::Everything, double clearance = 1e-4);

/// The same for the hand alone, its grasp frame at X_RH in the robot frame.
std::vector<Hit> find_hand_hits(CollisionChecker& checker, const Pose& X_RH, double opening,
                                double clearance = 1e-4);

/// What is met on the straight joint edge from a to b, both with their openings: pairs of bodies,
/// those first that are met at most of `samples` configurations spread over it.
/// @throws InvalidInput (E_DOF, E_NUMBER, E_RANGE)
std::vector<Hit> find_hits_along(CollisionChecker& checker, const Configuration& a,
                                 const Configuration& b, int samples = 64);

/// How deep the hand, its grasp frame at X_RH, is in the body of this name: by so much it must be
/// moved out, at least [m]; 0 if it is not in it.
double hand_depth(CollisionChecker& checker, const Pose& X_RH, double opening,
                  const std::string& body);

}  // namespace handey
