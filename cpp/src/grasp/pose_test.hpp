// Tests of single hand poses at both ends of a pick-and-place.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "handey/grasp/legality.hpp"

namespace handey::grasp {

/// The tests of a candidate in their order.
enum class Stage { Contact, Hold, ReachOrigin, ReachDestination, ClearOrigin, ClearDestination };

/// Counts why candidates fell.
class Tally {
 public:
  /// @param kind  what is counted together  @param text  how it reads  @param excess  the text of
  /// the least is kept
  void add(Stage stage, const std::string& kind, const std::string& text, double excess = 0.0);
  /// "text: 14 of 48" for the kind met most often among the candidates that got farthest, because
  /// that is what stands in the way; empty if none fell.
  std::string worst(int tried) const;

 private:
  struct Reason {
    int count = 0;
    std::string text;
    double excess = 0.0;
  };
  std::map<std::pair<Stage, std::string>, Reason> reasons_;
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

 private:
  struct End {
    const char* label;  // for reasons
    Pose X_RP;          // the part in the robot's frame
    CollisionChecker free_hand;
    CollisionChecker closed_hand;
  };
  struct Obstacle {
    Hit hit;
    bool of_hand = false;    // the hand itself: no other configuration of the same pose helps
    bool of_finger = false;  // a narrower opening may help
  };
  static End make_end(const GraspScene& scene, const Pose& X_WP, const char* label);

  std::vector<InverseSolution> inverse(const End& end, const Pose& X_PH, Tally& tally) const;
  /// The legal ones of `solutions`, or the obstacle of the last.
  std::vector<InverseSolution> collision_free(End& end,
                                              const std::vector<InverseSolution>& solutions,
                                              const GraspPose& pose,
                                              std::optional<Obstacle>& obstacle);
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
};

}  // namespace handey::grasp
