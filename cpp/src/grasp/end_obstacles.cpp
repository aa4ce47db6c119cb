// The hand is looked at first, for it is the same whichever way the arm brings it; then the arm,
// solution by solution, with what its joints are past their limits by.
#include "end_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "handey/collision/all_hits.hpp"

namespace handey::grasp {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::size_t kMostSolutions = 4;  // Choice: those of fewest joints past their limits
constexpr double kLifted = 2e-3;           // the part no longer touches what it stood on [m]

const Pose& standing_at(const GraspScene& scene, GraspEnd end) {
  return end == GraspEnd::Origin ? scene.cell.parts[static_cast<std::size_t>(scene.part)].X_WB
                                 : scene.X_WP_goal;
}

Allowance closed_on(int part) {
  Allowance allowance;
  allowance.closed_on = part;
  return allowance;
}

bool is_same(const InTheWay& a, const InTheWay& b) {
  return a.kind == b.kind && a.joint == b.joint && a.body == b.body;
}

}  // namespace

EndObstacles::EndObstacles(const GraspScene& scene, GraspEnd end,
                           const SphericalWristSolver& unlimited, const LegalityOptions& options)
    : robot_(*scene.cell.robot),
      unlimited_(unlimited),
      end_(end),
      clearance_(options.clearance),
      part_(scene.cell.parts[static_cast<std::size_t>(scene.part)].name),
      hand_(robot_.bodies[static_cast<std::size_t>(robot_.gripper.body)].name),
      X_RP_(scene.cell.X_WR.inverse() * standing_at(scene, end)),
      free_hand_(scene.model, scene.cell.with_part_at(scene.part, standing_at(scene, end))),
      closed_hand_(scene.model, free_hand_.cell(), closed_on(scene.part)) {
  for (const RobotBody& body : robot_.bodies) links_.insert(body.name);
  const Cell& cell = free_hand_.cell();
  Pose X_WP_lifted = standing_at(scene, end);
  X_WP_lifted.translation().z() += kLifted;
  const Cell lifted = cell.with_part_at(scene.part, X_WP_lifted);
  for (const BodyRef& body : touching_bodies(*scene.model, cell, scene.part)) {
    supports_.insert(cell.body(body).name);
  }
  for (const BodyRef& body : touching_bodies(*scene.model, lifted, scene.part)) {
    supports_.erase(cell.body(body).name);
  }
}

void EndObstacles::add_hits(const std::vector<Hit>& hits, EndResult& result) const {
  for (const Hit& hit : hits) {
    InTheWay found;
    found.end = end_;
    found.mover = hit.a == hand_ ? "hand" : hit.a;
    found.body = hit.b == hand_ ? "hand" : hit.b;
    const auto same = [&](const InTheWay& other) { return is_same(found, other); };
    if (std::none_of(result.obstacles.begin(), result.obstacles.end(), same)) {
      result.obstacles.push_back(std::move(found));
    }
  }
}

EndResult EndObstacles::hand(const Pose& X_PH, double opening, double width) {
  EndResult result;
  const Pose X_RH = X_RP_ * X_PH;
  add_hits(find_hand_hits(free_hand_, X_RH, opening, clearance_), result);
  add_hits(find_hand_hits(closed_hand_, X_RH, width, clearance_), result);
  result.meets_part = std::any_of(result.obstacles.begin(), result.obstacles.end(),
                                  [&](const InTheWay& found) { return found.body == part_; });
  return result;
}

// Turns every joint to within its limits, or as near to them as it gets.
std::vector<InTheWay> EndObstacles::limits(Eigen::VectorXd& q) const {
  std::vector<InTheWay> past;
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    const JointLimit& limit = robot_.joints[j].limit;
    if (!std::isfinite(limit.lower) || !std::isfinite(limit.upper)) continue;
    double& value = q[static_cast<Eigen::Index>(j)];
    const auto miss = [&](double angle) {
      return std::max({limit.lower - angle, angle - limit.upper, 0.0});
    };
    double best = value;
    for (const double turn : {-2.0 * kPi, 2.0 * kPi}) {
      if (miss(value + turn) < miss(best)) best = value + turn;
    }
    value = best;
    if (miss(best) <= 1e-9) continue;
    InTheWay found;
    found.kind = FallKind::JointLimit;
    found.end = end_;
    found.joint = static_cast<int>(j);
    found.amount = miss(best);
    past.push_back(found);
  }
  return past;
}

void EndObstacles::add_arm(const Pose& X_PH, double opening, EndResult& result) {
  const InverseResult inverse = unlimited_.solve(X_RP_ * X_PH);
  if (inverse.solutions.empty()) {
    InTheWay found;
    found.kind = FallKind::OutOfReach;
    found.end = end_;
    found.amount = inverse.excess;
    result.obstacles.push_back(found);
    return;
  }
  std::vector<std::pair<std::vector<InTheWay>, Eigen::VectorXd>> ways;
  for (const InverseSolution& solution : inverse.solutions) {
    Eigen::VectorXd q = solution.q;
    std::vector<InTheWay> past = limits(q);
    ways.emplace_back(std::move(past), std::move(q));
  }
  const auto total = [](const std::vector<InTheWay>& past) {
    double sum = 0.0;
    for (const InTheWay& found : past) sum += found.amount;
    return sum;
  };
  std::stable_sort(ways.begin(), ways.end(), [&](const auto& a, const auto& b) {
    if (a.first.size() != b.first.size()) return a.first.size() < b.first.size();
    return total(a.first) < total(b.first);
  });
  if (ways.size() > kMostSolutions) ways.resize(kMostSolutions);
  EndResult best;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    EndResult way = result;
    way.obstacles.insert(way.obstacles.end(), ways[i].first.begin(), ways[i].first.end());
    way.q = ways[i].second;
    if (i > 0 && way.obstacles.size() >= best.obstacles.size()) continue;
    add_hits(find_all_hits(free_hand_, {way.q, opening}, HitsOf::Arm, clearance_), way);
    if (i > 0 && way.obstacles.size() >= best.obstacles.size()) continue;
    best = std::move(way);
    if (best.obstacles.size() == result.obstacles.size()) break;
  }
  result = std::move(best);
}

double EndObstacles::depth(const Pose& X_PH, double opening, const Eigen::VectorXd& q,
                           const std::string& body) {
  double depth = hand_depth(free_hand_, X_RP_ * X_PH, opening, body);
  if (q.size() == 0) return depth;
  for (const Hit& hit : robot_overlaps(free_hand_, {q, opening}, 0.0)) {
    if (hit.b == body) depth = std::max(depth, -hit.distance);
  }
  return depth;
}

}  // namespace handey::grasp
