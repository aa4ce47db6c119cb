#include "handey/collision/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../src/collision/convex_distance.hpp"
#include "../../src/collision/piece_hulls.hpp"
#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;
using collision::ConvexSolid;
using Eigen::Vector3d;

double distance_to(const SceneHull& hull, const Vector3d& point) {
  ConvexSolid solid, single;
  solid.points = hull.points;
  for (const Vector3d& p : hull.points) {
    solid.centre += p / static_cast<double>(hull.points.size());
  }
  single.points = {point};
  single.centre = point;
  return collision::convex_distance(solid, Pose::Identity(), single, Pose::Identity(), 0.0, 1.0);
}

bool in_some(const std::vector<SceneHull>& hulls, const Vector3d& point) {
  return std::any_of(hulls.begin(), hulls.end(),
                     [&](const SceneHull& hull) { return distance_to(hull, point) < 1e-7; });
}

/// Vertices and random points of a shape's surface, and of its round surface itself.
std::vector<Vector3d> surface_points(const Shape& shape, int count, Random& random) {
  const TriangleMesh mesh = tessellate(shape, 48, false);
  std::vector<Vector3d> points = mesh.vertices;
  for (int i = 0; i < count; ++i) {
    const std::size_t t =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(mesh.triangles.size())));
    double a = random.uniform(0.0, 1.0), b = random.uniform(0.0, 1.0);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const auto at = [&](int k) -> const Vector3d& {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
    };
    points.emplace_back(at(0) + a * (at(1) - at(0)) + b * (at(2) - at(0)));
  }
  return points;
}

void expect_edges_in_range(const SceneHull& hull) {
  ASSERT_GE(hull.points.size(), 4u);
  ASSERT_GE(hull.edges.size(), 6u);
  for (const std::pair<int, int>& edge : hull.edges) {
    EXPECT_GE(std::min(edge.first, edge.second), 0);
    EXPECT_LT(std::max(edge.first, edge.second), static_cast<int>(hull.points.size()));
    EXPECT_NE(edge.first, edge.second);
  }
}

/// A cell with all kinds of bodies, the second part held.
Cell varied_cell() {
  Cell cell = puma_cell();
  Random random(3);
  cell.X_WR = random.pose(0.3);
  Body round = box_body("round", {0.1, 0.1, 0.1}, random.pose(0.8));
  round.shapes.push_back({Cylinder{0.07, 0.3}, random.pose(0.1)});
  round.shapes.push_back({Sphere{0.12}, random.pose(0.1)});
  cell.fixtures.push_back(round);
  cell.fixtures.push_back(mesh_body("tray", tray_mesh({0.4, 0.3, 0.1}, 0.01), random.pose(0.8)));
  TriangleMesh skin = box_mesh({0.3, 0.2, 0.2});
  skin.triangles.resize(10);
  cell.fixtures.push_back(mesh_body("skin", skin, random.pose(0.8), false));
  cell.parts.push_back(mesh_body("bracket", l_mesh(0.08, 0.02), random.pose(0.5)));
  return cell.with_held(1, random.pose(0.05));
}

TEST(DescribeScene, HullsContainEverySurface) {
  const Cell cell = varied_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Scene scene = describe_scene(checker);
  Random random(8);
  const auto expect_covered = [&](const std::vector<Shape>& shapes, const Pose& X,
                                  const std::vector<SceneHull>& hulls, const std::string& name) {
    for (const SceneHull& hull : hulls) expect_edges_in_range(hull);
    int outside = 0;
    for (const Shape& shape : shapes) {
      for (const Vector3d& point : surface_points(shape, 300, random)) {
        outside += !in_some(hulls, X * point);
      }
    }
    EXPECT_EQ(outside, 0) << name;
  };
  ASSERT_EQ(scene.movers.size(), cell.robot->bodies.size() + 1);
  for (std::size_t b = 0; b < cell.robot->bodies.size(); ++b) {
    EXPECT_EQ(scene.movers[b].name, cell.robot->bodies[b].name);
    EXPECT_EQ(scene.movers[b].hulls.size(), cell.robot->bodies[b].shapes.size());
    expect_covered(cell.robot->bodies[b].shapes, Pose::Identity(), scene.movers[b].hulls,
                   scene.movers[b].name);
  }
  const SceneMover& held = scene.movers.back();
  EXPECT_EQ(held.name, "held bracket");
  EXPECT_EQ(held.body, cell.robot->gripper.body);
  EXPECT_TRUE(held.X_BM.isApprox(cell.robot->gripper.X_BH * cell.held->X_HP));
  EXPECT_EQ(held.hulls.size(), 1u);  // what moves is one hull a piece
  expect_covered(cell.parts[1].shapes, Pose::Identity(), held.hulls, held.name);
  ASSERT_EQ(scene.obstacles.size(), cell.fixtures.size() + 1);  // without the part that is held
  const Pose X_RW = cell.X_WR.inverse();
  for (std::size_t f = 0; f < cell.fixtures.size(); ++f) {
    EXPECT_EQ(scene.obstacles[f].name, cell.fixtures[f].name);
    expect_covered(cell.fixtures[f].shapes, X_RW * cell.fixtures[f].X_WB, scene.obstacles[f].hulls,
                   scene.obstacles[f].name);
  }
  EXPECT_EQ(scene.obstacles.back().name, "block");
}

