// A part leaves what it stands on along a short edge: do the contacts that are allowed get deeper
// on the way? Proved by a plane for each pair of pieces that touch: it has one of them on either
// side, or leaves little of one beyond it, at every moment of the edge. Where there is no such
// plane, as of a peg in a hole, the depths are measured at stations, which proves nothing between
// them.
#pragma once

#include <optional>

#include "handey/collision/checker.hpp"

namespace handey {

struct ContactMotionOptions {
  double deeper = 1e-4;   ///< a contact may get deeper by this [m]
  double deepest = 5e-4;  ///< of any contact: the contact tolerance of a plan [m]
  int stations = 20;      ///< where depths are measured, for pairs without a plane
};

struct ContactMotion {
  std::optional<Hit> deeper;  ///< the pair that gets deeper; its distance is minus the depth
  int proved = 0;             ///< pairs of pieces with a plane, those never near left out
  int measured = 0;           ///< pairs without one
};

/// Looks at the pairs that `clear` keeps apart and `in_contact` does not, along the edge from `a`
/// to `b`.
/// @param in_contact, clear  checkers of the same model and cell
/// @throws InvalidInput for wrong lengths or numbers that are not finite, (E_REF) for checkers of
/// different cells
ContactMotion follow_contacts(CollisionChecker& clear, CollisionChecker& in_contact,
                              const Configuration& a, const Configuration& b,
                              const ContactMotionOptions& options = {});

}  // namespace handey
