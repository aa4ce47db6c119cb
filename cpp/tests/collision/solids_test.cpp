// Claims about inner solids: they lie inside their pieces, and where shapes are made of planes they
// fill them.
#include "handey/collision/solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "puma_cell.hpp"

namespace handey::testing {
namespace {

using Eigen::Vector3d;

Cell cell_with(const Shape& shape, const Pose& X_WB) {
  Cell cell = puma_cell();
  Body body;
  body.name = "thing";
  body.shapes = {shape};
  body.X_WB = X_WB;
  cell.fixtures = {body};
  cell.parts.clear();
  return cell;
}

std::vector<InnerSolid> solids_of(const Cell& cell) {
  CollisionChecker checker(make_collision_model(cell), cell);
  return describe_solids(checker).obstacles.front().solids;
}

/// How much of the shape is in an inner solid; every point of these is inside.
template <class Inside>
double filled(const Shape& shape, const Inside& is_inside, std::uint64_t seed,
              int samples = 20000) {
  Random random(seed);
  const Pose X_WB = random.pose(0.5);
  const std::vector<InnerSolid> solids = solids_of(cell_with(shape, X_WB));
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : tessellate(shape).vertices) box.extend(vertex);
  int inside = 0, covered = 0;
  for (int i = 0; i < samples; ++i) {
    Vector3d point;
    for (int k = 0; k < 3; ++k) point[k] = random.uniform(box.min()[k], box.max()[k]);
    const bool in_solid = std::any_of(solids.begin(), solids.end(), [&](const InnerSolid& solid) {
      return solid.depth(X_WB * point) > 0.0;
    });
    const bool in_shape = is_inside(shape.X_BS.inverse() * point);
    EXPECT_TRUE(in_shape || !in_solid) << point.transpose();
    inside += in_shape ? 1 : 0;
    covered += in_solid ? 1 : 0;
  }
  return static_cast<double>(covered) / inside;
}

Shape mesh_shape(const TriangleMesh& mesh) {
  return {MeshShape{std::make_shared<const TriangleMesh>(mesh), true}, Pose::Identity()};
}

TEST(InnerSolids, FillBoxes) {
  const auto inside = [](const Vector3d& p) {
    return std::abs(p.x()) < 0.1 && std::abs(p.y()) < 0.05 && std::abs(p.z()) < 0.02;
  };
  EXPECT_GT(filled({Box{{0.2, 0.1, 0.04}}, Random(1).pose(0.1)}, inside, 2), 0.99);
}

TEST(InnerSolids, LieWithinCylindersAndSpheres) {
  const auto in_cylinder = [](const Vector3d& p) {
    return p.head<2>().norm() < 0.1 && std::abs(p.z()) < 0.2;
  };
  EXPECT_GT(filled({Cylinder{0.1, 0.4}, Random(3).pose(0.1)}, in_cylinder, 4), 0.95);
  const auto in_sphere = [](const Vector3d& p) { return p.norm() < 0.1; };
  EXPECT_GT(filled({Sphere{0.1}, Random(5).pose(0.1)}, in_sphere, 6), 0.65);
}

TEST(InnerSolids, FillMeshesOfRightAnglesThatAreNotConvex) {
  for (const TriangleMesh& mesh : {l_mesh(0.3, 0.05), tray_mesh({0.3, 0.2, 0.1}, 0.02)}) {
    const auto inside = [&](const Vector3d& p) { return contains_point(mesh, p); };
    EXPECT_GT(filled(mesh_shape(mesh), inside, 7), 0.99);
  }
}

TEST(InnerSolids, LieWithinHills) {
  MeshFileOptions options;
  options.scale.setConstant(0.001);
  const TriangleMesh mesh =
      load_mesh(std::string(HANDEY_MODELS_DIR) + "/cells/meshes/hills.stl", options).mesh;
  const auto inside = [&](const Vector3d& p) { return contains_point(mesh, p); };
  EXPECT_GT(filled(mesh_shape(mesh), inside, 8, 1000), 0.3);
}

TEST(InnerSolids, LieWithinARoundMeshOfManyFaces) {
  const TriangleMesh mesh = tessellate({Sphere{0.1}, Pose::Identity()}, 64);
  const auto inside = [&](const Vector3d& p) { return contains_point(mesh, p); };
  EXPECT_GT(filled(mesh_shape(mesh), inside, 9, 1000), 0.65);
}

TEST(InnerSolids, OfAnOpenSkinAreNone) {
  TriangleMesh skin = box_mesh({0.2, 0.2, 0.2});
  skin.triangles.resize(10);
  const Shape shape{MeshShape{std::make_shared<const TriangleMesh>(skin), false}, Pose::Identity()};
  EXPECT_TRUE(solids_of(cell_with(shape, at(0.5, 0, 0.5))).empty());
}

TEST(InnerSolids, AreNoneInFlatOrThinPoints) {
  EXPECT_TRUE(inner_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).normals.empty());
  EXPECT_TRUE(inner_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-6}}).normals.empty());
}

}  // namespace
}  // namespace handey::testing
