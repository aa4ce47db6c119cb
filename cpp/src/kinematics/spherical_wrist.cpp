// The arm's motion from zero is a product of turns E1 .. E6 about its axes as they lie at zero. E4
// E5 E6 leave the wrist centre where it is, which gives joints 1 to 3 from its position alone:
//   joint 1  turns about the parallel axes 2 and 3 keep the coordinate along them
//   joint 3  a turn about axis 2 keeps the distance from it
//   joint 2  the angle that is left
// Joints 4 to 6 follow from the rotation that is left, joint 5 from the angle between axes 4 and 6.
// Square roots are taken of products of differences, not of 1 - cos^2, which loses half of the
// digits near 1.
#include "handey/kinematics/spherical_wrist.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "handey/errors.hpp"
#include "numbers.hpp"
#include "rotation.hpp"

namespace handey {

using kinematics::across;
using kinematics::angle_about;
using kinematics::number_text;
using kinematics::rotation_about;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMeetTolerance = 1e-6;  // of the wrist axes [m]
constexpr double kParallelTolerance =
    1e-5;                            // of axes 2 and 3: URDFs say 1.5708 for a right angle [rad]
constexpr double kRounding = 1e-11;  // deviations below need no refinement
constexpr double kClamp = 1e-12;     // relative: rounding at the border of the reach
constexpr double kSingular = 1e-9;   // margin below which two branches are one
constexpr double kLimitTolerance = 1e-9;  // [rad], as in limit_violation

struct Axes {
  Eigen::Matrix<double, 3, 6> directions, points;
  Pose X_RH_zero;
};

Axes axes_at_zero(const Robot& robot) {
  Axes axes;
  Pose X_RB = Pose::Identity();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const ArmJoint& joint = robot.joints[static_cast<std::size_t>(i)];
    X_RB = X_RB * joint.X_PJ;
    axes.directions.col(i) = (X_RB.linear() * joint.axis).normalized();
    axes.points.col(i) = X_RB.translation();
  }
  axes.X_RH_zero = X_RB * robot.gripper.X_BH;
  return axes;
}

/// The point nearest to the last three axes, least squares.
Eigen::Vector3d wrist_centre(const Axes& axes) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 3; i < 6; ++i) {
    const Eigen::Vector3d w = axes.directions.col(i);
    const Eigen::Matrix3d projector = Eigen::Matrix3d::Identity() - w * w.transpose();
    sum += projector;
    right += projector * axes.points.col(i);
  }
  return sum.inverse() * right;
}

double distance_from_axis(const Axes& axes, Eigen::Index i, const Eigen::Vector3d& point) {
  return across(axes.directions.col(i), point - axes.points.col(i)).norm();
}

double sine_between(const Axes& axes, Eigen::Index i, Eigen::Index j) {
  return axes.directions.col(i).cross(axes.directions.col(j)).norm();
}

/// What keeps the arm from being of this kind; empty if nothing does.
std::string objection(const Robot& robot) {
  if (robot.joints.size() != 6) {
    return "the arm has " + std::to_string(robot.joints.size()) + " joints; expected 6";
  }
  const Axes axes = axes_at_zero(robot);
  if (sine_between(axes, 1, 2) > kParallelTolerance) {
    return "axes 2 and 3 are " +
           number_text(std::asin(std::min(1.0, sine_between(axes, 1, 2))), 3) +
           " rad from parallel; expected parallel axes";
  }
  if (sine_between(axes, 0, 1) < 1e-3) return "axes 1 and 2 are parallel; expected them not to be";
  if (sine_between(axes, 3, 4) < 1e-3) return "axes 4 and 5 are parallel; expected them not to be";
  if (sine_between(axes, 4, 5) < 1e-3) return "axes 5 and 6 are parallel; expected them not to be";
  const Eigen::Vector3d centre = wrist_centre(axes);
  for (Eigen::Index i = 3; i < 6; ++i) {
    const double miss = distance_from_axis(axes, i, centre);
    if (miss > kMeetTolerance) {
      return "axis " + std::to_string(i + 1) + " misses the wrist's centre by " +
             number_text(miss, 3) + " m; expected axes 4, 5 and 6 to meet in a point";
    }
  }
  if (distance_from_axis(axes, 1, axes.points.col(2)) < 1e-3) return "axes 2 and 3 are one line";
  if (distance_from_axis(axes, 2, centre) < 1e-3) return "the wrist's centre lies on axis 3";
  return {};
}

