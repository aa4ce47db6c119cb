// Tests of single hand poses at both ends, cheapest first: inverse kinematics at both, then
// collision at both.
#include "pose_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "ranges.hpp"

namespace handey::grasp {
namespace {

// Just before the pads touch, nothing but them may touch the part: then each stands off by this
// [m]. Choice: what a contact may be deep; lower ribs on a face give way.
constexpr double kStandOff = 5e-4;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();  // solutions
// Full marks for the margins [rad], [-].
constexpr double kLimitMargin = 0.35, kSingularityMargin = 0.3;

void add_names(std::set<std::string>& names, const RobotBody& body) {
  names.insert(body.name);
  names.insert(body.links.begin(), body.links.end());
}

}  // namespace

bool FallKey::operator<(const FallKey& other) const {
  return std::tie(kind, end, joint, mover, body) <
         std::tie(other.kind, other.end, other.joint, other.mover, other.body);
}

void Tally::add(const FallKey& key, const GraspPose& pose, const std::string& text,
                std::optional<double> least, int count) {
  Fallen& fallen = fallen_[key];
  const bool is_first = fallen.count == 0;
  fallen.count += count;
  if (!is_first && !(least && (!fallen.least || *least < *fallen.least))) return;
  fallen.least = least;
  fallen.text = text;
  fallen.X_PH = pose.X_PH;
  fallen.opening = pose.opening;
  fallen.width = pose.width;
}

std::vector<Fallen> Tally::list() const {
  std::vector<Fallen> list;
  for (const auto& [key, fallen] : fallen_) {
    list.push_back(fallen);
    list.back().kind = key.kind;
    list.back().end = key.end;
    list.back().joint = key.joint;
    list.back().mover = key.mover;
    list.back().body = key.body;
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Fallen& a, const Fallen& b) { return a.count > b.count; });
  return list;
}

std::string Tally::worst(int tried) const {
  // How far a candidate got: contact, hold, reach at either end, collision at either end.
  const auto rank = [](const FallKey& key) {
    const bool reached = key.kind == FallKind::Collision;
    const bool unreachable = key.kind == FallKind::OutOfReach || key.kind == FallKind::JointLimit;
    const int end = key.end == GraspEnd::Destination ? 1 : 0;
    const bool has_contact = key.kind != FallKind::LittleContact;
    return reached ? 4 + end : unreachable ? 2 + end : has_contact ? 1 : 0;
  };
  const FallKey* key = nullptr;
  const Fallen* worst = nullptr;
  for (const auto& [other, fallen] : fallen_) {
    if (worst != nullptr &&
        (rank(other) < rank(*key) || (rank(other) == rank(*key) && fallen.count <= worst->count))) {
      continue;
    }
    key = &other;
    worst = &fallen;
  }
  if (worst == nullptr) return "";
  const std::string end = key->end == GraspEnd::Both     ? ""
                          : key->end == GraspEnd::Origin ? " (origin)"
                                                         : " (destination)";
  return worst->text + end + ": " + std::to_string(worst->count) + " of " + std::to_string(tried);
}

PoseTester::End PoseTester::make_end(const GraspScene& scene, const Pose& X_WP, GraspEnd end) {
  const Cell cell = scene.cell.with_part_at(scene.part, X_WP);
  Allowance closed;
  closed.closed_on = scene.part;
  return {end, cell.X_WR.inverse() * X_WP, CollisionChecker(scene.model, cell),
          CollisionChecker(scene.model, cell, closed)};
}

PoseTester::PoseTester(const GraspScene& scene, const SphericalWristSolver& solver,
                       const LegalityOptions& options)
    : scene_(scene),
      solver_(solver),
      options_(options),
      origin_(make_end(scene, scene.cell.parts[static_cast<std::size_t>(scene.part)].X_WB,
                       GraspEnd::Origin)),
      destination_(make_end(scene, scene.X_WP_goal, GraspEnd::Destination)) {
  const Robot& robot = *scene.cell.robot;
  for (const RobotBody& body : robot.bodies) add_names(robot_links_, body);
  for (const FingerJoint& finger : robot.gripper.fingers) {
    add_names(finger_links_, robot.bodies[static_cast<std::size_t>(finger.child)]);
  }
  hand_links_ = finger_links_;
  add_names(hand_links_, robot.bodies[static_cast<std::size_t>(robot.gripper.body)]);
}

