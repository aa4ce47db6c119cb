// How far can a point of the robot move while the joints move a little to both sides of a
// configuration? Per joint: the greatest distance of the piece's box from the axis, taken where the
// robot stands, plus what the joints beyond can add to that distance meanwhile; times the joint's
// motion. A turn about an axis does not change the distance from it. An upper bound for every point
// of the piece at every moment, whatever the joints do in between, so long as each stays within its
// half motion of the middle.
#pragma once

#include <array>
#include <vector>

#include "checker_impl.hpp"

namespace handey::collision {

class MotionBounds {
 public:
  explicit MotionBounds(const CollisionChecker::Impl& checker);

  /// The configuration is where the checker's movers are placed now.
  /// @param half_turns how far each joint moves to either side [rad]; signs matter where the joints
  /// move `together`, as on a straight edge  @param half_slide how far a finger joint moves [m]
  void set(const Eigen::VectorXd& half_turns, double half_slide, bool together = false);

  /// Bound on the motion of a mover's piece away from where it is, relative to a body that `depth`
  /// arm joints move [m].
  double piece_motion(int mover, int piece, int depth = 0);
  /// The same of the whole mover.
  double mover_motion(int mover, int depth = 0);
  /// Bound on how much nearer the two pieces (or, with pieces -1, movers) can come [m].
  double approach(const PiecePair& pair);
  /// Bound on how much nearer the two pieces can come along a direction that does not move: the
  /// motion to first order along it, and a bound of all that is left [m].
  double approach_along(const PiecePair& pair, const Eigen::Vector3d& direction);

 private:
  struct Entry {
    unsigned stamp = 0;
    std::vector<double> beyond;    ///< [d]: motion by joints d, d+1, ... and the finger joint
    std::vector<double> distance;  ///< [j]: of any point from the axis, anywhere within the motion
    std::array<Eigen::Vector3d, 8> corners;  ///< of a piece's box
  };
  double piece_motion_along(int mover, int piece, int depth, const Eigen::Vector3d& direction);
  Entry& piece_entry(int mover, int piece);
  Entry& mover_entry(int mover);
  template <class Distance>
  void fill(Entry& entry, const Mover& mover, const Distance& distance_from_axis) const;

  const CollisionChecker::Impl& checker_;
  std::vector<std::vector<Entry>> pieces_;
  std::vector<Entry> movers_;
  std::vector<Eigen::Vector3d> axes_, points_;  ///< of the joints, in R
  Eigen::VectorXd half_turns_;
  double half_slide_ = 0.0;
  bool together_ = false;
  unsigned stamp_ = 0;
};

}  // namespace handey::collision
