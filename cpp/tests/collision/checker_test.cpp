#include "handey/collision/checker.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;

TEST(Checker, HomeIsFreeAboveAnEmptyTable) {
  const Cell cell = puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_TRUE(checker.is_free(cell.start));
}

TEST(Checker, NamesTheLinkAndTheObstacle) {
  Cell cell = puma_cell();
  cell.fixtures.push_back(box_body("lamp", {0.3, 0.3, 0.3}, at(0.02, -0.15, 1.5)));
  CollisionChecker checker(make_collision_model(cell), cell);
  const auto hit = checker.find_hit(cell.start);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->b, "lamp");
  EXPECT_LE(hit->distance, 0.0);
}

TEST(Checker, TheBaseMayStandInAFixture) {
  Cell cell = puma_cell();
  cell.fixtures.push_back(box_body("floor", {2, 2, 0.1}, at(0, 0, -0.02)));
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_TRUE(checker.is_free(cell.start));
}

TEST(Checker, AnArmFoldedIntoItselfIsSeen) {
  const Cell cell = puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(1);
  int folded = 0;
  for (int i = 0; i < 500; ++i) {
    const auto hit = checker.find_hit(random.configuration(*cell.robot));
    if (hit && hit->b != "table" && hit->b != "block") ++folded;
  }
  EXPECT_GT(folded, 20);
  EXPECT_LT(folded, 400);
}

TEST(Checker, ABodyOfManyShapesIsTheSameAsManyBodies) {
  const Cell many = cluttered_cell(60);
  Cell one = puma_cell();
  Body heap;
  heap.name = "heap";
  heap.X_WB = at(0.2, -0.1, 0.05);
  for (const Body& body : many.fixtures) {
    if (body.name == "table") continue;
    Shape shape = body.shapes.front();
    shape.X_BS = heap.X_WB.inverse() * body.X_WB;
    heap.shapes.push_back(shape);
  }
  one.fixtures.push_back(heap);
  CollisionChecker apart(make_collision_model(many), many),
      together(make_collision_model(one), one);
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Configuration drawn = random.configuration(*many.robot);
    EXPECT_NEAR(apart.closest(drawn, 0.5).distance, together.closest(drawn, 0.5).distance, 1e-9);
    const bool free = apart.is_free(drawn, 0.01);
    EXPECT_EQ(free, together.is_free(drawn, 0.01));
    hits += free ? 0 : 1;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 400);
}

TEST(Checker, AModelWithKnownBodiesIsTheSameAsAFreshOne) {
  const Cell before = cluttered_cell(20);
  const auto known = make_collision_model(before);
  Cell after = before;
  after.fixtures.erase(after.fixtures.begin() + 5);
  for (const std::size_t larger : {std::size_t{3}, std::size_t{8}}) {
    after.fixtures[larger].shapes.push_back(
        {Box{{0.3, 0.2, 0.4}}, at(0.05, 0.0, 0.1)});  // of the same name, not of the same shapes
  }
  after.fixtures[4].X_WB = at(0.5, 0.3, 0.2);
  CollisionChecker taken_over(make_collision_model(after, known), after),
      fresh(make_collision_model(after), after);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Configuration drawn = random.configuration(*after.robot);
    const Hit one = taken_over.closest(drawn, 0.5), other = fresh.closest(drawn, 0.5);
    EXPECT_EQ(one.distance, other.distance);
    EXPECT_EQ(one.b, other.b);
  }
}

TEST(Checker, AModelOfAnotherRobotLendsNothingOfItsArm) {
  const Cell cell = puma_cell();
  Cell other = cell;
  Robot longer = *cell.robot;
  longer.bodies.back().shapes.push_back({Box{{0.5, 0.5, 0.5}}, Pose::Identity()});
  other.robot = std::make_shared<const Robot>(longer);
  CollisionChecker checker(make_collision_model(other, make_collision_model(cell)), other),
      fresh(make_collision_model(other), other);
  Random random(4);
  int hits = 0;
  for (int i = 0; i < 100; ++i) {
    const Configuration drawn = random.configuration(*cell.robot);
    EXPECT_EQ(checker.is_free(drawn), fresh.is_free(drawn));
    hits += fresh.is_free(drawn) ? 0 : 1;
  }
  EXPECT_GT(hits, 10);
}

TEST(Checker, ABodyWhollyInsideAMeshCollides) {
  // A small part in the hand, in the middle of a large solid that is not convex: surfaces are far
  // apart.
  Cell cell = puma_cell();
  TriangleMesh solid = l_mesh(3.0, 1.4);
  const Pose X_WH = hand_in_world(cell, cell.start.q);
  cell.fixtures.push_back(mesh_body(
      "rock", solid,
      at(X_WH.translation().x() - 0.7, X_WH.translation().y(), X_WH.translation().z() - 0.7)));
  CollisionChecker checker(make_collision_model(cell), cell);
  const auto hit = checker.find_hit(cell.start);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->b, "rock");
}