// Hits name a body by its first link, which for the hand may be the arm's last.
std::string PoseTester::display_name(const std::string& name) const {
  const Robot& robot = *scene_.cell.robot;
  return name == robot.bodies[static_cast<std::size_t>(robot.gripper.body)].name ? "hand" : name;
}

std::vector<double> PoseTester::openings(double width) const {
  const double greatest = scene_.cell.robot->gripper.max_opening;
  std::vector<double> openings;
  for (const double share : {1.0, 0.5, 0.25}) {
    const double opening = std::min(greatest, width + 2.0 * share * options_.open_clearance);
    if (openings.empty() || opening < openings.back() - 1e-6) openings.push_back(opening);
  }
  return openings;
}

std::vector<InverseSolution> PoseTester::inverse(const End& end, const GraspPose& pose,
                                                 Tally& tally) const {
  InverseResult result = solver_.solve(end.X_RP * pose.X_PH);
  if (result.solutions.empty()) {
    const bool limited = result.status == InverseStatus::OutsideLimits;
    tally.add({limited ? FallKind::JointLimit : FallKind::OutOfReach, end.end,
               limited ? result.joint : -1, "", ""},
              pose, result.reason, result.excess);
  }
  return std::move(result.solutions);
}

std::optional<PoseTester::Obstacle> PoseTester::first_obstacle(CollisionChecker& checker,
                                                               const Eigen::VectorXd& q,
                                                               double opening) const {
  const std::optional<Hit> hit = checker.find_hit({q, opening}, options_.clearance);
  if (!hit) return std::nullopt;
  const bool other_is_robot = robot_links_.count(hit->a) != 0 && robot_links_.count(hit->b) != 0;
  const auto involves = [&](const std::set<std::string>& names) {
    return !other_is_robot && (names.count(hit->a) != 0 || names.count(hit->b) != 0);
  };
  return Obstacle{*hit, involves(hand_links_), involves(finger_links_)};
}

void PoseTester::find_free(End& end, const std::vector<InverseSolution>& solutions,
                           const GraspPose& pose, std::size_t most, Free& free) {
  while (free.looked_at < solutions.size() && free.solutions.size() < most) {
    const InverseSolution& solution = solutions[free.looked_at++];
    if (free.branch == solution.branch) {  // the same but for full turns
      if (free.branch_is_free) free.solutions.push_back(solution);
      continue;
    }
    free.branch = solution.branch;
    std::optional<Obstacle> found = first_obstacle(end.free_hand, solution.q, pose.opening);
    if (!found && free.solutions.empty()) {
      // The hand is the same for every configuration of this pose: once is enough.
      found = first_obstacle(end.free_hand, solution.q, pose.width + 2.0 * kStandOff);
    }
    if (!found) found = first_obstacle(end.closed_hand, solution.q, pose.width);
    free.branch_is_free = !found;
    if (!found) {
      free.solutions.push_back(solution);
      continue;
    }
    free.obstacle = found;
    free.met_finger |= found->of_finger;
    if (found->of_hand && free.solutions.empty()) break;
  }
}

double PoseTester::joint_margin(const InverseSolution& solution) const {
  double from_limit = std::numeric_limits<double>::infinity();
  const std::vector<ArmJoint>& joints = scene_.cell.robot->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double value = solution.q[static_cast<Eigen::Index>(j)];
    from_limit =
        std::min({from_limit, value - joints[j].limit.lower, joints[j].limit.upper - value});
  }
  const double singular =
      std::min({solution.margin.shoulder, solution.margin.elbow, solution.margin.wrist});
  return std::clamp(std::min(from_limit / kLimitMargin, singular / kSingularityMargin), 0.0, 1.0);
}

