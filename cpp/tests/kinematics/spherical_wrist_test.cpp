// The closed-form inverse: round trips on three arms, the Puma's own formulas, wraps,
// singularities, refusals.
#include "handey/kinematics/spherical_wrist.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "handey/errors.hpp"
#include "test_arms.hpp"

namespace handey {
namespace {

using namespace testing;

double pose_error(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}
double nearest_distance(const InverseResult& result, const Eigen::VectorXd& q) {
  double least = 1e9;
  for (const InverseSolution& s : result.solutions) {
    least = std::min(least, (s.q - q).cwiseAbs().maxCoeff());
  }
  return least;
}
double least_margin(const SingularityMargin& margin) {
  return std::min({margin.shoulder, margin.elbow, margin.wrist});
}

void expect_round_trips(const Robot& robot, int count) {
  const SphericalWristSolver solver(robot);
  std::mt19937 random(7);
  int near_singular = 0;
  for (int n = 0; n < count; ++n) {
    const Eigen::VectorXd q = random_configuration(robot, random);
    const Pose X_RH = hand_pose(robot, q);
    const InverseResult result = solver.solve(X_RH);
    ASSERT_EQ(result.status, InverseStatus::Solved) << result.reason << "\n" << q.transpose();
    double margin = 1.0;
    for (const InverseSolution& s : result.solutions) {
      margin = std::min(margin, least_margin(s.margin));
      ASSERT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-9) << q.transpose();
      ASSERT_EQ(limit_violation(robot, s.q), "");
    }
    near_singular += margin < 1e-3;
    ASSERT_LT(nearest_distance(result, q), margin < 1e-3 ? 1e-6 : 1e-9) << q.transpose();
  }
  EXPECT_LT(near_singular, count / 50);
}

TEST(SphericalWrist, RecoversRandomConfigurationsOfThePuma) {
  expect_round_trips(puma(0.18), 100000);
}
TEST(SphericalWrist, RecoversRandomConfigurationsOfTheIrb120) {
  expect_round_trips(irb120(), 20000);
}
TEST(SphericalWrist, RecoversRandomConfigurationsOfAnOrthoParallelArm) {
  expect_round_trips(ortho_parallel(), 20000);
}

/// The Puma's eight solutions by its own formulas in DH parameters (no limits), normalised to (-pi,
/// pi].
std::vector<Eigen::VectorXd> puma_formulas(const Pose& X_RF) {
  const Eigen::Matrix3d R = X_RF.linear();
  const Eigen::Vector3d w = X_RF.translation() - 0.05625 * R.col(2);
  const double h = w.z() - kShoulderHeight, L = std::hypot(kA3, kD4), phi = std::atan2(kD4, kA3);
  std::vector<Eigen::VectorXd> all;
  for (int bits = 0; bits < 8; ++bits) {
    const double e1 = bits & 1 ? -1 : 1, e2 = bits & 2 ? -1 : 1, e3 = bits & 4 ? -1 : 1;
    const double rho = e1 * std::sqrt(w.x() * w.x() + w.y() * w.y() - kD3 * kD3);
    const double t1 = std::atan2(w.y(), w.x()) + std::atan2(kD3, rho);
    const double K = (rho * rho + h * h - kA2 * kA2 - kA3 * kA3 - kD4 * kD4) / (2 * kA2);
    const double t3 = -phi + e2 * std::atan2(std::sqrt((L - K) * (L + K)), K);
    const double t2 =
        std::atan2(h, rho) - std::atan2(kA3 * std::sin(t3) + kD4 * std::cos(t3),
                                        kA2 + kA3 * std::cos(t3) - kD4 * std::sin(t3));
    const double c1 = std::cos(t1), s1 = std::sin(t1), c = std::cos(t2 + t3), s = std::sin(t2 + t3);
    Eigen::Matrix3d R03;
    R03 << c1 * c, -s1, -c1 * s, s1 * c, c1, -s1 * s, s, 0, c;
    const Eigen::Matrix3d M = R03.transpose() * R;
    const double s5 = std::hypot(M(0, 2), M(1, 2));
    Eigen::VectorXd q(6);
    q << t1, t2, t3, std::atan2(-e3 * M(1, 2), -e3 * M(0, 2)), std::atan2(e3 * s5, M(2, 2)),
        std::atan2(-e3 * M(2, 1), e3 * M(2, 0));
    for (Eigen::Index i = 0; i < 6; ++i) q[i] = std::remainder(q[i], 2 * kPi);
    all.push_back(q);
  }
  return all;
}

TEST(SphericalWrist, FindsTheSameEightSolutionsAsThePumasFormulas) {
  const Robot robot = puma(0.05625, false);
  const SphericalWristSolver solver(robot);
  std::mt19937 random(11);
  for (int n = 0; n < 5000; ++n) {
    const Pose X_RH = hand_pose(robot, random_configuration(robot, random));
    const InverseResult result = solver.solve(X_RH);
    ASSERT_EQ(result.solutions.size(), 8u);
    std::set<int> branches;
    double margin = 1.0;
    for (const InverseSolution& s : result.solutions) {
      branches.insert(s.branch);
      margin = std::min(margin, least_margin(s.margin));
    }
    EXPECT_EQ(branches.size(), 8u);
    if (margin < 1e-3) continue;
    for (const Eigen::VectorXd& q : puma_formulas(X_RH)) {
      double least = 1e9;
      for (const InverseSolution& s : result.solutions) {
        double worst = 0.0;
        for (Eigen::Index i = 0; i < 6; ++i) {
          worst = std::max(worst, std::abs(std::remainder(s.q[i] - q[i], 2 * kPi)));
        }
        least = std::min(least, worst);
      }
      EXPECT_LT(least, 1e-9);
    }
  }
}

TEST(SphericalWrist, ReportsTheSingularityFactorsOfTheJacobian) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  std::mt19937 random(3);
  const double L = std::hypot(kA3, kD4), phi = std::atan2(kD4, kA3);
  for (int n = 0; n < 200; ++n) {
    const Eigen::VectorXd q = random_configuration(robot, random);
    const double rho =
        kA2 * std::cos(q[1]) + kA3 * std::cos(q[1] + q[2]) - kD4 * std::sin(q[1] + q[2]);
    const InverseResult result = solver.solve(hand_pose(robot, q));
    for (const InverseSolution& s : result.solutions) {
      if ((s.q - q).cwiseAbs().maxCoeff() > 1e-6) continue;
      EXPECT_NEAR(s.margin.shoulder, std::abs(rho) / (kA2 + L), 1e-8);
      EXPECT_NEAR(s.margin.elbow, std::abs(std::sin(q[2] + phi)), 1e-8);
      EXPECT_NEAR(s.margin.wrist, std::abs(std::sin(q[4])), 1e-8);
    }
  }
}

