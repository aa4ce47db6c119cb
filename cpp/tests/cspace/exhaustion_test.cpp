// Exhausted grasps: never said where a hand pose is legal, as random poses tell that are no part of
// the lattice; said of parts that are walled in, with the body that walls them in.
#include "handey/cspace/exhaustion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "../grasp/puma_bench.hpp"
#include "handey/errors.hpp"
#include "handey/grasp/target.hpp"

namespace handey {
namespace {

using testing::block_on_bench;
using testing::box_body;
using testing::puma;
using testing::translation;

/// Four walls so far from the block's middle, so high, and a lid.
Cell walled_in(double room, double height, bool lid) {
  Cell cell = block_on_bench();
  const double at = room + 0.01, z = 0.5 * height;
  cell.fixtures.push_back(
      box_body("left", {0.02, 2 * at + 0.02, height}, translation(0.50 - at, 0.20, z)));
  cell.fixtures.push_back(
      box_body("right", {0.02, 2 * at + 0.02, height}, translation(0.50 + at, 0.20, z)));
  cell.fixtures.push_back(
      box_body("front", {2 * at + 0.02, 0.02, height}, translation(0.50, 0.20 - at, z)));
  cell.fixtures.push_back(
      box_body("back", {2 * at + 0.02, 0.02, height}, translation(0.50, 0.20 + at, z)));
  if (lid) {
    cell.fixtures.push_back(box_body("lid", {2 * at + 0.02, 2 * at + 0.02, 0.02},
                                     translation(0.50, 0.20, height + 0.01)));
  }
  return cell;
}

Exhaustion exhaust(const Cell& cell, const std::vector<Pose>& places) {
  return exhaust_grasps(make_collision_model(cell), cell, 0, places, SphericalWristSolver(*puma()));
}

Exhaustion exhaust(const Cell& cell) { return exhaust(cell, {cell.parts[0].X_WB}); }

/// Random hand poses on the part's pairs that are legal where it stands.
int random_legal_poses(const Cell& cell, int count) {
  const SphericalWristSolver solver(*puma());
  Allowance closed_on;
  closed_on.closed_on = 0;
  CollisionChecker checker(make_collision_model(cell), cell, closed_on);
  const FeaturePairs features = find_feature_pairs(cell.parts[0], puma()->gripper);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int legal = 0;
  for (int i = 0; i < count; ++i) {
    const FeaturePair& pair = features.pairs[static_cast<std::size_t>(i) % features.pairs.size()];
    const PlanarPose pose{0.06 * share(random), 0.06 * share(random), 3.1416 * share(random)};
    if (pad_contact_area(pair.overlap, pose, puma()->gripper) <= 0.0) continue;
    const Pose X_PH = pair.X_PG * hand_in_plane(pose, i % 2 == 0);
    const double width = pair.width_at({pose.x, pose.y});
    for (const InverseSolution& solution : solver.solve(cell.parts[0].X_WB * X_PH).solutions) {
      if (checker.is_free({solution.q, width}, 0.0)) {
        ++legal;
        break;
      }
    }
  }
  return legal;
}

TEST(Exhaustion, IsNotSaidOfAPartOnABareTable) {
  const Exhaustion found = exhaust(block_on_bench());
  EXPECT_FALSE(found.exhausted);
  EXPECT_EQ(found.reason, "a hand pose is legal");
  EXPECT_LT(found.cells_looked_at, 100u);
}

TEST(Exhaustion, NamesTheBoxRoundThePart) {
  const Cell cell = walled_in(0.08, 0.15, true);
  const Exhaustion found = exhaust(cell);
  ASSERT_TRUE(found.exhausted) << found.reason;
  EXPECT_GT(found.pairs, 0);
  EXPECT_DOUBLE_EQ(found.spacing, 0.006);
  double shares = 0.0;
  bool lid = false;
  for (const IllegalCause& cause : found.causes) {
    shares += cause.share;
    lid = lid || cause.other == "lid";
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_TRUE(lid);
  EXPECT_EQ(random_legal_poses(cell, 20000), 0);
}

TEST(Exhaustion, AgreesWithRandomPosesForWallsOfAnyWidth) {
  int exhausted = 0;
  for (const double room : {0.035, 0.04, 0.045, 0.05, 0.06, 0.08}) {
    for (const double height : {0.05, 0.10, 0.30}) {
      const Cell cell = walled_in(room, height, false);
      if (!exhaust(cell).exhausted) continue;
      ++exhausted;
      EXPECT_EQ(random_legal_poses(cell, 6000), 0) << room << " " << height;
    }
  }
  EXPECT_GE(exhausted, 2);
  EXPECT_LE(exhausted, 15);
}

TEST(Exhaustion, IsProvedThroughoutForAPartThatIsFarAway) {
  Cell cell = block_on_bench();
  cell.parts[0].X_WB = translation(2.5, 0.0, 0.5);
  const Exhaustion found = exhaust(cell);
  EXPECT_TRUE(found.exhausted);
  EXPECT_EQ(found.spacing, 0.0);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].kind, IllegalKind::OutOfReach);
  EXPECT_GT(found.causes[0].least, 1.0);
}

TEST(Exhaustion, OfTwoPlacesAsksForAPoseThatIsLegalAtBoth) {
  // Walls of a lane at one place, across it at the other: each place has its grasps.
  Cell cell = block_on_bench();
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "_a" : "_b";
    cell.fixtures.push_back(
        box_body("lane" + name, {0.4, 0.02, 0.07}, translation(0.50, 0.20 + 0.041 * side, 0.035)));
    cell.fixtures.push_back(
        box_body("cross" + name, {0.02, 0.4, 0.07}, translation(0.50 + 0.031 * side, -0.3, 0.035)));
  }
  const Pose there = translation(0.50, -0.3, 0.025);
  EXPECT_FALSE(exhaust(cell).exhausted);
  EXPECT_FALSE(exhaust(cell, {there}).exhausted);
  const Exhaustion both = exhaust(cell, {cell.parts[0].X_WB, there});
  EXPECT_TRUE(both.exhausted) << both.reason;
}