double PoseTester::best_margin(const std::vector<InverseSolution>& solutions) const {
  double best = 0.0;
  for (const InverseSolution& solution : solutions) best = std::max(best, joint_margin(solution));
  return best;
}

std::vector<Eigen::VectorXd> PoseTester::soonest_first(
    const std::vector<InverseSolution>& solutions) const {
  const std::vector<ArmJoint>& joints = scene_.cell.robot->joints;
  const Eigen::VectorXd& start = scene_.cell.start.q;
  std::vector<std::pair<double, const Eigen::VectorXd*>> timed;
  for (const InverseSolution& solution : solutions) {
    double time = 0.0;
    for (Eigen::Index j = 0; j < solution.q.size() && j < start.size(); ++j) {
      time = std::max(time, std::abs(solution.q[j] - start[j]) /
                                joints[static_cast<std::size_t>(j)].limit.velocity);
    }
    timed.emplace_back(time, &solution.q);
  }
  std::stable_sort(timed.begin(), timed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first - 1e-9; });
  std::vector<Eigen::VectorXd> ordered;
  for (const auto& [time, q] : timed) ordered.push_back(*q);
  return ordered;
}

PoseVerdict PoseTester::add_blocked(const PoseBlock& block, GraspPose& pose, Tally& tally) const {
  const bool at_origin = block.end == GraspEnd::Origin;
  pose.opening = openings(pose.width).front();
  const std::string mover = display_name(block.mover), body = display_name(block.body);
  tally.add({FallKind::Collision, block.end, -1, mover, body}, pose, mover + " hits " + body);
  return at_origin ? PoseVerdict::CollidesAtOrigin : PoseVerdict::CollidesAtDestination;
}

PoseVerdict PoseTester::test(const FeaturePair& pair, GraspPose& pose, Tally& tally) {
  pose.X_PH = pair.X_PG * hand_in_plane(pose.in_plane, pose.flipped);
  pose.width = pair.width_at({pose.in_plane.x, pose.in_plane.y});
  const std::vector<InverseSolution> at_origin = inverse(origin_, pose, tally);
  if (at_origin.empty()) return PoseVerdict::UnreachableAtOrigin;
  const std::vector<InverseSolution> at_destination = inverse(destination_, pose, tally);
  if (at_destination.empty()) return PoseVerdict::UnreachableAtDestination;

  PoseVerdict verdict = PoseVerdict::CollidesAtOrigin;
  for (const double opening : openings(pose.width)) {
    pose.opening = opening;
    // One configuration at either end will do until it is known that there is one at both. Of
    // poses spread over a pair this one often falls where the last one fell.
    Free pick, place;
    const bool at_origin_first = !options_.spread || fell_last_ == GraspEnd::Origin;
    const auto look = [&](bool origin, std::size_t most) {
      find_free(origin ? origin_ : destination_, origin ? at_origin : at_destination, pose, most,
                origin ? pick : place);
      return !(origin ? pick : place).solutions.empty();
    };
    if (look(at_origin_first, 1) && look(!at_origin_first, 1)) {
      look(true, kAll);
      look(false, kAll);
      pose.q_pick = soonest_first(pick.solutions);
      pose.q_place = soonest_first(place.solutions);
      pose.merit = 0.2 * std::min(best_margin(pick.solutions), best_margin(place.solutions));
      return PoseVerdict::Legal;
    }
    const bool fell_at_origin = pick.looked_at > 0 && pick.solutions.empty();
    const Free& fell = fell_at_origin ? pick : place;
    fell_last_ = fell_at_origin ? GraspEnd::Origin : GraspEnd::Destination;
    verdict = fell_at_origin ? PoseVerdict::CollidesAtOrigin : PoseVerdict::CollidesAtDestination;
    if (fell.met_finger && opening > openings(pose.width).back() + 1e-6) continue;
    const std::string mover = display_name(fell.obstacle->hit.a);
    const std::string body = display_name(fell.obstacle->hit.b);
    tally.add({FallKind::Collision, fell_last_, -1, mover, body}, pose, mover + " hits " + body);
    break;
  }
  return verdict;
}

}  // namespace handey::grasp
