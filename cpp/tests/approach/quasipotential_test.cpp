// The slide by hand: open ground, a wall, a corridor, a trap; and what must hold of every path.
#include "handey/approach/quasipotential.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "handey/errors.hpp"
#include "small_hand.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using testing::kCell;
using testing::rectangle;
using testing::small_hand;

constexpr double kPi = 3.14159265358979323846;

Vector2d placed(const PlanarPose& pose, const Vector2d& p) {
  return {pose.x + std::cos(pose.theta) * p.x() - std::sin(pose.theta) * p.y(),
          pose.y + std::sin(pose.theta) * p.x() + std::cos(pose.theta) * p.y()};
}

bool anywhere(const PlanarPose&) { return true; }

/// No point moves more than a cell from pose to pose, and no edge of a piece lies on a filled cell.
void expect_legal(const MotionGrid& grid, const GripperOutline& outline,
                  const std::vector<PlanarPose>& path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t layer = 0; layer < outline.pieces.size(); ++layer) {
      const Polygon& polygon = outline.pieces[layer].polygon;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector2d a = placed(path[i], polygon[k]);
        const Vector2d b = placed(path[i], polygon[(k + 1) % polygon.size()]);
        EXPECT_FALSE(grid.touches(static_cast<int>(layer), a, b)) << "pose " << i;
        const Vector2d before = placed(path[i > 0 ? i - 1 : 0], polygon[k]);
        EXPECT_LE((a - before).norm(), grid.cell() + 1e-12) << "pose " << i;
      }
    }
  }
}

double distance(const PlanarPose& pose, const Vector2d& point) {
  return (Vector2d(pose.x, pose.y) - point).norm();
}

TEST(SlideToTarget, GoesStraightOverOpenGroundAndEndsExactlyOnTheTarget) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  const Vector2d target(0.1234567, 0.05);
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.1, 0.0, 0.3}, target, anywhere);
  ASSERT_EQ(result.status, SlideStatus::Reached);
  EXPECT_EQ(result.path.back().x, target.x());
  EXPECT_EQ(result.path.back().y, target.y());
  EXPECT_EQ(result.path.back().theta, 0.3);
  EXPECT_EQ(result.iterations, static_cast<int>(std::ceil(std::hypot(0.2234567, 0.05) / kCell)));
  EXPECT_EQ(result.refusals, 0);
  expect_legal(grid, small_hand(), result.path);
}

TEST(SlideToTarget, IsThereAtOnceWhereItStartsOnTheTarget) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  const SlideResult result =
      slide_to_target(grid, small_hand(), {0.01, 0.02, 1.0}, {0.01, 0.02}, anywhere);
  EXPECT_EQ(result.status, SlideStatus::Reached);
  EXPECT_EQ(result.path.size(), 1u);
}

TEST(SlideToTarget, SlidesAlongAWallThatTheStraightWayWouldEnter) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  grid.fill(0,
            rectangle(-0.2, 0.04, 0.06, 0.08));  // the straight line crosses its lower right corner
  const Vector2d target(0.16, 0.08);
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.15, 0.0, 0.0}, target, anywhere);
  ASSERT_EQ(result.status, SlideStatus::Reached);
  expect_legal(grid, small_hand(), result.path);
  EXPECT_TRUE(std::any_of(result.path.begin(), result.path.end(),
                          [](const PlanarPose& p) { return p.x > 0.0 && p.y < 0.03; }));
}

TEST(SlideToTarget, SwingsItsTailAwayFromAnObstacleBesideIt) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  grid.fill(0, rectangle(-0.2, 0.021, -0.03, 0.2));  // within the clearance of the left side
  const SlideResult result =
      slide_to_target(grid, small_hand(), {0.0, 0.0, 0.0}, {0.1, 0.0}, anywhere);
  ASSERT_EQ(result.status, SlideStatus::Reached);
  EXPECT_GT(result.path[1].theta, 0.0);  // the push is at the tail, the turn about the tip
  expect_legal(grid, small_hand(), result.path);
  MotionGrid mirrored({0, 0}, 0.2, kCell, 1);
  mirrored.fill(0, rectangle(-0.2, -0.2, -0.03, -0.021));
  const SlideResult other =
      slide_to_target(mirrored, small_hand(), {0.0, 0.0, 0.0}, {0.1, 0.0}, anywhere);
  ASSERT_EQ(other.path.size(), result.path.size());
  EXPECT_NEAR(other.path[1].theta, -result.path[1].theta, 1e-12);
}

