// Start after start: the arm is led out from the grasp to the start, so that it is in the grasp's
// branch; the hand slides in; where it ends short of the aim, the pose is tested as a grasp of its
// own; the joint path is drawn together into few certified edges.
#include "slide_approach.hpp"

#include <algorithm>
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

}  // namespace

SlideApproach::SlideApproach(const ApproachTask& task, HandReach& reach)
    : task_(task),
      obstacles_(reach.checker().cell(), task.outline, task.X_WG,
                 {task.aim.in_plane.x, task.aim.in_plane.y}, task.half_size()),
      reach_(reach),
      slider_(task.outline, obstacles_, reach, task.aim.in_plane, task.options.cell,
              task.options.slide),
      least_distance_(std::numeric_limits<double>::infinity()) {
  nearest_.status = ApproachStatus::StartBlocked;
  nearest_.planner = ApproachPlanner::Quasipotential;
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
  const LegalGrasps tested = test_grasp_pose(task_.scene, task_.solver, task_.pair, stop,
                                             task_.aim.flipped, task_.legality_at(stop));
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

ApproachResult SlideApproach::slide_from(const SlideStart& start, const Eigen::VectorXd& q_start) {
  ApproachResult result;
  result.planner = ApproachPlanner::Quasipotential;
  HandSlide way = slider_.run(start.pose, q_start, start.route);
  if (settle_grasp(way, result)) certify(way, result);
  result.slide = std::move(way.slide);
  return result;
}

/// @return true if the slide came in: it is then the nearest
bool SlideApproach::slide_in(const SlideStart& start) {
  const PlanarPose& aim = task_.aim.in_plane;
  const std::optional<Eigen::VectorXd> q = reach_.lead(aim, start.pose, task_.q_pick);
  if (!q || !reach_.follow_free(start.pose, *q)) {
    if (blocked_++ == 0) blocked_by_ = reach_.reason();
    return false;
  }
  ++slides_;
  ApproachResult result = slide_from(start, *q);
  const PlanarPose& end = result.slide.path.back();
  const double distance = std::hypot(end.x - aim.x, end.y - aim.y);
  const bool found = result.found();
  if (found || distance < least_distance_) {
    least_distance_ = distance;
    nearest_ = std::move(result);
  }
  return found;
}

ApproachResult SlideApproach::run() {
  const ApproachOptions& options = task_.options;
  const PlanarPose& aim = task_.aim.in_plane;
  const std::optional<SlideStart> widest =
      widest_start(slider_.grid(), task_.outline, aim, options.run_in);
  if (widest && slide_in(*widest)) return nearest_;
  for (const SlideStart& start : turned_starts(aim, options.run_in, options.least_run_in)) {
    if (slides_ >= options.most_slides) break;
    if (slide_in(start)) return nearest_;
  }
  const std::string blocked_text =
      std::to_string(blocked_) + " starts blocked" + (blocked_ > 0 ? " (" + blocked_by_ + ")" : "");
  nearest_.reason = slides_ == 0 ? "all " + blocked_text
                                 : nearest_.reason + "; nearest of " + std::to_string(slides_) +
                                       " slides, " + blocked_text;
  nearest_.grasp = {};
  nearest_.path.clear();
  return nearest_;
}

}  // namespace handey
