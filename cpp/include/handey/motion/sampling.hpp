// Gross motion by random sampling: OMPL's RRT-Connect over all joints, with the certificate as
// motion validator. The only source that sees OMPL. Bounded by states sampled, not by the clock,
// and with a random generator of its own, so the same request gives the same path, whatever was
// planned before it. Distances are weighted: a joint counts by how far it can move the hand, 1 for
// the joint that moves it farthest. Probabilistically complete: not guaranteed is any bound on the
// time it takes, nor an answer that there is no way. Article: the "guaranteed methods" to fall back
// on, in today's form (Kuffner and LaValle, ICRA 2000).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "handey/collision/certificate.hpp"

namespace handey {

struct SamplingOptions {
  std::uint64_t seed = 0;
  int max_iterations = 20000;  ///< states sampled, at least 1
  double range = 0.6;          ///< longest tree edge, in the weighted metric [rad]
  CertificateOptions certificate;
};

enum class MotionStatus {
  Found,
  StartBlocked,
  GoalsBlocked,
  IterationLimit,
  Infeasible  ///< proved: no path leads from the start to any goal that is free
};

struct MotionResult {
  MotionStatus status = MotionStatus::IterationLimit;
  std::vector<Configuration> path;  ///< from the start to goals[goal]; every edge certified
  int goal = -1;                    ///< which goal was reached
  int iterations = 0;               ///< states sampled, or boxes of the slices looked at
  std::string planner;              ///< "straight", "slices", "RRT-Connect"
  std::string slices_reason;        ///< why the slices gave no way, if they were searched in vain
  std::string reason;               ///< why not found, with names and numbers
  bool found() const { return status == MotionStatus::Found; }
};

/// Continuous joints are sampled over two turns to either side of zero, and as far as start and
/// goals lie.
/// @param goals same opening as the start
/// @throws InvalidInput (E_EMPTY, E_DOF, E_NUMBER, E_LIMIT, E_RANGE) for no goal, wrong lengths,
/// numbers or options,
///   configurations outside the limits, or a goal of another opening
MotionResult plan_by_sampling(CollisionChecker& checker, const Configuration& start,
                              const std::vector<Configuration>& goals,
                              const SamplingOptions& options = {});

}  // namespace handey
