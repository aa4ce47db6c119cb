// A block in the hand that touches this and that, and short edges of the arm out of the contact.
#include "handey/collision/contact_motion.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;

/// The joint motion that moves the hand by `by` without turning it, to first order [m].
Eigen::VectorXd motion_of_hand(const Cell& cell, const Eigen::VectorXd& q,
                               const Eigen::Vector3d& by) {
  const double h = 1e-6;
  Eigen::MatrixXd jacobian(6, q.size());
  const Pose X = hand_in_world(cell, q);
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    Eigen::VectorXd moved = q;
    moved[j] += h;
    const Pose Y = hand_in_world(cell, moved);
    const Eigen::AngleAxisd turn(Y.linear() * X.linear().transpose());
    jacobian.col(j).head<3>() = (Y.translation() - X.translation()) / h;
    jacobian.col(j).tail<3>() = turn.angle() * turn.axis() / h;
  }
  Eigen::VectorXd wanted(6);
  wanted << by, Eigen::Vector3d::Zero();
  return jacobian.colPivHouseholderQr().solve(wanted);
}

/// A part of 40 x 40 x 60 mm in the hand, and fixtures that it touches.
struct Holding {
  explicit Holding(const Body& part) : cell(puma_cell()) {
    cell.start.q << 0.3, 1.0, -2.6, 0.2, 0.6, 0.1;  // off all singularities
    cell.start.opening = 0.04;
    hand = hand_in_world(cell, cell.start.q).translation();
    cell.parts = {part};
    Pose X_WP = Pose::Identity();
    X_WP.translation() = hand;
    const Pose X_WH = hand_in_world(cell, cell.start.q);
    held = HeldPart{0, X_WH.inverse() * X_WP};
  }
  void touch(const Body& fixture) { cell.fixtures.push_back(fixture); }

  ContactMotion move(const Eigen::Vector3d& by, const ContactMotionOptions& options = {}) {
    cell.held = held;
    Allowance allowance;
    for (std::size_t i = 0; i < cell.fixtures.size(); ++i) {
      allowance.held_touches.push_back({BodyRef::Kind::Fixture, static_cast<int>(i)});
    }
    const auto model = make_collision_model(cell);
    CollisionChecker clear(model, cell), in_contact(model, cell, allowance);
    const Eigen::VectorXd q = cell.start.q + motion_of_hand(cell, cell.start.q, by);
    return follow_contacts(clear, in_contact, cell.start, {q, cell.start.opening}, options);
  }

  Cell cell;
  Eigen::Vector3d hand = Eigen::Vector3d::Zero();
  HeldPart held;
};

Body block() { return box_body("part", {0.04, 0.04, 0.06}, at(0, 0, 0)); }

/// Top face `sunk` above the underside of the part.
Body ground(const Holding& holding, double sunk = 0.0) {
  const Eigen::Vector3d& p = holding.hand;
  return box_body("ground", {0.3, 0.3, 0.02}, at(p.x(), p.y(), p.z() - 0.04 + sunk));
}

Body wall(const Holding& holding, double side) {
  const Eigen::Vector3d& p = holding.hand;
  return box_body(side < 0 ? "left wall" : "wall", {0.02, 0.3, 0.06},
                  at(p.x() + side * 0.03, p.y(), p.z()));
}

TEST(FollowContacts, ALiftOffTheGroundIsProved) {
  Holding holding(block());
  holding.touch(ground(holding));
  const ContactMotion motion = holding.move({0, 0, 0.0015});
  EXPECT_FALSE(motion.deeper.has_value());
  EXPECT_EQ(motion.proved, 1);
  EXPECT_EQ(motion.measured, 0);
}

TEST(FollowContacts, AMeshThatIsNotConvexIsProvedByWhatItStandsOn) {
  Body part = mesh_body("part", l_mesh(0.06, 0.02), at(0, 0, 0));
  Holding holding(part);
  const Eigen::Vector3d& p = holding.hand;
  holding.touch(box_body("ground", {0.3, 0.3, 0.02}, at(p.x(), p.y(), p.z() - 0.01)));
  const ContactMotion up = holding.move({0, 0, 0.0015});
  EXPECT_FALSE(up.deeper.has_value());
  EXPECT_EQ(up.measured, 0);
  EXPECT_TRUE(holding.move({0, 0, -0.0015}).deeper.has_value());
}

TEST(FollowContacts, AContactThatOverlapsALittleMayStayAsDeep) {
  Holding holding(block());
  holding.touch(ground(holding, 3e-4));
  EXPECT_FALSE(holding.move({0, 0, 0.0015}).deeper.has_value());
  EXPECT_TRUE(holding.move({0, 0, -3e-4}).deeper.has_value());
}

