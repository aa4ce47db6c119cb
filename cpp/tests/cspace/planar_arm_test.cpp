#include "handey/cspace/planar_arm.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;

constexpr double kPi = 3.14159265358979323846;

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : generator_(seed) {}
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  Vector2d vector(double size) { return {uniform(-size, size), uniform(-size, size)}; }
  Polygon polygon(double spread, double size) {
    const Vector2d middle = vector(spread);
    std::vector<Vector2d> points;
    for (int i = 0; i < 8; ++i) points.push_back(middle + vector(size));
    return convex_hull(points);
  }

 private:
  std::mt19937_64 generator_;
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

bool holds(const Polygon& polygon, const Vector2d& point) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], point - polygon[i]) < 0) return false;
  }
  return true;
}

/// By crossing edges and points inside: another way than the sources'.
bool meet(const Polygon& a, const Polygon& b) {
  if (holds(a, b.front()) || holds(b, a.front())) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d p = a[i], q = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vector2d r = b[j], s = b[(j + 1) % b.size()];
      if (cross(q - p, r - p) * cross(q - p, s - p) <= 0 &&
          cross(s - r, p - r) * cross(s - r, q - r) <= 0) {
        return true;
      }
    }
  }
  return false;
}

Polygon placed(const Polygon& polygon, double angle, const Vector2d& at = Vector2d::Zero()) {
  Polygon result;
  for (const Vector2d& point : polygon) result.push_back(at + Eigen::Rotation2Dd(angle) * point);
  return result;
}

bool is_in(const std::vector<AngleInterval>& intervals, double angle) {
  for (const AngleInterval& interval : intervals) {
    if (interval.lower <= angle && angle <= interval.upper) return true;
  }
  return false;
}

bool near_a_limit(const std::vector<AngleInterval>& intervals, double angle) {
  for (const AngleInterval& interval : intervals) {
    if (std::abs(interval.lower - angle) < 1e-9 || std::abs(interval.upper - angle) < 1e-9) {
      return true;
    }
  }
  return false;
}

void expect_in_order(const std::vector<AngleInterval>& intervals) {
  double before = -1.0;
  for (const AngleInterval& interval : intervals) {
    EXPECT_GE(interval.lower, 0.0);
    EXPECT_LE(interval.upper, 2.0 * kPi);
    EXPECT_LE(interval.lower, interval.upper);
    EXPECT_GT(interval.lower, before);
    before = interval.upper;
  }
}

Polygon box(double left, double right, double low, double high) {
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

TEST(ForbiddenAngles, AgreeWithBruteForceOnRandomPairs) {
  Numbers numbers(1);
  int mismatches = 0, free = 0, blocked = 0;
  for (int pair = 0; pair < 300; ++pair) {
    const Polygon link = numbers.polygon(0.4, 0.4), obstacle = numbers.polygon(0.8, 0.4);
    const std::vector<AngleInterval> intervals = forbidden_angles(link, obstacle);
    expect_in_order(intervals);
    for (int i = 0; i < 3000; ++i) {
      const double angle = numbers.uniform(0.0, 2.0 * kPi);
      if (near_a_limit(intervals, angle)) continue;
      const bool truth = meet(placed(link, angle), obstacle);
      mismatches += truth != is_in(intervals, angle);
      ++(truth ? blocked : free);
    }
  }
  EXPECT_EQ(mismatches, 0);
  EXPECT_GT(free, 100000);
  EXPECT_GT(blocked, 100000);
}

TEST(ForbiddenAngles, OfARodAgainstAPostAreTheContactAngles) {
  // A rod 2 cm thick and 1 m long; a square post half a metre out on the y axis.
  const std::vector<AngleInterval> intervals =
      forbidden_angles(box(0, 1, -0.01, 0.01), box(-0.05, 0.05, 0.5, 0.6));
  ASSERT_EQ(intervals.size(), 1u);
  // The near corner of the post is 0.05 off the axis; the rod's side 0.01.
  const double corner = std::hypot(0.05, 0.5);
  const double half = std::asin(0.05 / corner) + std::asin(0.01 / corner);
  EXPECT_NEAR(intervals[0].lower, 0.5 * kPi - half, 1e-12);
  EXPECT_NEAR(intervals[0].upper, 0.5 * kPi + half, 1e-12);
}

TEST(ForbiddenAngles, PastTwoPiAreGivenInTwo) {
  const std::vector<AngleInterval> intervals =
      forbidden_angles(box(0, 1, -0.01, 0.01), box(0.5, 0.6, -0.05, 0.05));
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[0].lower, 0.0);
  EXPECT_EQ(intervals[1].upper, 2.0 * kPi);
  EXPECT_NEAR(intervals[0].upper, 2.0 * kPi - intervals[1].lower, 1e-12);
}

TEST(ForbiddenAngles, AreAllWhereTheObstacleHoldsTheJointAndNoneOutOfReach) {
  const std::vector<AngleInterval> all =
      forbidden_angles(box(0, 0.2, -0.01, 0.01), box(-1, 1, -1, 1));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].lower, 0.0);
  EXPECT_EQ(all[0].upper, 2.0 * kPi);
  EXPECT_TRUE(forbidden_angles(box(0, 0.2, -0.01, 0.01), box(0.3, 1, -1, 1)).empty());
  // The ring that the link sweeps, seen from within.
  EXPECT_TRUE(forbidden_angles(box(0.5, 0.6, -0.1, 0.1), box(-0.4, 0.4, -0.2, 0.2)).empty());
}

