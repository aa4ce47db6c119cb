// Start after start: the arm is led out from the grasp to the start, so that it is in the grasp's
// branch; the hand slides in; where it ends short of the aim, the pose is tested as a grasp of its
// own; the joint path is drawn together into few certified edges.
#include "handey/approach/approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "certified_path.hpp"
#include "hand_slide.hpp"
#include "handey/errors.hpp"
#include "reason.hpp"

namespace handey {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Choice: two configurations that differ less are the same; far above rounding, far below what
// moves a finger.
constexpr double kSameConfiguration = 1e-6;  // [rad]
// Choice: starts, turned about the fingertips; the article takes any cell of the grid's border.
constexpr std::array<double, 11> kTurnsDeg = {0, 15, -15, 30, -30, 45, -45, 60, -60, 90, -90};

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

/// Straight back first, shorter, then turned.
std::vector<PlanarPose> starts(const PlanarPose& aim, const ApproachOptions& options) {
  std::vector<double> distances{options.run_in};
  if (options.least_run_in < options.run_in) {
    distances.push_back(0.5 * (options.run_in + options.least_run_in));
    distances.push_back(options.least_run_in);
  }
  std::vector<PlanarPose> result;
  for (const double turn : kTurnsDeg) {
    const double theta = aim.theta + turn * kPi / 180.0;
    for (const double distance : distances) {
      result.push_back(
          {aim.x - distance * std::cos(theta), aim.y - distance * std::sin(theta), theta});
    }
  }
  return result;
}

class Approach {
 public:
  Approach(const GraspScene& scene, const SphericalWristSolver& solver, const RankedPair& pair,
           const GraspPose& aim, const Eigen::VectorXd& q_pick, const ApproachOptions& options)
      : scene_(scene),
        solver_(solver),
        pair_(pair),
        aim_(aim),
        q_pick_(q_pick),
        options_(options),
        X_WG_(scene.cell.parts[static_cast<std::size_t>(scene.part)].X_WB * pair.pair.X_PG),
        outline_(gripper_outline(*scene.cell.robot, aim.opening, aim.flipped)),
        obstacles_(scene, outline_, X_WG_, pair.pair.X_PG, {aim.in_plane.x, aim.in_plane.y},
                   options.run_in + outline_.radius + options.slide.clearance,
                   options.destination_obstacles_join),
        reach_(scene, solver, X_WG_, aim, options.legality.clearance),
        slider_(outline_, obstacles_, reach_, aim.in_plane, options) {}

  ApproachResult run();

 private:
  ApproachResult slide_from(const PlanarPose& start, const Eigen::VectorXd& q_start);
  bool settle_grasp(HandSlide& way, ApproachResult& result);
  bool test_stop(const HandSlide& way, ApproachResult& result);
  void certify(const HandSlide& way, ApproachResult& result);

