// Grids and bump-line distances are halved from level to level.
#include "hand_slide.hpp"

#include <algorithm>
#include <cmath>

namespace handey {

namespace {

// Choice: with the default cell of 4 mm the finest grid has cells of 1 mm and bump lines 1.5 mm
// off.
constexpr int kLevels = 3;

/// What of a route lies beyond its point nearest to the pose.
std::vector<Eigen::Vector2d> ahead_of(const PlanarPose& pose,
                                      const std::vector<Eigen::Vector2d>& route) {
  const auto distance = [&](const Eigen::Vector2d& point) {
    return (point - Eigen::Vector2d(pose.x, pose.y)).squaredNorm();
  };
  const auto nearest = std::min_element(route.begin(), route.end(),
                                        [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                                          return distance(a) < distance(b);
                                        });
  return {nearest, route.end()};
}

}  // namespace

HandSlider::HandSlider(const GripperOutline& outline, const ObstacleLayers& obstacles,
                       HandReach& reach, const PlanarPose& aim, double cell,
                       const QuasipotentialOptions& options)
    : outline_(outline),
      obstacles_(obstacles),
      reach_(reach),
      aim_(aim),
      cell_(cell),
      options_(options),
      grids_(kLevels) {}

const MotionGrid& HandSlider::grid(int level) {
  std::unique_ptr<MotionGrid>& grid = grids_[static_cast<std::size_t>(level)];
  if (!grid) grid = std::make_unique<MotionGrid>(obstacles_.draw(std::ldexp(cell_, -level)));
  return *grid;
}

bool HandSlider::is_at_aim(const PlanarPose& pose) const {
  return pose.x == aim_.x && pose.y == aim_.y &&
         std::abs(std::remainder(pose.theta - aim_.theta, 2.0 * std::acos(-1.0))) < 1e-12;
}

HandSlide HandSlider::run(const PlanarPose& start, const Eigen::VectorXd& q_start,
                          const std::vector<Eigen::Vector2d>& route) {
  HandSlide way;
  way.slide.path.push_back(start);
  way.slide.status = SlideStatus::StartBlocked;
  way.q.push_back(q_start);
  for (int level = 0; level < kLevels; ++level) {
    slide(level, route, way);
    way.at_aim = is_at_aim(way.slide.path.back());
    if (!way.at_aim) close_in(way);
    if (way.at_aim || way.slide.status == SlideStatus::Reached) break;
  }
  return way;
}

void HandSlider::slide(int level, const std::vector<Eigen::Vector2d>& route, HandSlide& so_far) {
  QuasipotentialOptions options = options_;
  options.clearance = std::ldexp(options.clearance, -level);
  std::vector<Eigen::VectorXd> q{so_far.q.back()};
  bool at_start = true;
  const ReachTest reachable = [&](const PlanarPose& pose) {
    if (at_start) {  // found free before
      at_start = false;
      return true;
    }
    std::optional<Eigen::VectorXd> next = reach_.follow_free(pose, q.back());
    if (!next) {
      so_far.reason = reach_.reason();
      return false;
    }
    q.push_back(std::move(*next));
    return true;
  };
  const PlanarPose start = so_far.slide.path.back();
  const SlideResult slide =
      slide_along(grid(level), outline_, start, ahead_of(start, route), reachable, options);
  so_far.slide.iterations += slide.iterations;
  so_far.slide.refusals += slide.refusals;
  if (slide.status == SlideStatus::StartBlocked) return;  // too near for this grid
  so_far.slide.status = slide.status;
  so_far.slide.path.insert(so_far.slide.path.end(), slide.path.begin() + 1, slide.path.end());
  for (std::size_t i = 1; i < slide.path.size(); ++i) so_far.q.push_back(q[i]);
}

/// Straight from where the slide is to the aim, a cell at a time; all of it or nothing.
void HandSlider::close_in(HandSlide& so_far) {
  const PlanarPose from = so_far.slide.path.back();
  const double turn = std::remainder(aim_.theta - from.theta, 2.0 * std::acos(-1.0));
  const double travel =
      std::hypot(aim_.x - from.x, aim_.y - from.y) + outline_.radius * std::abs(turn);
  const std::vector<PlanarPose> line =
      planar_line(from, aim_, static_cast<int>(std::ceil(travel / cell_)) + 1);
  std::vector<Eigen::VectorXd> q{so_far.q.back()};
  for (const PlanarPose& pose : line) {
    std::optional<Eigen::VectorXd> next = reach_.follow_free(pose, q.back());
    if (!next) {
      so_far.reason = reach_.reason();
      return;
    }
    q.push_back(std::move(*next));
  }
  so_far.slide.path.insert(so_far.slide.path.end(), line.begin(), line.end());
  so_far.q.insert(so_far.q.end(), q.begin() + 1, q.end());
  so_far.slide.status = SlideStatus::Reached;
  so_far.at_aim = true;
}

}  // namespace handey
