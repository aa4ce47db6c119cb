// The arm behind a hand that slides in a grasp plane: which configuration takes the hand to a
// planar pose, near the one before and in the same branch, and whether the whole robot is free
// there, with what it holds.
#pragma once

#include <optional>
#include <string>

#include "handey/collision/checker.hpp"
#include "handey/grasp/features.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

class HandReach {
 public:
  /// @param checker  of the cell, with what is held; used as long as this lives
  /// @param X_WG  grasp plane in the world
  /// @param clearance  of the whole robot [m]
  HandReach(const SphericalWristSolver& solver, CollisionChecker& checker, const Pose& X_WG,
            bool flipped, double opening, double clearance);

  /// The configuration at `pose` next to `q`, whether free or not; none if the arm cannot follow
  /// (see reason()).
  std::optional<Eigen::VectorXd> follow(const PlanarPose& pose, const Eigen::VectorXd& q);
  /// The same, but none either where the robot is not free.
  std::optional<Eigen::VectorXd> follow_free(const PlanarPose& pose, const Eigen::VectorXd& q);
  /// Is the whole robot free there?
  bool is_free(const Eigen::VectorXd& q);
  /// The configuration at `to`, the hand led there from `from` in a straight line, not asking what
  /// is in the way.
  std::optional<Eigen::VectorXd> lead(const PlanarPose& from, const PlanarPose& to,
                                      const Eigen::VectorXd& q_from);

  Pose hand_in_robot(const PlanarPose& pose) const;
  Configuration with_opening(const Eigen::VectorXd& q) const { return {q, opening_}; }
  CollisionChecker& checker() { return checker_; }
  /// Why the last answer was none, with names.
  const std::string& reason() const { return reason_; }

 private:
  const SphericalWristSolver& solver_;
  CollisionChecker& checker_;
  Pose X_RG_;
  bool flipped_;
  double opening_, clearance_;
  std::string reason_;
};

/// From `from` to `to` in `steps` equal steps, `from` left out, turning the shorter way.
std::vector<PlanarPose> planar_line(const PlanarPose& from, const PlanarPose& to, int steps);

}  // namespace handey
