// What stands in the way of a hand pose at one end of a pick-and-place: all of it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "handey/grasp/diagnosis.hpp"

namespace handey::grasp {

/// One of the things in the way.
struct InTheWay {
  FallKind kind = FallKind::Collision;
  GraspEnd end = GraspEnd::Both;
  int joint = -1;
  std::string body;
  std::string mover;     // the first that met it; of two links of the robot it tells them apart
  double amount = -1.0;  // [m], [rad]; -1: a depth, not looked at
};

/// All of it at one end, for the inverse solution that has least.
struct EndResult {
  bool meets_part = false;  ///< the hand meets the part itself: this is no grasp of it
  std::vector<InTheWay> obstacles;
  Eigen::VectorXd q;  ///< of the solution; empty out of reach
};

/// One worker per end.
class EndObstacles {
 public:
  /// @param unlimited  inverse kinematics of the same arm without joint limits
  EndObstacles(const GraspScene& scene, GraspEnd end, const SphericalWristSolver& unlimited,
               const LegalityOptions& options);

  /// The hand alone, at X_PH, open and closed.
  EndResult hand(const Pose& X_PH, double opening, double width);
  /// Adds what the arm meets that brings the hand there.
  void add_arm(const Pose& X_PH, double opening, EndResult& result);
  /// Does the part stand on it?
  bool carries(const std::string& body) const { return supports_.count(body) != 0; }
  /// How deep hand or arm are in a body [m].
  double depth(const Pose& X_PH, double opening, const Eigen::VectorXd& q, const std::string& body);

 private:
  void add_hits(const std::vector<Hit>& hits, EndResult& result) const;
  std::vector<InTheWay> limits(Eigen::VectorXd& q) const;

  const Robot& robot_;
  const SphericalWristSolver& unlimited_;
  GraspEnd end_;
  double clearance_;
  std::string part_, hand_;
  std::set<std::string> links_;
  Pose X_RP_;
  CollisionChecker free_hand_, closed_hand_;
  std::set<std::string> supports_;
};

}  // namespace handey::grasp
