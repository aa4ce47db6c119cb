// One cell of hand poses on a feature pair: is every pose of it blocked, and by what?
#pragma once

#include <optional>
#include <vector>

#include "handey/collision/solids.hpp"
#include "handey/cspace/exhaustion.hpp"
#include "overlap_proof.hpp"

namespace handey::cspace {

/// Hand poses within (half, half, half_turn) of the middle, in the grasp plane.
struct HandCell {
  PlanarPose middle;
  int level = 0;  ///< half as wide as a cell of the level before
};

/// How far the poses of a cell leave its middle.
struct CellMotion {
  double shift = 0.0;      ///< of the grasp frame's origin [m]
  double half_turn = 0.0;  ///< about it [rad]

  double chord() const;
  /// Of a point of the hand so far from the origin [m].
  double of(double distance) const { return shift + chord() * distance; }
};

/// What blocks a cell: indices of names, see HandSolids.
struct Blocked {
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
  /// The pair that overlaps for all poses of the cell.
  std::optional<Blocked> blocking(const Pose& X_RH, const Eigen::Vector3d& turn_axis,
                                  const CellMotion& motion);
  /// A link of the arm that is so deep in an obstacle that a shift by `depth` would not free it.
  std::optional<Blocked> deep_in_arm(const Configuration& closed, double depth);

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

}  // namespace handey::cspace
