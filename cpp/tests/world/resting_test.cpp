#include "handey/world/resting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

Body box_part(const Vector3d& size, const Vector3d& at = Vector3d::Zero()) {
  Shape shape{Box{size}, Pose::Identity()};
  shape.X_BS.translation() = at;
  Body body;
  body.name = "part";
  body.shapes = {shape};
  return body;
}

Body mesh_part(const std::vector<Vector3d>& corners) {
  Body body;
  body.name = "part";
  body.shapes = {
      Shape{MeshShape{std::make_shared<TriangleMesh>(triangulate(convex_hull(corners))), true},
            Pose::Identity()}};
  return body;
}

double sum_of_probabilities(const std::vector<RestingPose>& rests) {
  return std::accumulate(rests.begin(), rests.end(), 0.0, [](double sum, const RestingPose& rest) {
    return sum + rest.probability;
  });
}

/// Solid angle of a rectangle a x b seen from a height h over its middle, as part of the sphere.
double share_of_rectangle(double a, double b, double h) {
  const double x = 0.5 * a, y = 0.5 * b;
  return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h))) / kPi;
}

/// The surface's least height, and the highest, at a pose.
std::pair<double, double> heights(const Body& part, const Pose& X_SP) {
  double least = 1e9, most = -1e9;
  for (const Shape& shape : part.shapes) {
    for (const Vector3d& vertex : tessellate(shape, 64).vertices) {
      least = std::min(least, (X_SP * vertex).z());
      most = std::max(most, (X_SP * vertex).z());
    }
  }
  return {least, most};
}

TEST(RestingPoses, ABoxHasSixWithTheSolidAnglesOfItsFaces) {
  const Vector3d size(0.04, 0.06, 0.1);
  const std::vector<RestingPose> rests = resting_poses(box_part(size, Vector3d(0.3, 0.0, -0.1)));
  ASSERT_EQ(rests.size(), 6u);
  EXPECT_NEAR(sum_of_probabilities(rests), 1.0, 1e-12);
  for (std::size_t i = 0; i < 6; ++i) {
    const int axis = static_cast<int>(i / 2);  // the flattest first: x, then y, then z upright
    const double a = size[(axis + 1) % 3], b = size[(axis + 2) % 3];
    const RestingPose& rest = rests[i];
    EXPECT_NEAR(rest.height, 0.5 * size[axis], 1e-12);
    EXPECT_NEAR(rest.top, size[axis], 1e-12);
    EXPECT_NEAR(rest.margin, 0.5 * std::min(a, b), 1e-12);
    EXPECT_NEAR(rest.tip_angle, std::atan(std::min(a, b) / size[axis]), 1e-12);
    EXPECT_NEAR(rest.probability, share_of_rectangle(a, b, 0.5 * size[axis]), 1e-9);
    EXPECT_NEAR(area(rest.contact), a * b, 1e-8);
    EXPECT_NEAR(std::abs(rest.X_SP.linear()(2, axis)), 1.0, 1e-12);
  }
}

TEST(RestingPoses, PutTheLowestPointOnThePlaneAndTheCentreOverTheOrigin) {
  const Body part =
      mesh_part({{0, 0, 0}, {0.1, 0, 0}, {0, 0.07, 0}, {0.02, 0.02, 0.05}, {0.05, 0.01, 0.04}});
  const std::vector<RestingPose> rests = resting_poses(part);
  ASSERT_FALSE(rests.empty());
  for (const RestingPose& rest : rests) {
    const auto [least, most] = heights(part, rest.X_SP);
    EXPECT_NEAR(least, 0.0, 1e-9);
    EXPECT_NEAR(most, rest.top, 1e-9);
    const Vector3d centre = rest.X_SP * centre_of_mass(part);
    EXPECT_NEAR(centre.x(), 0.0, 1e-12);
    EXPECT_NEAR(centre.y(), 0.0, 1e-12);
    EXPECT_NEAR(centre.z(), rest.height, 1e-12);
    EXPECT_NEAR(rest.X_SP.linear().determinant(), 1.0, 1e-12);
  }
}

TEST(RestingPoses, ARegularTetrahedronRestsOnEachFaceAlike) {
  const Body part =
      mesh_part({{0.1, 0.1, 0.1}, {0.1, -0.1, -0.1}, {-0.1, 0.1, -0.1}, {-0.1, -0.1, 0.1}});
  const std::vector<RestingPose> rests = resting_poses(part);
  ASSERT_EQ(rests.size(), 4u);
  const double edge = 0.2 * std::sqrt(2.0);
  for (const RestingPose& rest : rests) {
    EXPECT_NEAR(rest.probability, 0.25, 1e-9);
    EXPECT_NEAR(rest.margin, edge / (2.0 * std::sqrt(3.0)), 1e-9);  // the inradius of the face
    EXPECT_NEAR(rest.height, edge / (2.0 * std::sqrt(6.0)), 1e-9);  // the inradius of the solid
  }
}

