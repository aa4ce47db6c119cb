// Gross motion by random sampling: OMPL's RRT-Connect over all joints, with the certificate as motion validator.
// The only source that sees OMPL. Probabilistically complete; bounded by iterations, not by the clock, so repeatable.
// Article: the "guaranteed methods" to fall back on, in today's form.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct SamplingOptions {
  std::uint64_t seed = 0;
  int max_iterations = 4000;     ///< states sampled
  double range = 0.6;            ///< longest tree edge, in the joint metric [rad]
  CertificateOptions certificate;
};

enum class MotionStatus { Found, StartBlocked, GoalsBlocked, IterationLimit };

struct MotionResult {
  MotionStatus status = MotionStatus::IterationLimit;
  std::vector<Configuration> path;  ///< start to one goal; every edge certified
  int goal = -1;                    ///< which goal was reached
  int iterations = 0;
  std::string planner;              ///< "straight", "RRT-Connect"
  std::string reason;               ///< why not found, with names
  bool found() const { return status == MotionStatus::Found; }
};

/// @param goals same opening as the start
MotionResult plan_by_sampling(CollisionChecker& checker, const Configuration& start,
                              const std::vector<Configuration>& goals, const SamplingOptions& options = {});

}  // namespace handey
