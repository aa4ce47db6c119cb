// Everything that a slice keeps the arm apart from, sorted by what of the arm it concerns.
#pragma once

#include <algorithm>
#include <vector>

#include "arm_table_impl.hpp"
#include "handey/collision/scene.hpp"

namespace handey::cspace {

/// Which of the arm's links are kept apart from something.
struct Concerns {
  bool waist_body = false, upper = false, lower = false, turning = false;
  /// By ball of the hand: the radius that holds what of the hand is; 0: none of it [m].
  std::vector<double> hand;

  double widest_hand() const {
    return hand.empty() ? 0.0 : *std::max_element(hand.begin(), hand.end());
  }
  bool operator==(const Concerns& other) const {
    return waist_body == other.waist_body && upper == other.upper && lower == other.lower &&
           turning == other.turning && hand == other.hand;
  }
};

/// A convex hull that stands still, in R, or in a body of the arm that is taken to stand still.
struct Standing {
  SceneHull hull;  ///< points sorted along the waist's axis
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< of the ball about the centre that holds it [m]
  Concerns concerns;
};

/// A ball of the hand as it lies in the arm's plane.
struct PlaneBall {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< at q2 = q3 = 0, about the elbow [m]
  double lateral = 0.0;                              ///< of the centre, along z of E [m]
  WristColumns columns;
};

struct SliceScene {
  std::vector<PlaneBall> balls;       ///< that hold the hand
  bool hand_keeps_clear = false;      ///< of the forearm and of itself, over the wrist's range
  int rings = 0;                      ///< as far as links and balls' centres come
  std::vector<Standing> standing;     ///< fixtures, parts, the robot's base; in R
  std::vector<Standing> waist;        ///< the body that joint 1 moves; in R at q1 = 0
  std::vector<Standing> upper_arm;    ///< the body that joint 2 moves; in R at q1 = q2 = 0
  std::vector<LinkGroup> waist_body;  ///< the body that joint 1 moves, as outlines in E
};

/// @param lower, upper of the joints after the third [rad]
/// @param clearance of the hand from the forearm and from itself [m]
SliceScene make_slice_scene(CollisionChecker& checker, const ArmTable::Impl& table,
                            const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                            double opening, double clearance);

}  // namespace handey::cspace
