#include "handey/cspace/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../collision/puma_cell.hpp"
#include "../motion/planar_scene.hpp"
#include "handey/collision/solids.hpp"
#include "handey/motion/sampling.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;
using testing::cluttered_cell;
using testing::puma_cell;
using testing::Random;

CollisionChecker checker_of(const Cell& cell) {
  return CollisionChecker(make_collision_model(cell), cell);
}

Configuration folded(double waist) {
  Configuration c;
  c.q.resize(6);
  c.q << waist, 2.0, -2.6, 0.0, 0.0, 0.0;
  c.opening = 0.1;
  return c;
}

/// A wall that leads outwards from the waist at an angle of -1 rad.
Cell walled_cell(double height, double thickness) {
  Cell cell = puma_cell();
  cell.parts.clear();
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(-1.0, Vector3d::UnitZ()).toRotationMatrix();
  X.translation() = X.linear() * Vector3d(0.22 + 0.75, 0.0, 0.5 * height);
  cell.fixtures = {testing::box_body("table", {3, 3, 0.05}, testing::at(0, 0, -0.025)),
                   testing::box_body("wall", {1.5, thickness, height}, X)};
  return cell;
}

// With the limits of the first joint, one wall is enough.
TEST(ProveApart, TellsTheWallThatTheArmCannotPass) {
  CollisionChecker checker = checker_of(walled_cell(2.6, 0.1));
  const Configuration start = folded(-1.5), goal = folded(2.2);
  ASSERT_TRUE(checker.is_free(start));
  ASSERT_TRUE(checker.is_free(goal));
  const Separation separation = prove_apart(checker, start, {goal, folded(-0.8)});
  EXPECT_FALSE(separation.apart);
  ASSERT_EQ(separation.goal_apart.size(), 2u);
  EXPECT_TRUE(separation.goal_apart[0]);
  EXPECT_FALSE(separation.goal_apart[1]);
  const Separation one = prove_apart(checker, start, {goal});
  EXPECT_TRUE(one.apart);
  EXPECT_NE(one.reason.find("goal 0 is walled off"), std::string::npos) << one.reason;
  EXPECT_NE(one.reason.find("wall (link2"), std::string::npos) << one.reason;
}

TEST(ProveApart, DoesNotCallApartWhatTheArmPassesOver) {
  CollisionChecker checker = checker_of(walled_cell(0.3, 0.1));
  const Configuration start = folded(-1.5), goal = folded(2.2);
  ASSERT_TRUE(checker.is_free(start));
  ASSERT_TRUE(checker.is_free(goal));
  ASSERT_TRUE(plan_by_sampling(checker, start, {goal}).found());
  const Separation separation = prove_apart(checker, start, {goal});
  EXPECT_FALSE(separation.apart);
  EXPECT_NE(separation.reason.find("is linked with the start"), std::string::npos)
      << separation.reason;
}

/// Random configurations in blocked cells, all joints after the third anywhere.
void expect_blocked_cells_collide(const Cell& cell, int samples, std::uint64_t seed,
                                  double opening = 0.1) {
  CollisionChecker checker = checker_of(cell);
  BlockedCells blocked(checker, opening);
  const Lattice& lattice = blocked.lattice();
  Random random(seed);
  int found = 0;
  for (int trial = 0; found < samples && trial < samples; ++trial) {
    const int level = trial % Lattice::kLevels;
    CellIndex index{};
    for (int j = 0; j < 3; ++j) {
      const int count = lattice.cells(level, j);
      index[static_cast<std::size_t>(j)] =
          std::min(count - 1, static_cast<int>(random.uniform(0.0, count)));
    }
    const BlockedProof proof = blocked.prove(level, index);
    if (!proof.blocked) continue;
    for (int k = 0; k < 20; ++k, ++found) {
      Configuration c;
      c.q.resize(static_cast<Eigen::Index>(cell.robot->joints.size()));
      c.opening = opening;
      for (int j = 0; j < c.q.size(); ++j) {
        const JointLimit& limit = cell.robot->joints[static_cast<std::size_t>(j)].limit;
        c.q[j] = random.uniform(limit.lower, limit.upper);
        if (j >= 3) continue;
        // Corners of the cell as often as its inside.
        double share = random.uniform(-0.5, 0.5);
        if (k % 2 != 0) share = share < 0.0 ? -0.5 : 0.5;
        c.q[j] = lattice.centre(level, j, index[static_cast<std::size_t>(j)]) +
                 share * lattice.cell_width(level, j);
      }
      ASSERT_TRUE(checker.find_hit(c, 0.0).has_value())
          << proof.mover << " and " << proof.other << " at level " << level << ": "
          << c.q.transpose();
    }
  }
  EXPECT_GE(found, samples);
}

