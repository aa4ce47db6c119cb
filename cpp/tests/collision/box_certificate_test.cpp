// Claims about the proof of boxes of configurations: what is called free is free all over, for
// boxes within others too, next to meshes, with a part in the hand; and hopeless boxes are told.
#include "handey/collision/box_certificate.hpp"

#include <gtest/gtest.h>

#include <ostream>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::Random;

ConfigurationBox random_box(const Robot& robot, Random& random, double widest) {
  ConfigurationBox box{random.configuration(robot), Eigen::VectorXd(6)};
  box.centre.opening = 0.08;
  for (int j = 0; j < 6; ++j) {
    const bool moves = random.uniform(0.0, 1.0) < 0.7;
    box.half(j) = moves ? random.uniform(0.0, widest) : 0.0;
  }
  return box;
}

Configuration within(const ConfigurationBox& box, Random& random) {
  Configuration drawn = box.centre;
  for (int j = 0; j < 6; ++j) {
    // Corners are where a bound fails first.
    const double side = random.uniform(-1.5, 1.5);
    drawn.q(j) += box.half(j) * std::clamp(side, -1.0, 1.0);
  }
  return drawn;
}

Cell with_held_part() {
  Cell cell = testing::cluttered_cell(15);
  Pose X_HP = Pose::Identity();
  X_HP.translation() = Eigen::Vector3d(0.02, 0.0, 0.01);
  return cell.with_held(0, X_HP);
}

Cell with_meshes() {
  Cell cell = testing::puma_cell();
  cell.fixtures.push_back(testing::mesh_body("tray", testing::tray_mesh({0.3, 0.3, 0.15}, 0.01),
                                             testing::at(0.5, 0.2, 0.3)));
  cell.fixtures.push_back(
      testing::mesh_body("bracket", testing::l_mesh(0.4, 0.05), testing::at(0.3, -0.5, 0.4)));
  return cell;
}

struct NamedCell {
  const char* name;
  Cell (*make)();
};
std::ostream& operator<<(std::ostream& out, const NamedCell& cell) { return out << cell.name; }

class BoxProofIn : public ::testing::TestWithParam<NamedCell> {};

TEST_P(BoxProofIn, CallsNoBoxFreeInWhichAConfigurationCollides) {
  const Cell cell = GetParam().make();
  CollisionChecker checker(make_collision_model(cell), cell),
      oracle(make_collision_model(cell), cell);
  BoxProver prover(checker);
  Random random(3);
  int proved = 0, sampled = 0;
  for (int i = 0; i < 6000; ++i) {
    const ConfigurationBox box = random_box(*cell.robot, random, i % 2 == 0 ? 0.02 : 0.2);
    if (!prover.prove(box).free) continue;
    ++proved;
    for (int k = 0; k < 60; ++k, ++sampled) {
      const std::optional<Hit> hit = oracle.find_hit(within(box, random), 0.99e-4);
      ASSERT_FALSE(hit.has_value()) << hit->a << " and " << hit->b << ": " << hit->distance;
    }
  }
  EXPECT_GT(proved, 300);
  RecordProperty("proved", proved);
  RecordProperty("sampled", sampled);
}

TEST_P(BoxProofIn, HoldsForPartsOfABoxThatLookAtTheirOwnPairsOnly) {
  const Cell cell = GetParam().make();
  CollisionChecker checker(make_collision_model(cell), cell),
      oracle(make_collision_model(cell), cell);
  BoxProver prover(checker);
  Random random(4);
  int proved = 0;
  for (int i = 0; i < 4000; ++i) {
    ConfigurationBox box = random_box(*cell.robot, random, 0.3);
    BoxProof proof = prover.prove(box);
    for (int depth = 0; depth < 6 && !proof.free; ++depth) {
      box.half *= 0.5;
      for (int j = 0; j < 6; ++j) {
        box.centre.q(j) += (random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0) * box.half(j);
      }
      const std::vector<NearPair> near = proof.near;
      ASSERT_FALSE(near.empty());
      proof = prover.prove(box, near);
    }
    if (!proof.free) continue;
    ++proved;
    for (int k = 0; k < 20; ++k) {
      const std::optional<Hit> hit = oracle.find_hit(within(box, random), 0.99e-4);
      ASSERT_FALSE(hit.has_value()) << hit->a << " and " << hit->b << ": " << hit->distance;
    }
  }
  EXPECT_GT(proved, 300);
}

