// Start after start: the arm is led out from the grasp to the start, so that it is in the grasp's
// branch; the hand slides in; where it ends short of the aim, the pose is tested as a grasp of its
// own; the joint path is drawn together into few certified edges.
#include "slide_approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "certified_path.hpp"
#include "reason.hpp"

namespace handey {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Choice: two configurations that differ less are the same; far above rounding, far below what
// moves a finger.
constexpr double kSameConfiguration = 1e-6;  // [rad]
// Choice: starts, turned about the fingertips; the article takes any cell of the grid's border.
constexpr std::array<double, 11> kTurnsDeg = {0, 15, -15, 30, -30, 45, -45, 60, -60, 90, -90};

}  // namespace

SlideApproach::SlideApproach(const ApproachTask& task, HandReach& reach)
    : task_(task),
      obstacles_(task.scene, task.outline, task.X_WG, task.pair.pair.X_PG,
                 {task.aim.in_plane.x, task.aim.in_plane.y}, task.half_size(),
                 task.options.destination_obstacles_join),
      reach_(reach),
      slider_(task.outline, obstacles_, reach, task.aim.in_plane, task.options) {}

/// Straight back first, shorter, then turned.
std::vector<PlanarPose> SlideApproach::starts() const {
  const PlanarPose& aim = task_.aim.in_plane;
  const ApproachOptions& options = task_.options;
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

const Eigen::VectorXd* same_configuration(const std::vector<Eigen::VectorXd>& legal,
                                          const Eigen::VectorXd& q) {
  for (const Eigen::VectorXd& candidate : legal) {
    if ((candidate - q).cwiseAbs().maxCoeff() < kSameConfiguration) return &candidate;
  }
  return nullptr;
}

/// The slide stopped short of the aim: is it a grasp there?
bool SlideApproach::test_stop(const HandSlide& way, ApproachResult& result) {
  const PlanarPose stop = way.slide.path.back();
  const double short_by = std::hypot(stop.x - task_.aim.in_plane.x, stop.y - task_.aim.in_plane.y);
  const double turn = std::abs(std::remainder(stop.theta - task_.aim.in_plane.theta, 2.0 * kPi));
  const std::string where =
      (short_by > 1e-9 ? "stopped " + millimetres(short_by) + " before the target"
                       : "arrived turned by " + degrees(turn) + " from the aim") +
      (way.reason.empty() ? "" : " (" + way.reason + ")");
  LegalityOptions legality = task_.options.legality;
  legality.least_contact_share = task_.options.contact_share;
  const LegalGrasps tested =
      test_grasp_pose(task_.scene, task_.solver, task_.pair, stop, task_.aim.flipped, legality);
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
  if (std::abs(result.grasp.opening - task_.aim.opening) > 1e-9 ||
      !same_configuration(result.grasp.q_pick, way.q.back())) {
    result.status = ApproachStatus::Stalled;
    result.reason = where + "; a grasp there, but not with the arm as it came";
    return false;
  }
  return true;
}

/// What grasp the slide ended in; the path's last configuration becomes the grasp's own.
bool SlideApproach::settle_grasp(HandSlide& way, ApproachResult& result) {
  if (way.at_aim) {
    result.grasp = task_.aim;
    std::vector<Eigen::VectorXd> legal{task_.q_pick};
    legal.insert(legal.end(), task_.aim.q_pick.begin(), task_.aim.q_pick.end());
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

void SlideApproach::certify(const HandSlide& way, ApproachResult& result) {
  std::vector<Configuration> points;
  for (const Eigen::VectorXd& q : way.q) points.push_back(reach_.with_opening(q));
  CertifiedPath proved = certified_path(reach_.checker(), points, task_.options.certificate);
  if (proved.reached + 1 < points.size()) {
    result.status = ApproachStatus::NotCertified;
    result.reason = "the way in is not proved free: " + describe(proved.obstacle.hit);
    return;
  }
  result.path = std::move(proved.path);
  result.status = ApproachStatus::Found;
}

ApproachResult SlideApproach::slide_from(const PlanarPose& start, const Eigen::VectorXd& q_start) {
  ApproachResult result;
  result.planner = ApproachPlanner::Quasipotential;
  HandSlide way = slider_.run(start, q_start);
  if (settle_grasp(way, result)) certify(way, result);
  result.slide = std::move(way.slide);
  return result;
}

ApproachResult SlideApproach::run() {
  ApproachResult nearest;
  nearest.planner = ApproachPlanner::Quasipotential;
  nearest.status = ApproachStatus::StartBlocked;
  double least_distance = std::numeric_limits<double>::infinity();
  int slides = 0, blocked = 0;
  std::string blocked_by;
  for (const PlanarPose& start : starts()) {
    if (slides == task_.options.most_slides) break;
    const std::optional<Eigen::VectorXd> q = reach_.lead(task_.aim.in_plane, start, task_.q_pick);
    if (!q || !reach_.follow_free(start, *q)) {
      if (blocked++ == 0) blocked_by = reach_.reason();
      continue;
    }
    ++slides;
    ApproachResult result = slide_from(start, *q);
    if (result.found()) return result;
    const PlanarPose& end = result.slide.path.back();
    const double distance = std::hypot(end.x - task_.aim.in_plane.x, end.y - task_.aim.in_plane.y);
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

}  // namespace handey
