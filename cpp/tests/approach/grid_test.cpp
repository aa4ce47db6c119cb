// The motion grid errs on the full side only, by less than a cell, and its segment test misses no
// cell.
#include "handey/approach/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;

Region rectangle(double x0, double y0, double x1, double y1) {
  return {{{Vector2d(x0, y0), Vector2d(x1, y0), Vector2d(x1, y1), Vector2d(x0, y1)}}};
}

int filled_cells(const MotionGrid& grid, int layer) {
  int count = 0;
  for (int row = 0; row < grid.side(); ++row) {
    for (int column = 0; column < grid.side(); ++column) {
      count += grid.is_filled(layer, column, row) ? 1 : 0;
    }
  }
  return count;
}

Vector2d cell_centre(const MotionGrid& grid, int column, int row) {
  return grid.centre() +
         grid.cell() * Vector2d(column + 0.5 - 0.5 * grid.side(), row + 0.5 - 0.5 * grid.side());
}

Polygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> at(-0.12, 0.12);
  std::vector<Vector2d> points;
  for (int i = 0; i < 6; ++i) points.emplace_back(at(random), at(random));
  return convex_hull(points);
}

TEST(MotionGrid, IsEmptyAtFirst) {
  const MotionGrid grid({0.1, 0.2}, 0.05, 0.01, 2);
  EXPECT_EQ(grid.side(), 10);
  EXPECT_EQ(filled_cells(grid, 0) + filled_cells(grid, 1), 0);
}

TEST(MotionGrid, FillsTheCellsUnderARectangleInItsLayerOnly) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 2);
  grid.fill(1, rectangle(0.001, 0.001, 0.019, 0.029));
  EXPECT_EQ(filled_cells(grid, 0), 0);
  EXPECT_EQ(filled_cells(grid, 1), 2 * 3);
  EXPECT_TRUE(grid.is_filled(1, 5, 5));
  EXPECT_TRUE(grid.is_filled(1, 6, 7));
  EXPECT_FALSE(grid.is_filled(1, 7, 5));
}

TEST(MotionGrid, FillsCellsThatARegionOnlyTouchesAtTheirBorder) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(0.0, 0.0, 0.01, 0.01));
  EXPECT_EQ(filled_cells(grid, 0), 9);  // its own cell and the eight round it
}

TEST(MotionGrid, FillsASliverThinnerThanACell) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(-0.04, 0.0021, 0.04, 0.0022));
  EXPECT_EQ(filled_cells(grid, 0), 10);  // x from -0.04, which is a border, to +0.04, another
}

TEST(MotionGrid, LeavesHolesOpen) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  Region frame = rectangle(-0.045, -0.045, 0.045, 0.045);
  Polygon hole = rectangle(-0.025, -0.025, 0.025, 0.025).loops.front();
  std::reverse(hole.begin(), hole.end());
  frame.loops.push_back(hole);
  grid.fill(0, frame);
  EXPECT_EQ(filled_cells(grid, 0), 100 - 4 * 4);
  EXPECT_FALSE(grid.is_filled(0, 5, 5));
}

TEST(MotionGrid, FillsWhatReachesPastItsBorderUpToTheBorder) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(-1.0, -1.0, 1.0, 1.0));
  EXPECT_EQ(filled_cells(grid, 0), 100);
  MotionGrid beside({0.0, 0.0}, 0.05, 0.01, 1);
  beside.fill(0, rectangle(0.2, -1.0, 1.0, 1.0));
  EXPECT_EQ(filled_cells(beside, 0), 0);
}

TEST(MotionGrid, EveryPointOfARegionLiesInAFilledCell) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    MotionGrid grid({0.013, -0.007}, 0.1, 0.004, 1);
    const Polygon polygon = random_polygon(random);
    grid.fill(0, {{polygon}});
    for (int sample = 0; sample < 2000; ++sample) {
      Vector2d point = Vector2d::Zero();  // a convex combination of the corners
      double sum = 0.0;
      for (const Vector2d& corner : polygon) {
        const double weight = -std::log(share(random) + 1e-300);
        point += weight * corner;
        sum += weight;
      }
      point /= sum;
      if (!grid.is_inside(point)) continue;
      const Vector2d cell = (point - cell_centre(grid, 0, 0)) / grid.cell();
      EXPECT_TRUE(grid.is_filled(0, static_cast<int>(std::lround(cell.x())),
                                 static_cast<int>(std::lround(cell.y()))));
    }
  }
}

