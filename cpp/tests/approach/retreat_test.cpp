// Lifting a block off a table, drawing the hand back, and what stops either.
#include "handey/approach/retreat.hpp"

#include "handey/collision/box_certificate.hpp"
#include "handey/errors.hpp"
#include "puma_scene.hpp"

namespace handey {
namespace {

using namespace test;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

/// The hand over the block, pointing down, closing along the block's 40 mm.
Pose hand_on_block(const Cell& cell) {
  Pose X_WH = Pose::Identity();
  X_WH.linear().col(0) = Eigen::Vector3d::UnitY();
  X_WH.linear().col(1) = Eigen::Vector3d::UnitX();
  X_WH.linear().col(2) = -Eigen::Vector3d::UnitZ();
  X_WH.translation() = cell.parts[0].X_WB.translation();
  return X_WH;
}

Configuration arm_at(const Cell& cell, const SphericalWristSolver& solver, const Pose& X_WH,
                     double opening) {
  const InverseResult inverse = solver.solve(cell.X_WR.inverse() * X_WH);
  CollisionChecker checker(make_collision_model(cell), cell, {0, {{BodyRef::Kind::Fixture, 0}}});
  for (const InverseSolution& solution : inverse.solutions) {
    if (checker.is_free({solution.q, opening})) return {solution.q, opening};
  }
  ADD_FAILURE() << "no free configuration";
  return cell.start;
}

struct HeldBlock {
  explicit HeldBlock(const Cell& standing)
      : solver(*standing.robot),
        cell(standing.with_held(0, hand_on_block(standing).inverse() * standing.parts[0].X_WB)),
        model(make_collision_model(cell)),
        in_contact(model, cell, {std::nullopt, {{BodyRef::Kind::Fixture, 0}}}),
        clear(model, cell),
        start(arm_at(cell, solver, hand_on_block(standing), 0.04)) {}

  RetreatResult retreat(const Eigen::Vector3d& direction, const RetreatOptions& options = {}) {
    return plan_retreat(in_contact, clear, solver, start, direction, options);
  }
  double height(const Configuration& configuration) const {
    return hand_in_world(cell, configuration.q).translation().z() -
           hand_in_world(cell, start.q).translation().z();
  }

  SphericalWristSolver solver;
  Cell cell;
  std::shared_ptr<const CollisionModel> model;
  CollisionChecker in_contact, clear;
  Configuration start;
};

TEST(PlanRetreat, LiftsAHeldBlockOffTheTable) {
  HeldBlock block(block_on_table());
  ASSERT_FALSE(block.clear.is_free(block.start));  // it stands on the table
  const RetreatResult result = block.retreat(kUp);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_EQ(result.reason, "");
  EXPECT_DOUBLE_EQ(result.travelled, 0.1);
  EXPECT_EQ(result.path.front().q, block.start.q);
  EXPECT_NEAR(block.height(result.path[1]), 0.0015, 1e-9);
  EXPECT_NEAR(block.height(result.path.back()), 0.1, 1e-9);
  expect_free(block.in_contact, result.path);
  const std::vector<Configuration> after(result.path.begin() + 1, result.path.end());
  EXPECT_TRUE(certify_path(block.clear, after).is_free());
  expect_free(block.clear, after);
}

TEST(PlanRetreat, NeverLowersThePartWhileItMayTouch) {
  HeldBlock block(block_on_table());
  const RetreatResult result = block.retreat(kUp);
  ASSERT_TRUE(result.found) << result.reason;
  double height = 0.0;
  for (int k = 1; k <= 50; ++k) {
    const Configuration between{result.path[0].q + k / 50.0 * (result.path[1].q - result.path[0].q),
                                0.04};
    EXPECT_GT(block.height(between), height - 2e-5);
    height = block.height(between);
  }
}

TEST(PlanRetreat, StopsUnderABarAndNamesIt) {
  // The block is longer than the palm is wide; the bar hangs over its end, beside the hand.
  Cell cell = block_on_table({box("bar", {0.3, 0.006, 0.02}, at(0.5, 0.25, 0.095))});
  cell.parts[0].shapes[0].geometry = Box{{0.04, 0.12, 0.05}};
  HeldBlock block(cell);
  RetreatOptions options;
  options.room = 0.0;
  const RetreatResult result = block.retreat(kUp, options);
  EXPECT_TRUE(result.found);
  EXPECT_NEAR(result.travelled, 0.0315, 1e-9);  // 35 mm of room
  EXPECT_NE(result.reason.find("bar"), std::string::npos) << result.reason;
  expect_free(block.clear, {result.path.begin() + 1, result.path.end()});
  options.least = 0.05;
  const RetreatResult short_of = block.retreat(kUp, options);
  EXPECT_FALSE(short_of.found);
  EXPECT_NE(short_of.reason.find("bar"), std::string::npos) << short_of.reason;
  EXPECT_NE(short_of.reason.find("50.0 mm"), std::string::npos) << short_of.reason;
}

TEST(PlanRetreat, WillNotPushThePartIntoWhatItStandsOn) {
  HeldBlock block(block_on_table());
  const RetreatResult result = block.retreat(-kUp);
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.travelled, 0.0);
  EXPECT_NE(result.reason.find("table"), std::string::npos) << result.reason;
}

TEST(PlanRetreat, WillNotDragThePartAlongTheTable) {
  HeldBlock block(block_on_table());
  const RetreatResult result = block.retreat(Eigen::Vector3d::UnitY());
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("table"), std::string::npos) << result.reason;
}

