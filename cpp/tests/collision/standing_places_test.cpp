// A block put down on a table, on a shelf, in a tray, next to others.
#include "handey/collision/standing_places.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A table top at z = 0, 1 m x 0.6 m before the robot, and a block of 40 x 60 x 30 mm far off.
Cell table_cell() {
  Cell cell = puma_cell();
  cell.fixtures = {box_body("table", {0.6, 1.0, 0.05}, at(0.6, 0, -0.025))};
  cell.parts = {box_body("block", {0.04, 0.06, 0.03}, at(0.4, 0.4, 0.015))};
  return cell;
}

/// A tray with walls 30 mm high around a floor of the given size, its floor at z = 5 mm.
Body tray(double x, double y, const Pose& X_WB) {
  Body body = box_body("tray", {x + 0.02, y + 0.02, 0.005}, X_WB);
  body.shapes[0].X_BS.translation().z() = 0.0025;
  const auto wall = [&](const Vector3d& size, const Vector3d& where) {
    Shape shape{Box{size}, Pose::Identity()};
    shape.X_BS.translation() = where;
    body.shapes.push_back(shape);
  };
  for (const double side : {-0.5, 0.5}) {
    wall({0.01, y + 0.02, 0.03}, {side * (x + 0.01), 0, 0.015});
    wall({x + 0.02, 0.01, 0.03}, {0, side * (y + 0.01), 0.015});
  }
  return body;
}

struct Places {
  explicit Places(const Cell& cell_in) : cell(cell_in), model(make_collision_model(cell)) {}
  StandingPlaces on(const Body& body, const StandingPlaceOptions& options, std::size_t face = 0,
                    std::size_t rest = 0) {
    return find_standing_places(model, cell, 0, resting_poses(cell.parts[0])[rest],
                                support_faces(body)[face], options);
  }
  Cell cell;
  std::shared_ptr<const CollisionModel> model;
};

StandingPlaceOptions options_of(int count) {
  StandingPlaceOptions options;
  options.count = count;
  return options;
}

TEST(StandingPlaces, TouchTheTableAndOverlapNothing) {
  Cell cell = table_cell();
  cell.fixtures.push_back(box_body("wall", {0.02, 0.5, 0.2}, at(0.6, 0, 0.1)));
  cell.parts.push_back(box_body("other", {0.1, 0.1, 0.1}, at(0.45, -0.2, 0.05)));
  Places places(cell);
  const StandingPlaces found = places.on(cell.fixtures[0], options_of(200));
  ASSERT_GT(found.places.size(), 50u);
  EXPECT_GT(found.not_clear, 0);
  EXPECT_EQ(found.tried, 200);
  EXPECT_EQ(found.tried, static_cast<int>(found.places.size()) + found.off_the_face +
                             found.not_clear + found.outside_the_region + found.outside_the_walls);
  for (const StandingPlace& place : found.places) {
    const Cell there = cell.with_part_at(0, place.X_WP);
    EXPECT_TRUE(find_overlaps(*places.model, there, 1e-5).empty());
    const std::vector<BodyRef> touching = touching_bodies(*places.model, there, 0);
    ASSERT_EQ(touching.size(), 1u);
    EXPECT_EQ(touching[0].kind, BodyRef::Kind::Fixture);
    EXPECT_EQ(touching[0].index, 0);
    EXPECT_GE(place.room, 1e-3);
  }
}

TEST(StandingPlaces, HaveTheRoomThatTheyTell) {
  Cell cell = table_cell();
  cell.parts.push_back(box_body("other", {0.1, 0.1, 0.1}, at(0.6, 0, 0.05)));
  Places places(cell);
  const StandingPlaces found = places.on(cell.fixtures[0], options_of(300));
  int narrow = 0;
  for (const StandingPlace& place : found.places) {
    const Cell there = cell.with_part_at(0, place.X_WP);
    for (const BodyRef& near : touching_bodies(*places.model, there, 0, 0.97 * place.room)) {
      EXPECT_EQ(near.kind, BodyRef::Kind::Fixture);
    }
    narrow += place.room < 0.06 ? 1 : 0;
  }
  EXPECT_GT(narrow, 0);
}

TEST(StandingPlaces, LieInTheRegion) {
  const Cell cell = table_cell();
  Places places(cell);
  StandingPlaceOptions options = options_of(200);
  options.region = Eigen::AlignedBox2d(Vector2d(0.5, -0.1), Vector2d(0.62, 0.05));
  const StandingPlaces found = places.on(cell.fixtures[0], options);
  ASSERT_GT(found.places.size(), 20u);
  for (const StandingPlace& place : found.places) {
    for (const Vector3d& corner : hull_points(cell.parts[0].shapes[0])) {
      EXPECT_TRUE(options.region->contains(Vector2d((place.X_WP * corner).head<2>())));
    }
  }
}

