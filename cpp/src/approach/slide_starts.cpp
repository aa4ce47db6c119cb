// The widest start follows the article's hope for its grid; the turned ones stand for "any cell of
// the grid's border".
#include "slide_starts.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace handey {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Choice: starts, turned about the fingertips; the article takes any cell of the grid's border.
constexpr std::array<double, 11> kTurnsDeg = {0, 15, -15, 30, -30, 45, -45, 60, -60, 90, -90};

}  // namespace

std::optional<SlideStart> widest_start(const MotionGrid& grid, const GripperOutline& outline,
                                       const PlanarPose& aim, double run_in) {
  ClearancePath way = clearance_path(grid, outline, aim, run_in);
  if (!way.found()) return std::nullopt;
  const Eigen::Vector2d& first = way.points.front();
  double theta = aim.theta;
  if (!way.whole_hand) {
    const Eigen::Vector2d along = way.points[way.points.size() / 2] - first;
    if (along.norm() > 0.0) theta = std::atan2(along.y(), along.x());
  }
  const PlanarPose start{first.x(), first.y(), theta};
  return SlideStart{start, std::move(way.points)};
}

std::vector<SlideStart> turned_starts(const PlanarPose& aim, double run_in, double least_run_in) {
  std::vector<double> distances{run_in};
  if (least_run_in < run_in) {
    distances.push_back(0.5 * (run_in + least_run_in));
    distances.push_back(least_run_in);
  }
  std::vector<SlideStart> result;
  for (const double turn : kTurnsDeg) {
    const double theta = aim.theta + turn * kPi / 180.0;
    for (const double distance : distances) {
      const PlanarPose pose{aim.x - distance * std::cos(theta), aim.y - distance * std::sin(theta),
                            theta};
      result.push_back({pose, {{aim.x, aim.y}}});
    }
  }
  return result;
}

}  // namespace handey