/// The Puma before shelves, with solids of every kind, one of them held.
Cell shelf_cell() {
  Cell cell = puma_cell();
  const auto add = [&cell](const std::string& name, const Vector3d& size, const Vector3d& centre) {
    cell.fixtures.push_back(
        testing::box_body(name, size, testing::at(centre.x(), centre.y(), centre.z())));
  };
  for (int k = 0; k < 4; ++k) {
    add("board" + std::to_string(k), {0.3, 0.9, 0.02}, {0.65, 0.0, 0.3 + 0.25 * k});
    add("side" + std::to_string(k), {0.3, 0.02, 0.75}, {0.65, 0.3 * k - 0.45, 0.675});
  }
  Random random(11);
  cell.fixtures.push_back(testing::mesh_body("bracket", testing::l_mesh(0.4, 0.08),
                                             testing::at(-0.5, 0.2, 0.5) * random.pose(0.0)));
  cell.fixtures.push_back(testing::mesh_body("tray", testing::tray_mesh({0.4, 0.3, 0.2}, 0.03),
                                             testing::at(-0.3, -0.5, 0.6) * random.pose(0.0)));
  Body drum;
  drum.name = "drum";
  drum.shapes = {{Cylinder{0.12, 0.5}, testing::at(0, 0, 0)},
                 {Sphere{0.15}, testing::at(0, 0, 0.3)}};
  drum.X_WB = testing::at(0.1, 0.7, 0.4) * random.pose(0.0);
  cell.fixtures.push_back(drum);
  cell.parts[0] = testing::box_body("block", {0.3, 0.06, 0.08}, testing::at(0.45, -0.1, 0.015));
  return cell.with_held(0, testing::at(0, 0, 0.02));
}

TEST(BlockedCells, CollideEverywhereInClutter) {
  expect_blocked_cells_collide(cluttered_cell(25), 100000, 3);
}

TEST(BlockedCells, CollideEverywhereAmongShelvesMeshesAndRoundSolids) {
  expect_blocked_cells_collide(shelf_cell(), 100000, 4);
}

TEST(BlockedCells, CollideEverywhereInDenseClutter) {
  expect_blocked_cells_collide(cluttered_cell(80, 5), 100000, 5);
}

TEST(BlockedCells, CollideEverywhereForAnArmThatHasNoFurtherJoints) {
  Cell cell = test::planar_cell(
      {test::wall("wall", {0.4, 0.1}, 0.3, 0.0), test::wall("post", {0.1, 0.1}, -0.2, 0.3)});
  expect_blocked_cells_collide(cell, 20000, 6, 0.04);
}

TEST(BlockedCells, AreMostOfThoseWhoseEveryConfigurationCollides) {
  const Cell cell = cluttered_cell(25);
  CollisionChecker checker = checker_of(cell);
  BlockedCells blocked(checker, 0.1);
  const Lattice& lattice = blocked.lattice();
  Random random(8);
  int colliding = 0, proved = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    CellIndex index{};
    for (int j = 0; j < 3; ++j) {
      const double share = random.uniform(0.0, 1.0);
      index[static_cast<std::size_t>(j)] = static_cast<int>(share * lattice.cells(2, j));
    }
    bool free = false;
    for (int k = 0; k < 200 && !free; ++k) {
      Configuration c = random.configuration(*cell.robot);
      c.opening = 0.1;
      for (int j = 0; j < 3; ++j) {
        c.q[j] = lattice.centre(2, j, index[static_cast<std::size_t>(j)]) +
                 random.uniform(-0.5, 0.5) * lattice.cell_width(2, j);
      }
      free = checker.is_free(c);
    }
    if (free) continue;
    ++colliding;
    if (blocked.prove(2, index).blocked) ++proved;
  }
  RecordProperty("colliding", colliding);
  RecordProperty("proved", proved);
  EXPECT_GT(colliding, 200);
  EXPECT_GT(proved, colliding / 2);
}