TEST(SphericalWrist, ReturnsEveryTurnOfJointSixWithinItsLimits) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << 0.2, 0.4, -2.0, 0.3, 0.7, degrees(200);
  const InverseResult result = solver.solve(hand_pose(robot, q));
  Eigen::VectorXd other = q;
  other[5] -= 2 * kPi;
  EXPECT_LT(nearest_distance(result, q), 1e-12);
  EXPECT_LT(nearest_distance(result, other), 1e-12);
  for (std::size_t i = 1; i < result.solutions.size(); ++i) {
    const InverseSolution &a = result.solutions[i - 1], &b = result.solutions[i];
    EXPECT_LE(a.branch, b.branch);
    if (a.branch == b.branch) EXPECT_LT(a.q[5], b.q[5]);
  }
}

TEST(SphericalWrist, KeepsConfigurationsExactlyAtTheirLimits) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << degrees(160), degrees(30), degrees(-100), degrees(170), degrees(-100), degrees(266);
  EXPECT_LT(nearest_distance(solver.solve(hand_pose(robot, q)), q), 1e-9);
}

TEST(SphericalWrist, TakesJointFourFromTheReferenceWhereAxesFourAndSixAreInLine) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6), reference(6);
  q << 0.1, 0.5, -2.0, 0.4, 0.0, 0.3;
  reference << 0.1, 0.5, -2.0, -0.8, 0.0, 1.5;
  const Pose X_RH = hand_pose(robot, q);
  const InverseResult result = solver.solve(X_RH, &reference);
  EXPECT_LT(nearest_distance(result, reference), 1e-9);
  Eigen::VectorXd plain = q;
  plain[3] = 0.0;
  plain[5] = 0.7;
  const InverseResult without = solver.solve(X_RH);
  EXPECT_LT(nearest_distance(without, plain), 1e-9);
  for (const InverseSolution& s : without.solutions) {
    if (std::abs(s.q[4]) < 1e-9) EXPECT_LT(s.margin.wrist, 1e-9);
    EXPECT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-9);
  }
}

