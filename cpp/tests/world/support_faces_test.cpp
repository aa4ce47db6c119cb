#include "handey/world/support_faces.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Shape box_at(const Vector3d& size, const Vector3d& at) {
  Shape shape{Box{size}, Pose::Identity()};
  shape.X_BS.translation() = at;
  return shape;
}

Body body_of(std::vector<Shape> shapes) {
  Body body;
  body.name = "body";
  body.shapes = std::move(shapes);
  return body;
}

/// A floor 0.2 x 0.3 of 5 mm, and walls 10 mm thick up to 40 mm; the last one may be left out.
Body tray(bool closed = true) {
  Body body = body_of(
      {box_at({0.2, 0.3, 0.005}, {0, 0, 0.0025}), box_at({0.2, 0.01, 0.04}, {0, 0.145, 0.02}),
       box_at({0.2, 0.01, 0.04}, {0, -0.145, 0.02}), box_at({0.01, 0.28, 0.04}, {0.095, 0, 0.02})});
  if (closed) body.shapes.push_back(box_at({0.01, 0.28, 0.04}, {-0.095, 0, 0.02}));
  return body;
}

TEST(SupportFaces, OfATurnedTableIsItsTopWhereItIs) {
  Body table = body_of({box_at({1.0, 0.5, 0.1}, Vector3d::Zero())});
  table.X_WB = pose_from_xyz_rpy({0.3, 0.2, -0.05}, {0, 0, 0.5});
  const std::vector<SupportFace> faces = support_faces(table);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_NEAR(faces[0].area, 0.5, 1e-6);
  EXPECT_TRUE(faces[0].X_WS.translation().isApprox(Vector3d(0.3, 0.2, 0.0), 1e-6));
  EXPECT_TRUE(faces[0].X_WS.linear().isApprox(Eigen::Matrix3d::Identity(), 1e-9));
  const Vector2d corner = Eigen::Rotation2Dd(0.5) * Vector2d(0.49, 0.24);
  EXPECT_TRUE(contains(faces[0].region, corner));
  EXPECT_FALSE(contains(faces[0].region, Vector2d(0.49, 0.24)));
}

TEST(SupportFaces, OfATableThatLeansByMoreThanADegreeIsNone) {
  Body table = body_of({box_at({1.0, 0.5, 0.1}, Vector3d::Zero())});
  table.X_WB = pose_from_xyz_rpy({0, 0, 0}, {0.02, 0, 0});
  EXPECT_TRUE(support_faces(table).empty());
  table.X_WB = pose_from_xyz_rpy({0, 0, 0}, {0.01, 0, 0});
  const std::vector<SupportFace> faces = support_faces(table);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_TRUE(faces[0].X_WS.linear().col(2).isApprox(table.X_WB.linear().col(2), 1e-9));
}

TEST(SupportFaces, OfTwoBoxesInOnePlaneIsOneFace) {
  const Body table =
      body_of({box_at({0.5, 0.5, 0.1}, {0.25, 0, 0}), box_at({0.5, 0.5, 0.1}, {-0.25, 0, 0}),
               box_at({0.1, 0.1, 0.1}, {0, 0, 0.1})});
  const std::vector<SupportFace> faces = support_faces(table);
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_NEAR(faces[0].area, 0.01, 1e-6);
  EXPECT_NEAR(faces[0].X_WS.translation().z(), 0.15, 1e-9);
  EXPECT_NEAR(faces[1].area, 0.5, 1e-6);
}

TEST(SupportFaces, OfATrayAreItsRimAndItsFloorWhichTheWallsEnclose) {
  const std::vector<SupportFace> faces = support_faces(tray());
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_TRUE(faces[0].enclosed.empty());
  EXPECT_NEAR(area(faces[1].enclosed), 0.18 * 0.28, 2e-5);
  EXPECT_TRUE(contains(faces[1].enclosed, Vector2d(0.089, 0.139)));
  EXPECT_FALSE(contains(faces[1].enclosed, Vector2d(0.091, 0.0)));
  EXPECT_NEAR(area(faces[1].outline), 0.2 * 0.3, 2e-5);
}

TEST(SupportFaces, OfATrayWithAnOpenSideEncloseNothing) {
  for (const SupportFace& face : support_faces(tray(false))) EXPECT_TRUE(face.enclosed.empty());
}

TEST(SupportFaces, OfATrayWithAPostLeaveThePostOut) {
  Body body = tray();
  body.shapes.push_back(box_at({0.02, 0.02, 0.03}, {0, 0, 0.015}));
  const SupportFace floor = support_faces(body).back();
  EXPECT_NEAR(area(floor.enclosed), 0.18 * 0.28 - 0.02 * 0.02, 3e-5);
  EXPECT_FALSE(contains(floor.enclosed, Vector2d(0.0, 0.0)));
}

TEST(SupportFaces, RefuseOptionsOutOfRange) {
  SupportFaceOptions options;
  options.level = -0.1;
  EXPECT_THROW(support_faces(tray(), options), InvalidInput);
}

}  // namespace
}  // namespace handey