/// From any vertex, going up along edges as long as they rise leads to the highest point: true of
/// polyhedra whose edges are all there.
void expect_all_edges(const SceneHull& hull, Random& random) {
  for (int i = 0; i < 20; ++i) {
    const Vector3d up = random.vector(1.0);
    double highest = up.dot(hull.points.front());
    for (const Vector3d& point : hull.points) highest = std::max(highest, up.dot(point));
    std::size_t at =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(hull.points.size())));
    for (bool rose = true; rose;) {
      rose = false;
      for (const std::pair<int, int>& edge : hull.edges) {
        const std::size_t a = static_cast<std::size_t>(edge.first),
                          b = static_cast<std::size_t>(edge.second);
        if (a != at && b != at) continue;
        const std::size_t other = a == at ? b : a;
        if (up.dot(hull.points[other]) <= up.dot(hull.points[at])) continue;
        at = other;
        rose = true;
      }
    }
    EXPECT_NEAR(up.dot(hull.points[at]), highest, 1e-9);
  }
}

TEST(DescribeScene, NoEdgeIsMissing) {
  const Cell cell = varied_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Scene scene = describe_scene(checker);
  Random random(12);
  for (const SceneMover& mover : scene.movers) {
    for (const SceneHull& hull : mover.hulls) expect_all_edges(hull, random);
  }
  for (const SceneObstacle& obstacle : scene.obstacles) {
    for (const SceneHull& hull : obstacle.hulls) expect_all_edges(hull, random);
  }
}

TEST(HullOfPoints, ContainsThemHoweverFlatTheyLie) {
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    // From 1 m down to nothing along each axis, on a grid now and then.
    const auto extent = [&] {
      return random.uniform(0, 4) < 1 ? 0.0 : std::pow(10.0, random.uniform(-12.0, 0.0));
    };
    const Vector3d size(random.uniform(0.01, 1.0), extent(), extent());
    const Pose X = random.pose(1.0);
    const bool grid = i % 3 == 0;
    std::vector<Vector3d> points;
    for (int k = 0; k < 1 + i % 40; ++k) {
      Vector3d point = random.vector(1.0);
      if (grid) point = point.array().round();
      points.push_back(X * point.cwiseProduct(size));
    }
    const SceneHull hull = collision::hull_of_points(points);
    expect_edges_in_range(hull);
    expect_all_edges(hull, random);
    for (const Vector3d& point : points) EXPECT_LT(distance_to(hull, point), 2e-8) << i;
    // And it is no larger than they are.
    for (int k = 0; k < 20; ++k) {
      const Vector3d up = random.vector(1.0).normalized();
      double highest = -1e9, top = -1e9;
      for (const Vector3d& point : points) highest = std::max(highest, up.dot(point));
      for (const Vector3d& point : hull.points) top = std::max(top, up.dot(point));
      EXPECT_GE(top, highest - 1e-11) << i;
      EXPECT_LE(top, highest + 2e-6) << i;
    }
  }
}

TEST(DescribeScene, ConvexPiecesAreOneHullEachAndBoxesAreExact) {
  const Cell cell = varied_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Scene scene = describe_scene(checker);
  EXPECT_EQ(scene.obstacles[0].hulls.size(), 1u);
  EXPECT_EQ(scene.obstacles[0].hulls[0].points.size(), 8u);
  EXPECT_EQ(scene.obstacles[0].hulls[0].edges.size(), 12u);
  EXPECT_EQ(scene.obstacles[1].hulls.size(), 3u);  // box, cylinder, sphere
  EXPECT_GT(scene.obstacles[2].hulls.size(), 4u);  // the tray's walls
}