/// The turn of `angle` that is nearest to `reference`.
double nearest_turn(double angle, double reference) {
  return angle + 2.0 * kPi * std::round((reference - angle) / (2.0 * kPi));
}

std::string reach_text(InverseStatus status, double excess) {
  const std::string distance = number_text(1e3 * excess, 3) + " mm";
  if (status == InverseStatus::InsideShoulderCylinder) {
    return "wrist centre " + distance + " inside the cylinder about axis 1 that it cannot enter";
  }
  if (status == InverseStatus::TooFar) return "wrist centre " + distance + " beyond reach";
  return "wrist centre " + distance + " too close to axis 2";
}

}  // namespace

struct SphericalWristSolver::Position {
  double q1, q2, q3;
  int branch;
  double shoulder, elbow;  // margins
};

struct SphericalWristSolver::Search {
  Pose motion;  // the hand's, from zero
  const Eigen::VectorXd* reference;
  InverseResult result;
  bool out_of_reach = false, out_of_limits = false;
  double least_miss = std::numeric_limits<double>::infinity();  // [m]
  InverseStatus miss = InverseStatus::TooFar;
  double least_excess = std::numeric_limits<double>::infinity();  // [rad]
  int joint = -1;

  double reference_of(Eigen::Index i) const { return reference ? (*reference)[i] : 0.0; }
  /// Are joints already so far past their limits that nothing can come of the others: there is a
  /// solution, or a branch that misses less?
  bool is_settled(double past_limit) const {
    return past_limit > 0.0 && (!result.solutions.empty() || past_limit >= least_excess);
  }
  void note_miss(InverseStatus status, double metres) {
    out_of_reach = true;
    if (metres >= least_miss) return;
    least_miss = metres;
    miss = status;
  }
};

bool SphericalWristSolver::is_supported(const Robot& robot) { return objection(robot).empty(); }

SphericalWristSolver::SphericalWristSolver(const Robot& robot) {
  const std::string why_not = objection(robot);
  if (!why_not.empty()) {
    throw InvalidInput("E_KINEMATICS", "robot '" + robot.name + "'",
                       why_not + " (needed for the closed-form inverse)");
  }
  const Axes axes = axes_at_zero(robot);
  directions_ = axes.directions;
  points_ = axes.points;
  X_HR_zero_ = axes.X_RH_zero.inverse();
  wrist_centre_ = wrist_centre(axes);
  for (const ArmJoint& joint : robot.joints) {
    names_.push_back(joint.name);
    limits_.push_back(joint.limit);
  }
  upper_arm_ = across(directions_.col(1), points_.col(2) - points_.col(1)).norm();
  forearm_ = across(directions_.col(2), wrist_centre_ - points_.col(2)).norm();
  right_angled_ = std::abs(directions_.col(3).dot(directions_.col(4))) < kClamp &&
                  std::abs(directions_.col(4).dot(directions_.col(5))) < kClamp;
  exact_ = sine_between(axes, 1, 2) < kRounding;
  for (Eigen::Index i = 3; i < 6; ++i) {
    exact_ = exact_ && distance_from_axis(axes, i, wrist_centre_) < kRounding;
  }
}

InverseResult SphericalWristSolver::solve(const Pose& X_RH,
                                          const Eigen::VectorXd* reference) const {
  require_rigid(X_RH, "X_RH");
  if (reference && (reference->size() != 6 || !reference->allFinite())) {
    throw InvalidInput(reference->size() != 6 ? "E_DOF" : "E_NUMBER", "reference",
                       "expected 6 finite joint values [rad]");
  }
  Search search;
  search.motion = X_RH * X_HR_zero_;
  search.reference = reference;
  solve_shoulder(search.motion * wrist_centre_, search);

  InverseResult& result = search.result;
  if (!result.solutions.empty()) {
    result.status = InverseStatus::Solved;
  } else if (search.out_of_limits) {
    result.status = InverseStatus::OutsideLimits;
    result.excess = search.least_excess;
    result.joint = search.joint;
    result.reason = names_[static_cast<std::size_t>(search.joint)] + " " +
                    number_text(search.least_excess, 3) + " rad past its limit";
  } else {
    result.status = search.miss;
    result.excess = search.least_miss;
    result.reason = reach_text(search.miss, search.least_miss);
  }
  return std::move(result);
}

