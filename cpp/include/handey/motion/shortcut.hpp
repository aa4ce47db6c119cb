// Shortens a certified path: stretches that one straight edge can replace are found by division,
// then the corners left are moved where that saves time. Every new edge is certified, and keeps a
// clearance where the path has it: it does not graze what it passes. Deterministic for a seed. Not
// guaranteed: the shortest path, nor one of the same kind on the other side of an obstacle.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct ShortcutOptions {
  std::uint64_t seed = 0;
  int attempts = 60;         ///< most moves of corners tried after waypoints were skipped
  double clearance = 0.005;  ///< kept where the path has it [m]; 0: no more than the certificate's
  CertificateOptions certificate;
};

/// Same ends; never longer, neither at the velocity limits alone (travel_time) nor with the
/// acceleration limits (time_path). Edges of `path` may stay as they are; all others of the result
/// are certified, and keep `clearance` from everything all along. Excepted are places where `path`
/// itself is nearer, at its ends or in a passage, as long again before and after them (the path is
/// looked at every 0.05 s of its travel time): there a new edge stays at least half as far away as
/// the path does. What of the edge corresponds to which place is told by the share of the way.
/// @throws InvalidInput (E_EMPTY, E_DOF, E_NUMBER, E_LIMIT, E_RANGE) for an empty path, wrong
/// lengths, numbers or
///   options, or waypoints outside the limits
std::vector<Configuration> shorten_path(CollisionChecker& checker,
                                        const std::vector<Configuration>& path,
                                        const ShortcutOptions& options = {});

}  // namespace handey
