// Distances against brute force; widest ways by hand and against floods of what is wider.
#include "handey/approach/clearance_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>

#include "handey/approach/quasipotential.hpp"
#include "handey/errors.hpp"
#include "small_hand.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using testing::kCell;
using testing::rectangle;
using testing::small_hand;

MotionGrid grid_with(const std::vector<Region>& obstacles) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  for (const Region& region : obstacles) grid.fill(0, region);
  return grid;
}

TEST(DistanceTransform, AgreesWithEveryMarkedCellLookedAt) {
  std::mt19937 random(3);
  for (const double share : {0.0, 0.002, 0.05, 0.5}) {
    const int side = 37;
    std::vector<char> marked(side * side);
    std::bernoulli_distribution mark(share);
    for (char& m : marked) m = mark(random) ? 1 : 0;
    const std::vector<double> distance = distance_transform(marked, side);
    for (int a = 0; a < side * side; ++a) {
      double least = std::numeric_limits<double>::infinity();
      for (int b = 0; b < side * side; ++b) {
        if (marked[static_cast<std::size_t>(b)] == 0) continue;
        least = std::min(least, std::hypot(a % side - b % side, a / side - b / side));
      }
      const double found = distance[static_cast<std::size_t>(a)];
      if (std::isinf(least)) {
        EXPECT_TRUE(std::isinf(found));
      } else {
        EXPECT_NEAR(found, least, 1e-9);
      }
    }
  }
}

TEST(ClearancePath, GoesStraightOverOpenGround) {
  const ClearancePath path = clearance_path(grid_with({}), small_hand(), {0, 0, 0}, 0.1);
  ASSERT_TRUE(path.found());
  EXPECT_TRUE(path.whole_hand);
  EXPECT_DOUBLE_EQ(path.clearance, 0.02);  // more is worth nothing
  EXPECT_EQ(path.points.size(), 26u);
  EXPECT_EQ(path.points.back(), Vector2d(0, 0));
  EXPECT_NEAR(path.points.front().norm(), 0.1, 1e-9);
}

TEST(ClearancePath, TakesTheMiddleOfACorridor) {
  // 60 mm wide, for a hand of 30 mm, about y = 0.006.
  const MotionGrid grid =
      grid_with({rectangle(-0.2, 0.036, 0.06, 0.2), rectangle(-0.2, -0.2, 0.06, -0.024),
                 rectangle(0.05, -0.2, 0.2, 0.2)});
  const ClearancePath path = clearance_path(grid, small_hand(), {0, 0.006, 0}, 0.1);
  ASSERT_TRUE(path.found());
  for (const Vector2d& point : path.points) EXPECT_NEAR(point.y(), 0.006, kCell + 1e-9);
  EXPECT_GT(path.clearance, 0.007);
}

TEST(ClearancePath, PrefersTheWideGateToTheShortWay) {
  // A box with two gates in its wall: 40 mm near the target, 80 mm farther off.
  const MotionGrid grid =
      grid_with({rectangle(-0.08, -0.12, -0.07, -0.1), rectangle(-0.08, -0.06, -0.07, -0.03),
                 rectangle(-0.08, 0.05, -0.07, 0.07), rectangle(-0.08, -0.12, 0.12, -0.11),
                 rectangle(0.11, -0.12, 0.12, 0.07), rectangle(-0.08, 0.06, 0.12, 0.07)});
  const ClearancePath path = clearance_path(grid, small_hand(), {0.02, -0.08, 0}, 0.17, 0.03);
  ASSERT_TRUE(path.found());
  for (const Vector2d& point : path.points) {
    if (std::abs(point.x() + 0.075) < 0.004) EXPECT_NEAR(point.y(), 0.01, 0.008);
  }
  EXPECT_GT(path.clearance, 0.012);
}

TEST(ClearancePath, LetsTheTargetShareCellsWithWhatItStandsOn) {
  const MotionGrid grid = grid_with({rectangle(0.006, -0.2, 0.2, 0.2)});  // 1 mm off the tip
  const ClearancePath path = clearance_path(grid, small_hand(), {0, 0, 0}, 0.1);
  ASSERT_TRUE(path.found());
  EXPECT_TRUE(path.whole_hand);
  for (const Vector2d& point : path.points) EXPECT_LE(point.x(), 1e-9);
}

TEST(ClearancePath, FallsBackOnTheFingerTipsWhereTheHandMustTurn) {
  // A lane of 50 mm with a bend of a right angle: the hand that keeps its direction does not pass.
  const MotionGrid grid =
      grid_with({rectangle(-0.03, 0.02, 0.06, 0.2), rectangle(-0.13, -0.05, 0.06, -0.03),
                 rectangle(0.04, -0.05, 0.06, 0.2), rectangle(-0.13, -0.05, -0.11, 0.2)});
  const ClearancePath path = clearance_path(grid, small_hand(), {0, -0.005, 0}, 0.15);
  ASSERT_TRUE(path.found());
  const ClearancePath shut = clearance_path(
      grid_with({rectangle(-0.08, -0.08, -0.07, 0.08), rectangle(0.07, -0.08, 0.08, 0.08),
                 rectangle(-0.08, 0.07, 0.08, 0.08), rectangle(-0.08, -0.08, 0.08, -0.07)}),
      small_hand(), {0, 0, 0}, 0.1);
  EXPECT_FALSE(shut.found());
  EXPECT_TRUE(shut.points.empty());
}

