// Shortens a certified path: waypoints are skipped where the straight edge is free, then random
// pairs of points on it are joined where that saves time. Every edge of the result is certified.
// Deterministic for a seed. Not guaranteed: the shortest path, nor one of the same kind on the
// other side of an obstacle.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct ShortcutOptions {
  std::uint64_t seed = 0;
  int attempts = 60;  ///< random shortcuts tried after waypoints were skipped, at least 0
  CertificateOptions certificate;
};

/// Same ends; never longer, neither at the velocity limits alone (travel_time) nor with the
/// acceleration limits (time_path). Edges of `path` that cannot be certified stay as they are; all
/// others of the result are certified.
/// @throws InvalidInput (E_EMPTY, E_DOF, E_NUMBER, E_LIMIT, E_RANGE) for an empty path, wrong
/// lengths, numbers or
///   options, or waypoints outside the limits
std::vector<Configuration> shorten_path(CollisionChecker& checker,
                                        const std::vector<Configuration>& path,
                                        const ShortcutOptions& options = {});

}  // namespace handey
