// One checker pair per place; every grasp by inverse kinematics first, then open, then closing.
#include "handey/grasp/compatibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "handey/collision/checker.hpp"
#include "handey/stop.hpp"
#include "ranges.hpp"

namespace handey {
namespace {

// As in the tests of legality: just before the pads touch, nothing but them may touch the part [m].
constexpr double kStandOff = 5e-4;
constexpr double kLimitMargin = 0.35, kSingularityMargin = 0.3;  // full marks [rad], [-]

// Choice: a group whose best grasp has so much margin is not looked at further.
constexpr double kMarginEnough = 0.9;

double joint_margin(const Robot& robot, const InverseSolution& solution) {
  double from_limit = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const double value = solution.q[static_cast<Eigen::Index>(j)];
    const JointLimit& limit = robot.joints[j].limit;
    from_limit = std::min({from_limit, value - limit.lower, limit.upper - value});
  }
  const double singular =
      std::min({solution.margin.shoulder, solution.margin.elbow, solution.margin.wrist});
  return std::clamp(std::min(from_limit / kLimitMargin, singular / kSingularityMargin), 0.0, 1.0);
}

// Names of the robot's links in hits; of the hand's and the fingers' among them.
struct LinkNames {
  std::set<std::string> robot, hand, fingers;

  explicit LinkNames(const Robot& of) {
    for (std::size_t i = 0; i < of.bodies.size(); ++i) {
      const RobotBody& body = of.bodies[i];
      const int index = static_cast<int>(i);
      const bool finger = std::any_of(of.gripper.fingers.begin(), of.gripper.fingers.end(),
                                      [&](const FingerJoint& f) { return f.child == index; });
      add(robot, body);
      if (finger) add(fingers, body);
      if (finger || index == of.gripper.body) add(hand, body);
    }
    hand_body = of.bodies[static_cast<std::size_t>(of.gripper.body)].name;
  }
  std::string hand_body;

 private:
  static void add(std::set<std::string>& names, const RobotBody& body) {
    names.insert(body.name);
    names.insert(body.links.begin(), body.links.end());
  }
};

enum class Verdict { Legal, Unreachable, Collides };

// All tests with the part at one place.
class Place {
 public:
  Place(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
        const Pose& X_WP, const SphericalWristSolver& solver, const LinkNames& names,
        const CompatibilityOptions& options)
      : robot_(*cell.robot),
        X_RP_(cell.X_WR.inverse() * X_WP),
        solver_(solver),
        names_(names),
        options_(options),
        open_(model, cell.with_part_at(part, X_WP)),
        closed_(model, open_.cell(), closed_on(part)) {}

  Verdict test(const PartGrasp& grasp, CompatibleGrasp& result) {
    const InverseResult inverse = solver_.solve(X_RP_ * grasp.X_PH);
    if (inverse.solutions.empty()) return Verdict::Unreachable;
    const double greatest = robot_.gripper.max_opening;
    double before = std::numeric_limits<double>::infinity();
    for (const double share : {1.0, 0.5, 0.25}) {
      const double opening =
          std::min(greatest, grasp.width + 2.0 * share * options_.open_clearance);
      if (opening > before - 1e-6) continue;
      before = opening;
      bool of_finger = false;
      if (collect(inverse.solutions, grasp, opening, result, of_finger)) return Verdict::Legal;
      if (!of_finger) break;
    }
    if (hit_) ++hits_[name(hit_->a) + " hits " + name(hit_->b)];
    return Verdict::Collides;
  }

  std::string worst_reason(int tried) const {
    const auto worst =
        std::max_element(hits_.begin(), hits_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (worst == hits_.end()) return "";
    return worst->first + ": " + std::to_string(worst->second) + " of " + std::to_string(tried);
  }

 private:
  static Allowance closed_on(int part) {
    Allowance allowance;
    allowance.closed_on = part;
    return allowance;
  }

  // The hand is the same for every configuration of a grasp: closing is looked at once.
  bool collect(const std::vector<InverseSolution>& solutions, const PartGrasp& grasp,
               double opening, CompatibleGrasp& result, bool& of_finger) {
    for (const auto& [margin, solution] : best_margin_first(solutions)) {
      bool is_free = meets_nothing(open_, solution->q, opening);
      if (is_free && result.q.empty()) {
        is_free = meets_nothing(open_, solution->q, grasp.width + 2.0 * kStandOff) &&
                  meets_nothing(closed_, solution->q, grasp.width);
      }
      if (is_free) {
        if (result.q.empty()) result.margin = margin;
        result.q.push_back(solution->q);
        if (static_cast<int>(result.q.size()) == options_.configurations) break;
        continue;
      }
      of_finger = involves(names_.fingers);
      if (result.q.empty() && involves(names_.hand)) break;
    }
    result.opening = opening;
    return !result.q.empty();
  }

  std::vector<std::pair<double, const InverseSolution*>> best_margin_first(
      const std::vector<InverseSolution>& solutions) const {
    std::vector<std::pair<double, const InverseSolution*>> ordered;
    for (const InverseSolution& solution : solutions) {
      ordered.emplace_back(joint_margin(robot_, solution), &solution);
    }
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first + 1e-9; });
    return ordered;
  }

