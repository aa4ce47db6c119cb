#include "handey/geometry/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"

namespace handey {
namespace {

Shape shape_of(const Geometry& geometry) {
  Shape shape;
  shape.geometry = geometry;
  return shape;
}

double volume(const Shape& shape, int segments, bool outer) {
  const SurfaceReport report = inspect_surface(tessellate(shape, segments, outer));
  EXPECT_TRUE(report.closed && report.manifold && report.consistently_oriented);
  return report.volume;
}

TEST(Shape, OuterPolyhedraContainAndInnerOnesAreContained) {
  const double pi = 3.14159265358979323846;
  const Shape cylinder = shape_of(Cylinder{0.1, 0.3});
  const Shape sphere = shape_of(Sphere{0.1});
  for (const int segments : {3, 8, 33, 64}) {
    EXPECT_GT(volume(cylinder, segments, true), pi * 0.01 * 0.3);
    EXPECT_LT(volume(cylinder, segments, false), pi * 0.01 * 0.3);
    EXPECT_GT(volume(sphere, segments, true), 4.0 / 3.0 * pi * 1e-3);
    EXPECT_LT(volume(sphere, segments, false), 4.0 / 3.0 * pi * 1e-3);
    EXPECT_TRUE(is_convex(tessellate(sphere, segments, true)));
  }
  const TriangleMesh outer = tessellate(sphere, 32, true);
  for (const Eigen::Vector3i& t : outer.triangles) {
    const Eigen::Vector3d a = outer.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d b = outer.vertices[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3d c = outer.vertices[static_cast<std::size_t>(t[2])];
    EXPECT_GE((b - a).cross(c - a).normalized().dot(a), 0.1 - 1e-12);
  }
}

TEST(Shape, StandsAtItsPoseInTheBody) {
  Shape shape = shape_of(Box{{0.2, 0.4, 0.6}});
  shape.X_BS = pose_from_xyz_rpy({1, 0, 0}, {0, 0, 1.57079632679489662});
  const SurfaceReport report = inspect_surface(tessellate(shape));
  EXPECT_LT((report.upper - Eigen::Vector3d(1.2, 0.1, 0.3)).norm(), 1e-12);
}

TEST(Shape, HullPointsSpanTheShape) {
  EXPECT_EQ(hull_points(shape_of(Box{{1, 1, 1}})).size(), 8u);
  auto sheet = std::make_shared<TriangleMesh>();
  sheet->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet->triangles = {{0, 1, 2}};
  EXPECT_EQ(hull_points(shape_of(MeshShape{sheet, false})).size(), 3u);
}

TEST(Shape, ImpossibleSizesAreRefused) {
  EXPECT_THROW(require_valid(shape_of(Box{{1, -1, 1}}), "box"), InvalidInput);
  EXPECT_THROW(require_valid(shape_of(Box{{1, std::nan(""), 1}}), "box"), InvalidInput);
  EXPECT_THROW(require_valid(shape_of(Cylinder{0, 1}), "cylinder"), InvalidInput);
  EXPECT_THROW(require_valid(shape_of(Sphere{INFINITY}), "sphere"), InvalidInput);
  EXPECT_THROW(require_valid(shape_of(MeshShape{}), "mesh"), InvalidInput);
  EXPECT_THROW(tessellate(shape_of(Sphere{1}), 2), InvalidInput);
  Shape mirrored = shape_of(Sphere{1});
  mirrored.X_BS.linear()(0, 0) = -1;
  EXPECT_THROW(require_valid(mirrored, "sphere"), InvalidInput);
}

}  // namespace
}  // namespace handey