  const GraspScene& scene_;
  const SphericalWristSolver& solver_;
  const RankedPair& pair_;
  const GraspPose& aim_;
  const Eigen::VectorXd& q_pick_;
  const ApproachOptions& options_;
  const Pose X_WG_;
  const GripperOutline outline_;
  const ObstacleLayers obstacles_;
  HandReach reach_;
  HandSlider slider_;
};

/// The legal configuration that the slide ended in, exactly as it is listed.
const Eigen::VectorXd* same_configuration(const std::vector<Eigen::VectorXd>& legal,
                                          const Eigen::VectorXd& q) {
  for (const Eigen::VectorXd& candidate : legal) {
    if ((candidate - q).cwiseAbs().maxCoeff() < kSameConfiguration) return &candidate;
  }
  return nullptr;
}

/// The slide stopped short of the aim: is it a grasp there?
bool Approach::test_stop(const HandSlide& way, ApproachResult& result) {
  const PlanarPose stop = way.slide.path.back();
  const double short_by = std::hypot(stop.x - aim_.in_plane.x, stop.y - aim_.in_plane.y);
  const double turn = std::abs(std::remainder(stop.theta - aim_.in_plane.theta, 2.0 * kPi));
  const std::string where =
      (short_by > 1e-9 ? "stopped " + millimetres(short_by) + " before the target"
                       : "arrived turned by " + degrees(turn) + " from the aim") +
      (way.reason.empty() ? "" : " (" + way.reason + ")");
  LegalityOptions legality = options_.legality;
  legality.least_contact_share = options_.contact_share;
  const LegalGrasps tested = test_grasp_pose(scene_, solver_, pair_, stop, aim_.flipped, legality);
  if (tested.poses.empty()) {
    result.status = tested.too_little_contact > 0 ? ApproachStatus::PoorOverlap
                    : tested.unreachable_at_destination + tested.collides_at_destination > 0
                        ? ApproachStatus::IllegalAtDestination
                        : ApproachStatus::Stalled;
    result.reason = where + "; no grasp there: " + tested.worst_reason;
    return false;
  }
  result.grasp = tested.poses.front();
  // The hand stays as wide open as it came; the test may have chosen another opening.
  if (std::abs(result.grasp.opening - aim_.opening) > 1e-9 ||
      !same_configuration(result.grasp.q_pick, way.q.back())) {
    result.status = ApproachStatus::Stalled;
    result.reason = where + "; a grasp there, but not with the arm as it came";
    return false;
  }
  return true;
}

/// What grasp the slide ended in; the path's last configuration becomes the grasp's own.
bool Approach::settle_grasp(HandSlide& way, ApproachResult& result) {
  if (way.at_aim) {
    result.grasp = aim_;
    std::vector<Eigen::VectorXd> legal{q_pick_};
    legal.insert(legal.end(), aim_.q_pick.begin(), aim_.q_pick.end());
    const Eigen::VectorXd* q = same_configuration(legal, way.q.back());
    if (!q) {
      result.status = ApproachStatus::Stalled;
      result.reason = "the hand arrives, but the arm in another branch than it left";
      return false;
    }
    way.q.back() = *q;
  } else {
    if (!test_stop(way, result)) return false;
    way.q.back() = *same_configuration(result.grasp.q_pick, way.q.back());
  }
  result.grasp.q_pick = {way.q.back()};
  return true;
}

void Approach::certify(const HandSlide& way, ApproachResult& result) {
  std::vector<Configuration> points;
  for (const Eigen::VectorXd& q : way.q) points.push_back(reach_.with_opening(q));
  CertifiedPath proved = certified_path(reach_.checker(), points, options_.certificate);
  if (proved.reached + 1 < points.size()) {
    result.status = ApproachStatus::NotCertified;
    result.reason = "the way in is not proved free: " + describe(proved.obstacle.hit);
    return;
  }
  result.path = std::move(proved.path);
  result.status = ApproachStatus::Found;
}

ApproachResult Approach::slide_from(const PlanarPose& start, const Eigen::VectorXd& q_start) {
  ApproachResult result;
  result.planner = ApproachPlanner::Quasipotential;
  HandSlide way = slider_.run(start, q_start);
  if (settle_grasp(way, result)) certify(way, result);
  result.slide = std::move(way.slide);
  return result;
}

ApproachResult Approach::run() {
  ApproachResult nearest;
  nearest.status = ApproachStatus::StartBlocked;
  double least_distance = std::numeric_limits<double>::infinity();
  int slides = 0, blocked = 0;
  std::string blocked_by;
  for (const PlanarPose& start : starts(aim_.in_plane, options_)) {
    if (slides == options_.most_slides) break;
    const std::optional<Eigen::VectorXd> q = reach_.lead(aim_.in_plane, start, q_pick_);
    if (!q || !reach_.follow_free(start, *q)) {
      if (blocked++ == 0) blocked_by = reach_.reason();
      continue;
    }
    ++slides;
    ApproachResult result = slide_from(start, *q);
    if (result.found()) return result;
    const PlanarPose& end = result.slide.path.back();
    const double distance = std::hypot(end.x - aim_.in_plane.x, end.y - aim_.in_plane.y);
    if (distance < least_distance) {
      least_distance = distance;
      nearest = std::move(result);
    }
  }
  const std::string blocked_text =
      std::to_string(blocked) + " starts blocked" + (blocked > 0 ? " (" + blocked_by + ")" : "");
  nearest.reason = slides == 0 ? "all " + blocked_text
                               : nearest.reason + "; nearest of " + std::to_string(slides) +
                                     " slides, " + blocked_text;
  nearest.grasp = {};
  nearest.path.clear();
  return nearest;
}

}  // namespace

ApproachResult plan_approach(const GraspScene& scene, const SphericalWristSolver& solver,
                             const RankedPair& pair, const GraspPose& aim,
                             const Eigen::VectorXd& q_pick, const ApproachOptions& options) {
  require_valid(scene, aim, q_pick, options);
  return Approach(scene, solver, pair, aim, q_pick, options).run();
}

}  // namespace handey
