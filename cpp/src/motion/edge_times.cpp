#include "edge_times.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "handey/errors.hpp"

namespace handey::motion {

using Eigen::VectorXd;

namespace {

// Two waypoints nearer than this in every coordinate are one [rad, m].
constexpr double kSamePlace = 1e-10;
// Edges in line but for rounding: a jump of velocity that takes this share of an interval.
constexpr double kInLine = 1e-6;

void require_positive(double value, const std::string& place, const std::string& what) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidInput("E_LIMIT", place,
                     what + " limit " + std::to_string(value) + " is not a finite number > 0");
}

// May the path go on from one edge to the next without a stop? Only where they lie in line: a
// corner driven through at any speed is a jump of velocity, on top of the acceleration along the
// edges.
bool is_in_line(const Edge& before, const Edge& after, const Limits& limits, double interval) {
  const VectorXd jump = after.tangent - before.tangent;
  return jump.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff() <= kInLine * interval;
}

}  // namespace

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

VectorXd coordinates(const Configuration& configuration) {
  VectorXd x(configuration.q.size() + 1);
  x << configuration.q, 0.5 * configuration.opening;
  return x;
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

double Trapezoid::at(double t, double a) const {
  if (t <= up) return t * (from + 0.5 * a * t);
  const double ramp = 0.5 * up * (from + peak);
  if (t <= up + cruise) return ramp + peak * (t - up);
  const double late = t - up - cruise;
  return ramp + peak * cruise + late * (peak - 0.5 * a * late);
}

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

double path_duration(const std::vector<Configuration>& path, const Limits& limits) {
  const std::vector<Edge> edges = edges_of(without_repetitions(path), limits);
  const TimingOptions full_speed;
  const std::vector<double> speed = waypoint_speeds(edges, limits, full_speed);
  double total = 0.0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    total += trapezoid(edges[k], speed[k], speed[k + 1], full_speed.speed_scale).duration();
  }
  return total;
}

EdgeTime edge_time(const Configuration& a, const Configuration& b, const Limits& limits) {
  const Eigen::Index joints = a.q.size();
  // The acceleration limit along the edge is travel / squared: the closed form of its trapezoid.
  double travel = 0.0, squared = 0.0;
  const auto take = [&](double step, Eigen::Index row) {
    travel = std::max(travel, std::abs(step) / limits.velocity(row));
    squared = std::max(squared, std::abs(step) / limits.acceleration(row));
  };
  for (Eigen::Index j = 0; j < joints; ++j) take(b.q(j) - a.q(j), j);
  take(0.5 * (b.opening - a.opening), joints);
  if (travel <= 0.0) return {};
  const bool cruises = travel * travel >= squared;
  return {travel, cruises ? travel + squared / travel : 2.0 * std::sqrt(squared)};
}

}  // namespace handey::motion
