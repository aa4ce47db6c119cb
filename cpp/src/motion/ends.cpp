#include "ends.hpp"

#include <cmath>
#include <cstdio>

#include "handey/errors.hpp"
#include "require.hpp"

namespace handey::motion {

void require_ends(const Robot& robot, const Configuration& start,
                  const std::vector<Configuration>& goals) {
  require_configuration(robot, start, "start");
  if (goals.empty()) throw InvalidInput("E_EMPTY", "goals", "no goal, expected at least one");
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const std::string place = "goals[" + std::to_string(k) + "]";
    require_configuration(robot, goals[k], place);
    if (std::abs(goals[k].opening - start.opening) > 1e-9) {
      throw InvalidInput("E_RANGE", place,
                         "opening = " + std::to_string(goals[k].opening) +
                             " m, expected the start's, " + std::to_string(start.opening) + " m");
    }
  }
}

FreeEnds free_ends(CollisionChecker& checker, const Configuration& start,
                   const std::vector<Configuration>& goals, double clearance) {
  if (const std::optional<Hit> hit = checker.find_hit(start, clearance)) {
    return {MotionStatus::StartBlocked, "start: " + describe(*hit), {}};
  }
  FreeEnds ends;
  for (std::size_t k = 0; k < goals.size(); ++k) {
    const std::optional<Hit> hit = checker.find_hit(goals[k], clearance);
    if (!hit) {
      ends.goals.push_back(static_cast<int>(k));
    } else if (ends.reason.size() < 400) {
      if (!ends.reason.empty()) ends.reason += "; ";
      ends.reason += "goal " + std::to_string(k) + ": " + describe(*hit);
    }
  }
  if (ends.goals.empty()) ends.status = MotionStatus::GoalsBlocked;
  return ends;
}

std::string describe(const Hit& hit) {
  if (!(hit.distance > 0.0)) return hit.a + " and " + hit.b + " overlap";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", 1e3 * hit.distance);
  return hit.a + " is " + text + " mm from " + hit.b;
}

void require_options(const SamplingOptions& options) {
  if (options.max_iterations < 1) {
    throw InvalidInput("E_RANGE", "max_iterations",
                       std::to_string(options.max_iterations) + ", expected 1 or more");
  }
  if (!(std::isfinite(options.range) && options.range > 0.0)) {
    throw InvalidInput("E_RANGE", "range",
                       std::to_string(options.range) + " rad, expected a finite number > 0");
  }
}

}  // namespace handey::motion