TEST(DescribeScene, RoundShapesStandOutByLittle) {
  Cell cell = puma_cell();
  Body round = box_body("round", {0.1, 0.1, 0.1}, at(1, 1, 0.5));
  round.shapes = {{Cylinder{0.15, 0.3}, Pose::Identity()}, {Sphere{0.03}, Pose::Identity()}};
  cell.fixtures.push_back(round);
  CollisionChecker checker(make_collision_model(cell), cell);
  const Scene scene = describe_scene(checker);
  for (const Vector3d& point : scene.obstacles[1].hulls[0].points) {
    EXPECT_LT((point - Vector3d(1, 1, 0.5)).head<2>().norm(), 0.15 + 0.0015);
  }
  for (const Vector3d& point : scene.obstacles[1].hulls[1].points) {
    EXPECT_LT((point - Vector3d(1, 1, 0.5)).norm(), 0.03 + 0.002);
  }
}

TEST(DescribeScene, OpeningsOfAMeshStayOpen) {
  Cell cell = puma_cell();
  cell.fixtures = {mesh_body("tray", tray_mesh({0.4, 0.3, 0.2}, 0.01), Pose::Identity()),
                   mesh_body("hook", l_mesh(0.4, 0.04), at(2, 0, 0))};
  cell.parts.clear();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Scene scene = describe_scene(checker);
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Vector3d inside_tray(random.uniform(-0.19, 0.19), random.uniform(-0.14, 0.14),
                               random.uniform(0.01, 0.3));
    EXPECT_FALSE(in_some(scene.obstacles[0].hulls, inside_tray)) << inside_tray.transpose();
    const Vector3d in_the_hook(2.0 + random.uniform(0.06, 0.39), random.uniform(-0.05, 0.05),
                               random.uniform(0.06, 0.39));
    EXPECT_FALSE(in_some(scene.obstacles[1].hulls, in_the_hook)) << in_the_hook.transpose();
  }
}

TEST(DescribeScene, PatchesHaveNoMoreTrianglesThanAsked) {
  Cell cell = puma_cell();
  cell.fixtures = {mesh_body("tray", tray_mesh({0.4, 0.3, 0.2}, 0.01), Pose::Identity())};
  const auto model = make_collision_model(cell);
  CollisionChecker checker(model, cell);
  SceneOptions options;
  options.patch_triangles = 1;
  const Scene scene = describe_scene(checker, options);
  EXPECT_EQ(scene.obstacles[0].hulls.size(), 28u);  // its triangles
  for (const SceneHull& hull : scene.obstacles[0].hulls) EXPECT_EQ(hull.points.size(), 6u);
  for (const int wrong : {0, -3}) {
    options.patch_triangles = wrong;
    EXPECT_THROW(describe_scene(checker, options), InvalidInput);
  }
  options.patch_triangles = 24;
  options.patch_excess = 0.0;
  EXPECT_THROW(describe_scene(checker, options), InvalidInput);
}

TEST(DescribeScene, SaysWhatIsKeptApart) {
  const Cell cell = varied_cell();
  Allowance allowance;
  allowance.closed_on = 0;
  allowance.held_touches = {{BodyRef::Kind::Fixture, 1}};
  CollisionChecker checker(make_collision_model(cell), cell, allowance);
  const Scene scene = describe_scene(checker);
  int fingers = 0;
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    const SceneMover& mover = scene.movers[m];
    const bool held = m + 1 == scene.movers.size();
    fingers += mover.finger;
    for (std::size_t o = 0; o < scene.obstacles.size(); ++o) {
      ASSERT_EQ(scene.obstacles[o].checked.size(), scene.movers.size());
      const bool part = o + 1 == scene.obstacles.size();
      const bool expected = m != 0 && !(mover.finger && part) && !(held && o == 1);
      EXPECT_EQ(scene.obstacles[o].checked[m] != 0, expected)
          << mover.name << " " << scene.obstacles[o].name;
    }
  }
  EXPECT_EQ(fingers, 2);
  EXPECT_EQ(scene.movers[0].depth, 0);
  EXPECT_EQ(scene.movers.back().depth, 6);
  EXPECT_EQ(scene.movers[2].depth, 2);
  int with_held = 0;
  for (const std::pair<int, int>& pair : scene.mover_pairs) {
    EXPECT_NE(pair.first, pair.second);
    const int last = static_cast<int>(scene.movers.size()) - 1;
    if (pair.first != last && pair.second != last) continue;
    ++with_held;
    const int other = std::min(pair.first, pair.second);
    EXPECT_FALSE(scene.movers[static_cast<std::size_t>(other)].finger);
  }
  EXPECT_EQ(with_held, static_cast<int>(cell.robot->bodies.size()) - 2);
}

}  // namespace
}  // namespace handey
