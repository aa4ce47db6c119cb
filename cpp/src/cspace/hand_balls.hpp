// The hand over a range of the wrist as a few balls that the forearm carries: what each of the
// hand's pieces sweeps while the joints after the third turn through their ranges, pieces near each
// other in one ball. A wide range leaves one ball about the wrist, which holds the hand at all
// values. Errs on the large side: a ball holds all its pieces at every value of the range.
#pragma once

#include <vector>

#include "arm_links.hpp"

namespace handey::cspace {

/// A piece of the hand, fixed to the body that joint `depth` (3 or more) moves.
struct HandPiece {
  int mover = 0;
  int depth = 3;
  std::vector<Eigen::Vector3d> points;  ///< whose hull holds it, in that body [m]
};

struct HandBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the body that joint 3 moves [m]
  bool at_wrist = false;                             ///< the centre is the wrist
  std::vector<std::pair<int, double>> radii;  ///< by mover: of the ball that holds its pieces [m]
};

/// @param lower, upper of the joints after the third [rad]
std::vector<HandBall> hand_balls(const Robot& robot, const Eigen::Vector3d& wrist_in_body,
                                 const std::vector<HandPiece>& pieces, const Eigen::VectorXd& lower,
                                 const Eigen::VectorXd& upper);

}  // namespace handey::cspace