WristReach SphericalWristSolver::wrist_reach() const {
  const Eigen::Vector3d w1 = directions_.col(0), w2 = directions_.col(1), w3 = directions_.col(2);
  const Eigen::Vector3d p1 = points_.col(0), p2 = points_.col(1), p3 = points_.col(2);
  // The point of axis 2 nearest to axis 1 goes round in a circle.
  const Eigen::Vector3d w2_across = across(w1, w2);
  const double along = across(w1, p1 - p2).dot(w2_across) / w2_across.squaredNorm();
  const Eigen::Vector3d shoulder = p2 + along * w2;
  WristReach reach;
  reach.axis = w1;
  reach.centre = p1 + w1 * w1.dot(shoulder - p1);
  reach.radius = across(w1, shoulder - p1).norm();
  // |R3(q3) u + m| is greatest where a cos q3 + b sin q3 is.
  const Eigen::Vector3d u = across(w3, wrist_centre_ - p3), m = across(w2, p3 - p2);
  const double a = m.dot(u), b = m.dot(w3.cross(u));
  const JointLimit& limit = limits_[2];
  double most = std::hypot(a, b);
  if (std::isfinite(limit.lower) && std::isfinite(limit.upper)) {
    const double crest = std::atan2(b, a);
    const double turn = crest + 2.0 * kPi * std::ceil((limit.lower - crest) / (2.0 * kPi));
    if (turn > limit.upper) {
      most = std::max(a * std::cos(limit.lower) + b * std::sin(limit.lower),
                      a * std::cos(limit.upper) + b * std::sin(limit.upper));
    }
  }
  const double across_axis =
      std::sqrt(std::max(0.0, u.squaredNorm() + m.squaredNorm() + 2.0 * most));
  reach.farthest = std::hypot(across_axis, w2.dot(wrist_centre_ - shoulder));
  reach.p_HC = X_HR_zero_ * wrist_centre_;
  return reach;
}

/// Past the nearer limit whatever the turn [rad]; 0 within, to rounding.
double SphericalWristSolver::past_limit_of(Eigen::Index i, double angle) const {
  const JointLimit& limit = limits_[static_cast<std::size_t>(i)];
  if (!std::isfinite(limit.lower) || !std::isfinite(limit.upper)) return 0.0;
  const double low = limit.lower - kLimitTolerance, high = limit.upper + kLimitTolerance;
  const double lowest = angle + 2.0 * kPi * std::ceil((low - angle) / (2.0 * kPi));
  if (lowest <= high) return 0.0;
  return std::min(lowest - limit.upper, limit.lower - (lowest - 2.0 * kPi));
}

void SphericalWristSolver::solve_shoulder(const Eigen::Vector3d& centre, Search& search) const {
  const Eigen::Vector3d w1 = directions_.col(0), w2 = directions_.col(1), p1 = points_.col(0);
  const Eigen::Vector3d v = centre - p1;
  // w2 . R1(-q1) v = w2 . (c0 - p1), that is A cos q1 + B sin q1 = C.
  const Eigen::Vector3d v_across = across(w1, v);
  const double a = w2.dot(v_across), b = -w2.dot(w1.cross(v));
  const double c = w2.dot(wrist_centre_ - p1) - w2.dot(w1) * w1.dot(v);
  const double h = std::hypot(a, b), sine = w1.cross(w2).norm();
  const double reach = upper_arm_ + forearm_;
  if (h < kClamp * reach && std::abs(c) < kClamp * reach) {  // on axis 1: any turn will do
    solve_elbow(search.reference_of(0), 0, 0.0, centre, search);
    return;
  }
  if (std::abs(c) > h * (1.0 + kClamp)) {
    search.note_miss(InverseStatus::InsideShoulderCylinder, (std::abs(c) - h) / sine);
    return;
  }
  const double root = std::sqrt(std::max(0.0, (h - c) * (h + c)));
  const double middle = std::atan2(b, a), half = std::atan2(root, c);
  const double margin = std::min(1.0, root / (sine * reach));
  solve_elbow(middle + half, 0, margin, centre, search);
  if (margin >= kSingular) solve_elbow(middle - half, 1, margin, centre, search);
}

