// Shut in: said of a part in a box that is shut or whose opening is too small for a ball in it, at
// either end, with the box's name; never where the part is led out, or found out by sampling.
#include "handey/cspace/shut_in.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "../grasp/parts.hpp"
#include "../kinematics/puma.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;
using testing::box_body;
using testing::puma;
using testing::translation;

Shape box_at(const Vector3d& size, const Vector3d& at) {
  return {Box{size}, translation(at.x(), at.y(), at.z())};
}

/// Walls 10 mm thick round a room of 200 x 200 x 100 mm; in the lid a window of x by y.
Body cage(double x, double y) {
  Body body;
  body.name = "cage";
  const double half = 0.1, high = 0.1, thick = 0.01;
  for (const double side : {-1.0, 1.0}) {
    body.shapes.push_back(box_at({0.22, thick, high}, {0, side * (half + 0.005), 0.05}));
    body.shapes.push_back(box_at({thick, 0.22, high}, {side * (half + 0.005), 0, 0.05}));
    const double wide = half - 0.5 * x, deep = half - 0.5 * y, lid = high + 0.5 * thick;
    if (wide > 0)
      body.shapes.push_back(box_at({wide, 0.2, thick}, {side * 0.5 * (half + 0.5 * x), 0, lid}));
    if (deep > 0)
      body.shapes.push_back(
          box_at({x > 0 ? x : 0.01, deep, thick}, {0, side * 0.5 * (half + 0.5 * y), lid}));
  }
  body.X_WB = translation(0.5, 0.3, 0.0);
  return body;
}

/// On a table, the part in the hand.
Cell bench(const std::vector<Body>& fixtures, const Body& part) {
  Cell cell;
  cell.robot = puma();
  cell.start.q = Eigen::VectorXd::Zero(6);
  cell.start.opening = 0.1;
  cell.fixtures.push_back(box_body("table", {3, 3, 0.05}, translation(0, 0, -0.025)));
  cell.fixtures.insert(cell.fixtures.end(), fixtures.begin(), fixtures.end());
  cell.parts.push_back(part);
  return cell.with_held(0, Pose::Identity());
}

Body block() { return box_body("block", {0.04, 0.08, 0.05}); }
const Pose kInside = translation(0.5, 0.3, 0.025);
const Pose kElsewhere = translation(0.5, -0.3, 0.025);

ShutIn prove(const std::vector<Body>& fixtures, const Body& part, const Pose& from, const Pose& to,
             const ShutInOptions& options = {}) {
  const Cell cell = bench(fixtures, part);
  CollisionChecker checker(make_collision_model(cell), cell);
  return prove_shut_in(checker, from, to, options);
}

TEST(ShutIn, TellsTheBoxRoundEitherEnd) {
  const ShutIn from = prove({cage(0, 0)}, block(), kInside, kElsewhere);
  EXPECT_TRUE(from.shut_in) << from.reason;
  EXPECT_EQ(from.end, 0);
  EXPECT_NEAR(from.radius, 0.02, 1e-4);
  ASSERT_FALSE(from.bodies.empty());
  EXPECT_EQ(from.bodies.front(), "cage");
  const ShutIn to = prove({cage(0, 0)}, block(), kElsewhere, kInside);
  EXPECT_TRUE(to.shut_in) << to.reason;
  EXPECT_EQ(to.end, 1);
}

TEST(ShutIn, IsSaidOfAWindowNarrowerThanTheBall) {
  const ShutIn narrow = prove({cage(0.12, 0.034)}, block(), kInside, kElsewhere);
  EXPECT_TRUE(narrow.shut_in) << narrow.reason;
  EXPECT_GT(narrow.resolution, 0.0);
}

TEST(ShutIn, IsNotSaidWhereThePartPasses) {
  EXPECT_FALSE(prove({}, block(), kInside, kElsewhere).shut_in);
  // 40 by 80 mm, straight up through it, with a millimetre to spare.
  EXPECT_FALSE(prove({cage(0.042, 0.082)}, block(), kInside, kElsewhere).shut_in);
  // As wide as the part: what may touch may pass.
  EXPECT_FALSE(prove({cage(0.04, 0.08)}, block(), kInside, kElsewhere).shut_in);
  // Out of one cage, into another.
  Body other = cage(0.06, 0.1);
  other.name = "another cage";
  other.X_WB = translation(0.5, -0.3, 0.0);
  EXPECT_FALSE(prove({cage(0.06, 0.1), other}, block(), kInside, kElsewhere).shut_in);
}

