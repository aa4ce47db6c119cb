// Claims about the tree of points: it answers as a loop over all points does, to the last bit.
#include "handey/geometry/point_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace handey {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> random_points(int count, bool on_ball, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    Vector3d point(uniform(generator), uniform(generator), uniform(generator));
    if (on_ball) point.normalize();
    points.emplace_back(0.05 * point + Vector3d(3.0, -2.0, 0.1));
    if (i % 5 == 0) points.push_back(points.back());
  }
  return points;
}

TEST(PointTree, AnswersAsALoopOverAllPoints) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const int count : {1, 8, 9, 100, 1000}) {
    for (const bool on_ball : {false, true}) {
      const std::vector<Vector3d> points = random_points(count, on_ball, generator);
      const PointTree tree(points);
      for (int i = 0; i < 100; ++i) {
        Vector3d direction(uniform(generator), uniform(generator), uniform(generator));
        if (i % 4 == 0) direction = Vector3d::Unit(i / 4 % 3);
        double farthest = -std::numeric_limits<double>::infinity();
        for (const Vector3d& point : points) farthest = std::max(farthest, direction.dot(point));
        EXPECT_EQ(tree.farthest(direction), farthest);
        EXPECT_FALSE(tree.is_any_beyond(direction, farthest));
        EXPECT_TRUE(tree.is_any_beyond(direction, std::nextafter(farthest, -1e9)));
        const double level = farthest - 0.02 * std::abs(uniform(generator));
        std::vector<int> beyond;
        for (std::size_t k = 0; k < points.size(); ++k) {
          if (direction.dot(points[k]) > level) beyond.push_back(static_cast<int>(k));
        }
        EXPECT_EQ(tree.beyond(direction, level), beyond);
      }
    }
  }
}

TEST(PointTree, OfNoPointsReachesNowhere) {
  const std::vector<Vector3d> none;
  const PointTree tree(none);
  EXPECT_EQ(tree.farthest(Vector3d::UnitX()), -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(tree.is_any_beyond(Vector3d::UnitX(), -1e9));
  EXPECT_TRUE(tree.beyond(Vector3d::UnitX(), -1e9).empty());
}

}  // namespace
}  // namespace handey
