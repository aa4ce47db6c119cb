#include "handey/geometry/convex_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"
#include "handey/geometry/shape.hpp"

namespace handey {
namespace {

TriangleMesh mesh_of(const Geometry& geometry) {
  Shape shape;
  shape.geometry = geometry;
  return tessellate(shape);
}

TEST(ConvexHull, ACubeHasSixSquareFacesOutward) {
  std::vector<Eigen::Vector3d> points = mesh_of(Box{{0.1, 0.2, 0.3}}).vertices;
  points.emplace_back(0, 0, 0);       // inside
  points.emplace_back(0.05, 0, 0);    // on a face
  points.emplace_back(0.05, 0.1, 0);  // on an edge
  const ConvexPolyhedron hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 6u);
  for (const std::vector<int>& face : hull.faces) EXPECT_EQ(face.size(), 4u);
  const SurfaceReport surface = inspect_surface(triangulate(hull));
  EXPECT_TRUE(surface.closed && surface.manifold && surface.consistently_oriented);
  EXPECT_NEAR(surface.volume, 0.006, 1e-12);
}

TEST(ConvexHull, ContainsItsPointsAndIsConvex) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 20; ++run) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 100; ++i) {
      points.emplace_back(3.0 + 0.01 * normal(random), 0.01 * normal(random),
                          0.01 * normal(random));
    }
    const TriangleMesh mesh = triangulate(convex_hull(points));
    EXPECT_TRUE(is_convex(mesh, 1e-9));
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      const Eigen::Vector3d a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
      const Eigen::Vector3d b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
      const Eigen::Vector3d c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
      const Eigen::Vector3d out = (b - a).cross(c - a).normalized();
      for (const Eigen::Vector3d& point : points) EXPECT_LT(out.dot(point - a), 1e-10);
    }
  }
}

TEST(ConvexHull, FlatPointsAreRefused) {
  EXPECT_THROW(convex_hull(std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
               InvalidInput);
  EXPECT_THROW(convex_hull(std::vector<Eigen::Vector3d>{
                   {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 3, 1}}),
               InvalidInput);
  EXPECT_THROW(convex_hull(std::vector<Eigen::Vector3d>(5, Eigen::Vector3d(1, 2, 3))),
               InvalidInput);
  EXPECT_THROW(convex_hull(std::vector<Eigen::Vector3d>{
                   {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}),
               InvalidInput);
}

TEST(Convexity, RoundShapesAreConvexAndAnLIsNot) {
  EXPECT_TRUE(is_convex(mesh_of(Box{{1, 1, 1}})));
  EXPECT_TRUE(is_convex(mesh_of(Cylinder{0.1, 0.2})));
  EXPECT_TRUE(is_convex(mesh_of(Sphere{0.1})));
  TriangleMesh dented = mesh_of(Box{{1, 1, 1}});
  dented.vertices[7] = Eigen::Vector3d(-0.2, -0.2, -0.2);
  EXPECT_FALSE(is_convex(dented));
}

TEST(Convexity, OpenInvertedAndDoubledBoxesAreNotConvexSolids) {
  TriangleMesh open = mesh_of(Box{{1, 1, 1}});
  open.triangles.pop_back();
  EXPECT_FALSE(is_convex(open));
  TriangleMesh inverted = mesh_of(Box{{1, 1, 1}});
  for (Eigen::Vector3i& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_FALSE(is_convex(inverted));
  TriangleMesh doubled = mesh_of(Box{{1, 1, 1}});
  const std::vector<Eigen::Vector3i> once = doubled.triangles;
  doubled.triangles.insert(doubled.triangles.end(), once.begin(), once.end());
  EXPECT_FALSE(is_convex(doubled));
}

}  // namespace
}  // namespace handey
