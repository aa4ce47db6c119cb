// Is no hand pose legal at which the jaws could hold a part where it stands? The hand's poses on a
// feature pair are points (x, y, theta) of its grasp plane. Cells of these are cut finer until each
// is proved empty (no contact; the wrist out of reach; a solid of the hand deeper in a solid of an
// obstacle than any pose of the cell lets it move), or, where the arm's joints decide, its centre
// is illegal with a margin. The first legal pose that is met ends it: nothing is proved then. What
// the check of a plan would accept is not called illegal: only the closed hand counts, at no
// clearance. Article: the legality of grasps at pick-up and put-down.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/grasp/features.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

struct ExhaustionOptions {
  double spacing = 0.006;    ///< of cells that may be judged by their centres [m]
  double turn = 0.08726646;  ///< the same of directions [rad]. Choice: 5 degrees
  /// Looked at before it is given up; one at which the arm decides counts more. Choice: 0.2 s.
  std::size_t most_cells = 40000;
  int most_pairs = 400;  ///< with edges or vertices; a part with more is given up
};

enum class IllegalKind { OutOfReach, JointLimit, Collision };

/// What makes hand poses illegal.
struct IllegalCause {
  IllegalKind kind = IllegalKind::Collision;
  std::string mover, other;  ///< of collisions: "gripper", "rack"
  int joint = -1;            ///< of joint limits
  double share = 0.0;        ///< of all that is illegal, 0..1
  /// The least that was met: metres out of reach, radians past a limit; 0 for collisions.
  double least = 0.0;
};

struct Exhaustion {
  bool exhausted = false;  ///< no hand pose is legal at the resolution below
  int pairs = 0;           ///< of features that the jaws span
  std::size_t cells_looked_at = 0;
  double spacing = 0.0, turn = 0.0;  ///< widest cells judged by their centres [m], [rad]; 0: none
  std::vector<IllegalCause> causes;  ///< greatest share first
  std::string reason;                ///< why it is not exhausted; empty if it is
};

/// @param places  the part in the world; with several, a pose must be legal at all of them
/// @throws InvalidInput (E_MISSING, E_REF, E_RANGE, E_NUMBER, E_GEOMETRY, E_EMPTY)
Exhaustion exhaust_grasps(const std::shared_ptr<const CollisionModel>& model, const Cell& cell,
                          int part, const std::vector<Pose>& places,
                          const SphericalWristSolver& solver,
                          const ExhaustionOptions& options = {});

}  // namespace handey
