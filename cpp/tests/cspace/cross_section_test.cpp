#include "handey/cspace/cross_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "../kinematics/test_arms.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using namespace testing;
using Eigen::Vector2d;
using Eigen::Vector3d;

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : generator_(seed) {}
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(uniform(0.0, count)); }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

 private:
  std::mt19937_64 generator_;
};

/// A three-joint arm: joint 1 about z, its body's joints 2 and 3 along `axis` at `shoulder`.
Robot three_joints(const Vector3d& axis, const Vector3d& shoulder, const Vector3d& upper_arm) {
  Robot robot;
  robot.name = "three";
  robot.bodies.push_back({"base", {}, {}});
  add_joint(robot, translation(0.1, -0.2, 0.3), Vector3d::UnitZ(), -kPi, kPi);
  add_joint(robot, translation(shoulder.x(), shoulder.y(), shoulder.z()), axis.normalized(), -kPi,
            kPi);
  add_joint(robot, translation(upper_arm.x(), upper_arm.y(), upper_arm.z()), axis.normalized(),
            -kPi, kPi);
  add_gripper(robot, translation(0.3, 0, 0));
  return robot;
}

SceneHull box_hull(const Vector3d& size, const Pose& X_RB) {
  SceneHull hull;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5, corner & 4 ? 0.5 : -0.5);
    hull.points.push_back(X_RB * size.cwiseProduct(sign));
    for (const int bit : {1, 2, 4}) {
      if ((corner & bit) == 0) hull.edges.emplace_back(corner, corner | bit);
    }
  }
  return hull;
}

/// A box with its twelve edges, or a few random points and the edges of all pairs: a superset of
/// the hull's.
SceneHull random_hull(Numbers& numbers) {
  const Vector3d middle = numbers.vector(1.0);
  const double size = numbers.uniform(0.01, 0.8);
  if (numbers.below(3) == 0) {
    Pose X = Pose::Identity();
    X.linear() = Eigen::AngleAxisd(numbers.uniform(-3, 3), numbers.vector(1.0).normalized())
                     .toRotationMatrix();
    X.translation() = middle;
    return box_hull(numbers.vector(size).cwiseAbs(), X);
  }
  SceneHull hull;
  const int count = 1 + numbers.below(10);
  for (int i = 0; i < count; ++i) {
    hull.points.push_back(middle + numbers.vector(size));
    for (int j = 0; j < i; ++j) hull.edges.emplace_back(j, i);
  }
  return hull;
}

bool within(const Polygon& polygon, const Vector2d& point, double tolerance = 1e-9) {
  if (polygon.size() < 3) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2d to = point - polygon[i];
    if (edge.x() * to.y() - edge.y() * to.x() < -tolerance * edge.norm() - 1e-15) return false;
  }
  return true;
}

/// Random points of the hull inside the slab at random waist angles of the interval, that the
/// polygon must contain. @return how many were tried
int count_points_inside(const ArmPlane& plane, const SceneHull& hull, const Slab& slab, double q1,
                        double half_width, const Polygon& polygon, int tries, Numbers& numbers,
                        int& violations) {
  int points = 0;
  for (int turn = 0; turn < 10; ++turn) {
    const double phi =
        turn < 2 ? (2 * turn - 1) * half_width : numbers.uniform(-half_width, half_width);
    const Pose X_ER = plane.X_RE(q1 + phi).inverse();
    std::vector<Vector3d> at;
    for (const Vector3d& point : hull.points) at.push_back(X_ER * point);
    for (int i = 0; i < tries / 10; ++i) {
      // On a random chord of the hull, often between two vertices.
      const auto point_of_hull = [&] {
        Vector3d point = at[static_cast<std::size_t>(numbers.below(static_cast<int>(at.size())))];
        for (const Vector3d& other : at) {
          if (numbers.below(4) == 0) point += numbers.uniform(0.0, 1.0) * (other - point);
        }
        return point;
      };
      const Vector3d a = point_of_hull(), b = point_of_hull();
      double from = 0.0, to = 1.0;
      const double rise = b.z() - a.z();
      if (rise == 0.0) {
        if (a.z() < slab.lower || a.z() > slab.upper) continue;
      } else {
        const double s = (slab.lower - a.z()) / rise, t = (slab.upper - a.z()) / rise;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
        if (from > to) continue;
      }
      const int kind = numbers.below(3);
      const double along = kind == 0 ? from : kind == 1 ? to : numbers.uniform(from, to);
      const Vector3d point = a + along * (b - a);
      ++points;
      if (!within(polygon, point.head<2>())) ++violations;
    }
  }
  return points;
}

