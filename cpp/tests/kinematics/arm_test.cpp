// Forward kinematics against the DH product and by hand; what is refused.
#include "handey/kinematics/arm.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "handey/errors.hpp"
#include "test_arms.hpp"

namespace handey {
namespace {

using namespace testing;

std::string code_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.faults().front().code;
  }
  return "";
}

TEST(HandPose, EqualsTheDhProduct) {
  const Robot robot = puma();
  std::mt19937 random(1);
  for (int n = 0; n < 1000; ++n) {
    const Eigen::VectorXd q = random_configuration(robot, random);
    Pose expected = Pose::Identity();
    for (int i = 0; i < 6; ++i) expected = expected * turn_z(q[i]) * dh_rest(kPumaTable[i]);
    expected = expected * translation(0, 0, 0.05625);
    EXPECT_TRUE(hand_pose(robot, q).isApprox(expected, 1e-13));
  }
}

TEST(HandPose, PutsThePumasWristWhereThePublishedPosesPutIt) {
  const Robot robot = puma(0.0);
  const double half = kPi / 2;
  const struct {
    double q[6];
    Eigen::Vector3d wrist;
  } poses[] = {{{0, 0, 0, 0, 0, 0}, {0.4521, -0.15005, 1.10363}},
               {{0, half, -half, 0, 0, 0}, {0.0203, -0.15005, 1.53543}},
               {{0, 0, -half, 0, 0, 0}, {0.8636, -0.15005, 0.65153}}};
  for (const auto& pose : poses) {
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(pose.q, 6);
    EXPECT_LT((hand_pose(robot, q).translation() - pose.wrist).norm(), 1e-12);
  }
}

TEST(BodyPoses, PutEachFingerHalfTheOpeningFromTheMiddle) {
  const Robot robot = puma();
  const Configuration configuration{Eigen::VectorXd::Constant(6, 0.3), 0.08};
  const std::vector<Pose> poses = body_poses(robot, configuration);
  ASSERT_EQ(poses.size(), robot.bodies.size());
  const Pose X_RH = hand_pose(robot, configuration.q);
  EXPECT_LT((X_RH.inverse() * poses[7].translation() - Eigen::Vector3d(0, 0.04, 0)).norm(), 1e-15);
  EXPECT_LT((X_RH.inverse() * poses[8].translation() - Eigen::Vector3d(0, -0.04, 0)).norm(), 1e-15);
}

TEST(BodyPoses, OfTheHandsBodyCarryTheGraspFrame) {
  const Robot robot = irb120();
  std::mt19937 random(2);
  const Eigen::VectorXd q = random_configuration(robot, random);
  const std::vector<Pose> poses = body_poses(robot, {q, 0.0});
  const auto hand = static_cast<std::size_t>(robot.gripper.body);
  EXPECT_TRUE((poses[hand] * robot.gripper.X_BH).isApprox(hand_pose(robot, q), 1e-14));
}

TEST(BodyPoses, RefuseWrongNumbers) {
  const Robot robot = puma();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  EXPECT_EQ(code_of([&] { body_poses(robot, {Eigen::VectorXd::Zero(5), 0.0}); }), "E_DOF");
  EXPECT_EQ(code_of([&] { hand_pose(robot, Eigen::VectorXd::Zero(7)); }), "E_DOF");
  EXPECT_EQ(code_of([&] { body_poses(robot, {q, std::nan("")}); }), "E_NUMBER");
  q[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(code_of([&] { body_poses(robot, {q, 0.0}); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { limit_violation(robot, q); }), "E_NUMBER");
}

TEST(LimitViolation, NamesTheJointTheValueAndTheLimit) {
  const Robot robot = puma();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  EXPECT_EQ(limit_violation(robot, q), "");
  q[4] = 1.9;
  EXPECT_EQ(limit_violation(robot, q), "joint5 = 1.9 rad exceeds 1.74532925");
  q[4] = -1.9;
  EXPECT_EQ(limit_violation(robot, q), "joint5 = -1.9 rad is below -1.74532925");
}

TEST(LimitViolation, AllowsABillionthOfARadian) {
  const Robot robot = puma();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[4] = robot.joints[4].limit.upper + 0.9e-9;
  EXPECT_EQ(limit_violation(robot, q), "");
  q[4] = robot.joints[4].limit.upper + 1.1e-9;
  EXPECT_NE(limit_violation(robot, q), "");
}

}  // namespace
}  // namespace handey
