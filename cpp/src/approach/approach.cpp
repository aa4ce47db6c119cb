// Planner after planner, the cheapest first: straight in, the article's slides, the complete search
// of the grasp plane.
#include "handey/approach/approach.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "handey/approach/joined_destination.hpp"
#include "handey/errors.hpp"
#include "reason.hpp"
#include "search_approach.hpp"
#include "slide_approach.hpp"
#include "straight_approach.hpp"

namespace handey {

namespace {

// Choice: a run-in that something cut short is good at once if the robot has this much room where
// it begins; else better ones are looked for first [m].
constexpr double kRoom = 0.015;
// Choice: the fingers pass the widest place of the part this far from it, each side [m].
constexpr double kPast = 0.002;

void require_range(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "plan_approach", message);
}

void require_valid(const GraspScene& scene, const GraspPose& aim, const Eigen::VectorXd& q_pick,
                   const ApproachOptions& options) {
  const Cell& cell = scene.cell;
  require_range(scene.part >= 0 && static_cast<std::size_t>(scene.part) < cell.parts.size(),
                "part " + std::to_string(scene.part) + " of " + std::to_string(cell.parts.size()));
  require_range(!cell.held, "the hand must be empty");
  require_range(options.cell > 0.0 && options.slide.clearance >= 1.5 * options.cell * (1.0 - 1e-9),
                "the bump lines' clearance must be at least 1.5 cells");
  require_range(
      options.least_run_in > 0.0 && options.least_run_in <= options.run_in && options.run_in <= 1.0,
      "there must be 0 < least_run_in <= run_in <= 1 m");
  require_range(options.most_slides >= 1, "most_slides must be at least 1");
  require_range(options.search_levels >= 0 && options.search_levels <= 3,
                "search_levels must be 0 to 3");
  const std::size_t joints = cell.robot->joints.size();
  if (static_cast<std::size_t>(q_pick.size()) != joints) {
    throw InvalidInput("E_DOF", "plan_approach",
                       "q_pick has " + std::to_string(q_pick.size()) + " joint values, the arm " +
                           std::to_string(joints) + " joints");
  }
  if (!q_pick.allFinite()) {
    throw InvalidInput("E_NUMBER", "plan_approach", "q_pick must be finite numbers");
  }
  const Pose X_WP = cell.parts[static_cast<std::size_t>(scene.part)].X_WB;
  const Pose X_WH = hand_in_world(cell, q_pick), X_WH_aim = X_WP * aim.X_PH;
  if (!X_WH.isApprox(X_WH_aim, 1e-6)) {
    throw InvalidInput("E_VALUE", "plan_approach", "q_pick does not put the hand at the grasp");
  }
}

ApproachResult straight_result(const ApproachTask& task, const StraightWay& way) {
  ApproachResult result;
  result.status = ApproachStatus::Found;
  result.planner = ApproachPlanner::Straight;
  result.grasp = task.aim;
  result.grasp.q_pick = {way.path.back().q};
  result.path = way.path;
  result.slide.status = SlideStatus::Reached;
  const PlanarPose& aim = task.aim.in_plane;
  const PlanarPose start{aim.x - way.length * std::cos(aim.theta),
                         aim.y - way.length * std::sin(aim.theta), aim.theta};
  result.slide.path = {start};
  const int steps = static_cast<int>(std::ceil(way.length / task.options.cell));
  for (const PlanarPose& pose : planar_line(start, aim, steps)) result.slide.path.push_back(pose);
  return result;
}

/// All planners at one grasp, the hand as wide open as there.
class Opening {
 public:
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;
  Opening(ApproachTask task, CollisionChecker& checker)
      : task_(std::move(task)),
        reach_(task_.solver, checker, task_.X_WG, task_.aim.flipped, task_.aim.opening,
               task_.options.legality.clearance) {}

  /// Straight in, then by slides. A straight way that begins where there is little room is kept for
  /// last.
  ApproachResult come_in() {
    const ApproachOptions& options = task_.options;
    const StraightWay straight = straight_way(task_, reach_);
    if (straight.length >= options.least_run_in - 1e-9) {
      last_resort_ = straight_result(task_, straight);
      const bool is_whole = straight.length >= options.run_in - 1e-9;
      const Configuration& start = straight.path.front();
      if (is_whole || reach_.checker().closest(start, kRoom).distance >= kRoom) {
        return *last_resort_;
      }
    }
    return SlideApproach(task_, reach_).run();
  }
  ApproachResult search() { return SearchApproach(task_, reach_).run(); }
  const std::optional<ApproachResult>& last_resort() const { return last_resort_; }