TEST(MotionGrid, EveryFilledCellMeetsTheRegion) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    MotionGrid grid({0.0, 0.0}, 0.1, 0.005, 1);
    const Region region{{random_polygon(random)}};
    grid.fill(0, region);
    for (int row = 0; row < grid.side(); ++row) {
      for (int column = 0; column < grid.side(); ++column) {
        if (!grid.is_filled(0, column, row)) continue;
        const Vector2d centre = cell_centre(grid, column, row);
        EXPECT_TRUE(contains(region, centre) ||
                    boundary_distance(region, centre) <= std::sqrt(0.5) * grid.cell() + 1e-6);
      }
    }
  }
}

TEST(MotionGrid, ASegmentTouchesTheCellsOfItsEnds) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(0.021, 0.021, 0.029, 0.029));
  EXPECT_TRUE(grid.touches(0, {0.025, 0.025}, {0.045, 0.025}));
  EXPECT_TRUE(grid.touches(0, {-0.045, 0.025}, {0.022, 0.025}));
  EXPECT_TRUE(grid.touches(0, {0.025, 0.025}, {0.025, 0.025}));
  EXPECT_FALSE(grid.touches(0, {0.015, 0.015}, {0.015, 0.015}));
  EXPECT_FALSE(grid.touches(0, {-0.045, 0.025}, {0.019, 0.025}));
}

TEST(MotionGrid, ADiagonalSegmentDoesNotSlipBetweenTwoCellsThatMeetAtACorner) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(0.001, 0.001, 0.009, 0.009));
  grid.fill(0, rectangle(0.011, 0.011, 0.019, 0.019));
  EXPECT_TRUE(grid.touches(0, {0.0, 0.02}, {0.02, 0.0}));
}

TEST(MotionGrid, OutsideIsFree) {
  MotionGrid grid({0.0, 0.0}, 0.05, 0.01, 1);
  grid.fill(0, rectangle(-1.0, -1.0, 1.0, 1.0));
  EXPECT_FALSE(grid.touches(0, {0.06, -0.2}, {0.06, 0.2}));
  EXPECT_FALSE(grid.touches(0, {-0.2, -0.051}, {0.2, -0.051}));
  EXPECT_TRUE(grid.touches(0, {-0.2, -0.2}, {0.2, 0.2}));
}

TEST(MotionGrid, ASegmentTouchesWhereverAPointOfItDoes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> at(-0.12, 0.12);
  for (int trial = 0; trial < 30; ++trial) {
    MotionGrid grid({0.0, 0.0}, 0.1, 0.004, 1);
    grid.fill(0, {{random_polygon(random)}});
    for (int sample = 0; sample < 200; ++sample) {
      const Vector2d a(at(random), at(random)), b(at(random), at(random));
      bool expected = false, surely = true;
      for (int i = 0; i <= 2000 && !expected; ++i) {
        expected = grid.touches(0, a + i / 2000.0 * (b - a), a + i / 2000.0 * (b - a));
        surely = !expected;
      }
      EXPECT_TRUE(!expected || grid.touches(0, a, b));
      // The other way round a sample may miss a corner that the segment cuts, by less than the
      // sampling step.
      if (surely && grid.touches(0, a, b)) {
        MotionGrid coarse = grid;
        bool near = false;
        for (int i = 0; i <= 2000 && !near; ++i) {
          const Vector2d p = a + i / 2000.0 * (b - a);
          const Vector2d reach = 2e-4 * (b - a).normalized();
          const Vector2d side(-reach.y(), reach.x());
          near = coarse.touches(0, p - side, p + side);
        }
        EXPECT_TRUE(near);
      }
    }
  }
}

TEST(MotionGrid, RefusesSizesThatMakeNoGrid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MotionGrid({0, 0}, 0.0, 0.01, 1), InvalidInput);
  EXPECT_THROW(MotionGrid({0, 0}, 0.1, -0.01, 1), InvalidInput);
  EXPECT_THROW(MotionGrid({0, 0}, nan, 0.01, 1), InvalidInput);
  EXPECT_THROW(MotionGrid({nan, 0}, 0.1, 0.01, 1), InvalidInput);
  EXPECT_THROW(MotionGrid({0, 0}, 10.0, 0.001, 1), InvalidInput);
  EXPECT_THROW(MotionGrid({0, 0}, 0.1, 0.01, 0), InvalidInput);
  EXPECT_NO_THROW(MotionGrid({0, 0}, 2.048, 0.001, 1));
  MotionGrid grid({0, 0}, 0.1, 0.01, 1);
  EXPECT_THROW(grid.fill(1, rectangle(0, 0, 1, 1)), InvalidInput);
  EXPECT_THROW(grid.fill(0, rectangle(0, 0, nan, 1)), InvalidInput);
}

}  // namespace
}  // namespace handey