TEST(StandingPlaces, MayHangOverAnEdgeButNotWithTheCentre) {
  Cell cell = table_cell();
  cell.fixtures.push_back(box_body("post", {0.03, 0.03, 0.2}, at(0.6, 0, 0.1)));
  Places places(cell);
  const StandingPlaces found = places.on(cell.fixtures[1], options_of(300));
  ASSERT_GT(found.places.size(), 20u);
  for (const StandingPlace& place : found.places) {
    const Vector3d centre = place.X_WP.translation();
    EXPECT_LE(std::max(std::abs(centre.x() - 0.6), std::abs(centre.y())), 0.015 - 0.99e-3);
    EXPECT_LE(place.margin, 0.015);
  }
}

TEST(StandingPlaces, InsideATrayAreWithinItsWalls) {
  Cell cell = table_cell();
  cell.fixtures.push_back(tray(0.12, 0.10, at(0.6, 0, 0)));
  Places places(cell);
  StandingPlaceOptions options = options_of(200);
  options.inside = true;
  const StandingPlaces found = places.on(cell.fixtures[1], options, 1);
  ASSERT_GT(found.places.size(), 20u);
  for (const StandingPlace& place : found.places) {
    EXPECT_NEAR(place.X_WP.translation().z(), 0.005 + 0.015, 1e-9);
    EXPECT_LT(std::abs(place.X_WP.translation().x() - 0.6), 0.06 - 0.02);
    EXPECT_LT(std::abs(place.X_WP.translation().y()), 0.05 - 0.02);
  }
  // The rim is no inside.
  EXPECT_TRUE(places.on(cell.fixtures[1], options, 0).places.empty());
}

TEST(StandingPlaces, AreFoundWhereThePartHardlyFits) {
  Cell cell = table_cell();
  cell.fixtures.push_back(tray(0.064, 0.044, at(0.6, 0, 0)));  // 2 mm all round
  Places places(cell);
  StandingPlaceOptions options = options_of(64);
  options.inside = true;
  const StandingPlaces found = places.on(cell.fixtures[1], options, 1);
  EXPECT_FALSE(found.places.empty());
}

TEST(StandingPlaces, KeepClearOfTheRobotWhereItStands) {
  Cell cell = table_cell();
  cell.start.q << 0.0, -0.6, 0.4, 0.0, 1.0, 0.0;
  Places places(cell);
  StandingPlaceOptions options = options_of(300);
  const std::size_t all = places.on(cell.fixtures[0], options).places.size();
  options.robot = cell.start;
  const StandingPlaces found = places.on(cell.fixtures[0], options);
  EXPECT_LE(found.places.size(), all);
  for (const StandingPlace& place : found.places) {
    CollisionChecker checker(places.model, cell.with_part_at(0, place.X_WP));
    for (const Hit& hit : robot_overlaps(checker, cell.start, 1e-5)) {
      EXPECT_TRUE(hit.a != "block" && hit.b != "block") << hit.a << " " << hit.b;
    }
  }
}

TEST(StandingPlaces, NearAPointAreNearIt) {
  const Cell cell = table_cell();
  Places places(cell);
  StandingPlaceOptions options = options_of(100);
  options.near_point = Vector2d(0.7, -0.3);
  options.within = 0.1;
  int near = 0;
  for (const StandingPlace& place : places.on(cell.fixtures[0], options).places) {
    near += (place.X_WP.translation().head<2>() - *options.near_point).norm() <= 0.1 ? 1 : 0;
  }
  EXPECT_GE(near, 45);
}

TEST(StandingPlaces, GoOnWhereTheSequenceWasLeft) {
  const Cell cell = table_cell();
  Places places(cell);
  StandingPlaceOptions options = options_of(60);
  const StandingPlaces whole = places.on(cell.fixtures[0], options);
  options.count = 30;
  StandingPlaces parts = places.on(cell.fixtures[0], options);
  options.first = 30;
  for (const StandingPlace& place : places.on(cell.fixtures[0], options).places) {
    parts.places.push_back(place);
  }
  ASSERT_EQ(whole.places.size(), parts.places.size());
  for (std::size_t i = 0; i < whole.places.size(); ++i) {
    EXPECT_TRUE(whole.places[i].X_WP.matrix() == parts.places[i].X_WP.matrix());
  }
  options.seed = 1;
  EXPECT_FALSE(places.on(cell.fixtures[0], options).places[0].X_WP.matrix() ==
               whole.places[0].X_WP.matrix());
}

TEST(StandingPlaces, RefuseOptionsOutOfRange) {
  const Cell cell = table_cell();
  Places places(cell);
  StandingPlaceOptions options;
  options.rooms = {0.02, 0.01};
  EXPECT_THROW(places.on(cell.fixtures[0], options), InvalidInput);
  options = {};
  options.region = Eigen::AlignedBox2d(Vector2d(1, 1), Vector2d(0, 0));
  EXPECT_THROW(places.on(cell.fixtures[0], options), InvalidInput);
  options = {};
  options.count = -1;
  EXPECT_THROW(places.on(cell.fixtures[0], options), InvalidInput);
}

}  // namespace
}  // namespace handey
