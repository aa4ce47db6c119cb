#include "handey/motion/gross.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "ends.hpp"
#include "handey/errors.hpp"
#include "handey/motion/timing.hpp"

namespace handey {
namespace {

// Indices of the goals, nearest first; equally near ones in the order given.
std::vector<int> by_travel_time(const Robot& robot, const Configuration& start,
                                const std::vector<Configuration>& goals, std::vector<int> order) {
  std::vector<double> time;
  for (const Configuration& goal : goals) time.push_back(travel_time(robot, {start, goal}));
  std::stable_sort(order.begin(), order.end(), [&time](int a, int b) {
    return time[static_cast<std::size_t>(a)] < time[static_cast<std::size_t>(b)];
  });
  return order;
}

std::string describe_edge(int goal, const EdgeResult& edge) {
  char text[48];
  std::snprintf(text, sizeof text, "straight to goal %d, at %.0f %%: ", goal, 100.0 * edge.at);
  return text + motion::describe(edge.hit);
}

bool is_arm_of_slices(const Robot& robot) { return robot.joints.size() >= 3; }

MotionResult search_slices(CollisionChecker& checker, const Configuration& start,
                           const std::vector<Configuration>& goals, const GrossOptions& options) {
  MotionResult result;
  result.planner = "slices";
  if (!is_arm_of_slices(*checker.cell().robot)) {
    result.reason = "slices need an arm of three joints or more";
    return result;
  }
  if (options.search.max_proofs == 0) {
    result.reason = "slices are switched off";
    return result;
  }
  // One certificate for all that a gross motion is made of.
  FreeSpaceOptions slices = options.free_space;
  slices.clearance = std::max(slices.clearance, options.sampling.certificate.clearance);
  SearchOptions search = options.search;
  search.certificate = options.sampling.certificate;
  FreeSpace space(checker, start, goals, slices);
  SearchResult found = search_free_space(space, search);
  result.iterations = found.proofs;
  result.reason = std::move(found.reason);
  if (!found.found) return result;
  result.status = MotionStatus::Found;
  result.goal = found.goal;
  result.path = std::move(found.path);
  return result;
}

}  // namespace

MotionResult plan_gross_motion(CollisionChecker& checker, const Configuration& start,
                               const std::vector<Configuration>& goals,
                               const GrossOptions& options) {
  const Robot& robot = *checker.cell().robot;
  motion::require_ends(robot, start, goals);
  motion::require_options(options.sampling);
  const CertificateOptions& certificate = options.sampling.certificate;
  MotionResult result;
  result.planner = "straight";
  const motion::FreeEnds ends = motion::free_ends(checker, start, goals, certificate.clearance);
  if (ends.status != MotionStatus::Found) {
    result.status = ends.status;
    result.reason = ends.reason;
    return result;
  }

  const std::vector<int> order = by_travel_time(robot, start, goals, ends.goals);
  std::string obstruction;
  for (int goal : order) {
    const Configuration& end = goals[static_cast<std::size_t>(goal)];
    const EdgeResult edge = certify_edge(checker, start, end, certificate);
    if (edge.is_free()) {
      result.status = MotionStatus::Found;
      result.path = {start, end};
      result.goal = goal;
      return result;
    }
    if (obstruction.empty()) obstruction = describe_edge(goal, edge);
  }

  std::vector<Configuration> ordered;
  for (int goal : order) ordered.push_back(goals[static_cast<std::size_t>(goal)]);
  result = search_slices(checker, start, ordered, options);
  if (!result.found()) {
    const std::string slices_reason = result.reason;
    result = plan_by_sampling(checker, start, ordered, options.sampling);
    result.slices_reason = slices_reason;
    if (!result.found()) {
      const std::string sampling_reason = result.reason;
      const bool may_prove = is_arm_of_slices(robot) && options.separation.most_cells > 0;
      const Separation separation =
          may_prove ? prove_apart(checker, start, ordered, options.separation) : Separation{};
      if (separation.apart) result.status = MotionStatus::Infeasible;
      result.reason = obstruction + "; " + (separation.apart ? separation.reason : sampling_reason);
    }
  }
  if (!result.found()) return result;
  result.goal = order[static_cast<std::size_t>(result.goal)];
  result.path = shorten_path(checker, result.path, options.shortcut);
  return result;
}

}  // namespace handey
