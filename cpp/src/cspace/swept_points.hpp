// Points that a joint turns through a range: points whose hull contains all their ways. Parts of an
// arc are contained in triangles of their ends and the point where the tangents there meet.
#pragma once

#include <vector>

#include "handey/kinematics/arm.hpp"

namespace handey::cspace {

/// @param points in the body that joint `depth` moves
/// @param lower, upper of the joints after the third [rad]
/// @return in the body that joint `from` (3 to depth) moves
std::vector<Eigen::Vector3d> sweep_points(const Robot& robot, int from, int depth,
                                          const Eigen::VectorXd& lower,
                                          const Eigen::VectorXd& upper,
                                          std::vector<Eigen::Vector3d> points);

/// How many points one becomes.
std::size_t sweep_growth(int from, int depth, const Eigen::VectorXd& lower,
                         const Eigen::VectorXd& upper);

}  // namespace handey::cspace