TEST(ClearancePath, IsAsWideAsAnyWayAFloodFinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.12, 0.12);
  GripperOutline point_hand;  // a hand so small that its mask is the grid itself
  point_hand.pieces.push_back({rectangle(-1e-4, -1e-4, 1e-4, 1e-4).loops.front(), 0, 0});
  point_hand.radius = 2e-4;
  const int half = 26, side = 2 * half + 1;
  int found = 0;
  for (int round = 0; round < 20; ++round) {
    MotionGrid grid({0, 0}, 0.2, kCell, 1);
    for (int n = 0; n < 14; ++n) {
      const double x = place(random), y = place(random);
      if (std::max(std::abs(x), std::abs(y)) < 0.03) continue;
      grid.fill(0, rectangle(x - 0.02, y - 0.003, x + 0.02, y + 0.003));
      grid.fill(0, rectangle(x - 0.003, y - 0.02, x + 0.003, y + 0.02));
    }
    const Vector2d target = grid.corner() + kCell * Vector2d(50.5, 50.5);
    const ClearancePath path =
        clearance_path(grid, point_hand, {target.x(), target.y(), 0.0}, 25 * kCell, 1.0);
    std::vector<char> marked(static_cast<std::size_t>(side * side));
    for (int j = -half; j <= half; ++j) {
      for (int i = -half; i <= half; ++i) {
        marked[static_cast<std::size_t>((j + half) * side + i + half)] =
            grid.is_filled(0, 50 + i, 50 + j) ? 1 : 0;
      }
    }
    const std::vector<double> room = distance_transform(marked, side);
    const auto passes = [&](double least) {  // from the target out, over cells as wide as that
      std::vector<char> seen(room.size());
      std::queue<int> open;
      open.push(half * side + half);
      seen[static_cast<std::size_t>(half * side + half)] = 1;
      while (!open.empty()) {
        const int at = open.front();
        open.pop();
        const int i = at % side - half, j = at / side - half;
        if (std::sqrt(i * i + j * j) >= 25.0 - 1e-9) return true;
        for (int d = 0; d < 9; ++d) {
          const int ni = i + d % 3 - 1, nj = j + d / 3 - 1;
          const std::size_t to = static_cast<std::size_t>((nj + half) * side + ni + half);
          const bool near = std::max(std::abs(ni), std::abs(nj)) <= 3;
          if (seen[to] != 0 || (!near && (room[to] < least || room[to] <= 0.0))) continue;
          seen[to] = 1;
          open.push(static_cast<int>(to));
        }
      }
      return false;
    };
    EXPECT_EQ(path.found(), passes(0.0)) << "round " << round;
    if (!path.found()) continue;
    ++found;
    EXPECT_TRUE(passes(path.clearance / kCell - 1e-9));
    EXPECT_FALSE(passes(path.clearance / kCell + 1e-6)) << "round " << round;
  }
  EXPECT_GT(found, 5);
}

TEST(SlideAlong, ComesRoundATrapThatTheStraightPullStallsIn) {
  // A cup open toward the start, the target behind it.
  const MotionGrid grid =
      grid_with({rectangle(0.0, -0.06, 0.01, 0.06), rectangle(-0.06, 0.05, 0.01, 0.06),
                 rectangle(-0.06, -0.06, 0.01, -0.05)});
  const GripperOutline hand = small_hand();
  const auto anywhere = [](const PlanarPose&) { return true; };
  const SlideResult stalled = slide_to_target(grid, hand, {-0.14, 0, 0}, {0.08, 0}, anywhere);
  EXPECT_NE(stalled.status, SlideStatus::Reached);
  const ClearancePath path = clearance_path(grid, hand, {0.08, 0, 0}, 0.19);
  ASSERT_TRUE(path.found());
  // By hand: round the cup.
  const std::vector<Vector2d> route = {{-0.14, 0}, {-0.14, 0.1}, {0.08, 0.1}, {0.08, 0}};
  const SlideResult slide = slide_along(grid, hand, {-0.14, 0, 0}, route, anywhere);
  EXPECT_EQ(slide.status, SlideStatus::Reached);
  EXPECT_EQ(slide.path.back().x, 0.08);
  EXPECT_EQ(slide.path.back().y, 0.0);
}

TEST(ClearancePath, RefusesWhatDoesNotFit) {
  const MotionGrid grid = grid_with({});
  EXPECT_THROW(clearance_path(grid, small_hand(), {0.5, 0, 0}, 0.1), InvalidInput);
  EXPECT_THROW(clearance_path(grid, small_hand(), {NAN, 0, 0}, 0.1), InvalidInput);
  EXPECT_THROW(clearance_path(grid, small_hand(), {0, 0, 0}, 0.0), InvalidInput);
  EXPECT_THROW(clearance_path(grid, {}, {0, 0, 0}, 0.1), InvalidInput);
  EXPECT_THROW(distance_transform({1, 0, 0}, 2), InvalidInput);
  const auto anywhere = [](const PlanarPose&) { return true; };
  EXPECT_THROW(slide_along(grid, small_hand(), {0, 0, 0}, {}, anywhere), InvalidInput);
}

}  // namespace
}  // namespace handey
