// Bump lines surround their piece at the clearance; pieces follow the gripper's shapes.
#include "handey/approach/bump_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;

GripperOutline one_piece(const Polygon& polygon) {
  GripperOutline outline;
  outline.pieces.push_back({polygon, -0.01, 0.01});
  return outline;
}

TEST(BumpLines, StandTheClearanceOffEachSideOfASquare) {
  const std::vector<BumpLine> lines =
      bump_lines(one_piece({{0, 0}, {0.02, 0}, {0.02, 0.02}, {0, 0.02}}), 0.005);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NEAR((lines[0].normal - Vector2d(0, -1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((lines[0].a - Vector2d(-0.005, -0.005)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((lines[0].b - Vector2d(0.025, -0.005)).norm(), 0.0, 1e-12);
}

TEST(BumpLines, CutOffTheSpikeOfASharpCorner) {
  const std::vector<BumpLine> lines =
      bump_lines(one_piece({{0, -0.01}, {0.2, 0}, {0, 0.01}}), 0.005);
  for (const BumpLine& line : lines) {
    EXPECT_LE(line.a.x(), 0.205 + 1e-9);
    EXPECT_LE(line.b.x(), 0.205 + 1e-9);
  }
}

TEST(BumpLines, RunRoundEveryConvexPieceWithoutAGapAtTheClearanceOrMore) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-0.05, 0.05);
  const double clearance = 0.006;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 3 + trial % 8; ++i) points.emplace_back(at(random), at(random));
    const Polygon polygon = convex_hull(points);
    const std::vector<BumpLine> lines = bump_lines(one_piece(polygon), clearance);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_NEAR(lines[i].normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR((lines[i].b - lines[(i + 1) % lines.size()].a).norm(), 0.0, 1e-12);
      const Vector2d along = lines[i].b - lines[i].a;
      EXPECT_LT(along.x() * lines[i].normal.y() - along.y() * lines[i].normal.x(), 0.0);
      EXPECT_NEAR(along.dot(lines[i].normal), 0.0, 1e-12);
      double farthest = -1.0;  // of the piece along the normal
      for (const Vector2d& corner : polygon)
        farthest = std::max(farthest, lines[i].normal.dot(corner));
      EXPECT_NEAR(lines[i].normal.dot(lines[i].a) - farthest, clearance, 1e-9);
    }
  }
}

TEST(BumpLines, RefuseAPieceThatIsNotConvexOrClockwise) {
  EXPECT_THROW(bump_lines(one_piece({{0, 0}, {0, 1}, {1, 1}, {1, 0}}), 0.01), InvalidInput);
  EXPECT_THROW(bump_lines(one_piece({{0, 0}, {1, 0}, {0.5, 0.2}, {0.5, 1}}), 0.01), InvalidInput);
  EXPECT_THROW(bump_lines(one_piece({{0, 0}, {1, 0}}), 0.01), InvalidInput);
  EXPECT_THROW(bump_lines(one_piece({{0, 0}, {1, 0}, {1, 1}}), 0.0), InvalidInput);
}

}  // namespace
}  // namespace handey
