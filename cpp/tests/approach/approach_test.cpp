// The Puma's hand comes to a block on a table, between walls, and says what stops it.
#include "handey/approach/approach.hpp"

#include <cmath>

#include "handey/errors.hpp"
#include "puma_scene.hpp"

namespace handey {
namespace {

using namespace test;

const std::vector<Body> kTwoWalls = {box("left", {0.25, 0.02, 0.14}, at(0.5, 0.29, 0.07)),
                                     box("right", {0.25, 0.02, 0.14}, at(0.5, 0.11, 0.07))};

struct Aim {
  RankedPair pair;
  GraspPose grasp;
};

/// The best legal grasps of the scene's part, at most `most` of each face pair.
std::vector<Aim> aims(const GraspScene& scene, const SphericalWristSolver& solver,
                      std::size_t most) {
  std::vector<Aim> result;
  for (const RankedPair& pair : rank_grasps(scene.cell, scene.part, scene.X_WP_goal).ranked) {
    const LegalGrasps legal = find_legal_grasps(scene, solver, pair);
    for (std::size_t i = 0; i < std::min(most, legal.poses.size()); ++i) {
      result.push_back({pair, legal.poses[i]});
    }
  }
  return result;
}

void expect_good(const GraspScene& scene, const RankedPair& pair, const ApproachResult& result) {
  ASSERT_TRUE(result.found()) << result.reason;
  ASSERT_GE(result.path.size(), 2u);
  // It ends in the grasp, in a configuration of the grasp, at the pose of the grasp.
  ASSERT_EQ(result.grasp.q_pick.size(), 1u);
  EXPECT_EQ(result.path.back().q, result.grasp.q_pick.front());
  EXPECT_FALSE(result.grasp.q_place.empty());
  const Pose X_WP = scene.cell.parts[0].X_WB;
  EXPECT_TRUE(
      hand_in_world(scene.cell, result.path.back().q).isApprox(X_WP * result.grasp.X_PH, 1e-6));
  EXPECT_TRUE((pair.pair.X_PG * hand_in_plane(result.grasp.in_plane, result.grasp.flipped))
                  .isApprox(result.grasp.X_PH, 1e-6));
  for (const Configuration& c : result.path) EXPECT_EQ(c.opening, result.grasp.opening);
  CollisionChecker checker(scene.model, scene.cell);
  EXPECT_TRUE(certify_path(checker, result.path).is_free());
  expect_free(checker, result.path);
}

TEST(PlanApproach, ComesInToABlockOnAnOpenTable) {
  const GraspScene scene = scene_of(block_on_table(), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const std::vector<Aim> all = aims(scene, solver, 3);
  ASSERT_FALSE(all.empty());
  for (const Aim& aim : all) {
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
    expect_good(scene, aim.pair, result);
    EXPECT_EQ(result.slide.status, SlideStatus::Reached);
    const Pose X_WH = hand_in_world(scene.cell, result.path.front().q);
    const Pose X_WH_aim = scene.cell.parts[0].X_WB * aim.grasp.X_PH;
    EXPECT_GE((X_WH.translation() - X_WH_aim.translation()).norm(), 0.04 - 1e-9);
  }
}

TEST(PlanApproach, ComesInBetweenTwoWalls) {
  const GraspScene scene = scene_of(block_on_table(kTwoWalls), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  int found = 0;
  for (const Aim& aim : aims(scene, solver, 4)) {
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
    if (!result.found()) {
      EXPECT_FALSE(result.reason.empty());
      continue;
    }
    ++found;
    expect_good(scene, aim.pair, result);
  }
  EXPECT_GT(found, 0);
}

TEST(PlanApproach, ComesInBetweenPostsMadeOfManyTriangles) {
  std::vector<Body> posts;
  for (const double y : {0.13, 0.27}) {
    const TriangleMesh mesh = tessellate({Cylinder{0.02, 0.16}, Pose::Identity()}, 600);
    ASSERT_GT(mesh.triangles.size(), 1000u);
    Body post = box(y < 0.2 ? "near post" : "far post", {1, 1, 1}, at(0.5, y, 0.08));
    post.shapes[0].geometry = MeshShape{std::make_shared<const TriangleMesh>(mesh), true};
    posts.push_back(post);
  }
  const GraspScene scene = scene_of(block_on_table(posts), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  int found = 0;
  for (const Aim& aim : aims(scene, solver, 3)) {
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
    if (!result.found()) continue;
    ++found;
    expect_good(scene, aim.pair, result);
  }
  EXPECT_GT(found, 0);
}

TEST(PlanApproach, KeepsTheBranchOfThePickConfiguration) {
  const GraspScene scene = scene_of(block_on_table(), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const std::vector<Aim> all = aims(scene, solver, 1);
  ASSERT_FALSE(all.empty());
  int found = 0;
  for (const Eigen::VectorXd& q : all.front().grasp.q_pick) {
    const ApproachResult result =
        plan_approach(scene, solver, all.front().pair, all.front().grasp, q);
    if (!result.found()) continue;
    ++found;
    expect_good(scene, all.front().pair, result);
    EXPECT_LT((result.path.back().q - q).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((result.path.front().q - q).cwiseAbs().maxCoeff(), 1.5);
  }
  EXPECT_GT(found, 0);
}

TEST(PlanApproach, MovesInThePlaneOfTheGraspNoMoreThanACellAStep) {
  const GraspScene scene = scene_of(block_on_table(kTwoWalls), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const ApproachOptions options;
  for (const Aim& aim : aims(scene, solver, 2)) {
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front(), options);
    for (std::size_t i = 0; i + 1 < result.slide.path.size(); ++i) {
      const PlanarPose &a = result.slide.path[i], &b = result.slide.path[i + 1];
      EXPECT_LE(std::hypot(b.x - a.x, b.y - a.y), options.cell + 1e-9);
    }
  }
}

TEST(PlanApproach, StopsBeforeABarThatWasNotThereWhenTheGraspWasFoundAndNamesIt) {
  const GraspScene open = scene_of(block_on_table(), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*open.cell.robot);
  const std::vector<Aim> all = aims(open, solver, 1);
  ASSERT_FALSE(all.empty());
  // A plate over the block, wider than hand and grid.
  const GraspScene shut = scene_of(
      block_on_table({box("plate", {0.4, 0.4, 0.01}, at(0.5, 0.2, 0.0601))}), at(0.5, -0.2, 0.025));
  int tried = 0;
  for (const Aim& aim : all) {
    const Eigen::Vector3d approach = (open.cell.parts[0].X_WB * aim.grasp.X_PH).linear().col(2);
    if (approach.z() > -0.7) continue;  // from above only
    const ApproachResult result =
        plan_approach(shut, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
    EXPECT_FALSE(result.found());
    EXPECT_TRUE(result.path.empty());
    EXPECT_NE(result.reason.find("plate"), std::string::npos) << result.reason;
    ++tried;
  }
  EXPECT_GT(tried, 0);
}

/// Bars close over the palm of a hand that holds the block across y from above, and walls beside
/// it: it must move along the block, past the bars' ends, before it can rise.
Cell block_under_bars(double half_length) {
  const Eigen::Vector3d bar(2.0 * half_length, 0.008, 0.006), wall(0.01, 0.2, 0.14);
  return block_on_table(
      {box("bar", bar, at(0.5, 0.256, 0.16)), box("other bar", bar, at(0.5, 0.144, 0.16)),
       box("left", wall, at(0.395, 0.2, 0.07)), box("right", wall, at(0.605, 0.2, 0.07))});
}

std::vector<Aim> aims_from_above(const GraspScene& scene, const SphericalWristSolver& solver) {
  LegalityOptions options;
  options.most_poses = 100;
  std::vector<Aim> result;
  for (const RankedPair& pair : rank_grasps(scene.cell, scene.part, scene.X_WP_goal).ranked) {
    for (const GraspPose& pose : find_legal_grasps(scene, solver, pair, options).poses) {
      const Eigen::Matrix3d R_WH = (scene.cell.parts[0].X_WB * pose.X_PH).linear();
      if (R_WH(2, 2) < -0.99 && std::abs(R_WH(1, 1)) > 0.99) result.push_back({pair, pose});
    }
  }
  return result;
}

TEST(PlanApproach, SearchesWhereStraightIsShutAndSlidesStall) {
  const GraspScene scene = scene_of(block_under_bars(0.03), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  ApproachOptions lame;
  lame.slide.max_iterations = 1;
  int searched = 0;
  for (const Aim& aim : aims_from_above(scene, solver)) {
    const Eigen::VectorXd& q = aim.grasp.q_pick.front();
    const ApproachResult result = plan_approach(scene, solver, aim.pair, aim.grasp, q);
    if (result.found()) {
      EXPECT_NE(result.planner, ApproachPlanner::Straight);
      expect_good(scene, aim.pair, result);
    }
    const ApproachResult found = plan_approach(scene, solver, aim.pair, aim.grasp, q, lame);
    if (found.planner != ApproachPlanner::PlaneSearch || !found.found()) continue;
    ++searched;
    expect_good(scene, aim.pair, found);
    const PlanarPose& start = found.slide.path.front();
    EXPECT_GE(std::hypot(start.x - found.grasp.in_plane.x, start.y - found.grasp.in_plane.y),
              0.1 - 1e-9);
    const ApproachResult again = plan_approach(scene, solver, aim.pair, aim.grasp, q, lame);
    ASSERT_EQ(found.path.size(), again.path.size());
    for (std::size_t i = 0; i < found.path.size(); ++i) {
      EXPECT_EQ(found.path[i].q, again.path[i].q);
    }
    ApproachOptions without = lame;
    without.search_levels = 0;
    EXPECT_NE(plan_approach(scene, solver, aim.pair, aim.grasp, q, without).planner,
              ApproachPlanner::PlaneSearch);
  }
  EXPECT_GT(searched, 0);
}

TEST(PlanApproach, SaysThatThereIsNoWayInThePlaneAndWhoIsRoundTheGrasp) {
  // The bars reach from wall to wall.
  const GraspScene scene = scene_of(block_under_bars(0.1), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const std::vector<Aim> all = aims_from_above(scene, solver);
  ASSERT_FALSE(all.empty());
  const Aim& aim = all.front();
  const ApproachResult result =
      plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
  EXPECT_FALSE(result.found());
  EXPECT_EQ(result.planner, ApproachPlanner::PlaneSearch);
  EXPECT_TRUE(result.path.empty());
  EXPECT_NE(result.reason.find("no way out"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("bar"), std::string::npos) << result.reason;
}

TEST(PlanApproach, SaysSoWhereTheArmCanStandAtNoStart) {
  const GraspScene open = scene_of(block_on_table(), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*open.cell.robot);
  const std::vector<Aim> all = aims(open, solver, 1);
  ASSERT_FALSE(all.empty());
  const Aim& aim = all.front();
  const GraspScene filled = scene_of(
      block_on_table({box("ceiling", {1.0, 1.0, 0.6}, at(0.5, 0.2, 0.4))}), at(0.5, -0.2, 0.025));
  const ApproachResult result =
      plan_approach(filled, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
  EXPECT_EQ(result.status, ApproachStatus::StartBlocked);
  EXPECT_NE(result.reason.find("starts blocked"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("ceiling"), std::string::npos) << result.reason;
}

TEST(PlanApproach, GivesTheSamePathTwice) {
  const GraspScene scene = scene_of(block_on_table(kTwoWalls), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const std::vector<Aim> all = aims(scene, solver, 1);
  ASSERT_FALSE(all.empty());
  const Aim& aim = all.front();
  const Eigen::VectorXd& q = aim.grasp.q_pick.front();
  const ApproachResult once = plan_approach(scene, solver, aim.pair, aim.grasp, q);
  const ApproachResult again = plan_approach(scene, solver, aim.pair, aim.grasp, q);
  ASSERT_EQ(once.path.size(), again.path.size());
  for (std::size_t i = 0; i < once.path.size(); ++i) EXPECT_EQ(once.path[i].q, again.path[i].q);
}

TEST(PlanApproach, HoldsOffObstaclesOfTheDestinationWhereTheArticleWantsIt) {
  // At the destination the block stands beside a wall; moved by T^-1 the wall is beside it at the
  // origin.
  const GraspScene scene = scene_of(
      block_on_table({box("wall", {0.3, 0.02, 0.2}, at(0.5, -0.28, 0.1))}), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  ApproachOptions options;
  options.destination_obstacles_join = true;
  CollisionChecker checker(scene.model, scene.cell.with_part_at(0, scene.X_WP_goal));
  int found = 0;
  for (const Aim& aim : aims(scene, solver, 4)) {
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front(), options);
    if (!result.found()) continue;
    ++found;
    expect_good(scene, aim.pair, result);
  }
  EXPECT_GT(found, 0);
}

TEST(PlanApproach, OpensTheHandWiderWhereThePartIsWiderThanAtTheGrasp) {
  // A bar between two wider blocks, under rails over the hand's shoulders: the hand can come along
  // the bar only, past one of the blocks.
  Cell cell = block_on_table({
      box("left rail", {0.05, 0.24, 0.01}, at(0.427, 0.2, 0.165)),
      box("right rail", {0.05, 0.24, 0.01}, at(0.573, 0.2, 0.165)),
  });
  cell.parts[0].shapes = {{Box{{0.02, 0.12, 0.05}}, Pose::Identity()},
                          {Box{{0.05, 0.02, 0.05}}, at(0, 0.05, 0)},
                          {Box{{0.05, 0.02, 0.05}}, at(0, -0.05, 0)}};
  const GraspScene scene = scene_of(cell, at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  int on_bar = 0, wider = 0;
  for (const Aim& aim : aims(scene, solver, 16)) {
    if (std::abs(aim.grasp.width - 0.02) > 1e-6 || aim.grasp.X_PH(2, 2) > -0.99) continue;
    ++on_bar;
    const ApproachResult result =
        plan_approach(scene, solver, aim.pair, aim.grasp, aim.grasp.q_pick.front());
    if (!result.found()) continue;
    expect_good(scene, aim.pair, result);
    if (result.grasp.opening > 0.05) ++wider;
  }
  EXPECT_GT(on_bar, 0);
  EXPECT_GT(wider, 0);
}

TEST(PlanApproach, RefusesWhatDoesNotFit) {
  const GraspScene scene = scene_of(block_on_table(), at(0.5, -0.2, 0.025));
  const SphericalWristSolver solver(*scene.cell.robot);
  const std::vector<Aim> all = aims(scene, solver, 1);
  ASSERT_FALSE(all.empty());
  const Aim& aim = all.front();
  const Eigen::VectorXd q = aim.grasp.q_pick.front();
  EXPECT_THROW(plan_approach(scene, solver, aim.pair, aim.grasp, q.head(5)), InvalidInput);
  EXPECT_THROW(plan_approach(scene, solver, aim.pair, aim.grasp, scene.cell.start.q), InvalidInput);
  ApproachOptions options;
  options.cell = 0.005;  // more than the bump lines' 6 mm allow
  EXPECT_THROW(plan_approach(scene, solver, aim.pair, aim.grasp, q, options), InvalidInput);
  GraspScene holding = scene;
  holding.cell = scene.cell.with_held(0, aim.grasp.X_PH.inverse());
  EXPECT_THROW(plan_approach(holding, solver, aim.pair, aim.grasp, q), InvalidInput);
}

}  // namespace
}  // namespace handey
