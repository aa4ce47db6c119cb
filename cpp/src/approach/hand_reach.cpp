// Inverse kinematics and collision test of one planar pose after another.
#include "hand_reach.hpp"

#include <algorithm>
#include <cmath>

#include "handey/kinematics/path.hpp"
#include "reason.hpp"

namespace handey {

HandReach::HandReach(const SphericalWristSolver& solver, CollisionChecker& checker,
                     const Pose& X_WG, bool flipped, double opening, double clearance)
    : solver_(solver),
      checker_(checker),
      X_RG_(checker.cell().X_WR.inverse(Eigen::Isometry) * X_WG),
      flipped_(flipped),
      opening_(opening),
      clearance_(clearance) {}

Pose HandReach::hand_in_robot(const PlanarPose& pose) const {
  return X_RG_ * hand_in_plane(pose, flipped_);
}

std::optional<Eigen::VectorXd> HandReach::follow(const PlanarPose& pose, const Eigen::VectorXd& q) {
  HandPathResult arm = follow_hand_path(solver_, {hand_in_robot(pose)}, q);
  if (arm.path.empty()) {
    reason_ = "the arm cannot follow: " + arm.reason;
    return std::nullopt;
  }
  return arm.path.front();
}

std::optional<Eigen::VectorXd> HandReach::follow_free(const PlanarPose& pose,
                                                      const Eigen::VectorXd& q) {
  std::optional<Eigen::VectorXd> next = follow(pose, q);
  if (!next || !is_free(*next)) return std::nullopt;
  return next;
}

bool HandReach::is_free(const Eigen::VectorXd& q) {
  const std::optional<Hit> hit = checker_.find_hit(with_opening(q), clearance_);
  if (hit) reason_ = describe(*hit);
  return !hit;
}

std::optional<Eigen::VectorXd> HandReach::lead(const PlanarPose& from, const PlanarPose& to,
                                               const Eigen::VectorXd& q_from) {
  // Choice: a centimetre or 0.05 rad a step keeps the joints' steps well below the largest jump of
  // the hand path.
  const double steps = std::max(std::hypot(to.x - from.x, to.y - from.y) / 0.01,
                                std::abs(to.theta - from.theta) / 0.05);
  std::vector<Pose> line;
  for (const PlanarPose& pose : planar_line(from, to, static_cast<int>(std::ceil(steps)) + 1)) {
    line.push_back(hand_in_robot(pose));
  }
  HandPathResult arm = follow_hand_path(solver_, line, q_from);
  if (!arm.complete) {
    reason_ = "the arm cannot follow: " + arm.reason;
    return std::nullopt;
  }
  return arm.path.back();
}

std::vector<PlanarPose> planar_line(const PlanarPose& from, const PlanarPose& to, int steps) {
  const double turn = std::remainder(to.theta - from.theta, 2.0 * std::acos(-1.0));
  std::vector<PlanarPose> line;
  for (int i = 1; i < steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    line.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
                    from.theta + part * turn});
  }
  line.push_back(to);
  return line;
}

}  // namespace handey