TEST(SlideToTarget, PassesACorridorLittleWiderThanTheHand) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  grid.fill(0, rectangle(0.0, 0.025, 0.2, 0.2));
  grid.fill(0, rectangle(0.0, -0.2, 0.2, -0.025));
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.15, 0.012, 0.15}, {0.1, 0.0}, anywhere);
  ASSERT_EQ(result.status, SlideStatus::Reached);
  expect_legal(grid, small_hand(), result.path);
}

TEST(SlideToTarget, StallsInAUShapedTrapAndEndsWhereItCameNearest) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  grid.fill(0, rectangle(0.0, 0.06, 0.1, 0.07));
  grid.fill(0, rectangle(0.0, -0.07, 0.1, -0.06));
  grid.fill(0, rectangle(0.09, -0.07, 0.1, 0.07));
  const Vector2d target(0.16, 0.0);
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.1, 0.0, 0.0}, target, anywhere);
  ASSERT_EQ(result.status, SlideStatus::Stalled);
  expect_legal(grid, small_hand(), result.path);
  ASSERT_FALSE(result.path.empty());
  for (const PlanarPose& pose : result.path) {
    EXPECT_GE(distance(pose, target), distance(result.path.back(), target));
  }
  EXPECT_GT(result.path.back().x,
            0.06);  // before the bottom of the trap, not back where it came from
  EXPECT_LT(result.iterations, 200);
}

TEST(SlideToTarget, IsBlockedWhereTheHandStandsOnAFilledCell) {
  MotionGrid edge({0, 0}, 0.2, kCell, 1);
  edge.fill(0, rectangle(-0.2, 0.01, 0.2, 0.2));
  EXPECT_EQ(slide_to_target(edge, small_hand(), {0, 0, 0}, {0.1, -0.1}, anywhere).status,
            SlideStatus::StartBlocked);
  MotionGrid speck({0, 0}, 0.2, kCell, 1);
  speck.fill(0, rectangle(-0.021, -0.001, -0.0205, 0.001));  // wholly inside the hand
  const SlideResult result = slide_to_target(speck, small_hand(), {0, 0, 0}, {0.1, -0.1}, anywhere);
  EXPECT_EQ(result.status, SlideStatus::StartBlocked);
  EXPECT_TRUE(result.path.empty());
}

TEST(SlideToTarget, IsBlockedWhereTheArmCannotReachTheStart) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  const auto nowhere = [](const PlanarPose&) { return false; };
  EXPECT_EQ(slide_to_target(grid, small_hand(), {0, 0, 0}, {0.1, 0.0}, nowhere).status,
            SlideStatus::StartBlocked);
}

TEST(SlideToTarget, TakesAnotherDirectionWhereTheArmCannotGo) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  const Vector2d target(0.1, 0.1);
  // The arm cannot cross the disc; the grid knows nothing of it.
  const auto round_disc = [](const PlanarPose& p) { return std::hypot(p.x, p.y - 0.02) > 0.03; };
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.1, 0.0, 0.0}, target, round_disc);
  EXPECT_EQ(result.status, SlideStatus::Reached);
  EXPECT_GT(result.refusals, 0);
  for (const PlanarPose& pose : result.path) EXPECT_TRUE(round_disc(pose));
}

TEST(SlideToTarget, EachPieceMeetsItsOwnLayerOnly) {
  GripperOutline two = small_hand();
  two.pieces.push_back({rectangle(-0.045, -0.015, 0.005, 0.015).loops.front(), 0.03, 0.05});
  MotionGrid grid({0, 0}, 0.2, kCell, 2);
  grid.fill(0, rectangle(0.02, -0.2, 0.04, -0.08));
  const SlideResult free = slide_to_target(grid, two, {-0.1, 0.0, 0.0}, {0.1, 0.0}, anywhere);
  EXPECT_EQ(free.status, SlideStatus::Reached);
  grid.fill(1, rectangle(0.02, -0.2, 0.04, 0.2));
  const SlideResult held_up = slide_to_target(grid, two, {-0.1, 0.0, 0.0}, {0.1, 0.0}, anywhere);
  EXPECT_EQ(held_up.status, SlideStatus::Stalled);
  expect_legal(grid, two, held_up.path);
}