TEST(Exhaustion, IsGivenUpWhenItsBudgetIsSpent) {
  const Cell cell = walled_in(0.08, 0.15, true);
  ExhaustionOptions options;
  options.most_cells = 500;
  const Exhaustion found = exhaust_grasps(make_collision_model(cell), cell, 0, {cell.parts[0].X_WB},
                                          SphericalWristSolver(*puma()), options);
  EXPECT_FALSE(found.exhausted);
  EXPECT_LE(found.cells_looked_at, 500u);
  EXPECT_NE(found.reason.find("given up"), std::string::npos) << found.reason;
}

TEST(Exhaustion, IsNotSaidOfABall) {
  Cell cell = walled_in(0.08, 0.15, true);
  cell.parts[0].shapes = {{Sphere{0.02}, Pose::Identity()}};
  EXPECT_FALSE(exhaust(cell).exhausted);
}

TEST(Exhaustion, RefusesNoPlaceUnknownPartsAndBadOptions) {
  const Cell cell = block_on_bench();
  const SphericalWristSolver solver(*puma());
  const auto model = make_collision_model(cell);
  const std::vector<Pose> place{cell.parts[0].X_WB};
  EXPECT_THROW(exhaust_grasps(model, cell, 0, {}, solver), InvalidInput);
  EXPECT_THROW(exhaust_grasps(model, cell, 1, place, solver), InvalidInput);
  EXPECT_THROW(exhaust_grasps(nullptr, cell, 0, place, solver), InvalidInput);
  ExhaustionOptions options;
  options.spacing = std::nan("");
  EXPECT_THROW(exhaust_grasps(model, cell, 0, place, solver, options), InvalidInput);
}

}  // namespace
}  // namespace handey