  bool meets_nothing(CollisionChecker& checker, const Eigen::VectorXd& q, double opening) {
    const std::optional<Hit> hit = checker.find_hit({q, opening}, options_.clearance);
    if (hit) hit_ = hit;
    return !hit;
  }

  // Is the last hit one of these against what is not the robot?
  bool involves(const std::set<std::string>& names) const {
    if (!hit_ || (names_.robot.count(hit_->a) != 0 && names_.robot.count(hit_->b) != 0)) {
      return false;
    }
    return names.count(hit_->a) != 0 || names.count(hit_->b) != 0;
  }

  std::string name(const std::string& link) const {
    return link == names_.hand_body ? "hand" : link;
  }

  const Robot& robot_;
  Pose X_RP_;
  const SphericalWristSolver& solver_;
  const LinkNames& names_;
  const CompatibilityOptions& options_;
  CollisionChecker open_, closed_;
  std::optional<Hit> hit_;
  std::map<std::string, int> hits_;
};

void require_valid_input(const Cell& cell, const std::vector<PartGrasp>& grasps,
                         const std::vector<std::vector<int>>& groups,
                         const std::vector<Pose>& places) {
  if (!cell.robot) throw InvalidInput("E_MISSING", "cell.robot", "is missing");
  for (const std::vector<int>& group : groups) {
    for (const int index : group) {
      grasp::require_in_range(index, 0, static_cast<double>(grasps.size()) - 1, "groups");
    }
  }
  for (const Pose& place : places) require_rigid(place, "places");
}

CompatibleGrasps look_at(Place& place, const std::vector<PartGrasp>& grasps,
                         const std::vector<std::vector<int>>& groups, int most) {
  CompatibleGrasps found;
  std::map<int, bool> known;
  for (const std::vector<int>& group : groups) {
    int legal = 0;
    for (const int index : group) {
      if (most > 0 && legal >= most) break;
      const auto seen = known.find(index);
      if (seen != known.end()) {
        legal += seen->second ? 1 : 0;
        continue;
      }
      throw_if_stopped();
      CompatibleGrasp result;
      result.grasp = index;
      const Verdict verdict = place.test(grasps[static_cast<std::size_t>(index)], result);
      ++found.tried;
      known[index] = verdict == Verdict::Legal;
      if (verdict == Verdict::Unreachable) ++found.unreachable;
      if (verdict == Verdict::Collides) ++found.collides;
      if (verdict != Verdict::Legal) continue;
      ++legal;
      found.legal.push_back(std::move(result));
    }
  }
  std::sort(found.legal.begin(), found.legal.end(),
            [](const auto& a, const auto& b) { return a.grasp < b.grasp; });
  found.worst_reason = place.worst_reason(found.tried);
  return found;
}

}  // namespace

std::vector<CompatibleGrasps> find_compatible_grasps(
    const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
    const SphericalWristSolver& solver, const std::vector<PartGrasp>& grasps,
    const std::vector<std::vector<int>>& groups, const std::vector<Pose>& places,
    const CompatibilityOptions& options) {
  if (!model) throw InvalidInput("E_MISSING", "model", "is missing");
  require_valid_input(cell, grasps, groups, places);
  grasp::require_in_range(part, 0, static_cast<double>(cell.parts.size()) - 1, "part");
  grasp::require_in_range(options.open_clearance, 0.0, 0.5, "open_clearance");
  grasp::require_in_range(options.clearance, 0.0, 0.1, "clearance");
  grasp::require_in_range(options.most, 0, 1e9, "most");
  grasp::require_in_range(options.configurations, 1, 64, "configurations");
  if (cell.held) {
    throw InvalidInput("E_RANGE", "cell.held", "holds a part, expected an empty hand");
  }
  const LinkNames names(*cell.robot);
  std::vector<CompatibleGrasps> result;
  result.reserve(places.size());
  for (const Pose& X_WP : places) {
    Place place(model, cell, part, X_WP, solver, names, options);
    result.push_back(look_at(place, grasps, groups, options.most));
  }
  return result;
}

std::vector<std::vector<double>> reach_margins(const Cell& cell, const SphericalWristSolver& solver,
                                               const std::vector<PartGrasp>& grasps,
                                               const std::vector<std::vector<int>>& groups,
                                               const std::vector<Pose>& places) {
  require_valid_input(cell, grasps, groups, places);
  const Pose X_RW = cell.X_WR.inverse();
  std::vector<std::vector<double>> margins;
  margins.reserve(places.size());
  for (const Pose& X_WP : places) {
    const Pose X_RP = X_RW * X_WP;
    std::vector<double> best(groups.size(), -1.0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const int index : groups[g]) {
        const Pose& X_PH = grasps[static_cast<std::size_t>(index)].X_PH;
        if (best[g] >= kMarginEnough) break;
        throw_if_stopped();
        for (const InverseSolution& solution : solver.solve(X_RP * X_PH).solutions) {
          best[g] = std::max(best[g], joint_margin(*cell.robot, solution));
        }
      }
    }
    margins.push_back(std::move(best));
  }
  return margins;
}

}  // namespace handey
