// Are start and goals apart? The tree of cells and what is proved of them serves all goals.
#include "handey/cspace/separation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "handey/errors.hpp"
#include "two_floods.hpp"

namespace handey {
namespace {

using cspace::CellTree;
using cspace::Link;
using cspace::TwoFloods;

// Choice: to look up a neighbour costs about a hundredth of looking at a cell.
constexpr std::size_t kStepsPerCell = 100;
constexpr std::size_t kMostNames = 8;  // Choice: a line or two

void require_configuration(const Robot& robot, const Configuration& configuration,
                           const std::string& place) {
  if (static_cast<std::size_t>(configuration.q.size()) != robot.joints.size()) {
    throw InvalidInput("E_DOF", place,
                       std::to_string(configuration.q.size()) + " joint values, the arm has " +
                           std::to_string(robot.joints.size()) + " joints");
  }
  if (!configuration.q.allFinite() || !std::isfinite(configuration.opening)) {
    throw InvalidInput("E_NUMBER", place, "a joint value or the opening is not finite");
  }
  const std::string violation = limit_violation(robot, configuration.q);
  if (!violation.empty()) throw InvalidInput("E_LIMIT", place, violation);
}

void require_inputs(const Robot& robot, const Configuration& start,
                    const std::vector<Configuration>& goals, const SeparationOptions& options) {
  if (goals.empty()) throw InvalidInput("E_EMPTY", "goals", "is empty, expected at least one");
  require_configuration(robot, start, "start");
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const std::string place = "goals[" + std::to_string(g) + "]";
    require_configuration(robot, goals[g], place);
    if (std::abs(goals[g].opening - start.opening) > 1e-9) {
      throw InvalidInput("E_RANGE", place,
                         "opening = " + std::to_string(goals[g].opening) +
                             " m, expected the start's " + std::to_string(start.opening) + " m");
    }
  }
  if (options.finest_level < 0 || options.finest_level >= Lattice::kLevels) {
    throw InvalidInput("E_RANGE", "finest_level",
                       std::to_string(options.finest_level) + ", expected 0 to " +
                           std::to_string(Lattice::kLevels - 1));
  }
}

std::string degrees(double radians) {
  const double tenths = std::round(radians * 1800.0 / 3.14159265358979323846);
  const long whole = std::lround(tenths) / 10, rest = std::lround(tenths) % 10;
  std::string text = std::to_string(whole);
  if (rest != 0) text += "." + std::to_string(rest);
  return text + (text == "1" ? " degree" : " degrees");
}

double resolution_of(const Lattice& lattice, int level) {
  double widest = 0.0;
  for (int j = 0; j < 3; ++j) widest = std::max(widest, lattice.cell_width(level, j));
  return widest;
}

/// Names, those with most cells first, the rest counted.
std::string by_cells(const std::map<std::string, int>& counted) {
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [name, cells] : counted) sorted.emplace_back(-cells, name);
  std::sort(sorted.begin(), sorted.end());
  std::string text;
  const std::size_t told = std::min(sorted.size(), kMostNames);
  for (std::size_t i = 0; i < told; ++i) text += (i > 0 ? ", " : "") + sorted[i].second;
  if (told < sorted.size()) text += " and " + std::to_string(sorted.size() - told) + " more";
  return text;
}

/// "wall_left, table (forearm_link, upper_arm_link cannot pass)".
std::string walls(const BlockedCells::Impl& proofs, const std::map<int, int>& border) {
  std::map<std::string, int> others, movers;
  for (const auto& [pair, cells] : border) {
    const BlockedProof proof = proofs.named(pair);
    others[proof.other] += cells;
    movers[proof.mover] += cells;
  }
  if (others.empty()) return "the limits of the joints";
  return by_cells(others) + " (" + by_cells(movers) + " cannot pass)";
}

std::string apart_reason(const TwoFloods& floods, const BlockedCells::Impl& proofs,
                         const std::string& goal, const std::string& resolution) {
  const std::string bodies = walls(proofs, floods.border());
  if (floods.blocked_end() >= 0) {
    return (floods.blocked_end() == 0 ? "the start" : goal) + " collides, and so does all within " +
           resolution + " of it: " + bodies;
  }
  return goal + " is walled off from the start for the first three joints at " + resolution + ": " +
         bodies;
}

Separation not_apart(std::size_t goals, const std::string& reason) {
  Separation result;
  result.goal_apart.assign(goals, 0);
  result.reason = reason;
  return result;
}

}  // namespace

Separation prove_apart(CollisionChecker& checker, const Configuration& start,
                       const std::vector<Configuration>& goals, const SeparationOptions& options) {
  const Robot& robot = *checker.cell().robot;
  require_inputs(robot, start, goals, options);
  if (robot.joints.size() < 3)
    return not_apart(goals.size(), "the arm has fewer than three joints");
  const Lattice lattice = make_lattice(robot);
  if (cspace::coarse_cells(lattice) > cspace::kMostCoarseCells) {
    return not_apart(goals.size(), "the first three joints' ranges are too wide");
  }
  BlockedCells blocked(checker, start.opening);
  BlockedCells::Impl& proofs = blocked.impl();
  CellTree tree(proofs, options.finest_level);
  std::size_t steps_left = options.most_cells * kStepsPerCell;
  Separation result;
  result.apart = true;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    TwoFloods floods(tree, start.q, goals[g].q, options.most_cells, steps_left);
    const Link link = floods.run();
    const std::string goal = "goal " + std::to_string(g);
    const std::string finest = degrees(resolution_of(lattice, tree.finest_looked_at()));
    if (g > 0) result.reason += "; ";
    if (link == Link::Apart) {
      result.reason += apart_reason(floods, proofs, goal, finest);
    } else if (link == Link::Linked) {
      result.reason += goal + " is linked with the start by cells not proved blocked at " +
                       degrees(resolution_of(lattice, options.finest_level));
    } else {
      result.reason += goal + ": given up after " + std::to_string(tree.cells_looked_at()) +
                       " cells, " + finest + " the finest";
    }
    result.goal_apart.push_back(link == Link::Apart ? 1 : 0);
    if (link != Link::Apart) result.apart = false;
  }
  result.resolution = resolution_of(lattice, tree.finest_looked_at());
  result.cells_looked_at = tree.cells_looked_at();
  return result;
}

}  // namespace handey