INSTANTIATE_TEST_SUITE_P(
    Cells, BoxProofIn,
    ::testing::Values(NamedCell{"Clutter", +[] { return testing::cluttered_cell(25); }},
                      NamedCell{"PartHeld", &with_held_part}, NamedCell{"Meshes", &with_meshes}));

TEST(BoxProver, ProvesAPointThatIsFree) {
  const Cell cell = testing::cluttered_cell(25);
  CollisionChecker checker(make_collision_model(cell), cell);
  BoxProver prover(checker);
  Random random(5);
  int free = 0;
  for (int i = 0; i < 500; ++i) {
    ConfigurationBox box = random_box(*cell.robot, random, 0.0);
    const bool is_free = checker.is_free(box.centre, 1e-4 + 1e-8);
    const BoxProof proof = prover.prove(box);
    if (is_free) EXPECT_TRUE(proof.free);
    if (!checker.is_free(box.centre)) EXPECT_FALSE(proof.free);
    free += is_free ? 1 : 0;
  }
  EXPECT_GT(free, 50);
}

TEST(BoxProver, TellsThatTheMiddleCollides) {
  Cell cell = testing::puma_cell();
  cell.fixtures.push_back(box_body("wall", {0.4, 0.4, 0.4}, testing::at(0.0, 0.0, 1.4)));
  CollisionChecker checker(make_collision_model(cell), cell);
  BoxProver prover(checker);
  const BoxProof proof =
      prover.prove({{cell.robot->home, 0.05}, Eigen::VectorXd::Constant(6, 0.01)});
  EXPECT_FALSE(proof.free);
  EXPECT_TRUE(proof.collides);
}

TEST(BoxProver, ProvesTheHandClearOfTheForearmForAWholeRangeOfTheWrist) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell),
      oracle(make_collision_model(cell), cell);
  BoxProver prover(checker);
  ConfigurationBox box{{cell.robot->home, 0.05}, Eigen::VectorXd::Zero(6)};
  box.half << 0, 0, 0, 1.0, 0.5, 1.0;
  EXPECT_TRUE(prover.prove_beyond(3, box));
}

TEST(BoxProver, DoesNotProveARangeInWhichTheHeldPartMeetsTheForearm) {
  Cell cell = testing::puma_cell();
  cell.parts[0] = box_body("rod", {0.02, 0.04, 0.7}, testing::at(0.45, 0.0, 0.35));
  cell = cell.with_held(0, Pose::Identity());
  CollisionChecker checker(make_collision_model(cell), cell);
  BoxProver prover(checker);
  ConfigurationBox box{{cell.robot->home, 0.05}, Eigen::VectorXd::Zero(6)};
  box.half << 0, 0, 0, 0.5, 1.5, 0.5;
  EXPECT_FALSE(prover.prove_beyond(3, box));
}

TEST(BoxProver, RefusesClearancesThatAreNone) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_THROW(BoxProver(checker, -1.0), InvalidInput);
}

TEST(CollisionModel, TakesTheRobotFromAModelOfTheSameRobotOnly) {
  const Cell cell = testing::puma_cell();
  const auto bare = make_collision_model(cell);
  const Cell cluttered = testing::cluttered_cell(25);
  const auto fresh = make_collision_model(cluttered),
             reused = make_collision_model(cluttered, bare);
  CollisionChecker a(fresh, cluttered), b(reused, cluttered);
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const Configuration c = random.configuration(*cell.robot);
    EXPECT_EQ(a.closest(c).distance, b.closest(c).distance);
  }
  // Of another robot, here one whose palm is larger, nothing is taken.
  Robot larger = *cell.robot;
  RobotBody& palm = larger.bodies[static_cast<std::size_t>(larger.gripper.body)];
  palm.shapes.push_back({Box{{0.3, 0.3, 0.3}}, Pose::Identity()});
  Cell other = cluttered;
  other.robot = std::make_shared<const Robot>(larger);
  CollisionChecker truth(make_collision_model(other), other),
      taken(make_collision_model(other, bare), other);
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    const Configuration c = random.configuration(larger);
    EXPECT_EQ(taken.closest(c).distance, truth.closest(c).distance);
    if (taken.closest(c).distance != a.closest(c).distance) ++differ;
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace handey
