// Claims about sampling: what it finds is free and ends where it should, the same request gives the
// same path whatever went before, and a search that fails says so within its budget.
#include "handey/motion/sampling.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "planar_scene.hpp"

namespace handey {
namespace {

using namespace test;

SamplingOptions seeded(std::uint64_t seed) {
  SamplingOptions options;
  options.seed = seed;
  return options;
}

TEST(Sampling, FindsAWayRoundAPost) {
  CollisionChecker checker = checker_of(cell_with_post());
  ASSERT_FALSE(certify_edge(checker, below_post(), above_post()).is_free());
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const MotionResult result =
        plan_by_sampling(checker, below_post(), {above_post()}, seeded(seed));
    ASSERT_TRUE(result.found()) << result.reason;
    EXPECT_EQ(result.planner, "RRT-Connect");
    EXPECT_EQ(result.goal, 0);
    EXPECT_GT(result.iterations, 0);
    EXPECT_EQ(result.path.front().q, below_post().q);
    EXPECT_EQ(result.path.back().q, above_post().q);
    EXPECT_TRUE(certify_path(checker, result.path).is_free());
    expect_free(checker, result.path);
    for (const Configuration& row : result.path) {
      EXPECT_EQ(row.opening, 0.04);
      EXPECT_EQ(limit_violation(*checker.cell().robot, row.q), "");
    }
  }
}

TEST(Sampling, SameRequestGivesTheSamePathInAnyOrder) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult first = plan_by_sampling(checker, below_post(), {above_post()}, seeded(1));
  const MotionResult second = plan_by_sampling(checker, above_post(), {below_post()}, seeded(2));
  const MotionResult second_again =
      plan_by_sampling(checker, above_post(), {below_post()}, seeded(2));
  CollisionChecker fresh = checker_of(cell_with_post());
  const MotionResult first_again = plan_by_sampling(fresh, below_post(), {above_post()}, seeded(1));
  ASSERT_TRUE(first.found() && second.found());
  expect_equal(first.path, first_again.path);
  expect_equal(second.path, second_again.path);
  EXPECT_EQ(first.iterations, first_again.iterations);
  EXPECT_EQ(second.iterations, second_again.iterations);
}

TEST(Sampling, TheSeedMatters) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult one = plan_by_sampling(checker, below_post(), {above_post()}, seeded(1));
  const MotionResult two = plan_by_sampling(checker, below_post(), {above_post()}, seeded(2));
  ASSERT_TRUE(one.found() && two.found());
  bool same = one.path.size() == two.path.size();
  for (std::size_t k = 0; same && k < one.path.size(); ++k) same = one.path[k].q == two.path[k].q;
  EXPECT_FALSE(same);
}

// A slot between two walls, closed at both ends: the arm in it cannot get out.
Cell cell_with_cage() {
  return planar_cell(
      {wall("left", {0.9, 0.02}, 0.5, 0.08), wall("right", {0.9, 0.02}, 0.5, -0.08)});
}

TEST(Sampling, StopsAtTheIterationLimitWhereThereIsNoWay) {
  CollisionChecker checker = checker_of(cell_with_cage());
  SamplingOptions options;
  options.max_iterations = 150;
  const MotionResult result =
      plan_by_sampling(checker, configuration(0, 0, 0), {configuration(1.5, 0, 0)}, options);
  EXPECT_EQ(result.status, MotionStatus::IterationLimit);
  EXPECT_EQ(result.iterations, 150);
  EXPECT_TRUE(result.path.empty());
  EXPECT_EQ(result.goal, -1);
  EXPECT_NE(result.reason.find("150"), std::string::npos);
}

TEST(Sampling, NamesWhatBlocksTheStart) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult result = plan_by_sampling(checker, configuration(0, 0, 0), {above_post()});
  EXPECT_EQ(result.status, MotionStatus::StartBlocked);
  EXPECT_NE(result.reason.find("forearm"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("post"), std::string::npos) << result.reason;
}

TEST(Sampling, LeavesBlockedGoalsOutAndSaysWhyWhenAllAre) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Configuration blocked = configuration(0.05, 0, 0);
  const MotionResult one = plan_by_sampling(checker, below_post(), {blocked, above_post()});
  ASSERT_TRUE(one.found()) << one.reason;
  EXPECT_EQ(one.goal, 1);
  const MotionResult none = plan_by_sampling(checker, below_post(), {blocked, blocked});
  EXPECT_EQ(none.status, MotionStatus::GoalsBlocked);
  EXPECT_NE(none.reason.find("goal 1"), std::string::npos) << none.reason;
  EXPECT_NE(none.reason.find("post"), std::string::npos) << none.reason;
}

TEST(Sampling, ReachesAGoalOfAContinuousJointBeyondTwoTurns) {
  Cell cell = cell_with_post();
  auto robot = std::make_shared<Robot>(*cell.robot);
  robot->joints[2].limit.lower = -std::numeric_limits<double>::infinity();
  robot->joints[2].limit.upper = std::numeric_limits<double>::infinity();
  robot->ignored_pairs = {{1, 3}, {1, 4}, {1, 5}, {2, 4}, {2, 5}};
  cell.robot = robot;
  CollisionChecker checker = checker_of(cell);
  // Folded back, the arm is clear of the post on both sides, so the hand can turn.
  const MotionResult result =
      plan_by_sampling(checker, configuration(-1.5, 0, 0), {configuration(-1.5, 0, 13.0)});
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.path.back().q(2), 13.0);
}

TEST(Sampling, PrintsNothing) {
  CollisionChecker checker = checker_of(cell_with_post());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  plan_by_sampling(checker, below_post(), {above_post()});
  SamplingOptions little;
  little.max_iterations = 1;
  plan_by_sampling(checker, below_post(), {above_post()}, little);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Sampling, RefusesWrongInput) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Configuration start = below_post(), goal = above_post();
  const double nan = std::nan("");
  const auto code = [&](const Configuration& from, const std::vector<Configuration>& to,
                        const SamplingOptions& options = {}) {
    return code_of([&] { plan_by_sampling(checker, from, to, options); });
  };
  EXPECT_EQ(code(start, {}), "E_EMPTY");
  EXPECT_EQ(code({Eigen::Vector2d(0.1, 0.2), 0.04}, {goal}), "E_DOF");
  EXPECT_EQ(code(start, {goal, {Eigen::Vector2d(0.1, 0.2), 0.04}}), "E_DOF");
  EXPECT_EQ(code(configuration(nan, 0, 0), {goal}), "E_NUMBER");
  EXPECT_EQ(code(start, {configuration(1, 0, 0, nan)}), "E_NUMBER");
  EXPECT_EQ(code(start, {configuration(2.6, 0, 0)}), "E_LIMIT");
  EXPECT_EQ(code(configuration(-1, 0, 0, 0.07), {goal}), "E_LIMIT");
  EXPECT_EQ(code(start, {configuration(1, 0, 0, 0.05)}), "E_RANGE");
  SamplingOptions options;
  options.max_iterations = 0;
  EXPECT_EQ(code(start, {goal}, options), "E_RANGE");
  options = {};
  options.range = nan;
  EXPECT_EQ(code(start, {goal}, options), "E_RANGE");
}

}  // namespace
}  // namespace handey
