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

#include "handey/errors.hpp"
#include "require.hpp"

namespace handey {
namespace {

using Eigen::VectorXd;

// Two waypoints nearer than this in every coordinate are one [rad, m].
constexpr double kSamePlace = 1e-10;
// Edges in line but for rounding: a jump of velocity that takes this share of an interval.
constexpr double kInLine = 1e-6;
// A phase shorter than this gets no row of its own [s]: the speed changes by nothing meanwhile.
constexpr double kShortestPhase = 1e-6;
// More rows than this for one edge are a wrong limit or interval, not a motion.
constexpr double kMostRows = 1e6;

// The driven coordinates are the arm joints and a finger joint, which moves half the opening.
struct Limits {
  VectorXd velocity;
  VectorXd acceleration;
};

VectorXd coordinates(const Configuration& configuration) {
  VectorXd x(configuration.q.size() + 1);
  x << configuration.q, 0.5 * configuration.opening;
  return x;
}

void require_positive(double value, const std::string& place, const std::string& what) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidInput("E_LIMIT", place,
                     what + " limit " + std::to_string(value) + " is not a finite number > 0");
}

Limits limits_of(const Robot& robot) {
  const Eigen::Index joints = static_cast<Eigen::Index>(robot.joints.size());
  Limits limits{VectorXd(joints + 1), VectorXd(joints + 1)};
  for (Eigen::Index j = 0; j < joints; ++j) {
    const ArmJoint& joint = robot.joints[static_cast<std::size_t>(j)];
    require_positive(joint.limit.velocity, joint.name, "velocity");
    require_positive(joint.limit.acceleration, joint.name, "acceleration");
    limits.velocity(j) = joint.limit.velocity;
    limits.acceleration(j) = joint.limit.acceleration;
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    require_positive(finger.velocity, finger.name, "velocity");
  }
  require_positive(robot.gripper.acceleration, "gripper", "acceleration");
  limits.velocity(joints) =
      std::min(robot.gripper.fingers[0].velocity, robot.gripper.fingers[1].velocity);
  limits.acceleration(joints) = robot.gripper.acceleration;
  return limits;
}

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

// The first and the last waypoint stay as they are: the next step of a plan starts where this one
// ends.
std::vector<Configuration> without_repetitions(const std::vector<Configuration>& path) {
  std::vector<Configuration> kept{path.front()};
  const auto is_same = [](const Configuration& a, const Configuration& b) {
    return (coordinates(a) - coordinates(b)).cwiseAbs().maxCoeff() <= kSamePlace;
  };
  for (std::size_t k = 1; k < path.size(); ++k) {
    if (!is_same(kept.back(), path[k])) kept.push_back(path[k]);
  }
  if (kept.size() > 1) kept.back() = path.back();
  return kept;
}

// A straight piece of the path, driven along s.
struct Edge {
  double length = 0.0;        // of s: seconds at the velocity limits
  VectorXd tangent;           // d(coordinates)/ds, at most the velocity limit in each coordinate
  double acceleration = 0.0;  // limit of d2s/dt2
};

std::vector<Edge> edges_of(const std::vector<Configuration>& path, const Limits& limits) {
  std::vector<Edge> edges;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    Edge edge;
    const VectorXd step = coordinates(path[k + 1]) - coordinates(path[k]);
    edge.length = step.cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff();
    edge.tangent = step / edge.length;
    edge.acceleration = 1.0 / edge.tangent.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff();
    edges.push_back(edge);
  }
  return edges;
}

// May the path go on from one edge to the next without a stop? Only where they lie in line: a
// corner driven through at any speed is a jump of velocity, on top of the acceleration along the
// edges.
bool is_in_line(const Edge& before, const Edge& after, const Limits& limits, double interval) {
  const VectorXd jump = after.tangent - before.tangent;
  return jump.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff() <= kInLine * interval;
}

std::vector<double> waypoint_speeds(const std::vector<Edge>& edges, const Limits& limits,
                                    const TimingOptions& options) {
  std::vector<double> speed(edges.size() + 1, options.speed_scale);
  speed.front() = speed.back() = 0.0;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (!is_in_line(edges[k - 1], edges[k], limits, options.interval)) speed[k] = 0.0;
  }
  const auto reached = [](double from, const Edge& edge) {
    return std::sqrt(from * from + 2.0 * edge.acceleration * edge.length);
  };
  for (std::size_t k = 0; k < edges.size(); ++k) {
    speed[k + 1] = std::min(speed[k + 1], reached(speed[k], edges[k]));
  }
  for (std::size_t k = edges.size(); k-- > 0;) {
    speed[k] = std::min(speed[k], reached(speed[k + 1], edges[k]));
  }
  return speed;
}

// Speed up, cruise, slow down along one edge.
struct Trapezoid {
  double from, to, peak;    // speeds ds/dt
  double up, cruise, down;  // durations [s]
  double duration() const { return up + cruise + down; }
  // s from the beginning of the edge at time t.
  double at(double t, double acceleration) const {
    if (t <= up) return t * (from + 0.5 * acceleration * t);
    const double ramp = 0.5 * up * (from + peak);
    if (t <= up + cruise) return ramp + peak * (t - up);
    const double late = t - up - cruise;
    return ramp + peak * cruise + late * (peak - 0.5 * acceleration * late);
  }
};

Trapezoid trapezoid(const Edge& edge, double from, double to, double speed_scale) {
  Trapezoid profile{from, to, 0.0, 0.0, 0.0, 0.0};
  const double a = edge.acceleration;
  const double crest = std::sqrt(a * edge.length + 0.5 * (from * from + to * to));
  profile.peak = std::max({std::min(crest, speed_scale), from, to});
  profile.up = (profile.peak - from) / a;
  profile.down = (profile.peak - to) / a;
  const double ramps =
      0.5 * (profile.up * (from + profile.peak) + profile.down * (to + profile.peak));
  profile.cruise = std::max(0.0, (edge.length - ramps) / profile.peak);
  return profile;
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
  const VectorXd step = coordinates(row) - coordinates(timed.configurations.back());
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
  const Limits limits = limits_of(robot);
  const std::vector<Configuration> waypoints = without_repetitions(path);
  const std::vector<Edge> edges = edges_of(waypoints, limits);
  const std::vector<double> speed = waypoint_speeds(edges, limits, options);

  TimedPath timed{{0.0}, {waypoints.front()}};
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Trapezoid profile = trapezoid(edges[k], speed[k], speed[k + 1], options.speed_scale);
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
  for (const Edge& edge : edges_of(path, limits_of(robot))) total += edge.length;
  return total;
}

}  // namespace handey