TEST(FollowContacts, SlidingBetweenTwoWallsIsProved) {
  Holding holding(block());
  holding.touch(ground(holding));
  holding.touch(wall(holding, -1));
  holding.touch(wall(holding, 1));
  const ContactMotion motion = holding.move({0, 0, 0.0015});
  EXPECT_FALSE(motion.deeper.has_value()) << motion.deeper->b;
  EXPECT_EQ(motion.proved, 3);
}

TEST(FollowContacts, IntoTheGroundOrAWallIsNamed) {
  Holding holding(block());
  holding.touch(ground(holding));
  const ContactMotion down = holding.move({0, 0, -0.0015});
  ASSERT_TRUE(down.deeper.has_value());
  EXPECT_EQ(down.deeper->b, "ground");
  EXPECT_LT(down.deeper->distance, -1e-4);
  holding.touch(wall(holding, 1));
  const ContactMotion aside = holding.move({0.0015, 0, 0});
  ASSERT_TRUE(aside.deeper.has_value());
  EXPECT_EQ(aside.deeper->b, "wall");
}

TEST(FollowContacts, AThinLipBehindThePartIsNotPassedThrough) {
  Holding holding(block());
  const Eigen::Vector3d& p = holding.hand;
  // 0.8 mm thick, over the part's edge: at the end of the edge the part would be beyond it.
  holding.touch(box_body("lip", {0.01, 0.3, 0.0008}, at(p.x(), p.y(), p.z() + 0.0304)));
  EXPECT_TRUE(holding.move({0, 0, 0.0015}).deeper.has_value());
}

TEST(FollowContacts, WithoutAPlaneTheDepthsAreMeasured) {
  // An L hooked over a rod: the rod lies within the hull of the L.
  Holding holding(mesh_body("part", l_mesh(0.06, 0.02), at(0, 0, 0)));
  const Eigen::Vector3d& p = holding.hand;
  holding.touch(box_body("rod", {0.01, 0.3, 0.01}, at(p.x() + 0.025, p.y(), p.z() + 0.025)));
  const ContactMotion off = holding.move({0.0, 0, -0.0015});
  EXPECT_FALSE(off.deeper.has_value());
  EXPECT_EQ(off.measured, 1);
  EXPECT_TRUE(holding.move({0, 0, 0.0015}).deeper.has_value());
}

TEST(FollowContacts, WhatIsKeptApartAnywayIsNotLookedAt) {
  Holding holding(block());
  const ContactMotion motion = holding.move({0, 0, -0.0015});
  EXPECT_FALSE(motion.deeper.has_value());
  EXPECT_EQ(motion.proved + motion.measured, 0);
}

/// Planes never say more than depths measured along the edge do.
TEST(FollowContacts, NoContactThatIsProvedIsMeasuredDeeper) {
  Random random(7);
  int proved = 0, deeper = 0;
  for (int i = 0; i < 60; ++i) {
    Holding holding(block());
    holding.touch(ground(holding, random.uniform(-2e-4, 3e-4)));
    holding.touch(wall(holding, 1));
    const Eigen::Vector3d by(random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3),
                             random.uniform(-1e-3, 1e-3));
    const ContactMotion motion = holding.move(by);
    if (motion.deeper) ++deeper;
    if (motion.deeper || motion.measured > 0) continue;
    ++proved;
    const auto model = make_collision_model(holding.cell);
    CollisionChecker clear(model, holding.cell);
    const Eigen::VectorXd dq = motion_of_hand(holding.cell, holding.cell.start.q, by);
    for (int k = 0; k <= 20; ++k) {
      const Configuration at{holding.cell.start.q + k / 20.0 * dq, 0.04};
      for (const Hit& hit : robot_overlaps(clear, at, 0.0)) {
        if (hit.a == "held part") EXPECT_GT(hit.distance, -5e-4);
      }
    }
  }
  EXPECT_GT(proved, 10);
  EXPECT_GT(deeper, 10);
}

TEST(FollowContacts, RefusesWrongInput) {
  Holding holding(block());
  ContactMotionOptions options;
  options.stations = 0;
  EXPECT_THROW(holding.move({0, 0, 1e-3}, options), InvalidInput);
  options = {};
  options.deepest = options.deeper / 2;
  EXPECT_THROW(holding.move({0, 0, 1e-3}, options), InvalidInput);
  EXPECT_THROW(holding.move({0, 0, NAN}), InvalidInput);
}

}  // namespace
}  // namespace handey
