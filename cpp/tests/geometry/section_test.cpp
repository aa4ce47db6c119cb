#include "handey/geometry/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"

namespace handey {
namespace {

Shape shape_of(const Geometry& geometry) {
  Shape shape;
  shape.geometry = geometry;
  return shape;
}

Shape mesh_of(const Shape& shape) {
  return shape_of(MeshShape{std::make_shared<TriangleMesh>(tessellate(shape)), true});
}

Pose random_pose(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> angle(-3.14, 3.14);
  std::uniform_real_distribution<double> shift(-reach, reach);
  return pose_from_xyz_rpy({shift(random), shift(random), shift(random)},
                           {angle(random), angle(random), angle(random)});
}

// A U of three boxes' outline, extruded: not convex, upright walls, a roofed slot when it lies on
// its side.
TriangleMesh u_profile() {
  const std::vector<Eigen::Vector2d> outline = {{0, 0},       {0.09, 0},    {0.09, 0.08},
                                                {0.06, 0.08}, {0.06, 0.03}, {0.03, 0.03},
                                                {0.03, 0.08}, {0, 0.08}};
  TriangleMesh mesh;
  for (const double z : {0.0, 0.05}) {
    for (const Eigen::Vector2d& point : outline)
      mesh.vertices.emplace_back(point.x(), point.y(), z);
  }
  const std::vector<Eigen::Vector3i> cap = {{0, 5, 6}, {0, 6, 7}, {0, 4, 5},
                                            {0, 1, 4}, {1, 2, 3}, {1, 3, 4}};
  for (const Eigen::Vector3i& t : cap) {
    mesh.triangles.emplace_back(t[0], t[2], t[1]);
    mesh.triangles.emplace_back(t[0] + 8, t[1] + 8, t[2] + 8);
  }
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    mesh.triangles.emplace_back(i, j, j + 8);
    mesh.triangles.emplace_back(i, j + 8, i + 8);
  }
  return mesh;
}

TEST(SlabProjection, ABoxByHand) {
  const Shape box = shape_of(Box{{0.4, 0.2, 0.6}});
  EXPECT_NEAR(area(slab_projection(box, Pose::Identity(), 0.1, 0.2)), 0.08, 1e-9);
  EXPECT_NEAR(area(slab_projection(box, Pose::Identity(), 0.1, 0.1)), 0.08, 1e-9);
  EXPECT_TRUE(slab_projection(box, Pose::Identity(), 0.31, 0.5).empty());
  EXPECT_NEAR(area(slab_projection(mesh_of(box), Pose::Identity(), 0.1, 0.2)), 0.08, 1e-6);
  EXPECT_NEAR(area(slab_projection(mesh_of(box), Pose::Identity(), 0.3, 0.4)), 0.08,
              1e-6);  // its top
  EXPECT_NEAR(area(slab_projection(mesh_of(box), Pose::Identity(), -0.4, -0.3)), 0.08,
              1e-6);  // its bottom
  EXPECT_TRUE(slab_projection(mesh_of(box), Pose::Identity(), 0.31, 0.5).empty());
}

TEST(SlabProjection, MeshesAgreeWithTheConvexFormula) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> height(-0.2, 0.2);
  for (int i = 0; i < 200; ++i) {
    const Shape box = shape_of(Box{{0.3, 0.2, 0.1}});
    const Pose X_GB = random_pose(random, 0.1);
    const double a = height(random);
    const double b = height(random);
    const Region exact = slab_projection(box, X_GB, std::min(a, b), std::max(a, b));
    const Region mesh = slab_projection(mesh_of(box), X_GB, std::min(a, b), std::max(a, b));
    EXPECT_NEAR(area(exact), area(mesh), 1e-6);
    EXPECT_LT(area(subtract(exact, mesh)), 5e-7);
    Shape said = mesh_of(box);
    std::get<MeshShape>(said.geometry).convex = true;
    const Region known = slab_projection(said, X_GB, std::min(a, b), std::max(a, b));
    EXPECT_NEAR(area(known), area(mesh), 1e-9);
  }
}