TEST(ForbiddenAngles, ATouchIsForbidden) {
  // The tip, a point, reaches the wall at one angle only.
  const Polygon link{{0, -0.1}, {1, 0}, {0, 0.1}};
  const std::vector<AngleInterval> intervals = forbidden_angles(link, box(-2, 2, 1, 2));
  ASSERT_EQ(intervals.size(), 1u);
  EXPECT_NEAR(intervals[0].lower, 0.5 * kPi, 1e-6);
  EXPECT_NEAR(intervals[0].upper, 0.5 * kPi, 1e-6);
}

TEST(ForbiddenAngles, OfPiecesAreTheUnion) {
  Numbers numbers(2);
  const std::vector<Polygon> links{numbers.polygon(0.5, 0.2), numbers.polygon(0.5, 0.2)};
  const std::vector<Polygon> obstacles{numbers.polygon(0.8, 0.2), numbers.polygon(0.8, 0.2)};
  const std::vector<AngleInterval> intervals = forbidden_angles(links, obstacles);
  expect_in_order(intervals);
  for (int i = 0; i < 5000; ++i) {
    const double angle = numbers.uniform(0.0, 2.0 * kPi);
    bool one = false;
    for (const Polygon& link : links) {
      for (const Polygon& obstacle : obstacles) {
        one = one || is_in(forbidden_angles(link, obstacle), angle);
      }
    }
    EXPECT_EQ(one, is_in(intervals, angle)) << angle;
  }
}

TEST(ForbiddenAngles, TakeEitherOrientationAndPolygonsWithoutArea) {
  Polygon link = box(0, 1, -0.01, 0.01), obstacle = box(-0.05, 0.05, 0.5, 0.6);
  const std::vector<AngleInterval> expected = forbidden_angles(link, obstacle);
  std::reverse(link.begin(), link.end());
  const std::vector<AngleInterval> found = forbidden_angles(link, obstacle);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].lower, expected[0].lower, 1e-15);
  // A line on the axis, and the wall across it.
  const Polygon line{{0, 0}, {0.5, 0}, {1, 0}}, wall{{0.5, -0.5}, {0.5, 0}, {0.5, 0.5}};
  const std::vector<AngleInterval> lines = forbidden_angles(line, wall);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[0].upper, kPi / 4, 1e-12);
  EXPECT_NEAR(lines[1].lower, 2.0 * kPi - kPi / 4, 1e-12);
}

TEST(ForbiddenAngles, RefusesPolygonsThatAreNone) {
  const Polygon good = box(0, 1, 0, 1), two{{0, 0}, {1, 0}}, wrong{{0, 0}, {1, 0}, {0, NAN}};
  EXPECT_THROW(forbidden_angles(two, good), InvalidInput);
  EXPECT_THROW(forbidden_angles(good, Polygon{}), InvalidInput);
  EXPECT_THROW(forbidden_angles(good, wrong), InvalidInput);
  PlanarArm arm{{good}, {good}, {NAN, 0}};
  EXPECT_THROW(planar_slice(arm, {good}, {0.0}), InvalidInput);
  arm.elbow = Vector2d(1, 0);
  EXPECT_THROW(planar_slice(arm, {good}, {INFINITY}), InvalidInput);
  EXPECT_THROW(planar_slice(arm, {two}, {0.0}), InvalidInput);
}

TEST(PlanarSlice, AgreesWithBruteForce) {
  Numbers numbers(3);
  int mismatches = 0, free = 0, blocked = 0;
  for (int scene = 0; scene < 40; ++scene) {
    PlanarArm arm;
    arm.upper = {box(-0.1, 0.5, -0.06, 0.06), numbers.polygon(0.2, 0.1)};
    arm.lower = {box(-0.05, 0.45, -0.04, 0.04), numbers.polygon(0.3, 0.1)};
    arm.elbow = Vector2d(0.45, 0.02);
    std::vector<Polygon> obstacles;
    for (int i = 0; i < 4; ++i) obstacles.push_back(numbers.polygon(0.9, 0.12));
    std::vector<double> theta2;
    for (int i = 0; i < 40; ++i) theta2.push_back(numbers.uniform(-7.0, 7.0));
    const auto columns = planar_slice(arm, obstacles, theta2);
    ASSERT_EQ(columns.size(), theta2.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      expect_in_order(columns[c]);
      const Vector2d elbow = Eigen::Rotation2Dd(theta2[c]) * arm.elbow;
      for (int i = 0; i < 100; ++i) {
        const double theta3 = numbers.uniform(0.0, 2.0 * kPi);
        if (near_a_limit(columns[c], theta3)) continue;
        bool truth = false;
        for (const Polygon& obstacle : obstacles) {
          for (const Polygon& piece : arm.upper) {
            truth = truth || meet(placed(piece, theta2[c]), obstacle);
          }
          for (const Polygon& piece : arm.lower) {
            truth = truth || meet(placed(piece, theta2[c] + theta3, elbow), obstacle);
          }
        }
        mismatches += truth != is_in(columns[c], theta3);
        ++(truth ? blocked : free);
      }
    }
  }
  EXPECT_EQ(mismatches, 0);
  EXPECT_GT(free, 10000);
  EXPECT_GT(blocked, 10000);
}

TEST(PlanarSlice, WithoutObstaclesForbidsNothing) {
  const PlanarArm arm{{box(0, 1, -0.1, 0.1)}, {box(0, 1, -0.1, 0.1)}, {1, 0}};
  for (const auto& column : planar_slice(arm, {}, {0.0, 1.0, 2.0})) EXPECT_TRUE(column.empty());
}

}  // namespace
}  // namespace handey
