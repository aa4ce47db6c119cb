// Closed-form inverse kinematics of six-joint arms whose second and third axes are parallel and
// whose last three axes meet in a point (Puma, and the ortho-parallel arms of ABB, KUKA, Fanuc,
// Staubli). Each joint triple reduces to equations A cos q + B sin q = C in the arm's own axis
// lines, so no DH convention enters. Up to 8 branches; every wrap of a joint that has more than one
// turn is returned. Not guaranteed: accuracy better than 1e-9 within about 1e-3 rad of a
// singularity, which is reported.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "handey/kinematics/arm.hpp"

namespace handey {

/// How far from a singularity, 0 at it, at most 1.
struct SingularityMargin {
  double shoulder = 1.0;  ///< wrist centre on the cylinder where both arm branches merge
  double elbow = 1.0;     ///< arm stretched or folded
  double wrist = 1.0;     ///< axes 4 and 6 in line: |sin| of joint 5's angle from there
};

struct InverseSolution {
  Eigen::VectorXd q;  ///< within limits [rad]
  int branch = 0;     ///< 0..7: shoulder + 2 * elbow + 4 * wrist
  SingularityMargin margin;
};

enum class InverseStatus { Solved, InsideShoulderCylinder, TooFar, TooClose, OutsideLimits };

struct InverseResult {
  InverseStatus status = InverseStatus::TooFar;
  std::vector<InverseSolution> solutions;  ///< ordered by branch, then wraps ascending
  double excess = 0.0;  ///< how far out of reach [m], or past its limit the nearest branch's worst
                        ///< joint is [rad]
  int joint = -1;       ///< that joint, for OutsideLimits
  std::string reason;   ///< for people: "wrist centre 112 mm beyond reach", "joint5 0.20 rad past
                        ///< its limit"
};

/// The wrist centre stays within `farthest` of a circle about axis 1, whatever the joints do within
/// their limits. Necessary, not sufficient.
struct WristReach {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the circle, in R [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit, of joint 1, in R
  double radius = 0.0;                               ///< of the circle [m]
  double farthest = 0.0;                             ///< of the wrist centre from it [m]
  Eigen::Vector3d p_HC = Eigen::Vector3d::Zero();    ///< the wrist centre in the grasp frame [m]
};

class SphericalWristSolver {
 public:
  /// @throws InvalidInput (E_KINEMATICS) if the arm is not of this kind, saying which condition
  /// fails
  explicit SphericalWristSolver(const Robot& robot);

  /// All configurations that put the grasp frame at X_RH. At a wrist singularity (margin < 1e-9)
  /// joint 4 takes `reference`'s value (0 without one) and joint 6 follows. With a reference,
  /// continuous joints take the turn nearest to it; without one, the turn in (-pi, pi].
  InverseResult solve(const Pose& X_RH, const Eigen::VectorXd* reference = nullptr) const;

  /// How far the wrist centre comes, and where in the hand it is.
  WristReach wrist_reach() const;

  /// Does the arm belong to this kind?
  static bool is_supported(const Robot& robot);

 private:
  struct Position;  // joints 1 to 3 of one branch
  struct Search;    // what one solve collects

  double past_limit_of(Eigen::Index i, double angle) const;
  void solve_shoulder(const Eigen::Vector3d& centre, Search& search) const;
  void solve_elbow(double q1, int branch, double margin, const Eigen::Vector3d& centre,
                   Search& search) const;
  void solve_wrist(const Position& position, Search& search) const;
  void add_wraps(const Eigen::Matrix<double, 6, 1>& q, int branch, const SingularityMargin& margin,
                 Search& search) const;
  Eigen::Matrix<double, 6, 1> refined(const Eigen::Matrix<double, 6, 1>& q,
                                      const Pose& motion) const;

  // The arm at zero, in the robot frame R.
  Eigen::Matrix<double, 3, 6> directions_;  ///< unit vectors along the joint axes
  Eigen::Matrix<double, 3, 6> points_;      ///< a point on each axis [m]
  Eigen::Vector3d wrist_centre_;            ///< [m]
  Pose X_HR_zero_;
  std::vector<std::string> names_;
  std::vector<JointLimit> limits_;
  double upper_arm_ = 0.0;    ///< from axis 2 to axis 3 [m]
  double forearm_ = 0.0;      ///< from axis 3 to the wrist centre, across axis 3 [m]
  bool right_angled_ = true;  ///< axis 5 is perpendicular to axes 4 and 6, to rounding
  bool exact_ =
      true;  ///< the conditions hold to rounding; else solutions are refined by Newton steps
};

}  // namespace handey
