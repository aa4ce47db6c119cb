#include "handey/collision/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "handey/errors.hpp"
#include "solids_oracle.hpp"

namespace handey {
namespace {

using namespace testing;

Configuration between(const Configuration& a, const Configuration& b, double t) {
  return {a.q + t * (b.q - a.q), a.opening + t * (b.opening - a.opening)};
}

struct Tally {
  int certified = 0, colliding = 0, given_up = 0, evaluations = 0;
};

/// Certifies random edges until `wanted` are free; no sample on a free one may collide by the
/// oracle, and each edge on which a sample collides deeply must have been refused.
Tally try_edges(const Cell& cell, int wanted, std::uint64_t seed, int samples = 12) {
  const auto model = make_collision_model(cell);
  CollisionChecker checker(model, cell);
  const SolidsOracle oracle(cell);
  Random random(seed);
  Tally tally;
  for (int i = 0; i < 20 * wanted && tally.certified < wanted; ++i) {
    const Configuration a = random.configuration(*cell.robot);
    if (!checker.is_free(a)) continue;
    Configuration b = random.configuration(*cell.robot);
    b = between(a, b, std::pow(random.uniform(0.05, 1.0), 2));
    const EdgeResult result = certify_edge(checker, a, b);
    tally.evaluations += result.evaluations;
    if (!result.is_free()) {
      EXPECT_FALSE(result.hit.a.empty());
      EXPECT_GE(result.at, 0.0);
      EXPECT_LE(result.at, 1.0);
      ++(result.status == EdgeStatus::Colliding ? tally.colliding : tally.given_up);
      continue;
    }
    ++tally.certified;
    for (int k = 0; k < samples; ++k) {
      const double t = random.uniform(0.0, 1.0);
      const std::string hit = oracle.collision(between(a, b, t));
      EXPECT_EQ(hit, "") << "edge " << i << " at " << t;
      if (!hit.empty()) return tally;
    }
  }
  EXPECT_GE(tally.certified, wanted);
  return tally;
}

TEST(Certificate, NoSampleOfACertifiedEdgeCollidesAmongBoxes) {
  const Tally tally = try_edges(cluttered_cell(25), 2500, 11);
  EXPECT_GT(tally.colliding, 500);
  EXPECT_LT(tally.given_up, tally.colliding / 20);  // giving up is the exception
}

TEST(Certificate, NoSampleOfACertifiedEdgeCollidesWithAPartInTheHand) {
  Cell cell = cluttered_cell(15, 4);
  cell.parts.push_back(mesh_body("bracket", l_mesh(0.25, 0.03), at(0, 0, 0)));
  Pose X_HP = Pose::Identity();
  X_HP.translation() = Eigen::Vector3d(-0.1, 0, 0.01);
  try_edges(cell.with_held(1, X_HP), 1500, 12);
}

TEST(Certificate, NoSampleOfACertifiedEdgeCollidesAmongMeshesAndNestedSolids) {
  Cell cell = puma_cell();
  Random random(9);
  for (int i = 0; i < 4; ++i) {
    Pose X = random.pose(0.0);
    X.translation() = Eigen::Vector3d(random.uniform(0.3, 0.7), random.uniform(-0.6, 0.6),
                                      random.uniform(0.3, 1.2));
    cell.fixtures.push_back(mesh_body("l" + std::to_string(i), l_mesh(0.3, 0.06), X));
  }
  cell.fixtures.push_back(mesh_body("tray", tray_mesh({0.5, 0.4, 0.2}, 0.02), at(-0.6, 0.0, 0.9)));
  // Larger than the whole wrist: nothing but the point-in-solid test sees what is inside.
  cell.fixtures.push_back(mesh_body("rock", l_mesh(1.5, 0.7), at(0.2, 0.75, 0.9)));
  cell.parts.push_back(box_body("inner", {0.01, 0.01, 0.01}, at(0, 0, 0)));
  try_edges(cell.with_held(1, at(0, 0, 0)), 1500, 13);
}

TEST(Certificate, AThinWallIsNeverJumped) {
  // A wall of 1 mm across the workspace, and the waist swings the arm through it.
  Cell cell = puma_cell();
  cell.fixtures.push_back(box_body("wall", {0.8, 0.001, 3.0}, at(0.75, 0.0, 1.51)));
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(14);
  int tried = 0;
  for (int i = 0; i < 20000 && tried < 200; ++i) {
    const Configuration a = random.configuration(*cell.robot);
    Configuration b = a;
    b.q[0] -= random.uniform(0.3, 2.5);
    const Eigen::Vector3d from = hand_in_world(cell, a.q).translation();
    const Eigen::Vector3d to = hand_in_world(cell, b.q).translation();
    // The hand goes round the base from one side of the wall to the other, within the wall's
    // length.
    const double radius = from.head<2>().norm();
    if (from.x() < 0.2 || to.x() < 0.2 || from.y() < 0.0 || to.y() > 0.0) continue;
    if (radius < 0.5 || radius > 1.0 || !checker.is_free(a) || !checker.is_free(b)) continue;
    ++tried;
    const EdgeResult result = certify_edge(checker, a, b);
    EXPECT_FALSE(result.is_free()) << i;
    EXPECT_FALSE(result.hit.b.empty());
  }
  EXPECT_GT(tried, 50);
}

TEST(Certificate, AFreeEdgeIsProvedWithFewEvaluations) {
  const Cell cell = puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  Configuration b = cell.start;
  b.q[0] += 1.0;
  const EdgeResult result = certify_edge(checker, cell.start, b);
  EXPECT_TRUE(result.is_free()) << result.hit.a << " " << result.hit.b;
  EXPECT_LT(result.evaluations, 40);
}

TEST(Certificate, TheEdgeOfNoLengthIsItsConfiguration) {
  Cell cell = puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_TRUE(certify_edge(checker, cell.start, cell.start).is_free());
  cell.fixtures.push_back(box_body("lamp", {0.3, 0.3, 0.3}, hand_in_world(cell, cell.start.q)));
  CollisionChecker lit(make_collision_model(cell), cell);
  const EdgeResult result = certify_edge(lit, cell.start, cell.start);
  EXPECT_EQ(result.status, EdgeStatus::Colliding);
  EXPECT_EQ(result.hit.b, "lamp");
}

TEST(Certificate, AClosingFingerIsBoundedByHalfTheOpening) {
  // A post stands 10 mm inside the open finger: closing by 19 mm a side meets it, by 9 mm does not.
  Cell cell = puma_cell();
  const Pose X_WH = hand_in_world(cell, cell.start.q);
  cell.fixtures.push_back(
      box_body("post", {0.01, 0.01, 0.01}, X_WH * at(0, 0.05 - 0.01 - 0.005, 0)));
  CollisionChecker checker(make_collision_model(cell), cell);
  Configuration closed = cell.start;
  closed.opening = 0.1 - 2 * 0.009;
  EXPECT_TRUE(certify_edge(checker, cell.start, closed).is_free());
  closed.opening = 0.1 - 2 * 0.0105;
  const EdgeResult result = certify_edge(checker, cell.start, closed);
  EXPECT_FALSE(result.is_free());
  EXPECT_EQ(result.hit.b, "post");
}

TEST(Certificate, AStretchShorterThanTheResolutionIsGivenUp) {
  const Cell cell = cluttered_cell(15);
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(8);
  CertificateOptions coarse;
  coarse.resolution = 0.5;
  int given_up = 0, free = 0;
  for (int i = 0; i < 300; ++i) {
    const Configuration a = random.configuration(*cell.robot);
    const Configuration b = random.configuration(*cell.robot);
    const EdgeResult fine = certify_edge(checker, a, b),
                     rough = certify_edge(checker, a, b, coarse);
    if (rough.status == EdgeStatus::Free) EXPECT_EQ(fine.status, EdgeStatus::Free);
    if (rough.status != EdgeStatus::GivenUp) continue;
    ++given_up;
    EXPECT_GT(rough.hit.distance, coarse.clearance);
    EXPECT_LE(rough.evaluations, fine.evaluations);
    free += fine.is_free() ? 1 : 0;
  }
  EXPECT_GT(given_up, 10);
  EXPECT_GT(free, 0);
}

TEST(Certificate, MotionBoundIsNeverLessThanTheTravelOfAnyPoint) {
  const Cell cell = puma_cell().with_held(0, at(0, 0, 0.02));
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(15);
  for (int i = 0; i < 40; ++i) {
    const Configuration a = random.configuration(*cell.robot);
    const Configuration b =
        between(a, random.configuration(*cell.robot), random.uniform(0.01, 1.0));
    const double bound = motion_bound(checker, a, b);
    double most = 0.0;
    std::vector<Eigen::Vector3d> before;
    std::vector<double> travel;
    for (int k = 0; k <= 100; ++k) {
      const std::vector<Pose> poses = body_poses(*cell.robot, between(a, b, 0.01 * k));
      std::vector<Eigen::Vector3d> now;
      for (std::size_t body = 0; body < poses.size(); ++body) {
        for (const Shape& shape : cell.robot->bodies[body].shapes) {
          for (const Eigen::Vector3d& p : hull_points(shape)) now.push_back(poses[body] * p);
        }
      }
      travel.resize(now.size(), 0.0);
      for (std::size_t p = 0; p < now.size() && k > 0; ++p)
        most = std::max(most, travel[p] += (now[p] - before[p]).norm());
      before = now;
    }
    ASSERT_LE(most, bound + 1e-9) << i;
  }
}

TEST(Certificate, PathsReportTheEdgeAndThePlaceOnIt) {
  Cell cell = puma_cell();
  Configuration side = cell.start, far = cell.start;
  side.q[0] = 0.5;
  side.q[1] = far.q[1] = 1.0;  // leaning out
  far.q[0] = 1.5;
  Configuration middle = between(side, far, 0.5);
  cell.fixtures.push_back(box_body("lamp", {0.05, 0.05, 0.05}, hand_in_world(cell, middle.q)));
  CollisionChecker checker(make_collision_model(cell), cell);
  const EdgeResult result = certify_path(checker, {cell.start, cell.start, side, far});
  EXPECT_FALSE(result.is_free());
  EXPECT_GT(result.at, 2.0);
  EXPECT_LT(result.at, 3.0);
  EXPECT_EQ(result.hit.b, "lamp");
  EXPECT_TRUE(certify_path(checker, {cell.start}).is_free());
  EXPECT_THROW(certify_path(checker, {}), InvalidInput);
}

TEST(Certificate, WrongInputIsRefused) {
  const Cell cell = puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  Configuration bad = cell.start;
  bad.q[3] = std::nan("");
  EXPECT_THROW(certify_edge(checker, cell.start, bad), InvalidInput);
  EXPECT_THROW(certify_edge(checker, bad, cell.start), InvalidInput);
  bad.q = Eigen::VectorXd::Zero(5);
  EXPECT_THROW(certify_edge(checker, cell.start, bad), InvalidInput);
  CertificateOptions options;
  options.resolution = 0.0;
  EXPECT_THROW(certify_edge(checker, cell.start, cell.start, options), InvalidInput);
  options = {};
  options.clearance = -1.0;
  EXPECT_THROW(certify_edge(checker, cell.start, cell.start, options), InvalidInput);
}

}  // namespace
}  // namespace handey
