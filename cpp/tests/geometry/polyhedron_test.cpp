#include "handey/geometry/polyhedron.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "handey/errors.hpp"
#include "handey/geometry/shape.hpp"

namespace handey {
namespace {

TriangleMesh box(const Eigen::Vector3d& size,
                 const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  Shape shape;
  shape.geometry = Box{size};
  shape.X_BS.translation() = centre;
  return tessellate(shape);
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const int shift = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Eigen::Vector3i& triangle : b.triangles) {
    a.triangles.push_back(triangle + Eigen::Vector3i::Constant(shift));
  }
  return a;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// A flat n x n grid of squares on z = 0, two triangles each, seen from above.
TriangleMesh grid(int n, double side, double height_noise = 0.0) {
  TriangleMesh mesh;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-height_noise, height_noise);
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j)
      mesh.vertices.emplace_back(side * i / n, side * j / n, noise(random));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j;
      const int b = a + n + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  }
  return mesh;
}

TEST(Surface, ABoxIsASolid) {
  const SurfaceReport report = inspect_surface(box({0.1, 0.2, 0.3}, {1, 2, 3}));
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.consistently_oriented);
  EXPECT_EQ(report.components, 1);
  EXPECT_NEAR(report.volume, 0.006, 1e-15);
  EXPECT_LT((report.centroid - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((report.upper - Eigen::Vector3d(1.05, 2.1, 3.15)).norm(), 1e-12);
}

TEST(Surface, FaultsAreCounted) {
  TriangleMesh open = box({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_EQ(inspect_surface(open).open_edges, 3);
  EXPECT_FALSE(inspect_surface(open).closed);
  EXPECT_LT(inspect_surface(inside_out(box({1, 1, 1}))).volume, 0.0);
  TriangleMesh twisted = box({1, 1, 1});
  std::swap(twisted.triangles[0][1], twisted.triangles[0][2]);
  EXPECT_FALSE(inspect_surface(twisted).consistently_oriented);
  TriangleMesh doubled = box({1, 1, 1});
  doubled.triangles.push_back(doubled.triangles[0]);
  doubled.triangles.push_back(doubled.triangles[0]);
  EXPECT_FALSE(inspect_surface(doubled).manifold);
  EXPECT_EQ(inspect_surface({}).components, 0);
}

TEST(Surface, IndicesOutOfRangeAreRefused) {
  TriangleMesh mesh = box({1, 1, 1});
  mesh.triangles[3][0] = 8;
  EXPECT_THROW(inspect_surface(mesh), InvalidInput);
  EXPECT_THROW(planar_faces(mesh), InvalidInput);
  mesh.triangles[3][0] = -1;
  EXPECT_THROW(connected_components(mesh), InvalidInput);
}

TEST(Surface, PiecesComeApart) {
  const TriangleMesh two = together(box({1, 1, 1}), box({1, 1, 1}, {5, 0, 0}));
  EXPECT_EQ(inspect_surface(two).components, 2);
  const std::vector<TriangleMesh> pieces = connected_components(two);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].vertices.size(), 8u);
  EXPECT_NEAR(inspect_surface(pieces[1]).centroid.x(), 5.0, 1e-12);
}

TEST(Inside, OverlappingPiecesAreAUnionAndCavitiesAreOutside) {
  const TriangleMesh overlapping = together(box({1, 1, 1}), box({1, 1, 1}, {0.5, 0, 0}));
  EXPECT_TRUE(contains_point(overlapping, {0.25, 0.1, 0.2}));
  EXPECT_TRUE(contains_point(overlapping, {0.9, 0.1, 0.2}));
  EXPECT_FALSE(contains_point(overlapping, {1.1, 0.1, 0.2}));
  const TriangleMesh hollow = together(box({1, 1, 1}), inside_out(box({0.5, 0.5, 0.5})));
  EXPECT_FALSE(contains_point(hollow, {0.1, 0.1, 0.1}));
  EXPECT_TRUE(contains_point(hollow, {0.1, 0.1, 0.4}));
}

TEST(Inside, AgreesWithTheFormulaForASphere) {
  Shape shape;
  shape.geometry = Sphere{0.05};
  const TriangleMesh sphere = tessellate(shape, 64, false);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> coordinate(-0.06, 0.06);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point(coordinate(random), coordinate(random), coordinate(random));
    if (point.norm() > 0.0495 && point.norm() < 0.05) continue;
    EXPECT_EQ(contains_point(sphere, point), point.norm() < 0.05);
  }
}

TEST(PlanarFaces, ABoxHasSixLargestFirst) {
  const std::vector<PlanarFace> faces = planar_faces(box({0.1, 0.2, 0.3}, {1, 1, 1}));
  ASSERT_EQ(faces.size(), 6u);
  EXPECT_NEAR(faces[0].area, 0.06, 1e-9);
  EXPECT_NEAR(faces[5].area, 0.02, 1e-9);
  for (const PlanarFace& face : faces) {
    EXPECT_EQ(face.triangles.size(), 2u);
    EXPECT_LT((face.u.cross(face.v) - face.normal).norm(), 1e-12);
    EXPECT_GT(face.normal.dot(face.origin - Eigen::Vector3d(1, 1, 1)), 0.0);
    EXPECT_NEAR(area(face.region), face.area, 1e-12);
  }
}