 private:
  const ApproachTask task_;
  HandReach reach_;
  std::optional<ApproachResult> last_resort_;
};

/// The same grasp with the hand less open, where that is legal too, next wider first.
std::vector<GraspPose> less_open(const GraspScene& scene, const SphericalWristSolver& solver,
                                 const RankedPair& pair, const GraspPose& aim,
                                 const ApproachOptions& options) {
  std::vector<GraspPose> result;
  LegalityOptions legality = options.legality;
  legality.least_contact_share = 0.0;  // the aim has enough
  double opening = aim.opening;
  for (int halvings = 1; halvings <= 2; ++halvings) {
    legality.open_clearance = 0.5 * std::ldexp(aim.opening - aim.width, -halvings);
    const LegalGrasps legal =
        test_grasp_pose(scene, solver, pair, aim.in_plane, aim.flipped, legality);
    if (legal.poses.empty() || legal.poses.front().opening > opening - 1e-4) continue;
    opening = legal.poses.front().opening;
    result.push_back(legal.poses.front());
  }
  return result;
}

/// The same grasp with the hand so wide open that the fingers pass the part wherever it is wider
/// than at the grasp, where that is legal too.
std::optional<GraspPose> past_part(const GraspScene& scene, const SphericalWristSolver& solver,
                                   const RankedPair& pair, const GraspPose& aim,
                                   const ApproachOptions& options) {
  double reach = 0.0;  // of the part along the closing axis, to either side
  for (const Shape& shape : scene.cell.parts[static_cast<std::size_t>(scene.part)].shapes) {
    for (const Eigen::Vector3d& point : hull_points(shape)) {
      reach = std::max(reach, std::abs((aim.X_PH.inverse(Eigen::Isometry) * point).y()));
    }
  }
  const double most = scene.cell.robot->gripper.max_opening;
  const double opening = std::min(most, 2.0 * (reach + kPast));
  if (opening <= aim.opening + 1e-4) return std::nullopt;
  LegalityOptions legality = options.legality;
  legality.least_contact_share = 0.0;  // the aim has enough
  legality.open_clearance = 0.5 * (opening - aim.width);
  const LegalGrasps legal =
      test_grasp_pose(scene, solver, pair, aim.in_plane, aim.flipped, legality);
  if (legal.poses.empty() || legal.poses.front().opening < opening - 1e-4) return std::nullopt;
  return legal.poses.front();
}

/// With the arm as in `q_pick`.
std::vector<GraspPose> other_openings(const GraspScene& scene, const SphericalWristSolver& solver,
                                      const RankedPair& pair, const GraspPose& aim,
                                      const Eigen::VectorXd& q_pick,
                                      const ApproachOptions& options) {
  std::vector<GraspPose> result = less_open(scene, solver, pair, aim, options);
  std::optional<GraspPose> wide = past_part(scene, solver, pair, aim, options);
  if (wide) result.push_back(std::move(*wide));
  const auto is_elsewhere = [&](const GraspPose& grasp) {
    return same_configuration(grasp.q_pick, q_pick) == nullptr;
  };
  result.erase(std::remove_if(result.begin(), result.end(), is_elsewhere), result.end());
  return result;
}

}  // namespace

ApproachResult plan_approach(const GraspScene& scene, const SphericalWristSolver& solver,
                             const RankedPair& pair, const GraspPose& aim,
                             const Eigen::VectorXd& q_pick, const ApproachOptions& options) {
  require_valid(scene, aim, q_pick, options);
  const Pose X_WG = scene.cell.parts[static_cast<std::size_t>(scene.part)].X_WB * pair.pair.X_PG;
  CollisionChecker checker = options.destination_obstacles_join
                                 ? make_checker(join_destination(scene))
                                 : CollisionChecker(scene.model, scene.cell);
  ApproachOptions brief = options;
  brief.search_levels = std::min(options.search_levels, 1);
  std::deque<Opening> openings;  // an Opening refers to its own members
  const auto add = [&](const GraspPose& grasp, const ApproachOptions& budget) -> Opening& {
    openings.emplace_back(
        ApproachTask{scene, solver, pair, grasp, q_pick, budget, X_WG,
                     gripper_outline(*scene.cell.robot, grasp.opening, grasp.flipped)},
        checker);
    return openings.back();
  };
  Opening& first = add(aim, options);
  ApproachResult result = first.come_in();
  if (result.found()) return result;
  // The searches cost most: they wait until all that is quick has been tried.
  const std::vector<GraspPose> others =
      first.last_resort() ? std::vector<GraspPose>{}
                          : other_openings(scene, solver, pair, aim, q_pick, options);
  for (const GraspPose& grasp : others) {
    ApproachResult other = add(grasp, brief).come_in();
    if (other.found()) return other;
  }
  for (Opening& opening : openings) {
    if (options.search_levels > 0) {
      ApproachResult searched = opening.search();
      if (searched.found()) return searched;
      if (&opening == &first) {
        result.planner = searched.planner;
        result.reason += "; search: " + searched.reason;
      }
    }
    if (opening.last_resort()) return *opening.last_resort();
  }
  return result;
}

}  // namespace handey
