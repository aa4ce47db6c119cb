// Grasps in the part frame: each holds the part, none has the hand in it, and those that a plane
// forbids are forbidden by a table.
#include "handey/grasp/part_grasps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "handey/collision/checker.hpp"
#include "handey/errors.hpp"
#include "handey/grasp/compatibility.hpp"
#include "puma_bench.hpp"

namespace handey {
namespace {

using testing::block_on_bench;
using testing::puma;

const RankedPair* pair_of(const Ranking& ranking, const PartGrasp& grasp) {
  for (const RankedPair& ranked : ranking.ranked) {
    if (to_string(ranked.pair) == to_string(grasp.a, grasp.b)) return &ranked;
  }
  return nullptr;
}

TEST(PartGrasps, EachIsAHandPoseOfItsPairWithContact) {
  const Body block = block_on_bench().parts.front();
  const Ranking ranking = rank_part_alone(block, puma());
  const std::vector<PartGrasp> grasps = sample_part_grasps(block, puma());
  ASSERT_GT(grasps.size(), 500u);
  for (const PartGrasp& grasp : grasps) {
    const RankedPair* pair = pair_of(ranking, grasp);
    ASSERT_NE(pair, nullptr);
    const Pose X_PH = pair->pair.X_PG * hand_in_plane(grasp.in_plane, grasp.flipped);
    EXPECT_TRUE(grasp.X_PH.isApprox(X_PH, 1e-12));
    // Of an edge or a vertex, the strip or square that stands for it.
    const double least = pair->pair.kind == PairKind::FaceFace ? 30e-6 : 1e-9;
    EXPECT_GT(pad_contact_area(pair->unobstructed, grasp.in_plane, puma()->gripper), least);
    EXPECT_GT(grasp.width, 0.0);
    EXPECT_LE(grasp.width + 0.004, puma()->gripper.max_opening);
  }
}

// With the arm at home and the part brought to the hand, whatever else the arm meets.
TEST(PartGrasps, NoneHasTheHandInThePart) {
  Cell cell = block_on_bench();
  cell.fixtures.clear();
  const std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
  const Pose X_WH = hand_in_world(cell, cell.robot->home);
  std::size_t looked_at = 0;
  for (const PartGrasp& grasp : sample_part_grasps(cell.parts.front(), cell.robot)) {
    if (++looked_at % 7 != 0) continue;
    const Cell held = cell.with_part_at(0, X_WH * grasp.X_PH.inverse());
    CollisionChecker checker(model, held);
    EXPECT_TRUE(checker.is_free({cell.robot->home, grasp.width + 0.004}, 1e-4));
  }
}

TEST(PartGrasps, FewerWhereFewerAreAskedForAndEveryDirectionKeepsSome) {
  const Body block = block_on_bench().parts.front();
  PartGraspOptions options;
  options.most = 600;
  const std::vector<PartGrasp> grasps = sample_part_grasps(block, puma(), options);
  EXPECT_LT(2 * grasps.size(), sample_part_grasps(block, puma()).size());
  std::set<int> directions;
  for (const PartGrasp& grasp : grasps) {
    directions.insert(static_cast<int>(std::lround(grasp.in_plane.theta * 4.0 / 3.14159265)));
  }
  EXPECT_GE(directions.size(), 8u);
}

TEST(PartGrasps, WhatThePlaneForbidsATableForbids) {
  const Cell cell = block_on_bench();
  const std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
  const SphericalWristSolver solver(*cell.robot);
  const std::vector<PartGrasp> grasps = sample_part_grasps(cell.parts.front(), cell.robot);
  std::vector<int> all(grasps.size());
  std::iota(all.begin(), all.end(), 0);
  const Pose X_WP = cell.parts.front().X_WB;
  const std::vector<char> clear = clears_plane(cell.robot, grasps, X_WP);
  ASSERT_EQ(clear.size(), grasps.size());
  EXPECT_GT(std::count(clear.begin(), clear.end(), 1), 100);
  EXPECT_GT(std::count(clear.begin(), clear.end(), 0), 100);
  const CompatibleGrasps found =
      find_compatible_grasps(model, cell, 0, solver, grasps, {all}, {X_WP}).front();
  EXPECT_GT(found.legal.size(), 50u);
  for (const CompatibleGrasp& legal : found.legal) {
    EXPECT_TRUE(clear[static_cast<std::size_t>(legal.grasp)]) << legal.grasp;
  }
}

TEST(PartGrasps, RefuseWhatIsMissing) {
  const Body block = block_on_bench().parts.front();
  EXPECT_THROW(sample_part_grasps(block, nullptr), InvalidInput);
  EXPECT_THROW(clears_plane(nullptr, {}, Pose::Identity()), InvalidInput);
  PartGraspOptions options;
  options.most = 0;
  EXPECT_THROW(sample_part_grasps(block, puma(), options), InvalidInput);
}

}  // namespace
}  // namespace handey
