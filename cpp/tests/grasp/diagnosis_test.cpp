// Cells broken by one known cause: the diagnosis names it, at the right end, and by how much.
#include "handey/grasp/diagnosis.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"
#include "puma_bench.hpp"

namespace handey {
namespace {

using testing::block_on_bench;
using testing::box_body;
using testing::translation;

GraspScene make_scene(const Cell& cell, const Pose& X_WP_goal) {
  return {make_collision_model(cell), cell, 0, X_WP_goal};
}

const Pose kGoal = translation(0.45, -0.25, 0.025);

TEST(Diagnosis, OfACellThatIsWellFindsLegalGrasps) {
  const Diagnosis diagnosis = diagnose_grasps(make_scene(block_on_bench(), kGoal));
  EXPECT_GT(diagnosis.legal, 50);
  EXPECT_EQ(diagnosis.fewest, 0);
  EXPECT_GE(diagnosis.free_at_origin, diagnosis.legal);
  EXPECT_GE(diagnosis.free_at_destination, diagnosis.legal);
  for (const GraspObstacle& obstacle : diagnosis.obstacles) {
    EXPECT_LE(obstacle.alone, obstacle.met);
    EXPECT_LE(obstacle.met, diagnosis.looked_at);
    EXPECT_EQ(obstacle.carries, obstacle.body == "table");
  }
}

// Half of all hands come from below the table: it is met most often, and not the cause.
TEST(Diagnosis, TellsTheRoofOverTheDestinationFromTheTable) {
  Cell cell = block_on_bench();
  cell.fixtures.push_back(box_body("roof", {0.5, 0.5, 0.02}, translation(0.45, -0.25, 0.11)));
  const Diagnosis diagnosis = diagnose_grasps(make_scene(cell, kGoal));
  const GraspObstacle& first = diagnosis.obstacles.at(0);
  EXPECT_EQ(first.kind, FallKind::Collision);
  EXPECT_EQ(first.body, "roof");
  EXPECT_EQ(first.end, GraspEnd::Destination);
  EXPECT_GT(first.alone, 50);
  EXPECT_GT(first.least, 0.0);
  EXPECT_FALSE(first.carries);
  EXPECT_GT(diagnosis.free_at_origin, 50);
  EXPECT_EQ(diagnosis.free_at_destination, 0);
  EXPECT_GT(diagnosis.obstacles.at(1).met, first.met) << "the table is met more often";
  EXPECT_EQ(diagnosis.obstacles.at(1).body, "table");
}

TEST(Diagnosis, TellsByHowMuchTheGoalIsOutOfReach) {
  const Diagnosis near = diagnose_grasps(make_scene(block_on_bench(), translation(1.02, 0, 0.025)));
  const Diagnosis far = diagnose_grasps(make_scene(block_on_bench(), translation(1.10, 0, 0.025)));
  for (const Diagnosis& diagnosis : {near, far}) {
    EXPECT_EQ(diagnosis.obstacles.at(0).kind, FallKind::OutOfReach);
    EXPECT_EQ(diagnosis.obstacles.at(0).end, GraspEnd::Destination);
  }
  EXPECT_NEAR(far.obstacles[0].least - near.obstacles[0].least, 0.08, 0.01);
}

TEST(Diagnosis, TellsByHowMuchThePartIsTooWide) {
  Cell cell = block_on_bench();
  cell.parts[0] = box_body("block", {0.099, 0.14, 0.16}, translation(0.50, 0.20, 0.08));
  const Diagnosis diagnosis = diagnose_grasps(make_scene(cell, translation(0.45, -0.25, 0.08)));
  EXPECT_EQ(diagnosis.obstacles.at(0).kind, FallKind::TooWide);
  EXPECT_NEAR(diagnosis.obstacles.at(0).least, 0.003, 1e-9);
  EXPECT_EQ(diagnosis.legal, 0);
}

// The wrist is held fast but for the goal's need: joint 5 alone is what is past its limit.
TEST(Diagnosis, NamesTheJointThatIsPastItsLimit) {
  Cell cell = block_on_bench();
  const auto stiff = std::make_shared<Robot>(*block_on_bench().robot);
  stiff->joints[4].limit.lower = -0.05;
  stiff->joints[4].limit.upper = 0.05;
  cell.robot = stiff;
  const Diagnosis diagnosis = diagnose_grasps(make_scene(cell, kGoal));
  const GraspObstacle& first = diagnosis.obstacles.at(0);
  EXPECT_EQ(diagnosis.legal, 0);
  EXPECT_EQ(first.kind, FallKind::JointLimit);
  EXPECT_EQ(first.joint, 4);
  EXPECT_GT(first.least, 0.0);
}

TEST(Diagnosis, IsTheSameEveryTimeAndRefusesBadInputs) {
  const GraspScene scene = make_scene(block_on_bench(), kGoal);
  const Diagnosis a = diagnose_grasps(scene), b = diagnose_grasps(scene);
  ASSERT_EQ(a.obstacles.size(), b.obstacles.size());
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    EXPECT_EQ(a.obstacles[i].met, b.obstacles[i].met);
    EXPECT_EQ(a.obstacles[i].least, b.obstacles[i].least);
  }
  DiagnosisOptions options;
  options.most_poses = 0;
  EXPECT_THROW(diagnose_grasps(scene, options), InvalidInput);
  GraspScene holding = scene;
  holding.cell = scene.cell.with_held(0, Pose::Identity());
  EXPECT_THROW(diagnose_grasps(holding), InvalidInput);
}

}  // namespace
}  // namespace handey
