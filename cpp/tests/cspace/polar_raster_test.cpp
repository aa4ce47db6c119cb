#include "../../src/cspace/polar_raster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../collision/puma_cell.hpp"

namespace handey {
namespace {

using cspace::PolarRaster;
using cspace::RingSpan;
using Eigen::Vector2d;
using testing::Random;

constexpr double kTurn = 2.0 * 3.14159265358979323846;

bool covers(const std::vector<RingSpan>& spans, int ring, double angle) {
  for (const RingSpan& span : spans) {
    if (span.ring != ring) continue;
    const double above = angle + kTurn * std::ceil((span.lower - angle) / kTurn);
    if (above <= span.upper) return true;
  }
  return false;
}

/// Where a ray from the origin goes through a convex counter-clockwise polygon.
bool ray_meets(const Polygon& polygon, double angle, double& from, double& to) {
  const Vector2d ray(std::cos(angle), std::sin(angle));
  from = 0.0;
  to = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double along = edge.x() * ray.y() - edge.y() * ray.x();
    const double at = edge.x() * polygon[i].y() - edge.y() * polygon[i].x();
    if (along > 0.0) from = std::max(from, at / along);
    if (along < 0.0) to = std::min(to, at / along);
    if (along == 0.0 && at > 0.0) return false;
  }
  return from <= to;
}

Polygon random_polygon(Random& random) {
  std::vector<Vector2d> points;
  const Vector2d centre(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
  const double size = random.uniform(0.02, 0.6), thin = random.uniform(0.0, 1.0) < 0.2 ? 1e-7 : 1.0;
  for (int i = 0; i < 7; ++i) {
    points.push_back(centre + size * Vector2d(random.uniform(-1, 1), thin * random.uniform(-1, 1)));
  }
  return convex_hull(points);
}

TEST(PolarRaster, FindsWhatRaysFindAndNoMore) {
  const double width = 0.05;
  const int rings = 20;
  PolarRaster raster(width, rings);
  Random random(1);
  int met = 0, more = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Polygon grown;
    cspace::grow(random_polygon(random), trial % 2 == 0 ? 1e-6 : 0.05, 0.8, grown);
    std::vector<RingSpan> spans;
    raster.add_spans(grown, spans);
    for (int i = 0; i < 60; ++i) {
      const double angle = random.uniform(0.0, kTurn);
      double from = 0.0, to = 0.0;
      const bool meets = ray_meets(grown, angle, from, to);
      for (int ring = 0; ring < rings; ++ring) {
        const bool in_ring = meets && from <= (ring + 1) * width && to >= ring * width;
        const bool covered = covers(spans, ring, angle);
        ASSERT_LE(in_ring, covered) << trial << ": ring " << ring << " at " << angle;
        met += in_ring ? 1 : 0;
        more += covered && !in_ring ? 1 : 0;
      }
    }
  }
  EXPECT_GT(met, 50000);
  EXPECT_LT(more, met / 500);
}

TEST(PolarRaster, GivesTwoSpansOfARingThatAWallLeavesAndEntersAgain) {
  PolarRaster raster(0.1, 10);
  std::vector<RingSpan> spans;
  raster.add_spans({{0.3, -0.6}, {0.32, -0.6}, {0.32, 0.6}, {0.3, 0.6}}, 5, 6, spans);
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_TRUE(covers(spans, 5, std::atan2(0.45, 0.31)));
  EXPECT_TRUE(covers(spans, 5, -std::atan2(0.45, 0.31)));
  EXPECT_FALSE(covers(spans, 5, 0.0));
}

TEST(PolarRaster, APolygonRoundTheOriginMeetsWholeRings) {
  PolarRaster raster(0.1, 10);
  std::vector<RingSpan> spans;
  raster.add_spans({{-0.35, -0.35}, {0.35, -0.35}, {0.35, 0.35}, {-0.35, 0.35}}, spans);
  for (double angle = 0.0; angle < kTurn; angle += 0.01) {
    EXPECT_TRUE(covers(spans, 0, angle));
    EXPECT_TRUE(covers(spans, 3, angle));
  }
  EXPECT_TRUE(covers(spans, 4, 0.7853981633974483));
  EXPECT_FALSE(covers(spans, 4, 0.0));
}

TEST(Grow, ContainsTheBallsAboutAllPoints) {
  Random random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const Polygon polygon = random_polygon(random);
    const double distance = random.uniform(1e-4, 0.2);
    Polygon grown;
    cspace::grow(polygon, distance, 0.8, grown);
    for (const Vector2d& point : polygon) {
      for (double angle = 0.0; angle < kTurn; angle += 0.1) {
        const Vector2d at = point + (distance - 1e-9) * Vector2d(std::cos(angle), std::sin(angle));
        for (std::size_t i = 0; i < grown.size(); ++i) {
          const Vector2d edge = grown[(i + 1) % grown.size()] - grown[i], arm = at - grown[i];
          ASSERT_GE(edge.x() * arm.y() - edge.y() * arm.x(), -1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace handey
