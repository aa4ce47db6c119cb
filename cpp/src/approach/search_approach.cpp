// Neighbours are taken in the order of their contact; legality costs most, so few are asked.
#include "search_approach.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "reason.hpp"
#include "slide_approach.hpp"

namespace handey {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Choice: poses beside the aim that are tested as grasps, on each lattice.
constexpr std::size_t kMostNeighbours = 6;
// Choice: neighbours are turned from the aim by no more; others are aims of their own [rad].
constexpr double kMostTurn = 0.6;

Pose frame_of_aim(const PlanarPose& aim) {
  Pose X_GA = Pose::Identity();
  X_GA.linear() = Eigen::AngleAxisd(aim.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_GA.translation() = Eigen::Vector3d(aim.x, aim.y, 0.0);
  return X_GA;
}

}  // namespace

SearchApproach::SearchApproach(const ApproachTask& task, HandReach& reach)
    : task_(task),
      obstacles_(reach.checker().cell(), task.outline, task.X_WG * frame_of_aim(task.aim.in_plane),
                 {0.0, 0.0}, task.half_size()),
      reach_(reach) {}

void SearchApproach::take(SearchedWay&& way, const GraspPose& grasp, ApproachResult& result) const {
  result.status = ApproachStatus::Found;
  result.reason.clear();
  result.grasp = grasp;
  result.grasp.q_pick = {way.path.back().q};
  result.path = std::move(way.path);
  result.slide.status = SlideStatus::Reached;
  result.slide.path = std::move(way.poses);
}

bool SearchApproach::try_aim(HandSearch& search, ApproachResult& result) {
  SearchedWay way = search.way_from({}, task_.q_pick);
  if (!way.found) {
    result.reason = way.reason;
    return false;
  }
  take(std::move(way), task_.aim, result);
  return true;
}

/// Lattice points about the aim that the hand could leave and where the pads have enough contact.
std::vector<LatticePoint> SearchApproach::neighbours(const HandSearch& search) const {
  const Gripper& gripper = task_.scene.cell.robot->gripper;
  const double pad = gripper.pad_width * gripper.pad_length;
  // As legality: where no pad can have the share, most of what the aim has.
  const double least = std::min(task_.options.contact_share * pad, 0.8 * task_.aim.contact_area);
  const PlaneSearch& plane = search.plane();
  const int around = plane.half() / 3;
  const int turns = static_cast<int>(kMostTurn / (2.0 * kPi) * plane.directions());
  struct Ranked {
    double contact;
    int distance;
    LatticePoint point;
  };
  std::vector<Ranked> ranked;
  for (int k = -turns; k <= turns; ++k) {
    for (int j = -around; j <= around; ++j) {
      for (int i = -around; i <= around; ++i) {
        const LatticePoint p{i, j, (k + plane.directions()) % plane.directions()};
        if ((i == 0 && j == 0 && k == 0) || plane.is_blocked(p) || !plane.is_open(p)) continue;
        const double contact = pad_contact_area(task_.pair.unobstructed, search.pose(p), gripper);
        if (contact < least) continue;
        ranked.push_back({contact, std::abs(i) + std::abs(j) + std::abs(k), p});
      }
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    if (std::abs(a.contact - b.contact) > 1e-9) return a.contact > b.contact;
    return a.distance < b.distance;
  });
  std::vector<LatticePoint> result;
  for (const Ranked& r : ranked) result.push_back(r.point);
  return result;
}

bool SearchApproach::try_neighbours(HandSearch& search, ApproachResult& result) {
  std::vector<LatticePoint> tried;
  for (const LatticePoint& point : neighbours(search)) {
    if (tried.size() == kMostNeighbours) break;
    // Beside one that failed there is hardly one that does not.
    const bool near = std::any_of(tried.begin(), tried.end(), [&](const LatticePoint& other) {
      return point.k == other.k && std::abs(point.i - other.i) + std::abs(point.j - other.j) <= 2;
    });
    if (near) continue;
    tried.push_back(point);
    const PlanarPose pose = search.pose(point);
    const LegalGrasps legal = test_grasp_pose(task_.scene, task_.solver, task_.pair, pose,
                                              task_.aim.flipped, task_.legality_at(pose));
    if (legal.poses.empty()) continue;
    const GraspPose& grasp = legal.poses.front();
    if (std::abs(grasp.opening - task_.aim.opening) > 1e-9) continue;
    for (const Eigen::VectorXd& q : grasp.q_pick) {
      SearchedWay way = search.way_from(point, q);
      if (!way.found) continue;
      take(std::move(way), grasp, result);
      return true;
    }
  }
  return false;
}

/// Who stands in the way of the hand that leaves the aim along straight lines.
std::string SearchApproach::enclosing() {
  constexpr int kDirections = 16;
  std::map<std::string, int> met;
  const PlanarPose& aim = task_.aim.in_plane;
  for (int d = 0; d < kDirections; ++d) {
    const double angle = aim.theta + 2.0 * kPi * d / kDirections;
    Eigen::VectorXd q = task_.q_pick;
    const PlanarPose end{aim.x + task_.options.run_in * std::cos(angle),
                         aim.y + task_.options.run_in * std::sin(angle), aim.theta};
    const int steps = static_cast<int>(std::ceil(task_.options.run_in / task_.options.cell));
    for (const PlanarPose& pose : planar_line(aim, end, steps)) {
      std::optional<Eigen::VectorXd> next = reach_.follow_free(pose, q);
      if (!next) {
        ++met[reach_.reason()];
        break;
      }
      q = std::move(*next);
    }
  }
  std::string text;
  for (int rank = 0; rank < 2 && !met.empty(); ++rank) {
    const auto most = std::max_element(
        met.begin(), met.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    text += (rank == 0 ? "" : ", ") + most->first;
    met.erase(most);
  }
  return text;
}

ApproachResult SearchApproach::run() {
  ApproachResult result;
  result.planner = ApproachPlanner::PlaneSearch;
  for (int level = 0; level < task_.options.search_levels; ++level) {
    const double cell = std::ldexp(task_.options.cell, -level);
    const ApproachOptions& options = task_.options;
    PlaneSearch plane(obstacles_.draw(cell), obstacles_.draw_inside(cell), task_.outline, {},
                      options.run_in, options.search);
    HandSearch search(std::move(plane), reach_, task_.aim.in_plane, options.certificate);
    if (try_aim(search, result) || try_neighbours(search, result)) return result;
    result.reason += " (lattice of " + millimetres(cell) + ")";
  }
  const std::string names = enclosing();
  if (!names.empty()) result.reason += "; round the grasp: " + names;
  return result;
}

}  // namespace handey
