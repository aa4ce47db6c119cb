// Claims about gross motion: straight where that is free, through slices where not, by sampling
// where these fail, nearest goal first, and why it fails.
#include "handey/motion/gross.hpp"

#include <gtest/gtest.h>

#include "handey/motion/timing.hpp"
#include "planar_scene.hpp"

namespace handey {
namespace {

using namespace test;

TEST(Gross, GoesStraightWhereThatIsFree) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Configuration goal = configuration(-2.0, 0.5, 0.3);
  const MotionResult result = plan_gross_motion(checker, below_post(), {goal});
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.planner, "straight");
  EXPECT_EQ(result.iterations, 0);
  expect_equal(result.path, {below_post(), goal});
}

TEST(Gross, StaysWhereTheStartIsAGoal) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult result =
      plan_gross_motion(checker, below_post(), {above_post(), below_post()});
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.goal, 1);
  expect_equal(result.path, {below_post(), below_post()});
}

TEST(Gross, TakesTheGoalNearestByTravelTime) {
  CollisionChecker checker = checker_of(planar_cell({}));
  // Joint 3 is three times as fast as joint 1.
  const MotionResult result = plan_gross_motion(
      checker, configuration(0, 0, 0),
      {configuration(0.6, 0, 0), configuration(0, 0, 1.5), configuration(0, 1.3, 0)});
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.goal, 1);
}

TEST(Gross, FoldsTheArmToPassAPost) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult result = plan_gross_motion(checker, below_post(), {above_post()});
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.planner, "slices");
  EXPECT_EQ(result.slices_reason, "");
  EXPECT_GE(result.path.size(), 3u);
  EXPECT_EQ(result.path.front().q, below_post().q);
  EXPECT_EQ(result.path.back().q, above_post().q);
  EXPECT_TRUE(certify_path(checker, result.path).is_free());
  expect_free(checker, result.path);
  // The rows that are driven lie on what was proved.
  const TimedPath timed = time_path(*checker.cell().robot, result.path);
  for (const Configuration& row : timed.configurations) EXPECT_TRUE(checker.is_free(row, 5e-5));
}

TEST(Gross, CarriesAPartClearOfWhatTheEmptyHandPasses) {
  // The post stands beyond the finger tips, within reach of a stick that points out of the hand.
  Cell cell = planar_cell({wall("post", {0.06, 0.06}, 0.95, 0.0)});
  Body stick;
  stick.name = "stick";
  stick.shapes = {Shape{Box{{0.02, 0.02, 0.30}}, Pose::Identity()}};
  stick.X_WB = at(-2.0, 0.0);
  cell.parts = {stick};
  const Configuration start = configuration(-1.0, 0, 0), goal = configuration(1.0, 0, 0);

  CollisionChecker empty = checker_of(cell);
  const MotionResult without = plan_gross_motion(empty, start, {goal});
  ASSERT_TRUE(without.found()) << without.reason;
  EXPECT_EQ(without.planner, "straight");

  CollisionChecker holding = checker_of(cell.with_held(0, at(0.0, 0.0, 0.14)));
  const MotionResult with = plan_gross_motion(holding, start, {goal});
  ASSERT_TRUE(with.found()) << with.reason;
  EXPECT_EQ(with.planner, "slices");
  expect_free(holding, with.path);
}

TEST(Gross, KeepsTheClearanceThatIsAskedForInSlicesToo) {
  CollisionChecker checker = checker_of(cell_with_post());
  GrossOptions options;
  options.sampling.certificate.clearance = 0.02;
  options.shortcut.certificate.clearance = 0.02;
  const MotionResult result = plan_gross_motion(checker, below_post(), {above_post()}, options);
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.planner, "slices");
  for (std::size_t k = 0; k + 1 < result.path.size(); ++k) {
    for (int i = 0; i <= 200; ++i) {
      const Configuration& a = result.path[k];
      const Configuration& b = result.path[k + 1];
      EXPECT_GE(checker.closest({a.q + i / 200.0 * (b.q - a.q), a.opening}).distance, 0.02 - 1e-7);
    }
  }
}

TEST(Gross, FallsBackToSamplingAndSaysWhy) {
  CollisionChecker checker = checker_of(cell_with_post());
  GrossOptions options;
  options.search.max_proofs = 0;
  const MotionResult result = plan_gross_motion(checker, below_post(), {above_post()}, options);
  ASSERT_TRUE(result.found()) << result.reason;
  EXPECT_EQ(result.planner, "RRT-Connect");
  EXPECT_EQ(result.slices_reason, "slices are switched off");
  EXPECT_TRUE(certify_path(checker, result.path).is_free());
}

TEST(Gross, ProvesThatThereIsNoWay) {
  CollisionChecker checker = checker_of(
      planar_cell({wall("left", {0.9, 0.02}, 0.5, 0.08), wall("right", {0.9, 0.02}, 0.5, -0.08)}));
  GrossOptions options;
  options.sampling.max_iterations = 60;
  const MotionResult result =
      plan_gross_motion(checker, configuration(0, 0, 0), {configuration(1.5, 0, 0)}, options);
  EXPECT_EQ(result.status, MotionStatus::Infeasible);
  EXPECT_NE(result.reason.find("left"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("8 degrees"), std::string::npos) << result.reason;
}

TEST(Gross, SaysWhatIsInTheWayWhenItFindsNoWay) {
  CollisionChecker checker = checker_of(
      planar_cell({wall("left", {0.9, 0.02}, 0.5, 0.08), wall("right", {0.9, 0.02}, 0.5, -0.08)}));
  GrossOptions options;
  options.sampling.max_iterations = 60;
  options.separation.most_cells = 1;
  const MotionResult result =
      plan_gross_motion(checker, configuration(0, 0, 0), {configuration(1.5, 0, 0)}, options);
  EXPECT_EQ(result.status, MotionStatus::IterationLimit);
  EXPECT_NE(result.reason.find("left"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("60"), std::string::npos) << result.reason;
  EXPECT_FALSE(result.slices_reason.empty());
}

TEST(Gross, ReportsBlockedEnds) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult start = plan_gross_motion(checker, configuration(0, 0, 0), {above_post()});
  EXPECT_EQ(start.status, MotionStatus::StartBlocked);
  EXPECT_NE(start.reason.find("post"), std::string::npos) << start.reason;
  const MotionResult goals = plan_gross_motion(checker, below_post(), {configuration(0, 0, 0)});
  EXPECT_EQ(goals.status, MotionStatus::GoalsBlocked);
  EXPECT_NE(goals.reason.find("post"), std::string::npos) << goals.reason;
}

TEST(Gross, SameSeedSameResult) {
  CollisionChecker checker = checker_of(cell_with_post());
  const MotionResult once = plan_gross_motion(checker, below_post(), {above_post()});
  plan_gross_motion(checker, above_post(), {below_post()});
  const MotionResult again = plan_gross_motion(checker, below_post(), {above_post()});
  expect_equal(once.path, again.path);
}

TEST(Gross, RefusesWrongInput) {
  CollisionChecker checker = checker_of(cell_with_post());
  EXPECT_EQ(code_of([&] { plan_gross_motion(checker, below_post(), {}); }), "E_EMPTY");
  EXPECT_EQ(code_of([&] {
              plan_gross_motion(checker, below_post(), {{Eigen::Vector2d(0, 0), 0.04}});
            }),
            "E_DOF");
}

}  // namespace
}  // namespace handey
