// Blocked hand poses: never said where a pose is legal, as random poses about the middle tell; and
// a search that passes them over finds all that a search finds which does not.
#include "handey/grasp/blocked_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "handey/errors.hpp"
#include "handey/grasp/ranking.hpp"
#include "puma_bench.hpp"

namespace handey {
namespace {

using testing::block_on_bench;
using testing::box_body;
using testing::puma;
using testing::translation;

GraspScene scene_of(const Cell& cell) {
  return {make_collision_model(cell), cell, 0, translation(0.45, -0.25, 0.025)};
}

/// A wall before the goal and a roof over it, a rib beside the block.
GraspScene crowded() {
  Cell cell = block_on_bench();
  cell.fixtures.push_back(box_body("wall", {0.02, 0.3, 0.12}, translation(0.38, -0.25, 0.06)));
  cell.fixtures.push_back(box_body("roof", {0.2, 0.1, 0.02}, translation(0.47, -0.3, 0.2)));
  cell.fixtures.push_back(box_body("rib", {0.01, 0.08, 0.03}, translation(0.54, 0.20, 0.015)));
  return scene_of(cell);
}

/// The same with the block turned at both ends.
GraspScene turned() {
  GraspScene scene = crowded();
  scene.cell.parts[0].X_WB.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  scene.X_WP_goal.rotate(Eigen::AngleAxisd(-1.1, Eigen::Vector3d::UnitZ()));
  scene.model = make_collision_model(scene.cell);
  return scene;
}

/// Is the closed hand free where the pose puts it, with any solution at either end?
bool is_free_somewhere(const GraspScene& scene, const SphericalWristSolver& solver,
                       const Pose& X_PH, double width, GraspEnd end) {
  const Cell cell =
      end == GraspEnd::Origin ? scene.cell : scene.cell.with_part_at(scene.part, scene.X_WP_goal);
  Allowance closed_on;
  closed_on.closed_on = scene.part;
  CollisionChecker checker(scene.model, cell, closed_on);
  const Pose X_RH = cell.X_WR.inverse() * cell.parts[0].X_WB * X_PH;
  for (const InverseSolution& solution : solver.solve(X_RH).solutions) {
    if (checker.is_free({solution.q, width}, 0.0)) return true;
  }
  return false;
}

TEST(BlockedPoses, HoldNoPoseAtWhichTheClosedHandIsFree) {
  const SphericalWristSolver solver(*puma());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (const GraspScene& scene : {crowded(), turned()}) {
    BlockedPoses blocked(scene);
    int told = 0, with_solutions = 0;
    for (const RankedPair& pair : rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked) {
      for (int i = 0; i < 400; ++i) {
        const PlanarPose middle{0.05 * share(random), 0.05 * share(random), 3.15 * share(random)};
        const HandMotion motion{0.01 * (1.0 + share(random)), 0.1 * (1.0 + share(random))};
        const bool flipped = i % 2 == 0;
        const auto found = blocked.find(pair.pair, middle, flipped, motion);
        if (!found) continue;
        ++told;
        for (int k = 0; k < 4; ++k) {
          const double turn = 3.1416 * share(random), far = k < 2 ? 1.0 : 0.5;
          const PlanarPose pose{middle.x + far * motion.shift * std::cos(turn),
                                middle.y + far * motion.shift * std::sin(turn),
                                middle.theta + (k % 2 == 0 ? far : -far) * motion.half_turn};
          const Pose X_PH = pair.pair.X_PG * hand_in_plane(pose, flipped);
          const double width = pair.pair.width_at({pose.x, pose.y});
          EXPECT_FALSE(is_free_somewhere(scene, solver, X_PH, width, found->end))
              << to_string(pair.pair) << ": " << found->mover << " in " << found->body;
        }
        const Pose X_WP =
            found->end == GraspEnd::Origin ? scene.cell.parts[0].X_WB : scene.X_WP_goal;
        const Pose X_WH = X_WP * pair.pair.X_PG * hand_in_plane(middle, flipped);
        if (!solver.solve(scene.cell.X_WR.inverse() * X_WH).solutions.empty()) ++with_solutions;
      }
    }
    EXPECT_GT(told, 200);
    EXPECT_GT(with_solutions, 20);
  }
}

TEST(BlockedPoses, NameTheEndAndWhatTheHandIsIn) {
  const GraspScene scene = crowded();
  BlockedPoses blocked(scene);
  const FeaturePairs features = find_feature_pairs(scene.cell.parts[0], puma()->gripper);
  int under_table = 0;
  for (const FeaturePair& pair : features.pairs) {
    for (int turn = 0; turn < 8; ++turn) {
      const PlanarPose pose{0.0, 0.0, 0.7854 * turn};
      const Pose X_PH = pair.X_PG * hand_in_plane(pose, false);
      const auto found = blocked.find(pair, pose, false);
      if (X_PH.linear().col(2).z() < 0.9) continue;
      ++under_table;  // the hand comes from below
      ASSERT_TRUE(found);
      EXPECT_EQ(found->end, GraspEnd::Origin);
      EXPECT_EQ(found->body, "table");
    }
  }
  EXPECT_GT(under_table, 1);
}

TEST(BlockedPoses, AreNotSaidOfAHandFromAboveOnABareTable) {
  const GraspScene scene = scene_of(block_on_bench());
  BlockedPoses blocked(scene);
  const SphericalWristSolver solver(*puma());
  for (const RankedPair& pair : rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked) {
    for (const GraspPose& pose : find_legal_grasps(scene, solver, pair).poses) {
      EXPECT_FALSE(blocked.find(pair.pair, pose.in_plane, pose.flipped));
    }
  }
}

TEST(BlockedPoses, RefuseNumbersThatAreNone) {
  const GraspScene scene = scene_of(block_on_bench());
  BlockedPoses blocked(scene);
  const FeaturePair pair = find_feature_pairs(scene.cell.parts[0], puma()->gripper).pairs.at(0);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(blocked.find(pair, {none, 0.0, 0.0}, false), InvalidInput);
  EXPECT_THROW(blocked.find(pair, {}, false, {none, 0.0}), InvalidInput);
  EXPECT_THROW(blocked.find(pair, {}, false, {0.0, -0.1}), InvalidInput);
}

TEST(BlockedPoses, RefuseAFullHandAndNoModel) {
  GraspScene scene = scene_of(block_on_bench());
  scene.cell.held = HeldPart{0, Pose::Identity()};
  EXPECT_THROW(BlockedPoses{scene}, InvalidInput);
  scene = scene_of(block_on_bench());
  scene.model = nullptr;
  EXPECT_THROW(BlockedPoses{scene}, InvalidInput);
}

using Key = std::tuple<double, double, double, bool, std::size_t, std::size_t>;

std::set<Key> keys(const std::vector<GraspPose>& poses) {
  std::set<Key> keys;
  for (const GraspPose& pose : poses) {
    keys.insert({pose.in_plane.x, pose.in_plane.y, pose.in_plane.theta, pose.flipped,
                 pose.q_pick.size(), pose.q_place.size()});
  }
  return keys;
}

TEST(LegalGraspSearch, FindsThePosesThatItFindsWithoutBlockedOnes) {
  const SphericalWristSolver solver(*puma());
  std::size_t legal = 0;
  for (const GraspScene& scene : {scene_of(block_on_bench()), crowded(), turned()}) {
    const auto blocked = std::make_shared<BlockedPoses>(scene);
    LegalityOptions options;
    options.spacing = 0.008;
    options.directions = 20;  // no multiple of a cell's directions beside those along edges
    options.least_contact_share = 0.1;
    options.most_poses = 100000;
    for (const bool spread : {true, false}) {
      options.spread = spread;
      for (const RankedPair& pair : rank_grasps(scene.cell, 0, scene.X_WP_goal).ranked) {
        LegalGraspSearch pruned(scene, solver, pair, options, blocked);
        std::vector<GraspPose> found;
        while (!pruned.is_done()) {
          for (const GraspPose& pose : pruned.next(100)) found.push_back(pose);
        }
        const LegalGrasps all = find_legal_grasps(scene, solver, pair, options);
        EXPECT_EQ(keys(found), keys(all.poses)) << to_string(pair.pair);
        const LegalGrasps told = pruned.result();
        EXPECT_EQ(told.tried, all.tried);
        EXPECT_EQ(told.too_little_contact, all.too_little_contact);
        EXPECT_EQ(told.tried, static_cast<int>(told.poses.size()) + told.too_little_contact +
                                  told.would_turn + told.unreachable_at_origin +
                                  told.unreachable_at_destination + told.collides_at_origin +
                                  told.collides_at_destination);
        legal += found.size();
      }
    }
  }
  EXPECT_GT(legal, 300u);
}

}  // namespace
}  // namespace handey
