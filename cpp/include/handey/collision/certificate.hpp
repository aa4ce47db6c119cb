// Proves that a straight edge in joint space (and in the opening) is free: no point of a body moves
// farther than the bound of its motion, so a configuration with more distance than that bound
// clears a whole stretch. Else the stretch is split, found colliding, or given up as colliding. An
// edge that is not proved is never called free. After Schwarzer, Saha, Latombe, T-RO 21(3), 2005;
// bounds per joint from the true distance to its axis.
#pragma once

#include "handey/collision/checker.hpp"

namespace handey {

struct CertificateOptions {
  double clearance = 1e-4;  ///< least distance proved along the edge [m]
  double resolution =
      2e-4;  ///< a stretch that moves no point farther and is not proved is given up [m]
};

enum class EdgeStatus { Free, Colliding, GivenUp };

struct EdgeResult {
  EdgeStatus status = EdgeStatus::GivenUp;
  Hit hit;              ///< the pair in the way, unless Free
  double at = 0.0;      ///< where along the edge, 0..1
  int evaluations = 0;  ///< configurations looked at
  bool is_free() const { return status == EdgeStatus::Free; }
};

/// @throws InvalidInput for wrong lengths or numbers that are not finite
EdgeResult certify_edge(CollisionChecker& checker, const Configuration& a, const Configuration& b,
                        const CertificateOptions& options = {});

/// All edges of a path; the result is the first that is not free (`at` then counts edges: 2.4 = 0.4
/// along edge 2).
EdgeResult certify_path(CollisionChecker& checker, const std::vector<Configuration>& path,
                        const CertificateOptions& options = {});

/// Upper bound on how far any point of the moving bodies (robot and held part) travels along the
/// edge [m].
double motion_bound(CollisionChecker& checker, const Configuration& a, const Configuration& b);

}  // namespace handey
