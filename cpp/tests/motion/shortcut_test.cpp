// Claims about shortening: same ends, every edge certified, never longer by either clock, the same
// every time.
#include "handey/motion/shortcut.hpp"

#include <gtest/gtest.h>

#include "handey/motion/sampling.hpp"
#include "handey/motion/timing.hpp"
#include "planar_scene.hpp"

namespace handey {
namespace {

using namespace test;

std::vector<Configuration> way_round_post(CollisionChecker& checker, std::uint64_t seed) {
  SamplingOptions options;
  options.seed = seed;
  options.range = 0.15;  // many waypoints
  const MotionResult result = plan_by_sampling(checker, below_post(), {above_post()}, options);
  EXPECT_TRUE(result.found()) << result.reason;
  return result.path;
}

TEST(Shortcut, ADetourInFreeSpaceBecomesOneEdge) {
  CollisionChecker checker = checker_of(planar_cell({}));
  const std::vector<Configuration> detour{configuration(0, 0, 0), configuration(1, 0.4, 0),
                                          configuration(1, 1, 0.3), configuration(0.2, 0.5, 0.5)};
  expect_equal(shorten_path(checker, detour), {detour.front(), detour.back()});
}

TEST(Shortcut, TheResultIsCertifiedAndNeverLonger) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Robot& robot = *checker.cell().robot;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const std::vector<Configuration> path = way_round_post(checker, seed);
    ShortcutOptions options;
    options.seed = seed;
    const std::vector<Configuration> shorter = shorten_path(checker, path, options);
    EXPECT_EQ(shorter.front().q, path.front().q);
    EXPECT_EQ(shorter.back().q, path.back().q);
    EXPECT_TRUE(certify_path(checker, shorter, options.certificate).is_free());
    expect_free(checker, shorter);
    EXPECT_LE(travel_time(robot, shorter), travel_time(robot, path) + 1e-9);
    EXPECT_LE(time_path(robot, shorter).duration(), time_path(robot, path).duration() + 1e-9);
    EXPECT_LE(shorter.size(), path.size());
  }
}

TEST(Shortcut, RandomCutsSaveTimeAfterWaypointsWereSkipped) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Robot& robot = *checker.cell().robot;
  double skipped_only = 0.0, with_cuts = 0.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const std::vector<Configuration> path = way_round_post(checker, seed);
    ShortcutOptions options;
    options.attempts = 0;
    skipped_only += time_path(robot, shorten_path(checker, path, options)).duration();
    options.attempts = 100;
    with_cuts += time_path(robot, shorten_path(checker, path, options)).duration();
  }
  EXPECT_LT(with_cuts, skipped_only);
}

TEST(Shortcut, SkippingKeepsWaypointsOfThePathOnly) {
  CollisionChecker checker = checker_of(cell_with_post());
  const std::vector<Configuration> path = way_round_post(checker, 3);
  ShortcutOptions options;
  options.attempts = 0;
  for (const Configuration& kept : shorten_path(checker, path, options)) {
    EXPECT_TRUE(std::any_of(path.begin(), path.end(),
                            [&](const Configuration& waypoint) { return waypoint.q == kept.q; }));
  }
}

TEST(Shortcut, SameSeedSameResult) {
  CollisionChecker checker = checker_of(cell_with_post());
  const std::vector<Configuration> path = way_round_post(checker, 4);
  const std::vector<Configuration> once = shorten_path(checker, path);
  shorten_path(checker, way_round_post(checker, 5));
  expect_equal(shorten_path(checker, path), once);
}

TEST(Shortcut, AnEdgeThatIsNotFreeIsNotHidden) {
  CollisionChecker checker = checker_of(cell_with_post());
  const std::vector<Configuration> through{below_post(), configuration(-0.9, 0.1, 0.0),
                                           configuration(0.9, -0.1, 0.0), above_post()};
  const std::vector<Configuration> shorter = shorten_path(checker, through);
  EXPECT_FALSE(certify_path(checker, shorter).is_free());
  EXPECT_EQ(shorter.front().q, through.front().q);
  EXPECT_EQ(shorter.back().q, through.back().q);
}

TEST(Shortcut, ShortPathsComeBackAsTheyAre) {
  CollisionChecker checker = checker_of(cell_with_post());
  expect_equal(shorten_path(checker, {below_post()}), {below_post()});
  expect_equal(shorten_path(checker, {below_post(), above_post()}), {below_post(), above_post()});
  expect_equal(shorten_path(checker, {below_post(), below_post(), below_post()}),
               {below_post(), below_post()});
}

TEST(Shortcut, RefusesWrongInput) {
  CollisionChecker checker = checker_of(cell_with_post());
  const auto code = [&](const std::vector<Configuration>& path, int attempts = 10) {
    ShortcutOptions options;
    options.attempts = attempts;
    return code_of([&] { shorten_path(checker, path, options); });
  };
  EXPECT_EQ(code({}), "E_EMPTY");
  EXPECT_EQ(code({below_post(), {Eigen::Vector2d(0, 0), 0.04}}), "E_DOF");
  EXPECT_EQ(code({configuration(0, 0, std::nan(""))}), "E_NUMBER");
  EXPECT_EQ(code({configuration(0, 0, 2.6)}), "E_LIMIT");
  EXPECT_EQ(code({below_post()}, -1), "E_RANGE");
}

}  // namespace
}  // namespace handey
