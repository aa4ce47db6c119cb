#include "handey/cspace/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../kinematics/test_arms.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using namespace testing;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(Lattice, CellsOfEachLevelTileTheRangesOfThePumaExactly) {
  const Robot robot = puma();
  const Lattice lattice = make_lattice(robot);
  EXPECT_EQ(lattice.count, (std::array<int, 3>{40, 34, 34}));  // 320, 270 and 270 degrees
  for (int level = 0; level < Lattice::kLevels; ++level) {
    for (int j = 0; j < 3; ++j) {
      const JointLimit& limit = robot.joints[static_cast<std::size_t>(j)].limit;
      const double half = 0.5 * lattice.cell_width(level, j);
      const int last = lattice.cells(level, j) - 1;
      EXPECT_LE(2.0 * half, degrees(8.0) / (1 << level) + 1e-12);
      EXPECT_NEAR(lattice.centre(level, j, 0) - half, limit.lower, 1e-12);
      EXPECT_NEAR(lattice.centre(level, j, last) + half, limit.upper, 1e-12);
      EXPECT_FALSE(lattice.wraps[static_cast<std::size_t>(j)]);
    }
  }
}

TEST(Lattice, ACellIsTwoCellsOfTheNextLevel) {
  const Lattice lattice = make_lattice(puma());
  for (int index = 0; index < lattice.cells(1, 2); ++index) {
    const double low = lattice.centre(2, 2, 2 * index), high = lattice.centre(2, 2, 2 * index + 1);
    EXPECT_NEAR(0.5 * (low + high), lattice.centre(1, 2, index), 1e-12);
  }
}

TEST(Lattice, JointsWithoutLimitsWrapFromMinusPiToPi) {
  Robot robot = puma();
  robot.joints[0].limit.lower = -kInfinite;
  robot.joints[0].limit.upper = kInfinite;
  const Lattice lattice = make_lattice(robot);
  EXPECT_TRUE(lattice.wraps[0]);
  EXPECT_FALSE(lattice.wraps[1]);
  EXPECT_EQ(lattice.count[0], 45);
  EXPECT_NEAR(lattice.lower[0], -kPi, 1e-15);
  EXPECT_NEAR(lattice.width[0] * lattice.count[0], 2.0 * kPi, 1e-12);
  EXPECT_EQ(lattice.index_of(0, 0, 3.0 * kPi + 0.01), 0);
  EXPECT_EQ(lattice.index_of(0, 0, -kPi - 0.01), 44);
}

TEST(Lattice, TheCellOfAnAngleHoldsIt) {
  const Lattice lattice = make_lattice(puma());
  for (int level = 0; level < Lattice::kLevels; ++level) {
    for (int i = 0; i < lattice.cells(level, 1); ++i) {
      const double centre = lattice.centre(level, 1, i),
                   half = 0.499 * lattice.cell_width(level, 1);
      EXPECT_EQ(lattice.index_of(level, 1, centre - half), i);
      EXPECT_EQ(lattice.index_of(level, 1, centre + half), i);
    }
  }
  EXPECT_EQ(lattice.index_of(0, 1, degrees(-45.0)), 0);
  EXPECT_EQ(lattice.index_of(0, 1, degrees(225.0)), 33);
  EXPECT_EQ(lattice.index_of(0, 1, degrees(225.1)), -1);
  EXPECT_EQ(lattice.index_of(0, 1, degrees(-45.1)), -1);
}

TEST(Lattice, AFixedJointHasOneCell) {
  Robot robot = puma();
  robot.joints[1].limit.lower = robot.joints[1].limit.upper = 0.5;
  const Lattice lattice = make_lattice(robot);
  EXPECT_EQ(lattice.count[1], 1);
  EXPECT_EQ(lattice.centre(0, 1, 0), 0.5);
  EXPECT_EQ(lattice.index_of(0, 1, 0.5), 0);
}

TEST(Lattice, RefusesWrongWidthsAndRobots) {
  Robot robot = puma();
  for (const double coarse : {0.0, -0.1, 4.0, kInfinite, std::nan("")}) {
    EXPECT_THROW(make_lattice(robot, coarse), InvalidInput) << coarse;
  }
  Robot two = robot;
  two.joints.resize(2);
  EXPECT_THROW(make_lattice(two), InvalidInput);
  robot.joints[2].limit.upper = kInfinite;  // only one of the two
  EXPECT_THROW(make_lattice(robot), InvalidInput);
}

}  // namespace
}  // namespace handey
