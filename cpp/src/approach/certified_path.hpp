// A polyline of configurations made of few straight edges, each of them proved free: from each
// point the farthest later point that a certified edge reaches (found by halving, so a farther one
// may be missed).
#pragma once

#include <cstddef>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct CertifiedPath {
  std::vector<Configuration> path;  ///< starts at the first point
  std::size_t reached = 0;          ///< index of the point where it ends
  EdgeResult obstacle;              ///< why it goes no farther, where reached is not the last point
};

/// @param points  neighbours near each other; at least one
CertifiedPath certified_path(CollisionChecker& checker, const std::vector<Configuration>& points,
                             const CertificateOptions& options);

}  // namespace handey
