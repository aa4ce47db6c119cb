// Where the arm can be is asked once for each point; certified is only what the search proposes.
#include "hand_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certified_path.hpp"
#include "reason.hpp"

namespace handey {

namespace {

// Choice: each round costs a certified path; a way that needs more is hardly there.
constexpr int kMostRounds = 24;
// Choice: as the largest jump of a hand path [rad].
constexpr double kLargestJump = 0.15;

}  // namespace

HandSearch::HandSearch(PlaneSearch plane, HandReach& reach, const PlanarPose& aim,
                       const CertificateOptions& certificate)
    : reach_(reach), aim_(aim), certificate_(certificate), plane_(std::move(plane)) {}

PlanarPose HandSearch::pose(const LatticePoint& point) const {
  const PlanarPose local = plane_.pose(point);
  const double c = std::cos(aim_.theta), s = std::sin(aim_.theta);
  return {aim_.x + c * local.x - s * local.y, aim_.y + s * local.x + c * local.y,
          aim_.theta + local.theta};
}

int HandSearch::key(const LatticePoint& point) const {
  const int side = 2 * plane_.half() + 1;
  return (point.k * side + point.j + plane_.half()) * side + point.i + plane_.half();
}

StepAnswer HandSearch::step(const LatticePoint& from, const LatticePoint& to,
                            const EndTest& may_end) {
  const Eigen::VectorXd& q_from = stands_.at(key(from)).q;
  const auto known = stands_.find(key(to));
  if (known != stands_.end()) {
    if (!known->second.is_free) return StepAnswer::Never;
    const bool near = (known->second.q - q_from).cwiseAbs().maxCoeff() <= kLargestJump;
    return near ? StepAnswer::Yes : StepAnswer::NotFromThere;
  }
  std::optional<Eigen::VectorXd> q = reach_.follow(pose(to), q_from);
  if (!q) {
    refusal_ = reach_.reason();
    return StepAnswer::NotFromThere;
  }
  bool is_free = reach_.is_free(*q);
  if (!is_free) {
    refusal_ = reach_.reason();
  } else if (may_end && plane_.is_exit(to) && !may_end(*q)) {
    is_free = false;
    refusal_ = "too little room at the end";
  }
  stands_[key(to)] = {is_free, std::move(*q)};
  return is_free ? StepAnswer::Yes : StepAnswer::Never;
}

bool HandSearch::certify(const PlaneSearchResult& found, SearchedWay& way) {
  std::vector<Configuration> points;
  for (const LatticePoint& point : found.path) {
    points.push_back(reach_.with_opening(stands_.at(key(point)).q));
  }
  CertifiedPath proved = certified_path(reach_.checker(), points, certificate_);
  if (proved.reached + 1 < points.size()) {
    plane_.forbid(found.path[proved.reached], found.path[proved.reached + 1]);
    refusal_ = describe(proved.obstacle.hit);
    return false;
  }
  way.found = true;
  way.path.assign(proved.path.rbegin(), proved.path.rend());
  way.points.assign(points.rbegin(), points.rend());
  for (auto point = found.path.rbegin(); point != found.path.rend(); ++point) {
    way.poses.push_back(pose(*point));
  }
  return true;
}

std::string HandSearch::explain(const PlaneSearchResult& found) const {
  const std::string last = refusal_.empty() ? "" : ", the last refused: " + refusal_;
  switch (found.status) {
    case PlaneSearchStatus::Enclosed:
      return "the hand is enclosed: no way out in the grasp plane";
    case PlaneSearchStatus::TestLimit:
      return "no way out among " + std::to_string(found.tests) + " poses tried" + last;
    default:
      return "no way out at this resolution for hand and arm" + last;
  }
}

SearchedWay HandSearch::way_from(const LatticePoint& start, const Eigen::VectorXd& q,
                                 const EndTest& may_end) {
  stands_.clear();
  stands_[key(start)] = {true, q};
  refusal_.clear();
  const StepTest may_step = [&](const LatticePoint& from, const LatticePoint& to) {
    return step(from, to, may_end);
  };
  SearchedWay way;
  for (int round = 0; round < kMostRounds; ++round) {
    const PlaneSearchResult found = plane_.find_way_out(start, may_step);
    if (!found.found()) {
      way.reason = explain(found);
      return way;
    }
    if (certify(found, way)) return way;
  }
  way.reason =
      std::to_string(kMostRounds) + " ways out were not proved free, the last: " + refusal_;
  return way;
}

}  // namespace handey