TEST(SlideToTarget, NeverEntersAFilledCellWhateverTheScene) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-0.18, 0.18), size(0.005, 0.08), angle(-kPi, kPi);
  int reached = 0, walked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    MotionGrid grid({0, 0}, 0.2, kCell, 1);
    for (int i = 0; i < 4; ++i) {
      const double x = at(random), y = at(random);
      grid.fill(0, rectangle(x, y, x + size(random), y + size(random)));
    }
    const PlanarPose start{at(random), at(random), angle(random)};
    const Vector2d target(at(random), at(random));
    const SlideResult result = slide_to_target(grid, small_hand(), start, target, anywhere);
    expect_legal(grid, small_hand(), result.path);
    walked += result.path.size() > 1 ? 1 : 0;
    if (result.status != SlideStatus::Reached) continue;
    ++reached;
    EXPECT_EQ(distance(result.path.back(), target), 0.0);
  }
  EXPECT_GT(walked, 50);
  EXPECT_GT(reached, 20);
}

TEST(SlideToTarget, GivesTheSamePathTwice) {
  MotionGrid grid({0, 0}, 0.2, kCell, 1);
  grid.fill(0, rectangle(0.0, -0.2, 0.05, 0.01));
  const SlideResult a =
      slide_to_target(grid, small_hand(), {-0.1, -0.05, 0.4}, {0.12, 0.0}, anywhere);
  const SlideResult b =
      slide_to_target(grid, small_hand(), {-0.1, -0.05, 0.4}, {0.12, 0.0}, anywhere);
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    EXPECT_EQ(a.path[i].x, b.path[i].x);
    EXPECT_EQ(a.path[i].y, b.path[i].y);
    EXPECT_EQ(a.path[i].theta, b.path[i].theta);
  }
}

TEST(SlideToTarget, StopsAtTheIterationLimit) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  QuasipotentialOptions options;
  options.max_iterations = 5;
  const SlideResult result =
      slide_to_target(grid, small_hand(), {-0.1, 0, 0}, {0.1, 0}, anywhere, options);
  EXPECT_EQ(result.status, SlideStatus::IterationLimit);
  EXPECT_EQ(result.path.size(), 6u);
}

TEST(SlideToTarget, LetsThroughWhatTheReachTestThrows) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1);
  const auto throws = [](const PlanarPose& p) -> bool {
    if (p.x > 0.0) throw std::runtime_error("no arm");
    return true;
  };
  EXPECT_THROW(slide_to_target(grid, small_hand(), {-0.1, 0, 0}, {0.1, 0}, throws),
               std::runtime_error);
}

TEST(SlideToTarget, RefusesWhatDoesNotFit) {
  const MotionGrid grid({0, 0}, 0.2, kCell, 1), two({0, 0}, 0.2, kCell, 2);
  EXPECT_THROW(slide_to_target(grid, small_hand(), {0.3, 0, 0}, {0, 0}, anywhere), InvalidInput);
  EXPECT_THROW(slide_to_target(grid, small_hand(), {0, 0, 0}, {0, 0.3}, anywhere), InvalidInput);
  EXPECT_THROW(slide_to_target(grid, small_hand(), {NAN, 0, 0}, {0, 0}, anywhere), InvalidInput);
  EXPECT_THROW(slide_to_target(two, small_hand(), {0, 0, 0}, {0, 0}, anywhere), InvalidInput);
  EXPECT_THROW(slide_to_target(grid, small_hand(), {0, 0, 0}, {0, 0}, {}), InvalidInput);
  QuasipotentialOptions options;
  options.clearance = kCell;  // a cell could cross the line unseen
  EXPECT_THROW(slide_to_target(grid, small_hand(), {0, 0, 0}, {0, 0}, anywhere, options),
               InvalidInput);
}

}  // namespace
}  // namespace handey