TEST(PlanRetreat, DrawsTheOpenHandBackFromTheBlock) {
  const Cell cell = block_on_table();
  const SphericalWristSolver solver(*cell.robot);
  CollisionChecker clear(make_collision_model(cell), cell);
  const Configuration start = arm_at(cell, solver, hand_on_block(cell), 0.056);
  const RetreatResult result = plan_retreat(clear, clear, solver, start, kUp);
  ASSERT_TRUE(result.found) << result.reason;
  EXPECT_EQ(result.travelled, 0.1);
  expect_free(clear, result.path);
}

TEST(PlanRetreat, EndsWhereTheGrossMotionStartsInAFreeCell) {
  Cell cell = block_on_table({box("bar", {0.3, 0.006, 0.02}, at(0.5, 0.25, 0.095))});
  cell.parts[0].shapes[0].geometry = Box{{0.04, 0.12, 0.05}};
  HeldBlock block(cell);
  RetreatOptions options;
  options.least = 0.01;
  options.step = 0.004;
  options.room = 0.0;
  const RetreatResult farthest = block.retreat(kUp, options);
  options.room = 0.004;
  const RetreatResult result = block.retreat(kUp, options);
  ASSERT_TRUE(farthest.found && result.found) << result.reason;
  EXPECT_LT(result.travelled, farthest.travelled);  // which ends close under the bar
  EXPECT_EQ(result.reason, farthest.reason);
  EXPECT_TRUE(certify_path(block.clear, {result.path.begin() + 1, result.path.end()}).is_free());
  Eigen::VectorXd half = Eigen::VectorXd::Zero(6);
  half.head<3>().setConstant(options.room);
  EXPECT_TRUE(BoxProver(block.clear).prove({result.path.back(), half}).free);
  EXPECT_FALSE(BoxProver(block.clear).prove({farthest.path.back(), half}).free);
}

TEST(PlanRetreat, SaysWhereTheArmReachesNoFarther) {
  HeldBlock block(block_on_table());
  RetreatOptions options;
  options.most = 1.5;
  const RetreatResult result = block.retreat(kUp, options);
  EXPECT_TRUE(result.found);
  EXPECT_LT(result.travelled, 1.5);
  EXPECT_FALSE(result.reason.empty());
}

TEST(PlanRetreat, RefusesWrongInput) {
  HeldBlock block(block_on_table());
  EXPECT_THROW(block.retreat(2.0 * kUp), InvalidInput);
  EXPECT_THROW(block.retreat(Eigen::Vector3d::Zero()), InvalidInput);
  EXPECT_THROW(block.retreat({0, 0, NAN}), InvalidInput);
  RetreatOptions options;
  options.least = 0.2;
  EXPECT_THROW(block.retreat(kUp, options), InvalidInput);
  options = {};
  options.step = 0.0;
  EXPECT_THROW(block.retreat(kUp, options), InvalidInput);
  block.start.q.conservativeResize(5);
  EXPECT_THROW(block.retreat(kUp), InvalidInput);
}

}  // namespace
}  // namespace handey