TEST(SphericalWrist, SolvesTheStretchedArm) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << 0.3, 0.2, -std::atan2(kD4, kA3), 0.4, 0.5, 0.6;
  const Pose X_RH = hand_pose(robot, q);
  const InverseResult result = solver.solve(X_RH);
  ASSERT_EQ(result.status, InverseStatus::Solved) << result.reason;
  EXPECT_LT(nearest_distance(result, q), 1e-6);
  for (const InverseSolution& s : result.solutions) {
    EXPECT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-9);
    EXPECT_LT(s.margin.elbow, 1e-6);
  }
}

TEST(SphericalWrist, SolvesWhereTheShoulderBranchesMeet) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  const double t2 = kPi / 2,
               t3 = std::atan2(kA3, kD4) - kPi / 2;  // wrist centre above the shoulder
  Eigen::VectorXd q(6);
  q << 0.3, t2, t3, 0.4, 0.5, 0.6;
  const Pose X_RH = hand_pose(robot, q);
  const InverseResult result = solver.solve(X_RH);
  ASSERT_EQ(result.status, InverseStatus::Solved) << result.reason;
  for (const InverseSolution& s : result.solutions) {
    EXPECT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-8);
    EXPECT_LT(s.margin.shoulder, 1e-6);
  }
}

TEST(SphericalWrist, TakesJointOneFromTheReferenceWithTheWristOnAxisOne) {
  const Robot robot = irb120();  // no shoulder offset: the wrist centre can lie on axis 1
  const SphericalWristSolver solver(robot);
  const double length = std::hypot(0.07, 0.302);
  const Eigen::Vector3d wrist(0, 0, 0.29 + std::sqrt(0.27 * 0.27 + length * length));
  Pose X_RH = Pose(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const double reach = 0.072 + 0.12;
  X_RH.translation() = wrist + reach * X_RH.linear().col(2);
  Eigen::VectorXd reference = Eigen::VectorXd::Constant(6, 0.2);
  const InverseResult result = solver.solve(X_RH, &reference);
  ASSERT_EQ(result.status, InverseStatus::Solved) << result.reason;
  for (const InverseSolution& s : result.solutions) {
    EXPECT_EQ(s.q[0], 0.2);
    EXPECT_EQ(s.margin.shoulder, 0.0);
    EXPECT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-9);
  }
}

/// A hand pose with the wrist centre at `wrist`, the hand looking down.
Pose looking_down(const Eigen::Vector3d& wrist) {
  Pose pose = turn_x(kPi);
  pose.translation() = wrist + 0.05625 * pose.linear().col(2);
  return pose;
}

