// How long straight edges take: the arithmetic that timing and shortening share. An edge is driven
// along s, which counts seconds at the velocity limits; its acceleration limit follows from those
// of the joints.
#pragma once

#include <vector>

#include "handey/motion/timing.hpp"

namespace handey::motion {

/// Of the driven coordinates: the arm joints, and a finger joint, which moves half the opening.
struct Limits {
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;
};

/// @throws InvalidInput (E_LIMIT) for a limit that is not a finite number > 0
Limits limits_of(const Robot& robot);

/// The arm joints and half the opening.
Eigen::VectorXd coordinates(const Configuration& configuration);

/// A straight piece of a path.
struct Edge {
  double length = 0.0;        ///< of s: seconds at the velocity limits
  Eigen::VectorXd tangent;    ///< d(coordinates)/ds, at most the velocity limit in each coordinate
  double acceleration = 0.0;  ///< limit of d2s/dt2
};
std::vector<Edge> edges_of(const std::vector<Configuration>& path, const Limits& limits);

/// Speeds ds/dt at the waypoints: 0 at ends and corners, as fast as may be where edges lie in line.
std::vector<double> waypoint_speeds(const std::vector<Edge>& edges, const Limits& limits,
                                    const TimingOptions& options);

/// Speed up, cruise, slow down along one edge.
struct Trapezoid {
  double from, to, peak;    ///< speeds ds/dt
  double up, cruise, down;  ///< durations [s]
  double duration() const { return up + cruise + down; }
  /// s from the beginning of the edge at time t.
  double at(double t, double acceleration) const;
};
Trapezoid trapezoid(const Edge& edge, double from, double to, double speed_scale);

/// Waypoints that repeat the one before left out; the first and the last stay as they are.
std::vector<Configuration> without_repetitions(const std::vector<Configuration>& path);

/// Duration of time_path's result at full speed, without its rows; a few roundings off it [s].
double path_duration(const std::vector<Configuration>& path, const Limits& limits);

/// An edge that is driven alone, from rest to rest.
struct EdgeTime {
  double travel = 0.0;    ///< at the velocity limits alone [s]
  double duration = 0.0;  ///< with the acceleration limits [s]
};
EdgeTime edge_time(const Configuration& a, const Configuration& b, const Limits& limits);

}  // namespace handey::motion
