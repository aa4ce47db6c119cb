// Does the hand, closed on a part, hit something in all poses near one? Solids inside the hand
// against solids inside what stands near the part: where they overlap deeper than any of the poses
// lets them move, every pose is a collision, whatever the arm does. What is called blocked is; not
// that the rest is free.
#pragma once

#include <optional>
#include <vector>

#include "handey/collision/overlap_proof.hpp"
#include "handey/collision/solids.hpp"

namespace handey {

/// How far hand poses leave the one in their middle, in the grasp plane.
struct HandMotion {
  double shift = 0.0;      ///< of the grasp frame's origin [m]
  double half_turn = 0.0;  ///< about it [rad]

  double chord() const;
  /// Of a point of the hand so far from the origin [m].
  double of(double distance) const { return shift + chord() * distance; }
};

/// What blocks hand poses: indices of names, see HandSolids.
struct HandBlock {
  int mover = 0, other = 0;
};

/// The hand closed to a width, against all that stands near the part at one place.
class HandSolids {
 public:
  /// @param checker  of the part at its place, the fingers closed on it
  /// @param near     solids whose centre ball does not come so near to it are left out: a ball
  ///                 that holds the hand wherever it grasps the part, in R
  HandSolids(CollisionChecker& checker, const Eigen::Vector3d& centre, double radius);

  void set_width(double width);
  /// The pair that overlaps for all poses within the motion.
  /// @param turn_axis  normal of the grasp plane, in R
  std::optional<HandBlock> blocking(const Pose& X_RH, const Eigen::Vector3d& turn_axis,
                                    const HandMotion& motion);
  /// A link of the arm that is so deep in an obstacle that a shift by `depth` would not free it.
  std::optional<HandBlock> deep_in_arm(const Configuration& closed, double depth);

  const std::string& mover_name(int mover) const;
  const std::string& other_name(int other) const;
  /// Of the hand from the origin of the grasp frame, at any opening [m].
  static double extent(const Robot& robot);

 private:
  struct Piece {
    int mover = 0;
    bool finger = false;
    const InnerSolid* solid = nullptr;
    Pose X_HM = Pose::Identity();
  };
  struct Target {
    int obstacle = 0;
    const InnerSolid* solid = nullptr;
  };
  void add_base();
  bool blocks(const Piece& piece, const Target& target, const Pose& X_RM,
              const RelativeMotion& motion, double shift) const;

  const Robot& robot_;
  SolidScene scene_;
  std::vector<Piece> pieces_;    ///< of the hand
  std::vector<Piece> links_;     ///< of the arm; X_HM: in its body
  std::vector<Target> targets_;  ///< near the hand
  std::vector<Target> all_;
  std::pair<std::size_t, std::size_t> last_{0, 0}, last_link_{0, 0};
  std::vector<Pose> X_RB_;
};

}  // namespace handey
