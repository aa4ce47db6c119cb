// Claims about shortening: same ends, every edge certified, never longer by either clock, the same
// every time, and a clearance kept where the path has it.
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

std::vector<Configuration> subdivided(const std::vector<Configuration>& path, int parts) {
  std::vector<Configuration> fine{path.front()};
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      fine.push_back({path[k].q + share * (path[k + 1].q - path[k].q), path[k].opening});
    }
  }
  return fine;
}

// Of 200 configurations per edge, from the share of the path's edges that is asked for on.
double least_distance(CollisionChecker& checker, const std::vector<Configuration>& path,
                      double from = 0.0) {
  double least = 0.1;
  const std::vector<Configuration> fine = subdivided(path, 200);
  for (std::size_t k = static_cast<std::size_t>(from * static_cast<double>(fine.size()));
       k < fine.size(); ++k) {
    least = std::min(least, checker.closest(fine[k]).distance);
  }
  return least;
}

// The arm folds before it passes the post and unfolds well behind it, one joint at a time: 20 mm or
// more from everything.
std::vector<Configuration> wide_way_round_post() {
  return subdivided({below_post(), configuration(-1.0, -2.45, 0.0), configuration(2.2, -2.45, 0.0),
                     configuration(2.2, -0.2, 0.0), above_post()},
                    12);
}

TEST(Shortcut, TheClearanceIsKeptWhereThereIsRoom) {
  CollisionChecker checker = checker_of(cell_with_post());
  const Robot& robot = *checker.cell().robot;
  const std::vector<Configuration> path = wide_way_round_post();
  ASSERT_GT(least_distance(checker, path), 0.02);
  for (const double clearance : {0.005, 0.01, 0.02}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      ShortcutOptions options;
      options.clearance = clearance;
      options.seed = seed;
      const std::vector<Configuration> shorter = shorten_path(checker, path, options);
      EXPECT_GE(least_distance(checker, shorter), clearance);
      EXPECT_LT(time_path(robot, shorter).duration(), 0.8 * time_path(robot, path).duration());
    }
  }
}

TEST(Shortcut, WithoutAClearanceThePathGrazes) {
  CollisionChecker checker = checker_of(cell_with_post());
  double least = 1.0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    ShortcutOptions options;
    options.clearance = 0.0;
    options.seed = seed;
    least = std::min(
        least, least_distance(checker, shorten_path(checker, wide_way_round_post(), options)));
  }
  EXPECT_LT(least, 0.005);
  EXPECT_GT(least, 0.0);
}

TEST(Shortcut, TheDistanceGrowsBackFromEndsThatAreNear) {
  // At the start a wall stands beside the forearm, along it, 1 mm away: on the left, while the
  // forearm folds to the right.
  const double direction = below_post().q(0) + below_post().q(1), upper_arm = below_post().q(0);
  const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
  const Eigen::Vector2d elbow(0.3 * std::cos(upper_arm), 0.3 * std::sin(upper_arm));
  const Eigen::Vector2d centre =
      elbow + 0.15 * along + (0.015 + 0.001 + 0.01) * Eigen::Vector2d(-along.y(), along.x());
  Body beside = wall("beside", {0.1, 0.02}, 0.0, 0.0);
  beside.X_WB = pose_from_xyz_rpy({centre.x(), centre.y(), 0.0}, {0.0, 0.0, direction});
  Cell cell = cell_with_post();
  cell.fixtures.push_back(beside);
  CollisionChecker checker = checker_of(cell);
  const std::vector<Configuration> path = wide_way_round_post();
  ASSERT_NEAR(checker.closest(path.front()).distance, 1e-3, 1e-6);
  ASSERT_GT(least_distance(checker, path, 0.1), 0.02);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    ShortcutOptions options;
    options.seed = seed;
    const std::vector<Configuration> shorter = shorten_path(checker, path, options);
    EXPECT_LE(shorter.size(), 5U);
    EXPECT_GE(least_distance(checker, shorter), 0.5e-3);
    EXPECT_GE(least_distance(checker, shorter, 0.1), options.clearance);
  }
}

TEST(Shortcut, APassageNarrowerThanTheClearanceIsStillShortened) {
  // Two walls 34 mm apart: the stretched arm, 30 mm wide, has 2 mm to either side.
  Cell cell = planar_cell(
      {wall("left", {0.3, 0.04}, 0.45, 0.037), wall("right", {0.3, 0.04}, 0.45, -0.037)});
  CollisionChecker checker = checker_of(cell);
  // Small turns that almost touch one wall, then the other.
  std::vector<Configuration> path{configuration(0, 0, 0)};
  for (int k = 1; k <= 20; ++k) {
    path.push_back(configuration(k % 2 ? 0.002 : -0.002, k % 2 ? -0.002 : 0.002, 1e-4 * k));
  }
  const double had = least_distance(checker, path);
  ASSERT_LT(had, 2e-3);
  ASSERT_GT(had, 2e-4);
  const std::vector<Configuration> shorter = shorten_path(checker, path);
  EXPECT_EQ(shorter.size(), 2U);
  EXPECT_GE(least_distance(checker, shorter), 0.5 * had);
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
  for (const double clearance : {-1e-3, std::nan(""), HUGE_VAL}) {
    ShortcutOptions options;
    options.clearance = clearance;
    EXPECT_EQ(code_of([&] { shorten_path(checker, {below_post()}, options); }), "E_RANGE");
  }
}

}  // namespace
}  // namespace handey
