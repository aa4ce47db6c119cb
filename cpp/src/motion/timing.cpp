// The path parameter s is the travel time at the velocity limits: along an edge it grows by
// max_j |dq_j| / v_j. Then ds/dt <= speed_scale is the velocity limit of all joints at once, each
// edge has one constant limit of its acceleration, and the fastest profile is exact and in closed
// form: a stop at every corner, speeds where edges in line meet by one pass forward and one
// backward (Bobrow, Dubowsky, Gibson 1985, for straight edges), and a trapezoid between each two.
#include "handey/motion/timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "edge_times.hpp"
#include "handey/errors.hpp"
#include "require.hpp"

namespace handey {
namespace {

using Eigen::VectorXd;
using motion::Edge;
using motion::Limits;
using motion::Trapezoid;

// A phase shorter than this gets no row of its own [s]: the speed changes by nothing meanwhile.
constexpr double kShortestPhase = 1e-6;
// More rows than this for one edge are a wrong limit or interval, not a motion.
constexpr double kMostRows = 1e6;

void require_valid(const Robot& robot, const std::vector<Configuration>& path,
                   const TimingOptions& options) {
  if (path.empty()) throw InvalidInput("E_EMPTY", "path", "no waypoint, expected at least one");
  if (!(options.interval >= 1e-4 && options.interval <= 1.0)) {
    throw InvalidInput("E_RANGE", "interval",
                       std::to_string(options.interval) + " s, expected a number from 0.0001 to 1");
  }
  if (!(options.speed_scale > 0.0 && options.speed_scale <= 1.0)) {
    throw InvalidInput("E_RANGE", "speed_scale",
                       std::to_string(options.speed_scale) + ", expected a number in (0, 1]");
  }
  for (std::size_t k = 0; k < path.size(); ++k) {
    motion::require_configuration(robot, path[k], "path[" + std::to_string(k) + "]");
  }
}

// Times from the beginning of an edge at which a row is due, without 0 and the end: the ends of the
// phases, and between them, while the speed changes, no farther apart than the interval.
std::vector<double> inner_times(const Trapezoid& profile, double interval) {
  std::vector<double> times;
  double begin = 0.0;
  const auto add_phase = [&](double length, bool speed_changes) {
    if (length < kShortestPhase) return;
    if (speed_changes && length / interval > kMostRows) {
      throw InvalidInput("E_RANGE", "interval",
                         "speeding up takes " + std::to_string(length) + " s, too many rows");
    }
    const int steps = speed_changes ? static_cast<int>(std::ceil(length / interval)) : 1;
    for (int i = 1; i <= steps; ++i) times.push_back(begin + length * i / steps);
    begin += length;
  };
  add_phase(profile.up, true);
  add_phase(profile.cruise, false);
  add_phase(profile.down, true);
  if (!times.empty()) times.pop_back();  // the end of the edge, which its waypoint stands for
  return times;
}

// Adds a row, not earlier than the velocity limits allow for the numbers as they are rounded.
void append(TimedPath& timed, double time, const Configuration& row, const Limits& limits) {
  const VectorXd step = motion::coordinates(row) - motion::coordinates(timed.configurations.back());
  const double least = step.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff();
  const double before = timed.time.back();
  while (time <= before || time - before < least) {
    time = std::nextafter(std::max(time, before + least), std::numeric_limits<double>::infinity());
  }
  timed.time.push_back(time);
  timed.configurations.push_back(row);
}

}  // namespace

TimedPath time_path(const Robot& robot, const std::vector<Configuration>& path,
                    const TimingOptions& options) {
  require_valid(robot, path, options);
  const Limits limits = motion::limits_of(robot);
  const std::vector<Configuration> waypoints = motion::without_repetitions(path);
  const std::vector<Edge> edges = motion::edges_of(waypoints, limits);
  const std::vector<double> speed = motion::waypoint_speeds(edges, limits, options);

  TimedPath timed{{0.0}, {waypoints.front()}};
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Trapezoid profile =
        motion::trapezoid(edges[k], speed[k], speed[k + 1], options.speed_scale);
    const double begin = timed.time.back();
    const Configuration &a = waypoints[k], &b = waypoints[k + 1];
    for (double t : inner_times(profile, options.interval)) {
      const double share = std::min(1.0, profile.at(t, edges[k].acceleration) / edges[k].length);
      Configuration row;
      row.q = a.q + share * (b.q - a.q);
      row.opening = a.opening + share * (b.opening - a.opening);
      append(timed, begin + t, row, limits);
    }
    append(timed, begin + profile.duration(), b, limits);
  }
  return timed;
}

double travel_time(const Robot& robot, const std::vector<Configuration>& path) {
  double total = 0.0;
  for (const Edge& edge : motion::edges_of(path, motion::limits_of(robot))) total += edge.length;
  return total;
}

}  // namespace handey
