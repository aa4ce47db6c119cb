// Walled off: said of an arm in a cage, with the cage's name, and of joints that do not turn so
// far; never of a part that some free configuration holds which sampling reaches.
#include "handey/cspace/walled_off.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>

#include "../grasp/parts.hpp"
#include "../kinematics/puma.hpp"
#include "handey/errors.hpp"
#include "handey/motion/sampling.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::puma;
using testing::translation;

Configuration in_the_cage() {
  Configuration start;
  start.q.resize(6);
  start.q << -0.021, 1.269, -1.091, 2.234, -0.729, -2.159;
  start.opening = 0.1;
  return start;
}

Cell bench(bool cage, double height = 2.2) {
  Cell cell;
  cell.robot = puma();
  cell.fixtures.push_back(box_body("table", {3, 3, 0.05}, translation(0, 0, -0.025)));
  if (cage) {
    const double at = 0.34, z = 0.5 * height;
    cell.fixtures.push_back(box_body("front", {0.04, 0.72, height}, translation(at, 0, z)));
    cell.fixtures.push_back(box_body("back", {0.04, 0.72, height}, translation(-at, 0, z)));
    cell.fixtures.push_back(box_body("left", {0.72, 0.04, height}, translation(0, at, z)));
    cell.fixtures.push_back(box_body("right", {0.72, 0.04, height}, translation(0, -at, z)));
  }
  cell.start = in_the_cage();
  return cell;
}

Body block() { return box_body("block", {0.04, 0.06, 0.05}); }

WalledOff prove(const Cell& cell, const Pose& X_RP) {
  CollisionChecker checker(make_collision_model(cell), cell);
  return prove_walled_off(checker, cell.start, SphericalWristSolver(*cell.robot), block(), X_RP);
}

TEST(WalledOff, TellsTheCageThatTheArmCannotLeave) {
  const WalledOff found = prove(bench(true), translation(0.75, 0.1, 0.025));
  EXPECT_TRUE(found.walled_off) << found.reason;
  EXPECT_TRUE(found.within_limits);
  ASSERT_FALSE(found.bodies.empty());
  for (const std::string& name : found.bodies) {
    EXPECT_TRUE(name == "front" || name == "back" || name == "left" || name == "right") << name;
  }
  EXPECT_FALSE(found.movers.empty());
}

TEST(WalledOff, IsNotSaidWithoutTheCageOrOverALowOne) {
  EXPECT_FALSE(prove(bench(false), translation(0.75, 0.1, 0.025)).walled_off);
  EXPECT_FALSE(prove(bench(true, 0.3), translation(0.75, 0.1, 0.025)).walled_off);
}

TEST(WalledOff, IsSaidOfJointsThatDoNotTurnSoFar) {
  auto robot = std::make_shared<Robot>(*puma());
  robot->joints[0].limit.lower = -0.5;
  robot->joints[0].limit.upper = 0.5;
  Cell cell = bench(false);
  cell.robot = robot;
  // To the side, where neither arm comes: the shoulder's offset is 0.15 m.
  const WalledOff side = prove(cell, translation(0.0, 0.8, 0.4));
  EXPECT_TRUE(side.walled_off) << side.reason;
  EXPECT_FALSE(side.within_limits);
  EXPECT_TRUE(side.bodies.empty());
  EXPECT_FALSE(prove(cell, translation(0.7, 0.0, 0.2)).walled_off);
}

TEST(WalledOff, IsNeverSaidOfWhatSamplingReaches) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int reached = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Cell cell = bench(false);
    cell.start = {puma()->home, 0.1};
    for (int i = 0; i < 5; ++i) {
      const Pose X =
          translation(0.7 * share(random), 0.7 * share(random), 0.4 + 0.3 * share(random));
      cell.fixtures.push_back(box_body("box", {0.1, 0.3, 0.4}, X));
      cell.fixtures.back().name += std::to_string(i);
    }
    CollisionChecker checker(make_collision_model(cell), cell);
    Configuration goal = cell.start;
    for (Eigen::Index j = 0; j < 6; ++j) {
      const JointLimit& limit = puma()->joints[static_cast<std::size_t>(j)].limit;
      goal.q[j] = limit.lower + 0.5 * (1.0 + share(random)) * (limit.upper - limit.lower);
    }
    if (!checker.is_free(cell.start) || !checker.is_free(goal)) continue;
    if (!plan_by_sampling(checker, cell.start, {goal}).found()) continue;
    ++reached;
    EXPECT_FALSE(prove(cell, hand_pose(*puma(), goal.q)).walled_off);
  }
  EXPECT_GE(reached, 3);
}

TEST(WalledOff, RefusesAStartOutsideTheLimitsAndAPartWithoutShapes) {
  Cell cell = bench(false);
  CollisionChecker checker(make_collision_model(cell), cell);
  const SphericalWristSolver solver(*puma());
  const Pose at = translation(0.5, 0, 0.1);
  Configuration start = cell.start;
  start.q[0] = 9.0;
  EXPECT_THROW(prove_walled_off(checker, start, solver, block(), at), InvalidInput);
  EXPECT_THROW(prove_walled_off(checker, cell.start, solver, Body{}, at), InvalidInput);
}

}  // namespace
}  // namespace handey
