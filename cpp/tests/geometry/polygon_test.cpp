#include "handey/geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Polygon reversed(Polygon polygon) { return {polygon.rbegin(), polygon.rend()}; }

Region frame() { return {{rectangle(0, 0, 1, 1), reversed(rectangle(0.2, 0.2, 0.8, 0.8))}}; }

Polygon random_polygon(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(0.0, 0.1);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 6; ++i) points.emplace_back(coordinate(random), coordinate(random));
  return convex_hull(points);
}

TEST(Polygon, HolesAreTakenOffTheArea) {
  EXPECT_DOUBLE_EQ(signed_area(rectangle(0, 0, 2, 3)), 6.0);
  EXPECT_DOUBLE_EQ(signed_area(reversed(rectangle(0, 0, 2, 3))), -6.0);
  EXPECT_NEAR(area(frame()), 0.64, 1e-12);
}

TEST(Polygon, InclusionAndExclusionHoldForRandomPolygons) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const Region a{{random_polygon(random)}};
    const Region b{{random_polygon(random)}};
    const double common = area(intersect(a, b));
    EXPECT_NEAR(area(unite({a, b})), area(a) + area(b) - common, 2e-7);
    EXPECT_NEAR(area(subtract(a, b)), area(a) - common, 2e-7);
  }
}

TEST(Polygon, MembershipAgreesWithBooleansOnRandomPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0.0, 0.1);
  for (int i = 0; i < 50; ++i) {
    const Region a{{random_polygon(random)}};
    const Region b{{random_polygon(random)}};
    const Region both = intersect(a, b);
    const Region only_a = subtract(a, b);
    for (int j = 0; j < 50; ++j) {
      const Eigen::Vector2d point(coordinate(random), coordinate(random));
      if (boundary_distance(a, point) < 1e-6 || boundary_distance(b, point) < 1e-6) continue;
      EXPECT_EQ(contains(both, point), contains(a, point) && contains(b, point));
      EXPECT_EQ(contains(only_a, point), contains(a, point) && !contains(b, point));
    }
  }
}

TEST(Polygon, AHoleFilledByAnotherRegionIsFull) {
  const Region plug{{rectangle(0.1, 0.1, 0.9, 0.9)}};
  const Region full = unite({frame(), plug});
  ASSERT_EQ(full.loops.size(), 1u);
  EXPECT_NEAR(area(full), 1.0, 1e-9);
}

TEST(Polygon, LoopsThatOverlapUniteAndClockwiseOnesCancel) {
  EXPECT_NEAR(area(region_of_loops({rectangle(0, 0, 2, 1), rectangle(1, 0, 3, 1)})), 3.0, 1e-9);
  EXPECT_TRUE(region_of_loops({rectangle(0, 0, 1, 1), reversed(rectangle(0, 0, 1, 1))}).empty());
  EXPECT_TRUE(region_of_loops({reversed(rectangle(0, 0, 1, 1))}).empty());
}

// Above a certain number the sides at which neighbours meet are cancelled first.
TEST(Polygon, ManyTilesAndAHoleBetweenThemAreOneRegion) {
  std::vector<Polygon> tiles;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      if (i == 20 && j == 20) continue;
      tiles.push_back(rectangle(0.01 * i, 0.01 * j, 0.01 * (i + 1), 0.01 * (j + 1)));
    }
  }
  const Region region = region_of_loops(tiles);
  EXPECT_EQ(region.loops.size(), 2U);
  EXPECT_NEAR(area(region), 0.16 - 1e-4, 1e-9);
  tiles.push_back(rectangle(0.0, 0.0, 0.4, 0.4));  // over all of them
  EXPECT_NEAR(area(region_of_loops(tiles)), 0.16, 1e-9);
  tiles.push_back(reversed(rectangle(0.0, 0.0, 0.4, 0.4)));
  EXPECT_NEAR(area(region_of_loops(tiles)), 0.16 - 1e-4, 1e-9);
}

TEST(Polygon, AGrownRegionContainsTheTrueOffset) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(0.0, 6.2831853);
  for (int i = 0; i < 50; ++i) {
    const Region region{{random_polygon(random)}};
    const Region grown = offset(region, 0.01);
    for (const Eigen::Vector2d& vertex : region.loops.front()) {
      for (int j = 0; j < 20; ++j) {
        const double a = angle(random);
        EXPECT_TRUE(
            contains(grown, vertex + 0.0099999 * Eigen::Vector2d(std::cos(a), std::sin(a))));
      }
    }
  }
}

