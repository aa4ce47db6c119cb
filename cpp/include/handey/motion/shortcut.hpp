// Shortens a certified path; every edge of the result is certified. Deterministic for a seed.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct ShortcutOptions {
  std::uint64_t seed = 0;
  int attempts = 60;              ///< random shortcuts tried after vertex reduction
  CertificateOptions certificate;
};

/// @throws InvalidInput for an empty path
std::vector<Configuration> shorten_path(CollisionChecker& checker, const std::vector<Configuration>& path,
                                        const ShortcutOptions& options = {});

}  // namespace handey