void SphericalWristSolver::solve_elbow(double q1, int branch, double margin,
                                       const Eigen::Vector3d& centre, Search& search) const {
  const Eigen::Vector3d w1 = directions_.col(0), w2 = directions_.col(1), w3 = directions_.col(2);
  const Eigen::Vector3d p1 = points_.col(0), p2 = points_.col(1), p3 = points_.col(2);
  const Eigen::Vector3d target = rotation_about(w1, -q1) * (centre - p1) + (p1 - p2);
  const double d = across(w2, target).norm();
  const double far = upper_arm_ + forearm_, near = std::abs(upper_arm_ - forearm_);
  if (d > far * (1.0 + kClamp)) {
    search.note_miss(InverseStatus::TooFar, d - far);
    return;
  }
  if (d < near - far * kClamp) {
    search.note_miss(InverseStatus::TooClose, near - d);
    return;
  }
  // |R3(q3) u + m| = d, that is m . R3(q3) u = K with H = |m| |u|.
  const Eigen::Vector3d u = across(w3, wrist_centre_ - p3), m = across(w2, p3 - p2);
  const double a = m.dot(u), b = m.dot(w3.cross(u)), h = upper_arm_ * forearm_;
  const double h_minus_k = 0.5 * (far - d) * (far + d), h_plus_k = 0.5 * (d - near) * (d + near);
  const double root = std::sqrt(std::max(0.0, h_minus_k) * std::max(0.0, h_plus_k));
  const double middle = std::atan2(b, a), half = std::atan2(root, 0.5 * (h_plus_k - h_minus_k));
  const double elbow = std::min(1.0, root / h);
  for (int side = 0; side < (elbow < kSingular ? 1 : 2); ++side) {
    const double q3 = side == 0 ? middle + half : middle - half;
    const Eigen::Vector3d reached = rotation_about(w3, q3) * (wrist_centre_ - p3) + (p3 - p2);
    const bool on_axis = d < kSingular * far;
    const double q2 = on_axis ? search.reference_of(1) : angle_about(w2, reached, target);
    const double past_limit =
        std::max({past_limit_of(0, q1), past_limit_of(1, q2), past_limit_of(2, q3)});
    if (exact_ && search.is_settled(past_limit)) continue;
    solve_wrist({q1, q2, q3, branch + 2 * side, margin, elbow}, search);
  }
}

void SphericalWristSolver::solve_wrist(const Position& position, Search& search) const {
  const Eigen::Vector3d w4 = directions_.col(3), w5 = directions_.col(4), w6 = directions_.col(5);
  const Eigen::Matrix3d first_three = rotation_about(directions_.col(0), position.q1) *
                                      rotation_about(directions_.col(1), position.q2) *
                                      rotation_about(directions_.col(2), position.q3);
  const Eigen::Matrix3d left = first_three.transpose() * search.motion.linear();  // R4 R5 R6
  const Eigen::Vector3d z = left * w6;
  // w4 . R5(q5) w6 = w4 . z, that is A cos q5 + B sin q5 = C.
  const double a = w4.dot(across(w5, w6)), b = w4.dot(w5.cross(w6));
  const double c = w4.dot(z) - w4.dot(w5) * w5.dot(w6);
  const double h = std::hypot(a, b);
  if (std::abs(c) > h * (1.0 + 1e-9)) return;  // only a wrist without right angles
  const double root =
      right_angled_ ? w4.cross(z).norm() : std::sqrt(std::max(0.0, (h - c) * (h + c)));
  const double sine = w4.cross(z).norm();
  const bool singular = sine < kSingular;
  const double middle = std::atan2(b, a), half = std::atan2(root, c);
  for (int side = 0; side < (singular ? 1 : 2); ++side) {
    Vector6 q;
    q << position.q1, position.q2, position.q3, 0.0, side == 0 ? middle + half : middle - half, 0.0;
    const Eigen::Matrix3d R5 = rotation_about(w5, q[4]);
    q[3] = singular ? search.reference_of(3) : angle_about(w4, R5 * w6, z);
    const Eigen::Matrix3d last = (rotation_about(w4, q[3]) * R5).transpose() * left;
    q[5] = angle_about(w6, w5, last * w5);
    const SingularityMargin margin{position.shoulder, position.elbow, std::min(1.0, sine)};
    if (!exact_) q = refined(q, search.motion);
    add_wraps(q, position.branch + 4 * side, margin, search);
  }
}