TEST(SlabProjection, RoundShapesAreContained) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Shape cylinder = shape_of(Cylinder{0.05, 0.2});
  const Shape sphere = shape_of(Sphere{0.05});
  for (int i = 0; i < 50; ++i) {
    const Pose X_GB = random_pose(random, 0.02);
    const Region of_cylinder = slab_projection(cylinder, X_GB, -0.01, 0.02);
    const Region of_sphere = slab_projection(sphere, X_GB, -0.01, 0.02);
    for (int j = 0; j < 500; ++j) {
      const Eigen::Vector3d p(0.05 * unit(random), 0.05 * unit(random), 0.1 * unit(random));
      const Eigen::Vector3d q = X_GB * p;
      if (q.z() < -0.01 || q.z() > 0.02) continue;
      if (p.head<2>().norm() <= 0.05) EXPECT_TRUE(contains(of_cylinder, q.head<2>()));
      if (p.norm() <= 0.05) EXPECT_TRUE(contains(of_sphere, q.head<2>()));
    }
  }
  const double disc = 3.14159265358979323846 * 0.05 * 0.05;
  EXPECT_LT(area(slab_projection(sphere, Pose::Identity(), -0.1, 0.1)), 1.002 * disc);
  EXPECT_TRUE(slab_projection(sphere, Pose::Identity(), 0.06, 0.1).empty());
}

TEST(SlabProjection, ANonConvexSolidAgreesWithAskingPointsInside) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const TriangleMesh mesh = u_profile();
  ASSERT_TRUE(inspect_surface(mesh).closed);
  ASSERT_NEAR(inspect_surface(mesh).volume, (0.09 * 0.08 - 0.03 * 0.05) * 0.05, 1e-9);
  const Shape shape = shape_of(MeshShape{std::make_shared<TriangleMesh>(mesh), true});
  for (int i = 0; i < 30; ++i) {
    const Pose X_GB = random_pose(random, 0.03);
    const double lower = -0.06 + 0.1 * unit(random);
    const double upper = lower + 0.04 * unit(random);
    const Region region = slab_projection(shape, X_GB, lower, upper);
    const Pose X_BG = X_GB.inverse();
    for (int j = 0; j < 200; ++j) {
      const Eigen::Vector2d xy(-0.15 + 0.3 * unit(random), -0.15 + 0.3 * unit(random));
      bool hit = false;
      for (int k = 0; k <= 100 && !hit; ++k) {
        const double z = lower + (upper - lower) * k / 100.0;
        hit = contains_point(mesh, X_BG * Eigen::Vector3d(xy.x(), xy.y(), z));
      }
      if (hit) EXPECT_TRUE(contains(region, xy));
      if (!hit && contains(region, xy)) EXPECT_LT(boundary_distance(region, xy), 0.004);
    }
  }
}

TEST(SlabProjection, InteriorsCountAndCavitiesDoNot) {
  TriangleMesh hollow = tessellate(shape_of(Box{{0.4, 0.4, 0.4}}));
  TriangleMesh cavity = tessellate(shape_of(Box{{0.2, 0.2, 0.2}}));
  for (const Eigen::Vector3d& vertex : cavity.vertices) hollow.vertices.push_back(vertex);
  for (const Eigen::Vector3i& t : cavity.triangles)
    hollow.triangles.emplace_back(t[0] + 8, t[2] + 8, t[1] + 8);
  const Shape shape = shape_of(MeshShape{std::make_shared<TriangleMesh>(hollow), true});
  EXPECT_NEAR(area(slab_projection(shape, Pose::Identity(), 0.12, 0.15)), 0.16, 1e-6);
  EXPECT_NEAR(area(slab_projection(shape, Pose::Identity(), -0.05, 0.05)), 0.16 - 0.04, 1e-6);
  EXPECT_NEAR(area(slab_projection(shape, Pose::Identity(), -0.05, 0.15)), 0.16, 1e-6);
}

TEST(SlabProjection, AnOpenSkinIsItsTrianglesAlone) {
  auto sheet = std::make_shared<TriangleMesh>(tessellate(shape_of(Box{{0.4, 0.2, 0.6}})));
  const Shape skin = shape_of(MeshShape{sheet, false});
  const Region walls = slab_projection(skin, Pose::Identity(), -0.1, 0.1);
  EXPECT_FALSE(walls.empty());
  EXPECT_LT(area(walls), 1.2 * 4e-6);  // four upright walls, 2e-6 m thick
  EXPECT_LT(boundary_distance(walls, {0.2, 0.0}), 3e-6);
  EXPECT_NEAR(area(slab_projection(skin, Pose::Identity(), 0.2, 0.4)), 0.08, 1e-5);
}

TEST(SlabProjection, NonsenseIsRefused) {
  const Shape box = shape_of(Box{{1, 1, 1}});
  EXPECT_THROW(slab_projection(box, Pose::Identity(), 1, 0), InvalidInput);
  EXPECT_THROW(slab_projection(box, Pose::Identity(), std::nan(""), 0), InvalidInput);
  EXPECT_THROW(slab_projection(shape_of(Box{{1, 0, 1}}), Pose::Identity(), 0, 1), InvalidInput);
}

}  // namespace
}  // namespace handey
