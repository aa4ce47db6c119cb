// Pad contact by hand and against sampling; targets by what is promised of them.
#include "handey/grasp/target.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

Region rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

// A square frame: 80 mm outside, 40 mm hole.
Region frame() {
  return subtract(rectangle(-0.04, -0.04, 0.04, 0.04), rectangle(-0.02, -0.02, 0.02, 0.02));
}

TEST(PadContactArea, IsThePadsOnALargeFace) {
  const Gripper gripper;
  EXPECT_NEAR(pad_contact_area(rectangle(-1, -1, 1, 1), {0.1, 0.2, 0.7}, gripper), 0.02 * 0.03,
              1e-12);
}

TEST(PadContactArea, FollowsThePadsLengthAlongTheApproach) {
  const Gripper gripper;  // 20 wide, 30 long
  const Region strip = rectangle(-0.005, -1.0, 0.005, 1.0);
  EXPECT_NEAR(pad_contact_area(strip, {0, 0, 0}, gripper), 0.01 * 0.02, 1e-12);
  EXPECT_NEAR(pad_contact_area(strip, {0, 0, M_PI / 2}, gripper), 0.01 * 0.03, 1e-12);
  EXPECT_NEAR(pad_contact_area(strip, {0.02, 0, 0}, gripper), 0.0, 1e-12);
  EXPECT_NEAR(pad_contact_area(strip, {0.015, 0, 0}, gripper), 0.005 * 0.02, 1e-12);
}

TEST(PadContactArea, AgreesWithSampledAreasOnARegionWithHoles) {
  const Gripper gripper;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.05, 0.05), turn(-M_PI, M_PI), unit(-0.5, 0.5);
  const Region region = unite({frame(), rectangle(0.03, -0.01, 0.06, 0.012)});
  for (int trial = 0; trial < 40; ++trial) {
    const PlanarPose pose{place(random), place(random), turn(random)};
    int inside = 0;
    constexpr int kSamples = 4000;
    for (int i = 0; i < kSamples; ++i) {
      const double along = unit(random) * gripper.pad_length;
      const double across = unit(random) * gripper.pad_width;
      const double c = std::cos(pose.theta), s = std::sin(pose.theta);
      inside +=
          contains(region, {pose.x + c * along - s * across, pose.y + s * along + c * across});
    }
    const double pad = gripper.pad_length * gripper.pad_width;
    EXPECT_NEAR(pad_contact_area(region, pose, gripper) / pad, inside / double{kSamples}, 0.04);
  }
}

TEST(NearestPoint, IsThePointItselfInsideAndOnTheBorderOutside) {
  EXPECT_EQ(nearest_point(frame(), {0.03, 0.0}), Eigen::Vector2d(0.03, 0.0));
  EXPECT_TRUE(nearest_point(frame(), {0.01, 0.001}).isApprox(Eigen::Vector2d(0.02, 0.001), 1e-6));
  EXPECT_TRUE(nearest_point(frame(), {0.1, 0.1}).isApprox(Eigen::Vector2d(0.04, 0.04), 1e-6));
  EXPECT_EQ(nearest_point({}, {0.1, 0.1}), Eigen::Vector2d(0.1, 0.1));
}

TEST(FingertipTargets, BeginAtTheCentreOfMassWhereTheFaceIsLarge) {
  const std::vector<Eigen::Vector2d> targets =
      fingertip_targets(rectangle(-0.06, -0.04, 0.06, 0.04), {0.01, 0.005}, Gripper{}, 5);
  ASSERT_EQ(targets.size(), 5u);
  EXPECT_LT((targets[0] - Eigen::Vector2d(0.01, 0.005)).norm(), 1e-9);
}

TEST(FingertipTargets, KeepHalfAPadFromTheBorderWhereTheFaceIsWideEnough) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  for (int trial = 0; trial < 20; ++trial) {
    const double x = place(random), y = place(random);
    const Region region =
        subtract(rectangle(-0.06, -0.04, 0.06, 0.04), rectangle(x, y, x + 0.03, y + 0.03));
    const Eigen::Vector2d centre(place(random), 0.3 * place(random));
    for (const Eigen::Vector2d& target : fingertip_targets(region, centre, Gripper{}, 5)) {
      EXPECT_TRUE(contains(region, target));
      EXPECT_GT(boundary_distance(region, target), 0.01 - 2e-6);
    }
  }
}

TEST(FingertipTargets, LieApartAndInEveryLargePiece) {
  const Region two =
      unite({rectangle(-0.06, -0.02, -0.01, 0.02), rectangle(0.01, -0.02, 0.06, 0.02)});
  const std::vector<Eigen::Vector2d> targets = fingertip_targets(two, {-0.03, 0.0}, Gripper{}, 4);
  ASSERT_EQ(targets.size(), 4u);
  EXPECT_TRUE(std::any_of(targets.begin(), targets.end(), [](const auto& t) { return t.x() > 0; }));
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE((targets[i] - targets[j]).norm(), 0.005);
  }
}

TEST(FingertipTargets, ExistOnAStripNarrowerThanAPad) {
  const std::vector<Eigen::Vector2d> targets =
      fingertip_targets(rectangle(-0.03, -0.002, 0.03, 0.002), {0.0, 0.0}, Gripper{}, 3);
  ASSERT_FALSE(targets.empty());
  EXPECT_NEAR(targets[0].x(), 0.0, 1e-6);
}

TEST(FingertipTargets, OfNothingAreNoneAndBadNumbersAreRefused) {
  EXPECT_TRUE(fingertip_targets({}, {0.0, 0.0}, Gripper{}, 3).empty());
  EXPECT_THROW(fingertip_targets(frame(), {std::nan(""), 0.0}, Gripper{}, 3), InvalidInput);
  EXPECT_THROW(fingertip_targets(frame(), {0.0, 0.0}, Gripper{}, 0), InvalidInput);
}

}  // namespace
}  // namespace handey
