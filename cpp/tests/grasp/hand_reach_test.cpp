// Beyond reach: never said of a part that some configuration holds; said of one that is plainly
// too far, with a distance that is nearly the true one.
#include "handey/grasp/hand_reach.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../kinematics/puma.hpp"
#include "handey/errors.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::puma;
using testing::translation;

Eigen::VectorXd random_configuration(const Robot& robot, std::mt19937& random) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointLimit& limit = robot.joints[j].limit;
    q[static_cast<Eigen::Index>(j)] =
        std::uniform_real_distribution<double>(limit.lower, limit.upper)(random);
  }
  return q;
}

TEST(HandReach, WristCentreStaysWithinItsReach) {
  const SphericalWristSolver solver(*puma());
  const WristReach reach = solver.wrist_reach();
  std::mt19937 random(3);
  double farthest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Pose X_RH = hand_pose(*puma(), random_configuration(*puma(), random));
    const Eigen::Vector3d from = X_RH * reach.p_HC - reach.centre;
    const double along = from.dot(reach.axis);
    const double out = (from - along * reach.axis).norm() - reach.radius;
    const double distance = std::hypot(along, out);
    EXPECT_LE(distance, reach.farthest + 1e-9);
    farthest = std::max(farthest, distance);
  }
  EXPECT_GT(farthest, 0.98 * reach.farthest);
}

TEST(HandReach, IsNotDeniedToWhatAPadTouches) {
  const SphericalWristSolver solver(*puma());
  const Gripper& gripper = puma()->gripper;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-0.5, 0.5);
  for (int i = 0; i < 2000; ++i) {
    const Pose X_RH = hand_pose(*puma(), random_configuration(*puma(), random));
    // A thin rod between the pads, held at its far end by any point of them.
    Body rod = box_body("rod", {0.01, 0.04, 0.2});
    const Pose X_HP = translation(share(random) * gripper.pad_width, 0.0,
                                  0.1 + share(random) * gripper.pad_length);
    EXPECT_LE(beyond_reach(solver.wrist_reach(), gripper, rod, X_RH * X_HP), 0.0);
  }
}

TEST(HandReach, IsDeniedWithTheDistanceThatIsMissing) {
  const SphericalWristSolver solver(*puma());
  const WristReach reach = solver.wrist_reach();
  const Gripper& gripper = puma()->gripper;
  const Body cube = box_body("cube", {0.04, 0.04, 0.04});
  const double most = reach.radius + reach.farthest + hand_length(reach, gripper);
  const double at_shoulder = reach.centre.z();
  const Pose beside = translation(most + 0.02 + 0.1, 0.0, at_shoulder);
  EXPECT_NEAR(beyond_reach(reach, gripper, cube, beside), 0.1, 1e-5);
  EXPECT_LT(beyond_reach(reach, gripper, cube, translation(most, 0.0, at_shoulder)), 0.0);
  // A long part may be far away at one end.
  const Body beam = box_body("beam", {2.0, 0.04, 0.04});
  EXPECT_LT(beyond_reach(reach, gripper, beam, translation(1.2, 0.0, 0.2)), 0.0);
}

TEST(HandReach, RefusesAPartWithoutShapesAndAPoseThatIsNotRigid) {
  const SphericalWristSolver solver(*puma());
  const Gripper& gripper = puma()->gripper;
  Body nothing;
  nothing.name = "nothing";
  EXPECT_THROW(beyond_reach(solver.wrist_reach(), gripper, nothing, Pose::Identity()),
               InvalidInput);
  Pose scaled = Pose::Identity();
  scaled.linear() *= 2.0;
  const Body cube = box_body("cube", {0.04, 0.04, 0.04});
  EXPECT_THROW(beyond_reach(solver.wrist_reach(), gripper, cube, scaled), InvalidInput);
}

}  // namespace
}  // namespace handey
