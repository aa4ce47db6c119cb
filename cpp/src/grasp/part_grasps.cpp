// Samples the candidates of legality in the part frame and lets those fall that meet the part.
#include "handey/grasp/part_grasps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "candidates.hpp"
#include "handey/collision/checker.hpp"
#include "handey/stop.hpp"
#include "ranges.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kDirectionBins = 24;  // every direction keeps its best
constexpr int kMostDrawnBack = 4;   // candidates of one target and direction
// As little as legality lets the jaws open, in shares of its open clearance.
constexpr double kLeastOpen = 0.25;

Cell alone(const Body& part, const std::shared_ptr<const Robot>& robot) {
  if (!robot) throw InvalidInput("E_MISSING", "robot", "is missing");
  Cell cell;
  cell.robot = robot;
  cell.parts = {part};
  cell.parts.front().X_WB = Pose::Identity();
  cell.start = {robot->home, robot->gripper.max_opening};
  return cell;
}

double opening_of(const Gripper& gripper, double width, const LegalityOptions& options) {
  return std::min(gripper.max_opening, width + 2.0 * kLeastOpen * options.open_clearance);
}

// The hand and nothing else of the robot, kept apart from the part at any place of the two.
class HandAndPart {
 public:
  HandAndPart(const Body& part, const std::shared_ptr<const Robot>& robot) {
    const std::shared_ptr<Robot> hand = std::make_shared<Robot>(*robot);
    std::set<int> kept = {hand->gripper.body};
    for (const FingerJoint& finger : hand->gripper.fingers) kept.insert(finger.child);
    for (std::size_t i = 0; i < hand->bodies.size(); ++i) {
      if (kept.count(static_cast<int>(i)) == 0) hand->bodies[i].shapes.clear();
    }
    cell_ = alone(part, hand);
    model_ = make_collision_model(cell_);
    X_RH_ = hand_pose(*hand, hand->home);
  }

  bool is_clear(const Pose& X_PH, double opening, double clearance) const {
    const Cell placed = cell_.with_part_at(0, X_RH_ * X_PH.inverse());
    return CollisionChecker(model_, placed).is_free({cell_.robot->home, opening}, clearance);
  }

 private:
  Cell cell_;
  std::shared_ptr<const CollisionModel> model_;
  Pose X_RH_;
};

int bin_of(double theta) {
  const double turn = (std::remainder(theta, 2.0 * kPi) + kPi) / (2.0 * kPi);
  return static_cast<int>(std::floor(turn * kDirectionBins + 0.5)) % kDirectionBins;
}

// The hand's points, whose hull is the hand, in the grasp frame at an opening.
std::vector<Eigen::Vector3d> hand_points(const Robot& robot, double opening) {
  const Gripper& gripper = robot.gripper;
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](int body, const Pose& X_HB) {
    for (const Shape& shape : robot.bodies[static_cast<std::size_t>(body)].shapes) {
      for (const Eigen::Vector3d& point : hull_points(shape)) points.push_back(X_HB * point);
    }
  };
  const Pose X_HB = gripper.X_BH.inverse();
  add(gripper.body, X_HB);
  for (const FingerJoint& finger : gripper.fingers) {
    const Pose moved = finger.X_PJ * Eigen::Translation3d(0.5 * opening * finger.axis);
    add(finger.child, X_HB * moved);
  }
  return points;
}

}  // namespace

Ranking rank_part_alone(const Body& part, const std::shared_ptr<const Robot>& robot,
                        const RankingOptions& options) {
  RankingOptions alone_options = options;
  alone_options.use_destination = false;
  return rank_grasps(alone(part, robot), 0, Pose::Identity(), alone_options);
}

std::vector<PartGrasp> sample_part_grasps(const Body& part,
                                          const std::shared_ptr<const Robot>& robot,
                                          const PartGraspOptions& options) {
  grasp::require_in_range(options.most, 1, 1e7, "most");
  const Ranking ranking = rank_part_alone(part, robot, options.ranking);
  const HandAndPart hand(part, robot);
  const grasp::Hold hold(part, options.legality);
  const Gripper& gripper = robot->gripper;
  const int pairs = std::max<int>(1, static_cast<int>(ranking.ranked.size()));
  // Where a thin part lies flat, only pads drawn back have room: all of a target's stay together.
  const std::size_t groups_per_bin = static_cast<std::size_t>(
      std::max(1, options.most / (2 * kDirectionBins * pairs * kMostDrawnBack)));
  std::vector<PartGrasp> grasps;
  for (const RankedPair& pair : ranking.ranked) {
    const grasp::ContactDemand demand = grasp::contact_demand(pair, gripper, options.legality);
    const grasp::CandidateList list = grasp::make_candidates(pair, *robot, Eigen::Vector2d::Zero(),
                                                             demand, hold, options.legality);
    std::map<int, std::set<int>> in_bin;
    for (const grasp::Candidate& candidate : list.candidates) {
      throw_if_stopped();
      std::set<int>& groups = in_bin[bin_of(candidate.pose.theta)];
      if (groups.size() >= groups_per_bin && groups.count(candidate.group) == 0) continue;
      for (const bool flipped : {false, true}) {
        PartGrasp grasp;
        grasp.a = pair.pair.a;
        grasp.b = pair.pair.b;
        grasp.in_plane = candidate.pose;
        grasp.flipped = flipped;
        grasp.X_PH = pair.pair.X_PG * hand_in_plane(candidate.pose, flipped);
        grasp.width = pair.pair.width_at({candidate.pose.x, candidate.pose.y});
        // The same for every pose of a pair in this direction of the world: from above or not.
        grasp.merit = candidate.promise - 0.05;
        const double opening = opening_of(gripper, grasp.width, options.legality);
        if (!hand.is_clear(grasp.X_PH, opening, options.legality.clearance)) continue;
        groups.insert(candidate.group);
        grasps.push_back(grasp);
      }
    }
  }
  return grasps;
}

std::vector<char> clears_plane(const std::shared_ptr<const Robot>& robot,
                               const std::vector<PartGrasp>& grasps, const Pose& X_SP,
                               const LegalityOptions& options) {
  if (!robot) throw InvalidInput("E_MISSING", "robot", "is missing");
  require_rigid(X_SP, "X_SP");
  std::vector<char> clear;
  clear.reserve(grasps.size());
  double opening = -1.0;
  std::vector<Eigen::Vector3d> points;
  for (const PartGrasp& grasp : grasps) {
    throw_if_stopped();
    const double wanted = opening_of(robot->gripper, grasp.width, options);
    if (std::abs(wanted - opening) > 1e-9) points = hand_points(*robot, opening = wanted);
    const Pose X_SH = X_SP * grasp.X_PH;
    const Eigen::RowVector3d up = X_SH.linear().row(2);
    const double height = X_SH.translation().z();
    const bool above = std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
      return up.dot(point) + height >= options.clearance;
    });
    clear.push_back(above ? 1 : 0);
  }
  return clear;
}

}  // namespace handey
