// Pairs of faces by hand on boxes, a U and a stack; as a property on random parts: just inside both
// faces there is material, just outside there is none; on real parts against counts made by other
// programs.
#include "handey/grasp/features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "handey/errors.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::shared_part;
using testing::translation;
using testing::u_part;

Gripper jaw() { return testing::jaw_robot()->gripper; }

FeaturePairs face_pairs(const Body& part, const Gripper& gripper, FeatureOptions options = {}) {
  options.beyond_faces = false;
  return find_feature_pairs(part, gripper, options);
}

std::vector<double> widths(const FeaturePairs& features) {
  std::vector<double> result;
  for (const FeaturePair& pair : features.pairs) result.push_back(pair.width);
  std::sort(result.begin(), result.end());
  return result;
}

bool is_in_part(const Body& part, const Eigen::Vector3d& point) {
  return std::any_of(part.shapes.begin(), part.shapes.end(),
                     [&](const Shape& shape) { return contains_point(tessellate(shape), point); });
}

TEST(HandInPlane, ApproachesAlongThetaAndClosesAlongTheNormal) {
  const Pose straight = hand_in_plane({0.1, 0.2, M_PI / 3.0}, false);
  EXPECT_TRUE(straight.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.0)));
  EXPECT_TRUE(straight.linear().col(2).isApprox(Eigen::Vector3d(0.5, std::sqrt(0.75), 0.0), 1e-12));
  EXPECT_TRUE(straight.linear().col(1).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_NEAR(straight.linear().determinant(), 1.0, 1e-12);
  const Pose flipped = hand_in_plane({0.1, 0.2, M_PI / 3.0}, true);
  const Eigen::Matrix3d half_turn = straight.linear().transpose() * flipped.linear();
  EXPECT_TRUE(half_turn.isApprox(
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(FeaturePairs, OfABoxAreItsThreePairsOfOppositeFaces) {
  const FeaturePairs features = face_pairs(box_body("b", {0.04, 0.06, 0.03}), jaw());
  EXPECT_EQ(features.faces.size(), 6u);
  ASSERT_EQ(features.pairs.size(), 3u);
  EXPECT_TRUE(features.rejected.empty());
  // Largest overlap first.
  EXPECT_NEAR(features.pairs[0].width, 0.03, 1e-9);
  EXPECT_NEAR(features.pairs[0].area, 0.04 * 0.06, 1e-9);
  EXPECT_NEAR(features.pairs[1].width, 0.04, 1e-9);
  EXPECT_NEAR(features.pairs[2].width, 0.06, 1e-9);
}

TEST(FeaturePairs, GraspPlaneIsMidwayWithXAlongTheLongestEdge) {
  Body body = box_body("b", {0.04, 0.06, 0.03});
  body.shapes[0].X_BS = pose_from_xyz_rpy({0.3, -0.2, 0.5}, {0.3, -0.7, 1.1});
  for (const FeaturePair& pair : face_pairs(body, jaw()).pairs) {
    const Eigen::Vector3d in_box = body.shapes[0].X_BS.inverse() * pair.X_PG.translation();
    EXPECT_LT(in_box.norm(), 1e-7);
    EXPECT_NEAR(pair.X_PG.linear().determinant(), 1.0, 1e-9);
    const Eigen::Vector3d x = body.shapes[0].X_BS.linear().transpose() * pair.X_PG.linear().col(0);
    const Eigen::Vector3d half = 0.5 * Eigen::Vector3d(0.04, 0.06, 0.03);
    double longest = 0.0;
    const Eigen::Vector3d z = body.shapes[0].X_BS.linear().transpose() * pair.X_PG.linear().col(2);
    for (int i = 0; i < 3; ++i) {
      if (std::abs(z[i]) < 0.5) longest = std::max(longest, half[i]);
    }
    EXPECT_NEAR(x.cwiseAbs().dot(half), longest, 1e-7);
    EXPECT_LT(pair.taper.norm(), 1e-9);
  }
}

TEST(FeaturePairs, FacesOfASlotAreNotAPairButTheOuterFacesAre) {
  const FeaturePairs features = face_pairs(u_part(), jaw());
  // 10: each wall by itself, and the floor; 20: the U's front and back; 40: wall tops and
  // underside; 60: outer faces.
  const std::vector<double> found = widths(features);
  const auto count = [&](double width) {
    return std::count_if(found.begin(), found.end(),
                         [&](double w) { return std::abs(w - width) < 1e-7; });
  };
  EXPECT_EQ(count(0.010), 3);
  EXPECT_EQ(count(0.020), 1);
  EXPECT_EQ(count(0.040), 1);
  EXPECT_EQ(count(0.060), 1);
  EXPECT_EQ(found.size(), 6u);
}

TEST(FeaturePairs, CoplanarFacesOfTwoShapesAreOne) {
  Body body;
  body.name = "two";
  body.shapes.push_back({Box{{0.04, 0.02, 0.02}}, translation(-0.02, 0.0, 0.0)});
  body.shapes.push_back({Box{{0.04, 0.02, 0.02}}, translation(0.02, 0.0, 0.0)});
  const FeaturePairs features = face_pairs(body, jaw());
  // The two faces on which the halves touch make no pair with anything.
  ASSERT_EQ(features.pairs.size(), 3u);
  EXPECT_NEAR(features.pairs[0].area, 0.08 * 0.02, 1e-9);
  EXPECT_NEAR(features.pairs[2].width, 0.08, 1e-9);
}

TEST(FeaturePairs, WhatAnotherShapeCoversIsTakenOff) {
  Body body;
  body.name = "stack";
  body.shapes.push_back({Box{{0.06, 0.06, 0.01}}, translation(0.0, 0.0, 0.005)});
  body.shapes.push_back({Box{{0.02, 0.02, 0.03}}, translation(0.0, 0.0, 0.025)});
  const FeaturePairs features = face_pairs(body, jaw());
  const auto plate =
      std::find_if(features.pairs.begin(), features.pairs.end(),
                   [](const FeaturePair& pair) { return std::abs(pair.width - 0.01) < 1e-7; });
  ASSERT_NE(plate, features.pairs.end());
  EXPECT_NEAR(plate->area, 0.06 * 0.06 - 0.02 * 0.02, 1e-8);
  const Eigen::Vector3d middle = plate->X_PG.inverse() * Eigen::Vector3d(0.0, 0.0, 0.005);
  EXPECT_FALSE(contains(plate->overlap, middle.head<2>()));
  EXPECT_TRUE(contains(plate->overlap, Eigen::Vector2d(0.0, 0.0)));
}

TEST(FeaturePairs, TooWideSaysByHowMuch) {
  const FeaturePairs features = face_pairs(box_body("b", {0.0982, 0.06, 0.03}), jaw());
  ASSERT_EQ(features.rejected.size(), 1u);
  EXPECT_EQ(features.rejected[0].kind, Rejection::TooWide);
  EXPECT_NE(features.rejected[0].reason.find("98.2 mm wide"), std::string::npos);
  EXPECT_NE(features.rejected[0].reason.find("2.2 mm short"), std::string::npos);
  EXPECT_EQ(features.pairs.size(), 2u);
}

TEST(FeaturePairs, TooThinAndTooSmallSayWhy) {
  Gripper gripper = jaw();
  gripper.min_opening = 0.005;
  FeatureOptions options;
  options.least_overlap = 20e-6 * 20.5;
  const FeaturePairs features = face_pairs(box_body("b", {0.02, 0.02, 0.003}), gripper, options);
  // The four small sides are under the least overlap, the large ones too near each other.
  EXPECT_TRUE(features.pairs.empty());
  ASSERT_EQ(features.rejected.size(), 3u);
  EXPECT_EQ(features.rejected[0].kind, Rejection::TooThin);
  EXPECT_EQ(features.rejected[1].kind, Rejection::LittleOverlap);
  EXPECT_NE(features.rejected[1].reason.find("60.0 mm2"), std::string::npos)
      << features.rejected[1].reason;
}

TEST(FeaturePairs, NearlyParallelFacesHaveATaper) {
  // A wedge: top tilted by 0.3 degrees about y.
  const double slope = std::tan(0.3 * M_PI / 180.0);
  auto mesh = std::make_shared<TriangleMesh>();
  for (const double x : {-0.03, 0.03}) {
    for (const double y : {-0.02, 0.02}) {
      mesh->vertices.emplace_back(x, y, 0.0);
      mesh->vertices.emplace_back(x, y, 0.02 + slope * x);
    }
  }
  mesh->triangles = {{0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}, {0, 1, 3}, {0, 3, 2},
                     {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6}};
  Body body;
  body.name = "wedge";
  body.shapes.push_back({MeshShape{mesh, true}, Pose::Identity()});
  const FeaturePairs features = face_pairs(body, jaw());
  const FeaturePair& pair = features.pairs.front();
  ASSERT_NEAR(pair.width, 0.02, 1e-4);
  for (const double x : {-0.02, 0.0, 0.02}) {
    // Where the line through this point of G along z meets bottom and top, in the part.
    const Eigen::Vector3d on_plane = pair.X_PG * Eigen::Vector3d(x, 0.003, 0.0);
    const Eigen::Vector3d z = pair.X_PG.linear().col(2);
    const Eigen::Vector3d top_normal = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    const double to_top =
        (Eigen::Vector3d(0.0, 0.0, 0.02) - on_plane).dot(top_normal) / z.dot(top_normal);
    const double to_bottom = -on_plane.z() / z.z();
    EXPECT_NEAR(pair.width_at({x, 0.003}), std::abs(to_top - to_bottom), 1e-9);
  }
  FeatureOptions strict;
  strict.angle = 0.004;
  EXPECT_EQ(face_pairs(body, jaw(), strict).pairs.size(), features.pairs.size() - 1);
}

TEST(FeaturePairs, OfACylinderAreAsWideAsTheCylinder) {
  Body body;
  body.name = "can";
  body.shapes.push_back({Cylinder{0.02, 0.05}, Pose::Identity()});
  const FeaturePairs features = face_pairs(body, jaw());
  ASSERT_EQ(features.pairs.size(), 17u);
  EXPECT_NEAR(features.pairs[0].width, 0.05, 1e-9);
  for (std::size_t i = 1; i < features.pairs.size(); ++i) {
    EXPECT_NEAR(features.pairs[i].width, 0.04, 1e-9);
    EXPECT_LT(std::abs(features.pairs[i].X_PG.linear()(2, 2)), 1e-9);
  }
}

TEST(FeaturePairs, ASphereHasNone) {
  Body body;
  body.name = "ball";
  body.shapes.push_back({Sphere{0.045}, Pose::Identity()});
  const FeaturePairs features = face_pairs(body, jaw());
  EXPECT_TRUE(features.faces.empty());
  EXPECT_TRUE(features.pairs.empty());
}

// Random boxes thrown together: everywhere on an overlap both faces bound material and face free
// space.
TEST(FeaturePairs, BoundMaterialInsideAndFreeSpaceOutside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> offset(-0.02, 0.02), size(0.01, 0.04);
  int points = 0;
  for (int trial = 0; trial < 30; ++trial) {
    Body body;
    body.name = "heap";
    for (int i = 0; i < 4; ++i) {
      body.shapes.push_back({Box{{size(random), size(random), size(random)}},
                             translation(offset(random), offset(random), offset(random))});
    }
    for (const FeaturePair& pair : face_pairs(body, jaw()).pairs) {
      const InscribedCircle circle = largest_inscribed_circle(pair.overlap);
      for (const Eigen::Vector2d& at : {circle.centre, Eigen::Vector2d(0.0, 0.0)}) {
        ASSERT_TRUE(contains(pair.overlap, at));
        if (boundary_distance(pair.overlap, at) < 1e-5) continue;
        for (const double side : {1.0, -1.0}) {
          const auto point = [&](double height) {
            return Eigen::Vector3d(pair.X_PG * Eigen::Vector3d(at.x(), at.y(), side * height));
          };
          EXPECT_TRUE(is_in_part(body, point(0.5 * pair.width - 2e-5)));
          EXPECT_FALSE(is_in_part(body, point(0.5 * pair.width + 6e-5)));
          ++points;
        }
      }
    }
  }
  EXPECT_GT(points, 300);
}

TEST(FeaturePairs, RefuseAPartWithoutShapeAndBadOptions) {
  Body nothing;
  nothing.name = "nothing";
  EXPECT_THROW(face_pairs(nothing, jaw()), InvalidInput);
  FeatureOptions options;
  options.angle = std::nan("");
  EXPECT_THROW(face_pairs(box_body("b", {1, 1, 1}), jaw(), options), InvalidInput);
  EXPECT_THROW(face_pairs(box_body("b", {1, -1, 1}), jaw()), InvalidInput);
}

// Counts of outward antiparallel pairs made by another program (facets of a mesh library, polygon
// clipping of another): faces of 25 mm2 and more, overlaps of 10 mm2 and more, up to 100 mm apart,
// within 1.1 degrees. It takes faces apart that lie in one plane but do not touch; here they are
// one, so pieces are counted. It did not look whether another solid of the same file covers a face.
// Of tilted_lshape it took a 147 mm2 triangle of the plane z = 25.02 mm for a face of its own,
// whence its 7 pairs, the largest of 1910 mm2; merged they are 6 and 1960.
struct CountedPart {
  const char* file;
  double scale;
  int pairs;
  double best_width;  // mm
  double best_area;   // mm2
};

std::vector<Region> pieces_in_plane(const PlanarFace& face, const Pose& X_PG) {
  std::vector<Region> pieces;
  const Pose X_GP = X_PG.inverse();
  for (const Region& piece : connected_parts(face.region)) {
    if (area(piece) < 25e-6) continue;
    Region mapped;
    for (const Polygon& loop : piece.loops) {
      Polygon points;
      for (const Eigen::Vector2d& p : loop) {
        const Eigen::Vector3d at = face.origin + p.x() * face.u + p.y() * face.v;
        points.push_back((X_GP * at).head<2>());
      }
      // A face seen from behind runs the other way round.
      if ((X_GP.linear() * face.normal).z() < 0.0) std::reverse(points.begin(), points.end());
      mapped.loops.push_back(points);
    }
    pieces.push_back(mapped);
  }
  return pieces;
}

struct PieceCount {
  int pairs = 0;
  double best_area = 0.0, best_width = 0.0;
};

PieceCount count_piece_pairs(const FeaturePairs& features) {
  PieceCount count;
  for (const FeaturePair& pair : features.pairs) {
    const PlanarFace& a = features.faces[static_cast<std::size_t>(pair.a.index)];
    const PlanarFace& b = features.faces[static_cast<std::size_t>(pair.b.index)];
    for (const Region& piece_a : pieces_in_plane(a, pair.X_PG)) {
      for (const Region& piece_b : pieces_in_plane(b, pair.X_PG)) {
        const double common = area(intersect(intersect(piece_a, piece_b), pair.overlap));
        if (common < 10e-6) continue;
        ++count.pairs;
        if (common > count.best_area) {
          count.best_area = common;
          count.best_width = pair.width;
        }
      }
    }
  }
  return count;
}

void PrintTo(const CountedPart& part, std::ostream* out) { *out << part.file; }

class RealParts : public ::testing::TestWithParam<CountedPart> {};

TEST_P(RealParts, HaveThePairsCountedByAnotherProgram) {
  const CountedPart& expected = GetParam();
  const std::optional<Body> part = shared_part(expected.file, expected.scale);
  if (!part) GTEST_SKIP() << "no shared data";
  FeatureOptions options;
  options.angle = 1.1 * M_PI / 180.0;
  options.least_overlap = 10e-6;
  options.jaw_clearance = 0.0;
  const FeaturePairs features = face_pairs(*part, jaw(), options);
  const PieceCount count = count_piece_pairs(features);
  EXPECT_EQ(count.pairs, expected.pairs) << features.pairs.size() << " pairs of merged faces";
  EXPECT_NEAR(count.best_area * 1e6, expected.best_area, 0.003 * expected.best_area);
  EXPECT_NEAR(count.best_width * 1e3, expected.best_width, 0.006);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealParts,
    ::testing::Values(CountedPart{"kit_letter.obj", 0.001, 12, 18.91, 213},
                      CountedPart{"kit_pentagon.obj", 0.001, 1, 20.03, 238},
                      CountedPart{"kit_plus.obj", 0.001, 7, 20.00, 300},
                      CountedPart{"angle_block.stl", 0.0254, 5, 34.00, 618},
                      CountedPart{"cube_7_8ths.stl", 0.001, 6, 40.00, 1200},
                      CountedPart{"featuretype.stl", 0.0254, 44, 25.40, 3707},
                      CountedPart{"idler_riser.stl", 0.0254, 31, 6.35, 1929},
                      CountedPart{"octagonal_pocket.stl", 1.0, 110, 15.88, 10634},
                      CountedPart{"xyz_cube_20mm.stl", 0.001, 3, 20.00, 384},
                      CountedPart{"box_40_60_50.stl", 1.0, 3, 40.00, 3000},
                      CountedPart{"bunny_sim.stl", 1.0, 0, 0.0, 0},
                      CountedPart{"housing.stl", 1.0, 26, 8.00, 1250},
                      CountedPart{"lshape.stl", 1.0, 3, 25.00, 5000},
                      CountedPart{"milk_carton.stl", 1.0, 11, 70.00, 13422},
                      CountedPart{"motor_body.stl", 1.0, 2, 45.00, 430},
                      CountedPart{"star_prism.stl", 1.0, 1, 20.00, 2806},
                      CountedPart{"tilted_lshape.stl", 1.0, 6, 25.00, 1960.3},
                      CountedPart{"ycb_cracker_box.stl", 1.0, 1, 60.00, 34079}),
    [](const ::testing::TestParamInfo<CountedPart>& info) {
      const std::string file = info.param.file;
      return file.substr(0, file.find('.'));
    });

}  // namespace
}  // namespace handey