void expect_sound(const Robot& robot, std::uint64_t seed, double widest, int wanted) {
  const std::optional<ArmPlane> plane = arm_plane(robot);
  ASSERT_TRUE(plane.has_value());
  Numbers numbers(seed);
  int points = 0, violations = 0, empty = 0;
  while (points < wanted && violations == 0) {
    const SceneHull hull = random_hull(numbers);
    const double lower = numbers.uniform(-0.4, 0.3);
    const Slab slab{lower, lower + std::pow(numbers.uniform(0.0, 0.7), 2)};
    const double q1 = numbers.uniform(-4.0, 4.0), half_width = numbers.uniform(0.0, widest);
    const Polygon polygon = cross_section(*plane, hull, slab, q1, half_width);
    empty += polygon.empty();
    if (!polygon.empty()) {
      EXPECT_GE(polygon.size(), 3u);
      EXPECT_GE(signed_area(polygon), 0.0);
    }
    points +=
        count_points_inside(*plane, hull, slab, q1, half_width, polygon, 400, numbers, violations);
  }
  EXPECT_EQ(violations, 0) << robot.name << " after " << points << " points";
  EXPECT_GT(empty, 10);
}

TEST(ArmPlane, OfThePumaHasTheWaistUprightAndTheElbowAtItsOffset) {
  const std::optional<ArmPlane> plane = arm_plane(puma());
  ASSERT_TRUE(plane.has_value());
  EXPECT_TRUE(plane->waist_axis.isApprox(Vector3d::UnitY(), 1e-12));
  EXPECT_NEAR(plane->waist_point.head<1>().norm(), 0.0, 1e-12);
  EXPECT_NEAR(plane->waist_point.z(), 0.0, 1e-12);
  EXPECT_NEAR(plane->elbow.x(), kA2, 1e-12);
  EXPECT_NEAR(plane->elbow.y(), 0.0, 1e-12);
  EXPECT_EQ(plane->elbow_sense, 1.0);
  EXPECT_TRUE(plane->X_RE(0.0).translation().isApprox(Vector3d(0, 0, kShoulderHeight), 1e-12));
}

/// Follows axis 3 and a point of the forearm through random configurations.
void expect_plane_follows(const Robot& robot) {
  const std::optional<ArmPlane> plane = arm_plane(robot);
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(plane->waist_axis.norm(), 1.0, 1e-12);
  const std::size_t elbow_body = static_cast<std::size_t>(robot.joints[2].child);
  Numbers numbers(5);
  const auto place = [&](const Vector3d& q, const Vector3d& point) -> Vector3d {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
    all.head<3>() = q;
    const Pose X_RB = body_poses(robot, {all, 0.0})[elbow_body];
    return plane->X_RE(q[0]).inverse() * X_RB * point;
  };
  for (int i = 0; i < 100; ++i) {
    const Vector3d q = numbers.vector(3.0), point = numbers.vector(0.4);
    const Vector3d axis_point = place(q, Vector3d::Zero());
    const Vector2d elbow = Eigen::Rotation2Dd(q[1]) * plane->elbow;
    EXPECT_NEAR((axis_point.head<2>() - elbow).norm(), 0.0, 1e-9);
    const Vector3d rest = place({q[0], 0.0, 0.0}, point), moved = place(q, point);
    const Vector2d expected = elbow + Eigen::Rotation2Dd(q[1] + plane->elbow_sense * q[2]) *
                                          Vector2d(rest.head<2>() - plane->elbow);
    EXPECT_NEAR((moved.head<2>() - expected).norm(), 0.0, 1e-9);
    EXPECT_NEAR(moved.z(), rest.z(), 1e-9);
  }
}

