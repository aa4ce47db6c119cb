// Following a line of hand poses, and the three ways in which it ends.
#include "handey/kinematics/path.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"
#include "test_arms.hpp"

namespace handey {
namespace {

using namespace testing;

std::vector<Pose> line(const Pose& from, const Eigen::Vector3d& shift, int count) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    Pose pose = from;
    pose.translation() += shift * (static_cast<double>(i) / (count - 1));
    poses.push_back(pose);
  }
  return poses;
}

Eigen::VectorXd nominal() {
  Eigen::VectorXd q(6);
  q << 0.1, kPi / 4, -kPi * 0.95, 0.2, kPi / 4, 0.3;
  return q;
}

TEST(HandPath, FollowsAStraightLineOnOneBranch) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  const std::vector<Pose> poses = line(hand_pose(robot, nominal()), {0.0, 0.05, -0.1}, 40);
  const HandPathResult result = follow_hand_path(solver, poses, nominal());
  ASSERT_TRUE(result.complete) << result.reason;
  ASSERT_EQ(result.path.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(hand_pose(robot, result.path[i]).isApprox(poses[i], 1e-9));
    if (i > 0) EXPECT_LT((result.path[i] - result.path[i - 1]).cwiseAbs().maxCoeff(), 0.15);
  }
  EXPECT_LT((result.path.front() - nominal()).norm(), 1e-9);
}

TEST(HandPath, StopsAtTheBorderOfTheReachAndKeepsWhatItHas) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  const std::vector<Pose> poses = line(hand_pose(robot, nominal()), {1.0, 0.0, 0.0}, 400);
  const HandPathResult result = follow_hand_path(solver, poses, nominal());
  EXPECT_FALSE(result.complete);
  EXPECT_GT(result.path.size(), 10u);
  EXPECT_LT(result.path.size(), poses.size());
  EXPECT_EQ(result.reason.rfind("pose " + std::to_string(result.path.size()) + ": ", 0), 0u)
      << result.reason;
}

TEST(HandPath, StopsWhereAJointWouldJump) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  const std::vector<Pose> poses = line(hand_pose(robot, nominal()), {0.0, 0.0, -0.3}, 2);
  const HandPathResult result = follow_hand_path(solver, poses, nominal());
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.path.size(), 1u);
  EXPECT_NE(result.reason.find("jump"), std::string::npos) << result.reason;
}

TEST(HandPath, TurnsTheWristByJointSixAloneAtAWristSingularity) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << 0.1, 0.5, -2.0, 0.6, 0.0, 0.3;
  std::vector<Pose> poses;
  for (int i = 0; i < 20; ++i) {
    poses.push_back(hand_pose(robot, q) * turn_z(0.05 * i));
  }
  const HandPathResult result = follow_hand_path(solver, poses, q);
  ASSERT_TRUE(result.complete) << result.reason;
  EXPECT_NEAR(result.path.back()[3], 0.6, 1e-9);
  EXPECT_NEAR(result.path.back()[5], 0.3 + 0.05 * 19, 1e-9);
}

TEST(HandPath, PassesThroughAWristSingularityWithTheOtherJointsAtRest) {
  const Robot robot = puma();
  const SphericalWristSolver solver(robot);
  Eigen::VectorXd q(6);
  q << 0.1, 0.5, -2.0, 0.6, 0.5, 0.3;
  std::vector<Pose> poses;
  for (int i = 0; i <= 20; ++i) {
    Eigen::VectorXd along = q;
    along[4] = 0.5 - 0.05 * i;  // 0 at i = 10, to rounding
    poses.push_back(hand_pose(robot, along));
  }
  const HandPathResult result = follow_hand_path(solver, poses, q);
  ASSERT_TRUE(result.complete) << result.reason;
  EXPECT_NEAR(result.path.back()[3], 0.6, 1e-9);
  EXPECT_NEAR(result.path.back()[4], -0.5, 1e-9);
}

TEST(HandPath, OfNoPosesIsComplete) {
  const HandPathResult result = follow_hand_path(SphericalWristSolver(puma()), {}, nominal());
  EXPECT_TRUE(result.complete);
  EXPECT_TRUE(result.path.empty());
}

TEST(HandPath, RefusesAJumpThatIsNotPositive) {
  const SphericalWristSolver solver(puma());
  EXPECT_THROW(follow_hand_path(solver, {}, nominal(), {0.0}), InvalidInput);
  EXPECT_THROW(follow_hand_path(solver, {}, nominal(), {std::nan("")}), InvalidInput);
}

}  // namespace
}  // namespace handey
