// Step by step along each line, the arm behind the hand.
#include "handey/approach/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "handey/collision/all_hits.hpp"
#include "handey/errors.hpp"
#include "handey/kinematics/path.hpp"

namespace handey {
namespace {

using Names = std::pair<std::string, std::string>;

constexpr double kStep = 0.005;                           // along a line [m]
constexpr double kTilts[] = {0.0, 0.6, -0.6, 1.2, -1.2};  // from straight back [rad]

std::vector<Eigen::Vector3d> directions(const Pose& X_WH) {
  std::vector<Eigen::Vector3d> result;
  for (const double tilt : kTilts) {
    result.push_back(std::sin(tilt) * X_WH.linear().col(0) - std::cos(tilt) * X_WH.linear().col(2));
  }
  result.push_back(Eigen::Vector3d::UnitZ());
  return result;
}

// Choice: what ends the way that is tried first tells more than what stands to the sides.
constexpr int kFirstWay = 8;

struct Met {
  int ways = 0;
  double came = 0.0;
};

}  // namespace

std::vector<Hit> find_enclosing(CollisionChecker& checker, const SphericalWristSolver& solver,
                                const Configuration& start, double distance) {
  if (!std::isfinite(distance) || distance <= 0.0 || distance > 10.0) {
    throw InvalidInput("E_RANGE", "distance", "must be a positive number of at most 10 m");
  }
  std::set<Names> at_start;
  for (const Hit& hit : find_all_hits(checker, start)) at_start.insert({hit.a, hit.b});
  const Pose X_WH = hand_in_world(checker.cell(), start.q);
  const Pose X_RW = checker.cell().X_WR.inverse();
  std::map<Names, Met> met;
  const std::vector<Eigen::Vector3d> ways = directions(X_WH);
  const std::size_t first = checker.cell().held ? ways.size() - 1 : 0;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    const Eigen::Vector3d& direction = ways[way];
    std::vector<Pose> line;
    for (int step = 1; step * kStep <= distance + 1e-9; ++step) {
      line.push_back(X_RW * Eigen::Translation3d(step * kStep * direction) * X_WH);
    }
    const HandPathResult arm = follow_hand_path(solver, line, start.q);
    bool is_over = false;
    for (std::size_t i = 0; i < arm.path.size() && !is_over; ++i) {
      for (const Hit& hit : find_all_hits(checker, {arm.path[i], start.opening})) {
        if (at_start.count({hit.a, hit.b}) != 0) continue;
        Met& one = met[{hit.a, hit.b}];
        one.ways += way == first ? kFirstWay : 1;
        one.came = std::max(one.came, static_cast<double>(i) * kStep);
        is_over = true;
      }
    }
  }
  std::vector<std::pair<int, Hit>> counted;
  for (const auto& [names, one] : met) {
    counted.push_back({one.ways, {names.first, names.second, one.came}});
  }
  std::stable_sort(counted.begin(), counted.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Hit> hits;
  for (const auto& one : counted) hits.push_back(one.second);
  return hits;
}

}  // namespace handey