TEST(Checker, AMeshPartInsideASolidBoxCollidesAndInsideATrayDoesNot) {
  Cell cell = puma_cell();
  cell.parts.push_back(mesh_body("bracket", l_mesh(0.04, 0.01), at(0.5, 0.3, 0.2)));
  cell.fixtures.push_back(mesh_body("tray", tray_mesh({0.2, 0.2, 0.1}, 0.01), at(0.5, 0.3, 0.18)));
  const auto model = make_collision_model(cell);
  EXPECT_TRUE(touching_bodies(*model, cell, 1, 1e-3).empty());
  cell.fixtures.back() = box_body("tray", {0.4, 0.4, 0.4}, at(0.5, 0.3, 0.2));
  const auto boxed = make_collision_model(cell);
  ASSERT_EQ(touching_bodies(*boxed, cell, 1, 1e-3).size(), 1U);
  EXPECT_EQ(find_overlaps(*boxed, cell).size(), 1U);
}

TEST(Checker, TheHeldPartIsCheckedAgainstAllButTheFingers) {
  Cell cell = puma_cell();
  const auto model = make_collision_model(cell);
  const Cell held = cell.with_held(0, Pose::Identity());
  Configuration grasping = cell.start;
  grasping.opening = 0.06;
  EXPECT_TRUE(CollisionChecker(model, held).is_free(grasping));
  // Pushed back into the palm it is in the way.
  const Cell in_palm = cell.with_held(0, at(0, 0, -0.08));
  const auto hit = CollisionChecker(model, in_palm).find_hit(grasping);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->b, "held block");
  // And in the table it is, unless told that it stands there.
  const Pose X_WH = hand_in_world(cell, cell.start.q);
  cell.fixtures[0].X_WB =
      at(X_WH.translation().x(), X_WH.translation().y(), X_WH.translation().z() + 0.04);
  const Cell above = cell.with_held(0, at(0, 0, 0.0));
  const auto table = CollisionChecker(model, above).find_hit(grasping);
  ASSERT_TRUE(table.has_value());
  EXPECT_EQ(table->b, "table");
}

TEST(Checker, AllowedContactsAreNotHitsAndNothingElseIsAllowed) {
  Cell cell = puma_cell();
  Configuration grasping = cell.start;
  grasping.opening = 0.06;
  const Pose X_WH = hand_in_world(cell, grasping.q);
  cell.parts[0].X_WB = X_WH;  // between the pads, touching both
  const auto model = make_collision_model(cell);
  ASSERT_TRUE(CollisionChecker(model, cell).find_hit(grasping).has_value());
  Allowance closed;
  closed.closed_on = 0;
  EXPECT_TRUE(CollisionChecker(model, cell, closed).is_free(grasping));
  // The finger's neighbour is still an obstacle.
  cell.fixtures.push_back(box_body("post", {0.02, 0.02, 0.02}, X_WH * at(0, 0.04, 0)));
  const auto with_post = make_collision_model(cell);
  const auto hit = CollisionChecker(with_post, cell, closed).find_hit(grasping);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->b, "post");
  // Held: it may touch the post only if told so.
  const Cell held = cell.with_held(0, at(0, 0, 0.0));
  cell.fixtures.back().X_WB = X_WH * at(0, 0, 0.025);
  const Cell standing = cell.with_held(0, Pose::Identity());
  EXPECT_FALSE(CollisionChecker(with_post, standing).is_free(grasping));
  Allowance stands;
  stands.held_touches = {{BodyRef::Kind::Fixture, 1}};
  const auto other = CollisionChecker(with_post, standing, stands).find_hit(grasping);
  EXPECT_TRUE(!other.has_value() || other->a != "held block");
}

TEST(Checker, ClosestIsNeverMoreThanTheTruthAndCloseToIt) {
  Cell cell = puma_cell();
  cell.fixtures.clear();
  cell.parts.clear();
  const Pose X_WH = hand_in_world(cell, cell.start.q);
  // A plate 5 mm beyond the finger tips, which point up.
  cell.fixtures.push_back(
      box_body("plate", {0.5, 0.5, 0.02}, at(0, -0.15, X_WH.translation().z() + 0.03)));
  const auto model = make_collision_model(cell);
  const Hit near = CollisionChecker(model, cell).closest(cell.start, 0.5);
  EXPECT_EQ(near.b, "plate");
  Cell nearer = cell;
  nearer.fixtures[0].X_WB.translation().z() -= near.distance - 1e-4;
  CollisionChecker moved(model, nearer);
  EXPECT_NEAR(moved.closest(cell.start, 0.5).distance, 1e-4, 1e-6);
  EXPECT_TRUE(moved.is_free(cell.start, 0.9e-4));
  EXPECT_FALSE(moved.is_free(cell.start, 1.1e-4));
}

