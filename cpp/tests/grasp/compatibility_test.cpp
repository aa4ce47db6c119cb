// Grasps at single places, held against the legality of pick-and-places between two of them.
#include "handey/grasp/compatibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "handey/errors.hpp"
#include "puma_bench.hpp"

namespace handey {
namespace {

using testing::block_on_bench;

struct Bench {
  Cell cell = block_on_bench();
  std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
  SphericalWristSolver solver{*cell.robot};
  std::vector<PartGrasp> grasps = sample_part_grasps(cell.parts.front(), cell.robot);
  std::vector<int> all = std::vector<int>(grasps.size());
  Pose origin = cell.parts.front().X_WB;
  Pose goal =
      testing::translation(0.45, -0.25, 0.025) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ());

  Bench() { std::iota(all.begin(), all.end(), 0); }

  std::vector<CompatibleGrasps> find(const std::vector<std::vector<int>>& groups,
                                     const std::vector<Pose>& places,
                                     const CompatibilityOptions& options = {}) const {
    return find_compatible_grasps(model, cell, 0, solver, grasps, groups, places, options);
  }
};

// The oracle: a pick-and-place with a grasp is legal if and only if the grasp is at both ends.
TEST(Compatibility, AgreesWithLegalityOfAPickAndPlace) {
  const Bench bench;
  const std::vector<CompatibleGrasps> ends = bench.find({bench.all}, {bench.origin, bench.goal});
  std::map<int, int> legal_at;
  for (const CompatibleGrasps& end : ends) {
    for (const CompatibleGrasp& grasp : end.legal) ++legal_at[grasp.grasp];
  }
  const GraspScene scene{bench.model, bench.cell, 0, bench.goal};
  const Ranking ranking = rank_part_alone(bench.cell.parts.front(), bench.cell.robot);
  int legal = 0;
  for (std::size_t i = 0; i < bench.grasps.size(); i += 5) {
    const PartGrasp& grasp = bench.grasps[i];
    const auto pair = std::find_if(
        ranking.ranked.begin(), ranking.ranked.end(),
        [&](const RankedPair& r) { return to_string(r.pair) == to_string(grasp.a, grasp.b); });
    ASSERT_NE(pair, ranking.ranked.end());
    const LegalGrasps direct =
        test_grasp_pose(scene, bench.solver, *pair, grasp.in_plane, grasp.flipped);
    EXPECT_EQ(!direct.poses.empty(), legal_at[static_cast<int>(i)] == 2) << i;
    legal += direct.poses.empty() ? 0 : 1;
  }
  EXPECT_GT(legal, 20);
}

TEST(Compatibility, CountsWhatFellAndWhy) {
  const Bench bench;
  const CompatibleGrasps found = bench.find({bench.all}, {bench.origin}).front();
  EXPECT_EQ(found.tried, static_cast<int>(bench.grasps.size()));
  EXPECT_EQ(found.tried, found.unreachable + found.collides + static_cast<int>(found.legal.size()));
  EXPECT_NE(found.worst_reason.find("hits table"), std::string::npos) << found.worst_reason;
  for (const CompatibleGrasp& legal : found.legal) {
    EXPECT_LE(legal.q.size(), 2u);
    EXPECT_GE(legal.margin, 0.0);
    EXPECT_GT(legal.opening, bench.grasps[static_cast<std::size_t>(legal.grasp)].width);
  }
}

TEST(Compatibility, AGroupEndsWhenItHasEnough) {
  const Bench bench;
  const std::vector<int> half(bench.all.begin(), bench.all.begin() + 400);
  CompatibilityOptions options;
  options.most = 3;
  const CompatibleGrasps one = bench.find({half}, {bench.origin}, options).front();
  EXPECT_EQ(one.legal.size(), 3u);
  // A grasp in two groups is looked at once and counts in both.
  const CompatibleGrasps two = bench.find({half, half}, {bench.origin}, options).front();
  EXPECT_EQ(two.legal.size(), 3u);
  EXPECT_EQ(two.tried, one.tried);
}

TEST(Compatibility, APlaceOutOfReachHasNone) {
  const Bench bench;
  const Pose far = testing::translation(3.0, 0.0, 0.025);
  EXPECT_TRUE(bench.find({bench.all}, {far}).front().legal.empty());
  const auto margins =
      reach_margins(bench.cell, bench.solver, bench.grasps, {bench.all, {}}, {far, bench.origin});
  ASSERT_EQ(margins.size(), 2u);
  EXPECT_EQ(margins[0][0], -1.0);
  EXPECT_GT(margins[1][0], 0.5);
  EXPECT_EQ(margins[1][1], -1.0);  // nothing in the group
}

TEST(Compatibility, RefusesUnknownGraspsAndAFullHand) {
  const Bench bench;
  EXPECT_THROW(bench.find({{static_cast<int>(bench.grasps.size())}}, {bench.origin}), InvalidInput);
  EXPECT_THROW(find_compatible_grasps(bench.model, bench.cell.with_held(0, Pose::Identity()), 0,
                                      bench.solver, bench.grasps, {bench.all}, {bench.origin}),
               InvalidInput);
  CompatibilityOptions options;
  options.configurations = 0;
  EXPECT_THROW(bench.find({bench.all}, {bench.origin}, options), InvalidInput);
}

}  // namespace
}  // namespace handey
