// The axes of a six-joint arm as they lie at zero, and whether the closed-form inverse applies to
// them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "handey/kinematics/arm.hpp"

namespace handey::kinematics {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// In the robot frame R, at q = 0.
struct ArmAxes {
  Eigen::Matrix<double, 3, 6> directions;  ///< unit vectors
  Eigen::Matrix<double, 3, 6> points;      ///< a point on each axis [m]
  Pose X_RH_zero;                          ///< the hand
};

/// Only for an arm of six joints.
ArmAxes axes_at_zero(const Robot& robot);

/// The point nearest to the last three axes, least squares.
Eigen::Vector3d wrist_centre(const ArmAxes& axes);

/// What keeps the arm from having parallel axes 2 and 3 and a spherical wrist; empty if nothing
/// does.
std::string objection(const Robot& robot);

/// True if these conditions hold to rounding, not only to the tolerance that objection() allows.
bool is_exact(const ArmAxes& axes);

/// Newton steps from `start`, near a solution, to the joint values that move the hand by `motion`
/// from zero.
Vector6 refine(const ArmAxes& axes, const Vector6& start, const Pose& motion);

}  // namespace handey::kinematics