TEST(RestingPoses, ALeaningPrismTopplesFromItsSmallEnd) {
  // A parallelogram that leans so far that the centre of mass is beyond its short bottom.
  std::vector<Vector3d> corners;
  for (const double y : {-0.03, 0.03}) {
    corners.insert(corners.end(), {{0, y, 0}, {0.02, y, 0}, {0.12, y, 0.06}, {0.10, y, 0.06}});
  }
  const std::vector<RestingPose> rests = resting_poses(mesh_part(corners));
  // Not on the bottom nor on the top: only on the two long sides and the two flat ends.
  ASSERT_EQ(rests.size(), 4u);
  EXPECT_NEAR(sum_of_probabilities(rests), 1.0, 1e-12);
  for (const RestingPose& rest : rests) EXPECT_LT(std::abs(rest.X_SP.linear()(2, 2)), 0.95);
}

TEST(RestingPoses, AnLBlockOfTwoBoxesRestsAlsoOnTheFaceOfItsHull) {
  Body part = box_part({0.08, 0.04, 0.02});
  Shape leg{Box{Vector3d(0.02, 0.04, 0.06)}, Pose::Identity()};
  leg.X_BS.translation() = Vector3d(-0.03, 0.0, 0.04);
  part.shapes.push_back(leg);
  const std::vector<RestingPose> rests = resting_poses(part);
  // Five faces and the slanted one between the two tips; the small tips do not hold it all.
  EXPECT_NEAR(sum_of_probabilities(rests), 1.0, 1e-12);
  bool slanted = false;
  for (const RestingPose& rest : rests) {
    const double share = area(rest.contact) / std::abs(signed_area(rest.footprint));
    slanted = slanted || share < 0.5;  // it touches by two edges, far from each other
  }
  EXPECT_TRUE(slanted);
}

TEST(RestingPoses, ACylinderStandsOnItsEndsAndRollsOnItsSide) {
  Body part;
  part.name = "peg";
  part.shapes = {Shape{Cylinder{0.02, 0.1}, Pose::Identity()}};
  const std::vector<RestingPose> rests = resting_poses(part);
  ASSERT_GE(rests.size(), 8u);
  ASSERT_LE(rests.size(), 20u);
  for (int end : {0, 1}) {
    EXPECT_NEAR(rests[static_cast<std::size_t>(end)].margin, 0.02, 1e-9);
    EXPECT_NEAR(rests[static_cast<std::size_t>(end)].tip_angle, std::atan(0.4), 1e-9);
  }
  for (std::size_t i = 2; i < rests.size(); ++i) {
    EXPECT_NEAR(rests[i].height, 0.02, 1e-9);
    EXPECT_LT(rests[i].tip_angle, 0.06);
    // What lies within 0.6 mm of the table is about 2 sqrt(2 r 0.6 mm) wide.
    EXPECT_NEAR(rests[i].width, 2.0 * std::sqrt(2.0 * 0.02 * 6e-4), 3e-4);
  }
  EXPECT_NEAR(sum_of_probabilities(rests), 1.0, 1e-12);
}

TEST(RestingPoses, AFaceInManyTrianglesIsOneFace) {
  std::vector<Vector3d> corners;
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; j <= 6; ++j) {
      for (const double z : {0.0, 0.05}) {
        corners.emplace_back(0.01 * i, 0.01 * j, z + 1e-7 * ((3 * i + 5 * j) % 7 - 3));
      }
    }
  }
  EXPECT_EQ(resting_poses(mesh_part(corners)).size(), 6u);
}

TEST(RestingPoses, AreTheSteadiestFirstAndRepeatable) {
  const Body part =
      mesh_part({{0, 0, 0}, {0.1, 0, 0}, {0, 0.07, 0}, {0.02, 0.02, 0.05}, {0.05, 0.05, 0.04}});
  const std::vector<RestingPose> once = resting_poses(part), again = resting_poses(part);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(once[i].X_SP.matrix() == again[i].X_SP.matrix());
    if (i > 0) EXPECT_GE(once[i - 1].tip_angle + 1e-9, once[i].tip_angle);
  }
}

TEST(RestingPose, OfAGivenDirectionIsThatOfTheListWhereItIsAFace) {
  const Body part = box_part({0.04, 0.06, 0.1});
  const RestingPose rest = resting_pose(part, Vector3d(1.0, 0.0, 0.0));
  EXPECT_NEAR(rest.margin, 0.03, 1e-9);
  EXPECT_NEAR(rest.height, 0.02, 1e-12);
  EXPECT_TRUE(rest.X_SP.linear().row(2).isApprox(Eigen::RowVector3d(1.0, 0.0, 0.0)));
  // On an edge it does not stand: what is within 0.6 mm of the plane is narrow.
  const RestingPose edge = resting_pose(part, Vector3d(1.0, 1.0, 0.0));
  EXPECT_LT(edge.width, 2e-3);
}

TEST(RestingPoses, RefuseWhatIsNoPartAndOptionsOutOfRange) {
  Body empty;
  empty.name = "none";
  EXPECT_THROW(resting_poses(empty), InvalidInput);
  RestingOptions options;
  options.contact_gap = -1.0;
  EXPECT_THROW(resting_poses(box_part({0.1, 0.1, 0.1}), options), InvalidInput);
  EXPECT_THROW(resting_pose(box_part({0.1, 0.1, 0.1}), Vector3d::Zero()), InvalidInput);
}

}  // namespace
}  // namespace handey
