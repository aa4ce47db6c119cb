// Tests of single hand poses at both ends of a pick-and-place.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "handey/grasp/blocked_poses.hpp"
#include "handey/grasp/legality.hpp"

namespace handey::grasp {

/// What candidates that fell are counted by, in the order of the tests.
struct FallKey {
  FallKind kind = FallKind::Collision;
  GraspEnd end = GraspEnd::Both;
  int joint = -1;
  std::string mover, body;
  bool operator<(const FallKey& other) const;
};

/// Counts why candidates fell.
class Tally {
 public:
  /// @param text  how it reads  @param least  by how much it missed: text and pose of the least are
  /// kept, or the first if that is not known
  void add(const FallKey& key, const GraspPose& pose, const std::string& text,
           std::optional<double> least = std::nullopt, int count = 1);
  /// Most frequent first.
  std::vector<Fallen> list() const;
  /// "text (end): 14 of 48" for what is met most often among the candidates that got farthest,
  /// because that is what stands in the way; empty if none fell.
  std::string worst(int tried) const;

 private:
  std::map<FallKey, Fallen> fallen_;
};

enum class PoseVerdict {
  Legal,
  UnreachableAtOrigin,
  UnreachableAtDestination,
  CollidesAtOrigin,
  CollidesAtDestination
};

/// One worker per scene: keeps a checker for each end, hand free and closed on the part.
class PoseTester {
 public:
  PoseTester(const GraspScene& scene, const SphericalWristSolver& solver,
             const LegalityOptions& options);

  /// Fills X_PH, width, opening, q_pick, q_place of `pose` (in_plane and flipped are given); merit
  /// gets the joint margin's share, 0..0.2.
  PoseVerdict test(const FeaturePair& pair, GraspPose& pose, Tally& tally);
  /// Counts a pose of which X_PH and width are known, and that it is illegal.
  PoseVerdict add_blocked(const PoseBlock& block, GraspPose& pose, Tally& tally) const;

 private:
  struct End {
    GraspEnd end;
    Pose X_RP;  // the part in the robot's frame
    CollisionChecker free_hand;
    CollisionChecker closed_hand;
  };
  struct Obstacle {
    Hit hit;
    bool of_hand = false;  // the hand itself: no other configuration of the same pose helps
    bool of_finger = false;
  };
  /// Of the solutions at an end.
  struct Free {
    std::vector<InverseSolution> solutions;  // the legal ones
    std::optional<Obstacle> obstacle;        // of the last that is not
    bool met_finger = false;                 // of any: a narrower opening may help
    std::size_t looked_at = 0;
    int branch = -1;  // of the last
    bool branch_is_free = false;
  };
  static End make_end(const GraspScene& scene, const Pose& X_WP, GraspEnd end);

  std::vector<InverseSolution> inverse(const End& end, const GraspPose& pose, Tally& tally) const;
  /// Goes on from the solutions looked at until `most` of them are legal.
  void find_free(End& end, const std::vector<InverseSolution>& solutions, const GraspPose& pose,
                 std::size_t most, Free& free);
  std::optional<Obstacle> first_obstacle(CollisionChecker& checker, const Eigen::VectorXd& q,
                                         double opening) const;
  double joint_margin(const InverseSolution& solution) const;
  double best_margin(const std::vector<InverseSolution>& solutions) const;
  std::vector<Eigen::VectorXd> soonest_first(const std::vector<InverseSolution>& solutions) const;
  std::vector<double> openings(double width) const;
  std::string display_name(const std::string& name) const;

  const GraspScene& scene_;
  const SphericalWristSolver& solver_;
  const LegalityOptions& options_;
  std::set<std::string> hand_links_, finger_links_, robot_links_;
  End origin_, destination_;
  GraspEnd fell_last_ = GraspEnd::Origin;
};

}  // namespace handey::grasp