TEST(ShutIn, IsNotSaidOfAPartThatStandsClose) {
  // Between two walls that it touches, on the table: it goes straight up.
  const Body left = box_body("left", {0.02, 0.2, 0.2}, translation(0.47, 0.3, 0.1));
  const Body right = box_body("right", {0.02, 0.2, 0.2}, translation(0.53, 0.3, 0.1));
  const ShutIn found = prove({left, right}, block(), kInside, kElsewhere);
  EXPECT_FALSE(found.shut_in);
}

/// Random boxes, in a room that is shut in every third trial; a cube walks at random: where it came
/// it is not shut in.
TEST(ShutIn, IsNeverSaidOfWhereAWalkLeads) {
  std::mt19937_64 generator(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator() >> 11) / 9007199254740992.0;
  };
  const Body cube = box_body("cube", {0.03, 0.03, 0.03});
  int apart = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const bool shut = trial % 3 == 0;
    std::vector<Body> fixtures;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int i = 0; i < (shut ? 4 : 30); ++i) {
      const Vector3d size(between(0.03, 0.15), between(0.03, 0.15), between(0.03, 0.15));
      const Vector3d at(between(0.3, 0.7), between(0.0, 0.4), between(0.05, 0.35));
      fixtures.push_back(
          box_body("box" + std::to_string(i), size, translation(at.x(), at.y(), at.z())));
      boxes.emplace_back(at - 0.5 * size, at + 0.5 * size);
    }
    if (shut) {
      fixtures.push_back(box_body("front", {0.02, 0.26, 0.3}, translation(0.38, 0.2, 0.15)));
      fixtures.push_back(box_body("back", {0.02, 0.26, 0.3}, translation(0.62, 0.2, 0.15)));
      fixtures.push_back(box_body("left", {0.26, 0.02, 0.3}, translation(0.5, 0.08, 0.15)));
      fixtures.push_back(box_body("right", {0.26, 0.02, 0.3}, translation(0.5, 0.32, 0.15)));
      fixtures.push_back(box_body("roof", {0.26, 0.26, 0.02}, translation(0.5, 0.2, 0.31)));
    }
    const auto is_free = [&](const Vector3d& at) {
      const Vector3d middle(0.5, 0.2, 0.2);
      if (shut && ((at - middle).cwiseAbs().array() > 0.09).any()) return false;
      if (at.z() < 0.0151) return false;
      const Eigen::AlignedBox3d here(at - Vector3d::Constant(0.015),
                                     at + Vector3d::Constant(0.015));
      for (const auto& box : boxes) {
        if (box.intersects(here)) return false;
      }
      return true;
    };
    Vector3d at(0.5, 0.2, 0.2);
    for (int k = 0; k < 200 && !is_free(at); ++k) {
      at = Vector3d(between(0.3, 0.7), between(0.0, 0.4), between(0.05, 0.35));
    }
    if (!is_free(at)) continue;
    const Vector3d from = at;
    for (int k = 0; k < 3000; ++k) {
      Vector3d next = at;
      next[static_cast<Eigen::Index>(generator() % 3)] += between(-0.008, 0.008);
      if (is_free(next)) at = next;  // steps shorter than any box is wide
    }
    const ShutIn walked = prove(fixtures, cube, translation(from.x(), from.y(), from.z()),
                                translation(at.x(), at.y(), at.z()));
    EXPECT_FALSE(walked.shut_in) << "trial " << trial;
    const ShutIn out = prove(fixtures, cube, translation(from.x(), from.y(), from.z()), kElsewhere);
    apart += out.shut_in;
  }
  EXPECT_GE(apart, 5);  // the first place is seldom taken
}

TEST(ShutIn, RefusesAnEmptyHandAndBadOptions) {
  Cell cell = bench({}, block());
  CollisionChecker holding(make_collision_model(cell), cell);
  ShutInOptions options;
  options.finest = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(prove_shut_in(holding, kInside, kElsewhere, options), InvalidInput);
  cell.held.reset();
  CollisionChecker empty(make_collision_model(cell), cell);
  EXPECT_THROW(prove_shut_in(empty, kInside, kElsewhere), InvalidInput);
}

}  // namespace
}  // namespace handey