TEST(SphericalWrist, SaysHowFarBeyondReach) {
  const SphericalWristSolver solver(puma());
  const double reach = std::hypot(kA2 + std::hypot(kA3, kD4), 0.0);
  const InverseResult result = solver.solve(looking_down({reach + 0.1, -kD3, kShoulderHeight}));
  EXPECT_EQ(result.status, InverseStatus::TooFar);
  EXPECT_NEAR(result.excess, 0.1, 1e-9);
  EXPECT_EQ(result.reason, "wrist centre 100 mm beyond reach");
}

TEST(SphericalWrist, SaysHowFarInsideTheShoulderCylinder) {
  const SphericalWristSolver solver(puma());
  const InverseResult result = solver.solve(looking_down({0.05, 0.0, 1.0}));
  EXPECT_EQ(result.status, InverseStatus::InsideShoulderCylinder);
  EXPECT_NEAR(result.excess, kD3 - 0.05, 1e-9);
}

TEST(SphericalWrist, SaysWhenTooCloseToTheShoulder) {
  const SphericalWristSolver solver(irb120());
  Pose X_RH = turn_x(kPi);
  X_RH.translation() = Eigen::Vector3d(0.01, 0, 0.29) + 0.192 * X_RH.linear().col(2);
  const InverseResult result = solver.solve(X_RH);
  EXPECT_EQ(result.status, InverseStatus::TooClose);
  EXPECT_NEAR(result.excess, std::hypot(0.07, 0.302) - 0.27 - 0.01, 1e-9);
}

TEST(SphericalWrist, NamesTheJointThatIsPastItsLimit) {
  Robot robot = puma();
  const SphericalWristSolver free(robot);
  Eigen::VectorXd q(6);
  q << 0.2, 0.4, -2.0, 0.3, 0.7, 0.5;
  const Pose X_RH = hand_pose(robot, q);
  // Leave only the solution that has joint 5 past its limit by 0.2.
  for (std::size_t i = 0; i < 6; ++i) {
    robot.joints[i].limit.lower = q[static_cast<Eigen::Index>(i)] - 0.01;
    robot.joints[i].limit.upper = q[static_cast<Eigen::Index>(i)] + 0.01;
  }
  robot.joints[4].limit.lower = 0.2;
  robot.joints[4].limit.upper = 0.5;
  const InverseResult result = SphericalWristSolver(robot).solve(X_RH);
  EXPECT_EQ(result.status, InverseStatus::OutsideLimits);
  EXPECT_EQ(result.joint, 4);
  EXPECT_NEAR(result.excess, 0.2, 1e-9);
  EXPECT_EQ(result.reason, "joint5 0.2 rad past its limit");
}

TEST(SphericalWrist, TellsOfAllBranchesTheOneThatIsLeastPastItsLimits) {
  Robot robot = puma();
  for (ArmJoint& joint : robot.joints) {
    joint.limit.lower = -std::numeric_limits<double>::infinity();
    joint.limit.upper = std::numeric_limits<double>::infinity();
  }
  const SphericalWristSolver unlimited(robot);
  const double half[] = {0.5, 0.3, 0.6, 0.7, 0.4, 0.9};
  for (std::size_t i = 0; i < 6; ++i) {
    robot.joints[i].limit.lower = 0.2 - half[i];
    robot.joints[i].limit.upper = 0.2 + half[i];
  }
  const SphericalWristSolver solver(robot);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  int limited = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Eigen::VectorXd q(6);
    for (double& value : q) value = angle(random);
    const Pose X_RH = hand_pose(robot, q);
    double least = std::numeric_limits<double>::infinity();
    for (const InverseSolution& branch : unlimited.solve(X_RH).solutions) {
      double worst = 0.0;
      for (Eigen::Index i = 0; i < 6; ++i) {
        const double off = std::abs(std::remainder(branch.q[i] - 0.2, 2.0 * kPi));
        worst = std::max(worst, off - half[i]);
      }
      least = std::min(least, worst);
    }
    const InverseResult result = solver.solve(X_RH);
    EXPECT_EQ(result.solutions.empty(), least > 1e-9);
    if (!result.solutions.empty()) continue;
    ++limited;
    EXPECT_NEAR(result.excess, least, 1e-9);
  }
  EXPECT_GT(limited, 200);
}