TEST(ArmPlane, HoldsTheForearmOfAnyArmWithParallelAxes) {
  expect_plane_follows(puma());
  expect_plane_follows(irb120());
  expect_plane_follows(ortho_parallel());
  expect_plane_follows(three_joints({0.1, 1, 0.2}, {0.1, 0.05, 0.4}, {0.3, 0.02, 0.1}));
  Robot opposed = three_joints({0, 1, 0}, {0, 0, 0.4}, {0.3, 0, 0});
  opposed.joints[2].axis = -opposed.joints[2].axis;
  expect_plane_follows(opposed);
  EXPECT_EQ(arm_plane(opposed)->elbow_sense, -1.0);
}

TEST(ArmPlane, OfAPlanarArmHasTheWaistAlongZ) {
  const Robot planar = three_joints(Vector3d::UnitZ(), {0.4, 0, 0}, {0.3, 0, 0});
  const std::optional<ArmPlane> plane = arm_plane(planar);
  ASSERT_TRUE(plane.has_value());
  EXPECT_TRUE(plane->waist_axis.isApprox(Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(plane->waist_point.head<2>().isApprox(Vector2d(-0.4, 0), 1e-12));
  EXPECT_TRUE(plane->elbow.isApprox(Vector2d(0.3, 0), 1e-12));
  expect_plane_follows(planar);
}

TEST(ArmPlane, OfTheIrb120HasItsLinkLengths) {
  const std::optional<ArmPlane> plane = arm_plane(irb120());
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(plane->elbow.x(), 0.0, 1e-12);
  EXPECT_NEAR(plane->elbow.y(), 0.27, 1e-12);
  EXPECT_TRUE(plane->waist_axis.isApprox(Vector3d::UnitY(), 1e-12));
}

TEST(ArmPlane, IsNotFoundWhereAxesTwoAndThreeAreNotParallel) {
  Robot robot = three_joints({0, 1, 0}, {0, 0, 0.4}, {0.3, 0, 0});
  robot.joints[2].axis = Vector3d(1e-4, 1, 0).normalized();
  std::string reason;
  EXPECT_FALSE(arm_plane(robot, &reason).has_value());
  EXPECT_NE(reason.find("parallel"), std::string::npos) << reason;
  EXPECT_NE(reason.find("joint3"), std::string::npos) << reason;
  robot.joints.resize(2);
  EXPECT_FALSE(arm_plane(robot, &reason).has_value());
  EXPECT_NE(reason.find("2 joints"), std::string::npos) << reason;
}

TEST(CrossSection, ContainsWhatReachesTheSlabOfThePuma) { expect_sound(puma(), 1, 0.1, 700000); }
TEST(CrossSection, ContainsWhatReachesTheSlabOfAWaistOffTheShoulder) {
  expect_sound(ortho_parallel(), 2, 0.1, 300000);
}
TEST(CrossSection, ContainsWhatReachesTheSlabWhereTheWaistIsTilted) {
  expect_sound(three_joints({0.4, 1, 0.5}, {0.1, 0.05, 0.4}, {0.3, 0.02, 0.1}), 3, 0.1, 500000);
}
TEST(CrossSection, ContainsWhatReachesTheSlabOfAPlanarArm) {
  expect_sound(three_joints({0, 0, 1}, {0.4, 0, 0}, {0.3, 0, 0}), 4, 0.1, 300000);
}
TEST(CrossSection, ContainsWhatReachesTheSlabInWideIntervals) {
  expect_sound(puma(), 5, kPi, 200000);
  expect_sound(three_joints({0.4, 1, 0.5}, {0.1, 0.05, 0.4}, {0.3, 0.02, 0.1}), 6, kPi, 200000);
}

TEST(CrossSection, OfABoxAtOneAngleIsItsTrueSection) {
  const std::optional<ArmPlane> plane = arm_plane(puma());
  Pose X = Pose::Identity();
  X.translation() = Vector3d(0.5, 0.0, kShoulderHeight);
  // The lateral axis of the Puma is -y of R at the waist's zero.
  const Polygon section =
      cross_section(*plane, box_hull({0.2, 0.1, 0.4}, X), {0.02, 0.03}, 0.0, 0.0);
  ASSERT_EQ(section.size(), 4u);
  EXPECT_NEAR(signed_area(section), 0.2 * 0.4, 1e-9);
  for (const Vector2d& point : section) {
    EXPECT_NEAR(std::abs(point.x() - 0.5), 0.1, 1e-9);
    EXPECT_NEAR(std::abs(point.y()), 0.2, 1e-9);
  }
  EXPECT_TRUE(cross_section(*plane, box_hull({0.2, 0.1, 0.4}, X), {0.051, 0.06}, 0.0, 0.0).empty());
}

TEST(CrossSection, GrowsNoMoreThanTheTurnMovesThingsInThePlane) {
  // 0.9 m out and at the forearm's lateral place, one degree to either side: the way in the plane
  // is the lateral coordinate's, 3.7 mm, not the whole turn's 15.7 mm; none of it in height.
  const std::optional<ArmPlane> plane = arm_plane(puma());
  Pose X = Pose::Identity();
  X.translation() = Vector3d(0.9, -0.15, kShoulderHeight);
  const Polygon section =
      cross_section(*plane, box_hull({0.1, 0.5, 0.1}, X), {0.1, 0.2}, 0.0, degrees(1.0));
  double lowest = 1, highest = -1, nearest = 2, farthest = 0;
  for (const Vector2d& point : section) {
    lowest = std::min(lowest, point.y());
    highest = std::max(highest, point.y());
    nearest = std::min(nearest, point.x());
    farthest = std::max(farthest, point.x());
  }
  EXPECT_NEAR(lowest, -0.05, 1e-12);
  EXPECT_NEAR(highest, 0.05, 1e-12);
  EXPECT_GT(nearest, 0.85 - 0.0042);
  EXPECT_LT(farthest, 0.95 + 0.0042);
}

TEST(CrossSection, MayHaveASlabWithoutBounds) {
  const double kInfinite = std::numeric_limits<double>::infinity();
  const std::optional<ArmPlane> plane = arm_plane(puma());
  Pose X = Pose::Identity();
  X.translation() = Vector3d(0.5, 0.3, kShoulderHeight);
  const Polygon section =
      cross_section(*plane, box_hull({0.2, 0.1, 0.4}, X), {-kInfinite, kInfinite}, 0.0, 0.0);
  EXPECT_NEAR(signed_area(section), 0.2 * 0.4, 1e-9);
}

TEST(CrossSection, RefusesWrongNumbers) {
  const ArmPlane plane = *arm_plane(puma());
  SceneHull hull = box_hull({0.2, 0.1, 0.4}, Pose::Identity());
  EXPECT_THROW(cross_section(plane, hull, {0.1, 0.0}, 0.0, 0.1), InvalidInput);
  EXPECT_THROW(cross_section(plane, hull, {0.0, std::nan("")}, 0.0, 0.1), InvalidInput);
  EXPECT_THROW(cross_section(plane, hull, {0.0, 0.1}, std::nan(""), 0.1), InvalidInput);
  EXPECT_THROW(cross_section(plane, hull, {0.0, 0.1}, 0.0, -0.1), InvalidInput);
  EXPECT_THROW(cross_section(plane, hull, {0.0, 0.1}, 0.0, 4.0), InvalidInput);
  EXPECT_THROW(WaistCell(plane, 0.0, 0.6), InvalidInput);
  hull.edges.emplace_back(0, 8);
  EXPECT_THROW(cross_section(plane, hull, {0.0, 0.1}, 0.0, 0.1), InvalidInput);
  hull.edges.pop_back();
  hull.points[3].x() = std::nan("");
  EXPECT_THROW(cross_section(plane, hull, {0.0, 0.1}, 0.0, 0.1), InvalidInput);
}

/// Every point that reaches the slab at an angle is in a torus whose window holds the angle.
void expect_tori_sound(const Robot& robot, std::uint64_t seed, int hulls) {
  const ArmPlane plane = *arm_plane(robot);
  Numbers numbers(seed);
  int points = 0;
  for (int i = 0; i < hulls; ++i) {
    const SceneHull hull = random_hull(numbers);
    const double lower = numbers.uniform(-0.3, 0.2);
    const Slab slab{lower, lower + numbers.uniform(0.0, 0.2)};
    const std::vector<Torus> tori = torus_of(plane, hull, slab);
    for (int k = 0; k < 200; ++k) {
      const double q1 = numbers.uniform(-kPi, kPi);
      const Polygon exact = cross_section(plane, hull, slab, q1, 0.0);
      if (exact.empty()) continue;
      ++points;
      bool held = false;
      for (const Torus& torus : tori) {
        const bool in_window =
            (torus.lower <= q1 && q1 <= torus.upper) || q1 + 2.0 * kPi <= torus.upper;
        if (!in_window) continue;
        held = true;
        for (const Vector2d& point : exact) held = held && within(torus.section, point, 1e-8);
      }
      ASSERT_TRUE(held) << "hull " << i << " at " << q1;
    }
  }
  EXPECT_GT(points, 20 * hulls);
}

TEST(TorusOf, ContainsTheSectionsOfAllAngles) {
  expect_tori_sound(puma(), 7, 150);
  expect_tori_sound(three_joints({0.4, 1, 0.5}, {0.1, 0.05, 0.4}, {0.3, 0.02, 0.1}), 8, 80);
}

TEST(TorusOf, APostIsMetOnceInFrontAndOnceBehind) {
  const ArmPlane plane = *arm_plane(puma());
  Pose X = Pose::Identity();
  X.translation() = Vector3d(-0.6, 0.05, 0.6);  // in front when the waist looks back: over pi
  const std::vector<Torus> tori = torus_of(plane, box_hull({0.05, 0.05, 1.2}, X), {-0.05, 0.05});
  ASSERT_EQ(tori.size(), 2u);
  const double window = 2.0 * std::asin(0.09 / 0.6);
  double ahead = 0.0;
  for (const Torus& torus : tori) {
    EXPECT_GE(torus.lower, -kPi);
    EXPECT_LT(torus.lower, kPi);
    EXPECT_LT(torus.upper - torus.lower, window + degrees(2.0));
    ahead += torus.section.front().x();
    if (torus.section.front().x() > 0) EXPECT_GT(torus.upper, kPi);  // it goes on round
  }
  EXPECT_LT(std::abs(ahead), 0.1);  // one on each side
}

TEST(TorusOf, WhatSurroundsTheWaistIsOneTorusAllRound) {
  const ArmPlane plane = *arm_plane(puma());
  Pose X = Pose::Identity();
  X.translation() = Vector3d(0.3, 0.0, -0.025);
  const std::vector<Torus> tori = torus_of(plane, box_hull({1.6, 1.2, 0.05}, X), {0.05, 0.2});
  ASSERT_EQ(tori.size(), 1u);
  EXPECT_EQ(tori[0].lower, -kPi);
  EXPECT_EQ(tori[0].upper, kPi);
  for (const Vector2d& point : tori[0].section) EXPECT_LT(point.y(), -kShoulderHeight + 1e-9);
}

TEST(TorusOf, WhatIsOutOfTheSlabIsNone) {
  const ArmPlane plane = *arm_plane(puma());
  EXPECT_TRUE(torus_of(plane, box_hull({0.2, 0.2, 0.2}, Pose::Identity()), {0.3, 0.4}).empty());
}

}  // namespace
}  // namespace handey