/// Free paths lie in cells that are not blocked, and their ends are not apart.
void expect_paths_not_apart(const Cell& cell, int pairs, std::uint64_t seed) {
  CollisionChecker checker = checker_of(cell);
  BlockedCells blocked(checker, 0.1);
  const Lattice& lattice = blocked.lattice();
  Random random(seed);
  SamplingOptions sampling;
  sampling.max_iterations = 300;
  SeparationOptions options;
  options.most_cells = 3000;
  const auto draw = [&] {
    Configuration c;
    do {
      c = random.configuration(*cell.robot);
      c.opening = 0.1;
    } while (!checker.is_free(c));
    return c;
  };
  for (int found = 0, trial = 0; found < pairs; ++trial) {
    ASSERT_LT(trial, 4 * pairs);
    const Configuration start = draw(), goal = draw();
    const MotionResult motion = plan_by_sampling(checker, start, {goal}, sampling);
    if (!motion.found()) continue;
    ++found;
    const Separation separation = prove_apart(checker, start, {goal}, options);
    ASSERT_FALSE(separation.apart) << separation.reason;
    for (std::size_t k = 0; k + 1 < motion.path.size(); ++k) {
      for (int i = 0; i <= 20; ++i) {
        const Eigen::VectorXd q =
            motion.path[k].q + i / 20.0 * (motion.path[k + 1].q - motion.path[k].q);
        for (int level = 0; level < Lattice::kLevels; ++level) {
          CellIndex index{};
          for (int j = 0; j < 3; ++j) {
            index[static_cast<std::size_t>(j)] = lattice.index_of(level, j, q[j]);
          }
          const BlockedProof proof = blocked.prove(level, index);
          ASSERT_FALSE(proof.blocked) << proof.mover << " and " << proof.other;
        }
      }
    }
  }
}

TEST(ProveApart, NeverCallsApartWhatAPathLinksInClutter) {
  expect_paths_not_apart(cluttered_cell(25), 80, 21);
}

TEST(ProveApart, NeverCallsApartWhatAPathLinksInDenseClutter) {
  expect_paths_not_apart(cluttered_cell(60, 9), 60, 22);
}

TEST(ProveApart, NeverCallsApartWhatAPathLinksBeforeShelves) {
  expect_paths_not_apart(shelf_cell(), 60, 23);
}

/// A wall outwards from the axis of the planar arm, that its upper arm cannot pass.
Body wall_at(const std::string& name, double angle) {
  Body body = test::wall(name, {0.8, 0.1}, 0.0, 0.0);
  body.X_WB.linear() = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  body.X_WB.translation() = body.X_WB.linear() * Vector3d(0.5, 0.0, 0.0);
  return body;
}

TEST(ProveApart, CountsTheLimitsOfJointsAsWalls) {
  CollisionChecker checker = checker_of(test::planar_cell({wall_at("wall", 0.0)}));
  const Separation separation =
      prove_apart(checker, test::configuration(-1, 0, 0), {test::configuration(1, 0, 0)});
  EXPECT_TRUE(separation.apart) << separation.reason;
  EXPECT_NE(separation.reason.find(": wall (upper_arm"), std::string::npos) << separation.reason;
}

TEST(ProveApart, GoesRoundByTheBackWhereAJointHasNoLimits) {
  const auto turning = [](std::vector<Body> walls) {
    Cell cell = test::planar_cell(std::move(walls));
    auto robot = std::make_shared<Robot>(*cell.robot);
    robot->joints[0].limit.lower = -std::numeric_limits<double>::infinity();
    robot->joints[0].limit.upper = std::numeric_limits<double>::infinity();
    cell.robot = robot;
    return cell;
  };
  // The same place two turns on.
  const Configuration start = test::configuration(-1, 0, 0),
                      goal = test::configuration(1 + 4 * 3.14159265358979, 0, 0);
  CollisionChecker one = checker_of(turning({wall_at("front", 0.0)}));
  EXPECT_FALSE(prove_apart(one, start, {goal}).apart);
  CollisionChecker two = checker_of(turning({wall_at("front", 0.0), wall_at("back", 3.0)}));
  const Separation separation = prove_apart(two, start, {goal});
  EXPECT_TRUE(separation.apart) << separation.reason;
  EXPECT_NE(separation.reason.find("front"), std::string::npos);
  EXPECT_NE(separation.reason.find("back"), std::string::npos);
}