TEST(SphericalWrist, GivesAContinuousJointTheTurnNearestToTheReference) {
  Robot robot = puma();
  robot.joints[5].limit.lower = -std::numeric_limits<double>::infinity();
  robot.joints[5].limit.upper = std::numeric_limits<double>::infinity();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << 0.2, 0.4, -2.0, 0.3, 0.7, 20.0;
  const Pose X_RH = hand_pose(robot, q);
  EXPECT_LT(nearest_distance(solver.solve(X_RH, &q), q), 1e-12);
  for (const InverseSolution& s : solver.solve(X_RH).solutions) {
    EXPECT_LE(std::abs(s.q[5]), kPi);
  }
}

TEST(SphericalWrist, StaysExactWithRoundedRightAngles) {
  Robot robot;  // a URDF that says 1.5708 has its axes off by 4e-6 rad
  robot.bodies.push_back({"base", {}, {}});
  Pose rest = Pose::Identity();
  for (int i = 0; i < 6; ++i) {
    add_joint(robot, rest, Eigen::Vector3d::UnitZ(), -kPi, kPi);
    const DhRow& row = kPumaTable[i];
    const double alpha = std::abs(row.alpha) > 1 ? std::copysign(1.5708, row.alpha) : 3e-6;
    rest = dh_rest({row.d, row.a, i == 5 ? 0.0 : alpha});
  }
  add_gripper(robot, translation(0, 0, 0.18));
  const SphericalWristSolver solver(robot);
  std::mt19937 random(5);
  int checked = 0;
  for (int n = 0; n < 2000; ++n) {
    const Eigen::VectorXd q = random_configuration(robot, random);
    const Pose X_RH = hand_pose(robot, q);
    for (const InverseSolution& s : solver.solve(X_RH).solutions) {
      if (least_margin(s.margin) < 1e-2) continue;
      ASSERT_LT(pose_error(hand_pose(robot, s.q), X_RH), 1e-9);
      ++checked;
    }
  }
  EXPECT_GT(checked, 10000);
}

TEST(SphericalWrist, RefusesArmsOfAnotherKindAndSaysWhy) {
  const auto reason = [](const Robot& robot) -> std::string {
    EXPECT_FALSE(SphericalWristSolver::is_supported(robot));
    try {
      SphericalWristSolver solver(robot);
    } catch (const InvalidInput& error) {
      EXPECT_EQ(error.faults().front().code, "E_KINEMATICS");
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(SphericalWristSolver::is_supported(puma()));
  Robot five = puma();
  five.joints.pop_back();
  EXPECT_NE(reason(five).find("5 joints"), std::string::npos);
  Robot skew = puma();
  skew.joints[2].X_PJ = skew.joints[2].X_PJ * turn_x(0.1);
  EXPECT_NE(reason(skew).find("axes 2 and 3"), std::string::npos);
  Robot offset = puma();
  offset.joints[5].X_PJ.translation() += Eigen::Vector3d(0.01, 0, 0);
  EXPECT_NE(reason(offset).find("wrist's centre"), std::string::npos);
}

TEST(SphericalWrist, RefusesPosesThatAreNotRigid) {
  const SphericalWristSolver solver(puma());
  Pose nan = Pose::Identity();
  nan.translation().x() = std::nan("");
  EXPECT_THROW(solver.solve(nan), InvalidInput);
  Pose stretched = Pose::Identity();
  stretched.linear() *= 1.01;
  EXPECT_THROW(solver.solve(stretched), InvalidInput);
  const Eigen::VectorXd shorter = Eigen::VectorXd::Zero(5);
  EXPECT_THROW(solver.solve(Pose::Identity(), &shorter), InvalidInput);
}

}  // namespace
}  // namespace handey
