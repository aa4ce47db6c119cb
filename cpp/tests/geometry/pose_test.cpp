#include "handey/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

std::string code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.faults().front().code;
  }
  return "";
}

TEST(Pose, RollPitchYawTurnAboutFixedAxesInThatOrder) {
  const Pose pose = pose_from_xyz_rpy({1, 2, 3}, {kHalfTurn / 2, 0, kHalfTurn / 2});
  // y rolls to z, and yaw about the fixed z leaves it there.
  const Eigen::Vector3d moved = pose.linear() * Eigen::Vector3d::UnitY();
  EXPECT_LT((moved - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  // x is not moved by roll, then yaws to y.
  const Eigen::Vector3d x = pose.linear() * Eigen::Vector3d::UnitX();
  EXPECT_LT((x - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(Pose, QuaternionsSurviveTheRoundTrip) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector4d quaternion(normal(random), normal(random), normal(random), normal(random));
    quaternion.normalize();
    if (quaternion.w() < 0) quaternion = -quaternion;
    const Pose pose = pose_from_xyz_quat(Eigen::Vector3d::Zero(), quaternion);
    EXPECT_LT((quaternion_xyzw(pose) - quaternion).norm(), 1e-12);
    require_rigid(pose, "pose");
  }
}

TEST(Pose, NearlyUnitQuaternionsAreNormalisedExactly) {
  const Pose pose = pose_from_xyz_quat({0, 0, 0}, {0.7071, 0, 0, 0.7071});
  EXPECT_NEAR(pose.linear().determinant(), 1.0, 1e-15);
}

TEST(Pose, BadNumbersAreRefusedByName) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(code_of([&] { pose_from_xyz_rpy({nan, 0, 0}, {0, 0, 0}); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { pose_from_xyz_rpy({0, 0, 0}, {0, infinity, 0}); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { pose_from_xyz_quat({0, 0, 0}, {0, 0, 0, nan}); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { pose_from_xyz_quat({0, 0, 0}, {0, 0, 0, 1.002}); }), "E_QUATERNION");
  EXPECT_EQ(code_of([&] { pose_from_xyz_quat({0, 0, 0}, {0, 0, 0, 0}); }), "E_QUATERNION");
}

TEST(Pose, OnlyRigidTransformsPass) {
  Pose scaled = Pose::Identity();
  scaled.linear() *= 1.001;
  EXPECT_EQ(code_of([&] { require_rigid(scaled, "X"); }), "E_NUMBER");
  Pose mirrored = Pose::Identity();
  mirrored.linear()(0, 0) = -1;
  EXPECT_EQ(code_of([&] { require_rigid(mirrored, "X"); }), "E_NUMBER");
  Pose sheared = Pose::Identity();
  sheared.matrix()(3, 0) = 0.1;
  EXPECT_EQ(code_of([&] { require_rigid(sheared, "X"); }), "E_NUMBER");
  Pose unset = Pose::Identity();
  unset.translation().x() = std::nan("");
  EXPECT_EQ(code_of([&] { require_rigid(unset, "X"); }), "E_NUMBER");
  EXPECT_EQ(code_of([&] { require_rigid(Pose::Identity(), "X"); }), "");
}

}  // namespace
}  // namespace handey