TEST(Polygon, AShrunkRegionStaysAwayFromTheBoundary) {
  const Region shrunk = offset(frame(), -0.05);
  EXPECT_NEAR(area(shrunk), 0.9 * 0.9 - 0.7 * 0.7, 1e-6);
  for (const Polygon& loop : shrunk.loops) {
    for (const Eigen::Vector2d& point : loop)
      EXPECT_GE(boundary_distance(frame(), point), 0.05 - 1e-6);
  }
  EXPECT_TRUE(offset(frame(), -0.11).empty());
}

TEST(Polygon, PartsComeLargestFirstWithTheirHoles) {
  Region region = frame();
  region.loops.push_back(rectangle(0.4, 0.4, 0.6, 0.6));  // an island in the hole
  region.loops.push_back(rectangle(2, 0, 4, 1));
  const std::vector<Region> parts = connected_parts(region);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_NEAR(area(parts[0]), 2.0, 1e-6);
  EXPECT_NEAR(area(parts[1]), 0.64, 1e-6);
  EXPECT_EQ(parts[1].loops.size(), 2u);
  EXPECT_NEAR(area(parts[2]), 0.04, 1e-6);
}

TEST(Polygon, TheInscribedCircleAvoidsTheHole) {
  const InscribedCircle circle = largest_inscribed_circle({{rectangle(0, 0, 0.4, 0.1)}}, 1e-5);
  EXPECT_NEAR(circle.radius, 0.05, 1e-5);
  const InscribedCircle beside = largest_inscribed_circle(frame(), 1e-5);
  // In a corner of the frame, touching two sides and the hole's corner: r = 0.2 sqrt2 / (1 +
  // sqrt2).
  EXPECT_NEAR(beside.radius, 0.2 * std::sqrt(2.0) / (1.0 + std::sqrt(2.0)), 1e-5);
  EXPECT_TRUE(contains(frame(), beside.centre));
  EXPECT_EQ(largest_inscribed_circle({}).radius, 0.0);
}

TEST(Polygon, TheHullHasNoCollinearPoints) {
  const Polygon hull = convex_hull(
      std::vector<Eigen::Vector2d>{{0, 0}, {1, 0}, {0.5, 0}, {1, 1}, {0, 1}, {0, 0.5}, {0.3, 0.3}});
  ASSERT_EQ(hull.size(), 4u);
  EXPECT_DOUBLE_EQ(signed_area(hull), 1.0);
}

TEST(Polygon, NonsenseIsRefused) {
  const Region bad{{{{0, 0}, {1, 0}, {std::nan(""), 1}}}};
  EXPECT_THROW(unite({bad}), InvalidInput);
  EXPECT_THROW(offset(frame(), std::nan("")), InvalidInput);
  EXPECT_THROW(largest_inscribed_circle(frame(), 0.0), InvalidInput);
  EXPECT_THROW(unite({Region{{rectangle(0, 0, 1e9, 1)}}}), InvalidInput);
}

TEST(ConvexHull, KeepsTheCornersOfSidesThatAreNearlyUpright) {
  // The left side's middle is a hair to the left, its lower end next, its upper end last: along
  // such a side the order by x says nothing.
  const Polygon hull = convex_hull(std::vector<Eigen::Vector2d>{
      {0.0, 0.5}, {1e-17, 0.0}, {2e-17, 1.0}, {1.0, 0.0}, {1.0 + 2e-16, 0.5}, {1.0, 1.0}});
  EXPECT_NEAR(signed_area(hull), 1.0, 1e-12);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0.0, 6.3);
  for (int i = 0; i < 2000; ++i) {  // a square with points along its sides, turned
    const double turn = i % 2 == 0 ? angle(random) : 1.5707963267948966 * (i % 7);
    std::vector<Eigen::Vector2d> points;
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) {
        points.emplace_back(x * std::cos(turn) - y * std::sin(turn),
                            x * std::sin(turn) + y * std::cos(turn));
      }
    }
    const Polygon square = convex_hull(points);
    EXPECT_EQ(square.size(), 4u) << turn;
    EXPECT_NEAR(signed_area(square), 9.0, 1e-9) << turn;
  }
}

}  // namespace
}  // namespace handey