TEST(PlanarFaces, ACylinderOf32FacetsKeepsThem) {
  Shape shape;
  shape.geometry = Cylinder{0.001, 0.1};
  EXPECT_EQ(planar_faces(tessellate(shape, 32)).size(), 34u);
  shape.geometry = Cylinder{0.05, 0.1};
  EXPECT_EQ(planar_faces(tessellate(shape, 32)).size(), 34u);
}

TEST(PlanarFaces, AFinelyCurvedSideDoesNotDriftIntoOneFace) {
  Shape shape;
  shape.geometry = Cylinder{0.05, 0.1};
  // Neighbours differ by 1.53 mrad, within the 1.6 mrad allowed here; a chain of such steps would
  // be the whole circle, but no facet may leave the common plane by more.
  for (const PlanarFace& face : planar_faces(tessellate(shape, 4096), {1.6e-3, 1e-5, 0.0})) {
    if (face.area > 1e-3) continue;  // the two caps
    EXPECT_LE(face.triangles.size(), 6u);
  }
}

TEST(PlanarFaces, ManyTrianglesWithRoundingAreOneFace) {
  const std::vector<PlanarFace> faces = planar_faces(grid(100, 0.1, 2e-9));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].triangles.size(), 20000u);
  EXPECT_NEAR(faces[0].area, 0.01, 1e-8);
  EXPECT_EQ(faces[0].region.loops.size(), 1u);
  EXPECT_EQ(faces[0].region.loops[0].size(), 4u);
}

TEST(PlanarFaces, AHoleIsAHole) {
  TriangleMesh sheet = grid(10, 0.1);
  std::vector<Eigen::Vector3i> kept;
  for (const Eigen::Vector3i& triangle : sheet.triangles) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += sheet.vertices[static_cast<std::size_t>(triangle[k])] / 3.0;
    const bool in_hole = std::abs(centre.x() - 0.05) < 0.02 && std::abs(centre.y() - 0.05) < 0.02;
    if (!in_hole) kept.push_back(triangle);
  }
  sheet.triangles = kept;
  const std::vector<PlanarFace> faces = planar_faces(sheet);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].region.loops.size(), 2u);
  EXPECT_NEAR(faces[0].area, 0.01 - 0.04 * 0.04, 1e-8);
}

TEST(PlanarFaces, IslandsOnThePlaneBelongToTheFace) {
  const TriangleMesh two = together(box({0.1, 0.1, 0.1}), box({0.02, 0.02, 0.1}, {0.2, 0, 0}));
  const std::vector<PlanarFace> faces = planar_faces(two);
  EXPECT_EQ(faces.size(), 10u);  // tops and bottoms are common
  EXPECT_EQ(faces[0].region.loops.size(), 2u);
  EXPECT_NEAR(faces[0].area, 0.01 + 0.0004, 1e-8);
}

TEST(PlanarFaces, TJunctionsLeaveNoSeam) {
  // One square whose lower half is one quad and whose upper half is two that meet its long side in
  // its middle, off the line by rounding.
  TriangleMesh mesh;
  mesh.vertices = {
      {0, 0, 0},   {0.1, 0, 0},    {0.1, 0.05, 0}, {0, 0.05, 0}, {0.05, 0.05 + 2e-8, 0},
      {0, 0.1, 0}, {0.05, 0.1, 0}, {0.1, 0.1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 4, 6}, {3, 6, 5}, {4, 2, 7}, {4, 7, 6}};
  const std::vector<PlanarFace> faces = planar_faces(mesh);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].region.loops.size(), 1u);
  EXPECT_NEAR(faces[0].area, 0.01, 1e-8);
  EXPECT_NEAR(largest_inscribed_circle(faces[0].region, 1e-5).radius, 0.05, 2e-5);
}

TEST(PlanarFaces, ATJunctionAtTheOutlineLeavesNoNotch) {
  // A stepped outline: the narrow upper rectangle ends on the long side of the lower one, off it by
  // rounding.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0},   {0.1, 0, 0},   {0.1, 0.05, 0}, {0, 0.05, 0}, {0.08, 0.05 + 3e-7, 0},
                   {0, 0.1, 0}, {0.08, 0.1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 4, 6}, {3, 6, 5}};
  const std::vector<PlanarFace> faces = planar_faces(mesh);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_NEAR(faces[0].area, 0.009, 1e-7);
  // Without closing, no circle larger than 0.025 m would fit into either rectangle.
  EXPECT_GT(largest_inscribed_circle(faces[0].region, 1e-5).radius, 0.04);
}

TEST(PlanarFaces, SliverTrianglesJoinTheFaceThatTheyLieIn) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}, {0.05, -1e-9, 3e-9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}};
  const std::vector<PlanarFace> faces = planar_faces(mesh);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].triangles.size(), 3u);
}

TEST(PlanarFaces, SmallFacesCanBeLeftOut) {
  PlanarFaceOptions options;
  options.least_area = 0.025;
  EXPECT_EQ(planar_faces(box({0.1, 0.2, 0.3}), options).size(), 4u);
  options.least_area = std::nan("");
  EXPECT_THROW(planar_faces(box({0.1, 0.2, 0.3}), options), InvalidInput);
}

}  // namespace
}  // namespace handey