void SphericalWristSolver::add_wraps(const Vector6& q, int branch, const SingularityMargin& margin,
                                     Search& search) const {
  Vector6 lowest;
  std::array<int, 6> turns;  // how many more full turns fit
  double worst = 0.0;
  int worst_joint = -1;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const JointLimit& limit = limits_[static_cast<std::size_t>(i)];
    const std::size_t at = static_cast<std::size_t>(i);
    turns[at] = 0;
    if (!std::isfinite(limit.lower) || !std::isfinite(limit.upper)) {
      lowest[i] =
          search.reference ? nearest_turn(q[i], search.reference_of(i)) : nearest_turn(q[i], 0.0);
      if (!search.reference && lowest[i] <= -kPi) lowest[i] += 2.0 * kPi;
      continue;
    }
    const double low = limit.lower - kLimitTolerance, high = limit.upper + kLimitTolerance;
    lowest[i] = q[i] + 2.0 * kPi * std::ceil((low - q[i]) / (2.0 * kPi));
    turns[at] = static_cast<int>(std::floor((high - lowest[i]) / (2.0 * kPi)));
    if (turns[at] >= 0) continue;
    const double past_limit = past_limit_of(i, q[i]);
    if (past_limit > worst) {
      worst = past_limit;
      worst_joint = static_cast<int>(i);
    }
  }
  if (worst_joint >= 0) {
    search.out_of_limits = true;
    if (worst < search.least_excess) {
      search.least_excess = worst;
      search.joint = worst_joint;
    }
    return;
  }
  std::array<int, 6> k{};
  for (bool more = true; more;) {
    InverseSolution solution{lowest, branch, margin};
    for (std::size_t i = 0; i < 6; ++i)
      solution.q[static_cast<Eigen::Index>(i)] += 2.0 * kPi * k[i];
    search.result.solutions.push_back(std::move(solution));
    more = false;
    for (std::size_t i = 6; i-- > 0;) {  // count up, the last joint fastest
      if (k[i] < turns[i]) {
        ++k[i];
        more = true;
        break;
      }
      k[i] = 0;
    }
  }
}

Vector6 SphericalWristSolver::refined(const Vector6& start, const Pose& motion) const {
  Vector6 q = start;
  for (int step = 0; step < 3; ++step) {
    Pose reached = Pose::Identity();
    Eigen::Matrix<double, 6, 6> jacobian;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Eigen::Vector3d w = reached.linear() * directions_.col(i);
      const Eigen::Vector3d p = reached * Eigen::Vector3d(points_.col(i));
      jacobian.col(i) << p.cross(w), w;
      const Eigen::Matrix3d turn = rotation_about(directions_.col(i), q[i]);
      const Eigen::Vector3d point = points_.col(i);
      Pose e = Pose::Identity();
      e.linear() = turn;
      e.translation() = point - turn * point;
      reached = reached * e;
    }
    // The twist, about the origin of R, that takes what is reached to what is wanted.
    const Pose rest = motion * reached.inverse();
    const Eigen::AngleAxisd turn(rest.linear());
    const Eigen::Vector3d omega = turn.angle() * turn.axis();
    Vector6 twist;
    twist << rest.translation() - 0.5 * omega.cross(rest.translation()), omega;
    const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(jacobian);
    const Vector6 change = lu.solve(twist);
    // Near a singularity the step may be wild; the closed form is then the better answer.
    if (!change.allFinite() || change.cwiseAbs().maxCoeff() > 1e-2) return q;
    q += change;
    if (change.cwiseAbs().maxCoeff() < 1e-13) break;
  }
  return q;
}

}  // namespace handey