// Folded, the arm passes between the walls; the plate that it holds over its links does not.
TEST(ProveApart, CountsWhatIsHeld) {
  std::vector<Body> walls{test::wall("front", {0.7, 0.2}, 0.70, 0.0),
                          test::wall("back", {0.7, 0.2}, -0.70, 0.0)};
  for (Body& wall : walls) wall.shapes = {Shape{Box{{0.7, 0.2, 1.0}}, Pose::Identity()}};
  Cell cell = test::planar_cell(walls);
  Body plate;
  plate.name = "plate";
  plate.shapes = {Shape{Box{{0.2, 0.8, 0.8}}, Pose::Identity()}};  // x of the hand is up
  plate.X_WB = test::at(3, 3);
  cell.parts = {plate};
  const Configuration start = test::configuration(-1.5, 0, 0),
                      goal = test::configuration(1.5, 0, 0);
  CollisionChecker empty = checker_of(cell);
  EXPECT_FALSE(prove_apart(empty, start, {goal}).apart);
  CollisionChecker holding = checker_of(cell.with_held(0, test::at(0.125, 0, 0)));
  ASSERT_TRUE(holding.is_free(start));
  ASSERT_TRUE(holding.is_free(goal));
  const Separation separation = prove_apart(holding, start, {goal});
  EXPECT_TRUE(separation.apart) << separation.reason;
  EXPECT_NE(separation.reason.find("held plate"), std::string::npos) << separation.reason;
}

TEST(ProveApart, SaysThatAGoalCollides) {
  CollisionChecker checker = checker_of(test::planar_cell({wall_at("wall", 0.0)}));
  const Separation separation =
      prove_apart(checker, test::configuration(-1, 0, 0), {test::configuration(0, 0, 0)});
  EXPECT_TRUE(separation.apart);
  EXPECT_NE(separation.reason.find("goal 0 collides"), std::string::npos) << separation.reason;
}

TEST(ProveApart, GivesUpWhereItMayNotLookFurther) {
  CollisionChecker checker = checker_of(walled_cell(2.6, 0.1));
  SeparationOptions options;
  options.most_cells = 100;
  const Separation separation = prove_apart(checker, folded(-1.5), {folded(2.2)}, options);
  EXPECT_FALSE(separation.apart);
  EXPECT_LE(separation.cells_looked_at, 130u);
  EXPECT_NE(separation.reason.find("given up after"), std::string::npos) << separation.reason;
}

TEST(ProveApart, AnswersTheSameEachTime) {
  CollisionChecker checker = checker_of(cluttered_cell(25));
  Random random(31);
  const Configuration start = folded(-1.5), goal = folded(1.0);
  const Separation one = prove_apart(checker, start, {goal});
  for (int i = 0; i < 5; ++i) checker.is_free(random.configuration(*checker.cell().robot));
  const Separation two = prove_apart(checker, start, {goal});
  EXPECT_EQ(one.reason, two.reason);
  EXPECT_EQ(one.cells_looked_at, two.cells_looked_at);
}

TEST(ProveApart, RefusesWrongInputs) {
  CollisionChecker checker = checker_of(test::planar_cell({}));
  const Configuration start = test::configuration(0, 0, 0);
  Configuration wider = start, longer = start, far = start, nan = start;
  wider.opening = 0.05;
  longer.q.conservativeResize(4);
  longer.q[3] = 0.0;
  far.q[1] = 3.0;
  nan.q[2] = std::nan("");
  const auto code = [&](const Configuration& from, const std::vector<Configuration>& to) {
    return test::code_of([&] { prove_apart(checker, from, to); });
  };
  EXPECT_EQ(code(start, {}), "E_EMPTY");
  EXPECT_EQ(code(start, {wider}), "E_RANGE");
  EXPECT_EQ(code(longer, {start}), "E_DOF");
  EXPECT_EQ(code(start, {start, far}), "E_LIMIT");
  EXPECT_EQ(code(nan, {start}), "E_NUMBER");
  SeparationOptions options;
  options.finest_level = 4;
  EXPECT_EQ(test::code_of([&] { prove_apart(checker, start, {start}, options); }), "E_RANGE");
  EXPECT_EQ(test::code_of([&] { BlockedCells(checker, std::nan("")); }), "E_NUMBER");
  BlockedCells blocked(checker, 0.04);
  EXPECT_EQ(test::code_of([&] { blocked.prove(0, {0, -1, 0}); }), "E_RANGE");
  EXPECT_EQ(test::code_of([&] { blocked.prove(-1, {0, 0, 0}); }), "E_RANGE");
}

}  // namespace
}  // namespace handey