TEST(Checker, BeyondTheHorizonThereIsNoName) {
  Cell cell = puma_cell();
  const auto model = make_collision_model(cell);
  const Hit none = CollisionChecker(model, cell).closest(cell.start, 1e-6);
  EXPECT_TRUE(none.a.empty());
  EXPECT_DOUBLE_EQ(none.distance, 1e-6);
}

TEST(Checker, WrongInputIsRefused) {
  Cell cell = puma_cell();
  const auto model = make_collision_model(cell);
  CollisionChecker checker(model, cell);
  Configuration bad = cell.start;
  bad.q[2] = std::nan("");
  EXPECT_THROW(checker.find_hit(bad), InvalidInput);
  bad = cell.start;
  bad.opening = std::nan("");
  EXPECT_THROW(checker.find_hit(bad), InvalidInput);
  bad.q.resize(3);
  EXPECT_THROW(checker.find_hit(bad), InvalidInput);
  Cell other = cell;
  other.parts[0].X_WB.linear() *= 2.0;
  EXPECT_THROW(CollisionChecker(model, other), InvalidInput);
  other = cell;
  other.parts.clear();
  EXPECT_THROW(CollisionChecker(model, other), InvalidInput);
  Allowance nothing;
  nothing.closed_on = 7;
  EXPECT_THROW(CollisionChecker(model, cell, nothing), InvalidInput);
  EXPECT_THROW(checker.closest(cell.start, -1.0), InvalidInput);
}

TEST(Overlaps, RestingContactIsNoneAndDepthIsTheWayOut) {
  Cell cell = puma_cell();
  const auto model = make_collision_model(cell);
  EXPECT_TRUE(find_overlaps(*model, cell).empty());
  EXPECT_EQ(touching_bodies(*model, cell, 0), (std::vector<BodyRef>{{BodyRef::Kind::Fixture, 0}}));
  const Cell sunk = cell.with_part_at(0, at(0.45, -0.1, 0.012));
  const std::vector<Overlap> found = find_overlaps(*model, sunk);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name_a, "table");
  EXPECT_EQ(found[0].name_b, "block");
  EXPECT_NEAR(found[0].depth, 0.003, 1e-9);
  EXPECT_TRUE(touching_bodies(*model, cell.with_part_at(0, at(0.45, -0.1, 0.017)), 0).empty());
}

TEST(Overlaps, MeshesInContactAndInOneAnother) {
  Cell cell = puma_cell();
  cell.fixtures.push_back(
      mesh_body("tray", tray_mesh({0.1, 0.06, 0.05}, 0.01), at(0.5, 0.3, 0.01)));
  cell.parts.push_back(mesh_body("angle", l_mesh(0.1, 0.02), at(0.45, 0.3, 0.01)));
  const auto model = make_collision_model(cell);
  // Snug: length of the angle is that of the tray; floor and both ends touch.
  EXPECT_TRUE(find_overlaps(*model, cell).empty());
  const std::vector<BodyRef> touching = touching_bodies(*model, cell, 1);
  EXPECT_EQ(touching.size(), 1U);
  const Cell sunk = cell.with_part_at(1, at(0.45, 0.3, 0.007));
  const std::vector<Overlap> found = find_overlaps(*model, sunk);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GE(found[0].depth, 0.0015);
  EXPECT_LE(found[0].depth, 0.0031);
  // The same mesh twice at one place: surfaces coincide, interiors overlap.
  cell.parts.push_back(mesh_body("twin", l_mesh(0.1, 0.02), at(0.45, 0.3, 0.01)));
  const std::vector<Overlap> twins = find_overlaps(*make_collision_model(cell), cell);
  ASSERT_EQ(twins.size(), 1U);
  EXPECT_GT(twins[0].depth, 0.01);
}

TEST(Overlaps, RobotOverlapsNamesAllPairsWithTheBaseAgainstParts) {
  Cell cell = puma_cell();
  cell.parts[0].X_WB = at(0.0, 0.0, 0.3);  // inside the column
  cell.fixtures.push_back(box_body("lamp", {0.3, 0.3, 0.3}, hand_in_world(cell, cell.start.q)));
  const auto model = make_collision_model(cell);
  CollisionChecker checker(model, cell);
  const std::vector<Hit> hits = robot_overlaps(checker, cell.start, 5e-4);
  const auto names = [&](const std::string& a, const std::string& b) {
    return std::any_of(hits.begin(), hits.end(),
                       [&](const Hit& h) { return h.a == a && h.b == b && h.distance < -5e-4; });
  };
  EXPECT_TRUE(names("left_finger", "lamp"));
  EXPECT_TRUE(names("right_finger", "lamp"));
  EXPECT_TRUE(names(cell.robot->bodies[0].name, "block"));
  EXPECT_TRUE(robot_overlaps(checker, cell.start, 10.0).empty());
}

}  // namespace
}  // namespace handey
