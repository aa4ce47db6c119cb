#include "handey/cspace/separation.hpp"

#include <gtest/gtest.h>

#include <string>
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

/// Random configurations in every blocked cell found, all joints after the third anywhere.
void expect_blocked_cells_collide(const Cell& cell, int samples, std::uint64_t seed) {
  CollisionChecker checker = checker_of(cell);
  const Robot& robot = *cell.robot;
  BlockedCells blocked(checker, 0.1);
  const Lattice& lattice = blocked.lattice();
  Random random(seed);
  int found = 0, cells = 0;
  for (int trial = 0; found < samples && trial < 100 * samples; ++trial) {
    const int level = trial % 3;
    CellIndex index{};
    for (int j = 0; j < 3; ++j) {
      const int count = lattice.cells(level, j);
      index[static_cast<std::size_t>(j)] =
          std::min(count - 1, static_cast<int>(random.uniform(0.0, count)));
    }
    const BlockedProof proof = blocked.prove(level, index);
    if (!proof.blocked) continue;
    ++cells;
    for (int k = 0; k < 20; ++k, ++found) {
      Configuration c = random.configuration(robot);
      c.opening = 0.1;
      for (int j = 0; j < 3; ++j) {
        // Corners of the cell as often as its inside.
        const double share =
            k % 2 == 0 ? random.uniform(-0.5, 0.5) : (random.uniform(-1.0, 1.0) < 0.0 ? -0.5 : 0.5);
        c.q[j] = lattice.centre(level, j, index[static_cast<std::size_t>(j)]) +
                 share * lattice.cell_width(level, j);
      }
      ASSERT_TRUE(checker.find_hit(c, 0.0).has_value())
          << proof.mover << " and " << proof.other << " at level " << level << ": "
          << c.q.transpose();
    }
  }
  EXPECT_GE(found, samples) << "in " << cells << " blocked cells";
}

TEST(BlockedCells, CollideEverywhereInClutter) {
  expect_blocked_cells_collide(cluttered_cell(25), 100000, 3);
}

}  // namespace
}  // namespace handey
