// Straight motion of the hand out of contact: lifting a part off what it stands on, drawing the
// open hand back from a part. Reversed it is the deposit, or a straight approach. Every edge is
// certified; while the part has moved less than `contact_travel`, the contacts it stood in are
// allowed, and only if the motion does not deepen them. Not guaranteed: between two configurations
// the motion is a straight joint line, which leaves the hand's straight line a little.
#pragma once

#include <string>
#include <vector>

#include "handey/collision/certificate.hpp"
#include "handey/kinematics/path.hpp"

namespace handey {

struct RetreatOptions {
  double least = 0.02;             ///< shorter is a failure [m]
  double most = 0.10;              ///< stops there [m]
  double step = 0.01;              ///< between two hand poses [m]
  double contact_travel = 0.0015;  ///< first step, with contacts allowed [m]
  /// It ends at the farthest point where the first three joints are free by so much to either
  /// side, the wrist as it is, if there is one: the gross motion then starts in a free cell of its
  /// slice (article, "Global planning": I' and F'). Choice: the width of a finest cell. 0: not
  /// asked [rad].
  double room = 0.0175;
  CertificateOptions certificate;
};

struct RetreatResult {
  bool found = false;
  /// From the contact outwards, certified; the first edge is `contact_travel` long. As far as it
  /// went, if not found.
  std::vector<Configuration> path;
  double travelled = 0.0;  ///< [m]
  bool has_room = false;   ///< it ends where `room` is free; false if that was not asked
  std::string
      reason;  ///< what stopped it before `most`, with names and numbers; empty if nothing did
};

/// @param in_contact  checker with the contacts allowed (used for the first step only); may be the
/// same as `clear`
/// @param clear       checker without them
/// @param direction   of the hand's motion, world [unit vector]
/// @throws InvalidInput (E_DOF, E_NUMBER, E_RANGE)
RetreatResult plan_retreat(CollisionChecker& in_contact, CollisionChecker& clear,
                           const SphericalWristSolver& solver, const Configuration& start,
                           const Eigen::Vector3d& direction, const RetreatOptions& options = {});

}  // namespace handey
