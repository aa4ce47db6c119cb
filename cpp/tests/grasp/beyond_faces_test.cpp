// Pairs with edges and vertices: by hand on prisms, wedges, a tetrahedron, crossed edges and
// rounds; as a property on random polyhedra: each pad's plane supports the part where it touches
// it, and the line between the contacts lies in the friction cones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/grasp/features.hpp"
#include "handey/grasp/legality.hpp"
#include "handey/grasp/ranking.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::translation;

Gripper jaw() { return testing::jaw_robot()->gripper; }

Body hull_body(const std::string& name, const std::vector<Eigen::Vector3d>& points) {
  Body body;
  body.name = name;
  MeshShape shape;
  shape.mesh = std::make_shared<const TriangleMesh>(triangulate(convex_hull(points)));
  body.shapes.push_back({shape, Pose::Identity()});
  return body;
}

/// A prism along z over a regular polygon, one corner at +x.
Body prism(int corners, double radius, double height) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    for (const double z : {-0.5 * height, 0.5 * height}) {
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return hull_body("prism", points);
}

std::vector<FeaturePair> of_kind(const FeaturePairs& features, PairKind kind) {
  std::vector<FeaturePair> found;
  std::copy_if(features.pairs.begin(), features.pairs.end(), std::back_inserter(found),
               [&](const FeaturePair& pair) { return pair.kind == kind; });
  return found;
}

TEST(BeyondFaces, APentagonalPrismIsHeldBetweenEachSideAndTheEdgeOppositeToIt) {
  const double radius = 0.01, height = 0.02;
  const FeaturePairs features = find_feature_pairs(prism(5, radius, height), jaw());
  EXPECT_EQ(features.faces.size(), 7u);
  EXPECT_EQ(features.edges.size(), 15u);
  EXPECT_EQ(features.vertices.size(), 10u);
  EXPECT_EQ(of_kind(features, PairKind::FaceFace).size(), 1u);
  const std::vector<FeaturePair> pairs = of_kind(features, PairKind::FaceEdge);
  ASSERT_EQ(pairs.size(), 5u);
  for (const FeaturePair& pair : pairs) {
    // From the middle of a side to the corner opposite to it.
    EXPECT_NEAR(pair.width, radius * (1.0 + std::cos(M_PI / 5.0)), 1e-7);
    EXPECT_EQ(pair.a.kind, FeatureKind::Face);
    EXPECT_EQ(pair.b.kind, FeatureKind::Edge);
    EXPECT_NEAR(std::abs(pair.X_PG.linear()(2, 0)), 1.0, 1e-9) << "x along the edge";
    EXPECT_NEAR(pair.strip, 0.002, 1e-12);
    EXPECT_NEAR(pair.area, height * pair.strip, 1e-9);
    EXPECT_LT(pair.taper.norm(), 1e-6);
    // The axis of G goes through the edge: behind the middle, at half the width.
    const Eigen::Vector3d on_edge = pair.X_PG * Eigen::Vector3d(0.0, 0.0, -0.5 * pair.width);
    EXPECT_NEAR(on_edge.head<2>().norm(), radius, 1e-7);
    EXPECT_NEAR(on_edge.z(), 0.0, 1e-7);
  }
}

TEST(BeyondFaces, ATriangularPrismIsHeldLikewiseAndAnObtuseOneOnlyAcrossItsBase) {
  EXPECT_EQ(of_kind(find_feature_pairs(prism(3, 0.02, 0.03), jaw()), PairKind::FaceEdge).size(),
            3u);
  std::vector<Eigen::Vector3d> points;
  for (const double z : {0.0, 0.03}) {
    points.emplace_back(-0.03, 0.0, z);
    points.emplace_back(0.03, 0.0, z);
    points.emplace_back(0.005, 0.012, z);
  }
  const std::vector<FeaturePair> pairs =
      of_kind(find_feature_pairs(hull_body("roof", points), jaw()), PairKind::FaceEdge);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].width, 0.012, 1e-8);
}

TEST(BeyondFaces, ARegularTetrahedronHasFourCornersBehindFacesAndThreeCrossingsOfEdges) {
  const double edge = 0.05;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                                        Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
    points.push_back(corner * edge / std::sqrt(8.0));
  }
  const FeaturePairs features = find_feature_pairs(hull_body("tetrahedron", points), jaw());
  EXPECT_TRUE(of_kind(features, PairKind::FaceFace).empty());
  EXPECT_TRUE(of_kind(features, PairKind::FaceEdge).empty());
  const std::vector<FeaturePair> corners = of_kind(features, PairKind::FaceVertex);
  ASSERT_EQ(corners.size(), 4u);
  for (const FeaturePair& pair : corners) {
    EXPECT_NEAR(pair.width, edge * std::sqrt(2.0 / 3.0), 1e-7);
  }
  const std::vector<FeaturePair> crossings = of_kind(features, PairKind::CrossedEdges);
  ASSERT_EQ(crossings.size(), 3u);
  for (const FeaturePair& pair : crossings) {
    EXPECT_NEAR(pair.width, edge / std::sqrt(2.0), 1e-7);
    EXPECT_LT(pair.X_PG.translation().norm(), 1e-7);
  }
}

TEST(BeyondFaces, ARhombusIsHeldOnItsParallelEdgesAlongTheLineThatJoinsThem) {
  std::vector<Eigen::Vector3d> points;
  for (const double z : {-0.02, 0.02}) {
    points.emplace_back(0.02, 0.0, z);
    points.emplace_back(-0.02, 0.0, z);
    points.emplace_back(0.0, 0.03, z);
    points.emplace_back(0.0, -0.03, z);
  }
  const FeaturePairs features = find_feature_pairs(hull_body("rhombus", points), jaw());
  std::vector<double> upright;
  for (const FeaturePair& pair : of_kind(features, PairKind::ParallelEdges)) {
    if (std::abs(pair.X_PG.linear()(2, 0)) < 0.99) continue;  // edges of the ends
    upright.push_back(pair.width);
    EXPECT_NEAR(pair.strip, 0.002, 1e-9) << "both edges on one line of the closing axis";
    EXPECT_NEAR(pair.area, 0.04 * pair.strip, 1e-9);
  }
  std::sort(upright.begin(), upright.end());
  ASSERT_EQ(upright.size(), 2u);
  EXPECT_NEAR(upright[0], 0.04, 1e-8);
  EXPECT_NEAR(upright[1], 0.06, 1e-8);
}

TEST(BeyondFaces, ClosingAxisOfParallelEdgesLeansAsFarAsFrictionAllows) {
  // Two ridges, offset by 6 mm: the line that joins them lies outside both arcs of normals.
  std::vector<Eigen::Vector3d> points;
  for (const double x : {-0.02, 0.02}) {
    points.emplace_back(x, -0.003, 0.02);
    points.emplace_back(x, 0.003, -0.02);
    points.emplace_back(x, 0.02, 0.017);
    points.emplace_back(x, -0.02, -0.015);
    points.emplace_back(x, -0.02, 0.0199);
    points.emplace_back(x, 0.02, -0.0199);
  }
  Body body = hull_body("ridges", points);
  const auto ridges = [&](double friction) {
    body.friction = friction;
    int found = 0;
    for (const FeaturePair& pair :
         of_kind(find_feature_pairs(body, jaw()), PairKind::ParallelEdges)) {
      const Eigen::Vector3d z = pair.X_PG.linear().col(2).cwiseAbs();
      if (std::abs(pair.X_PG.linear()(0, 0)) < 0.99 || z.z() < 0.98) continue;
      if (pair.X_PG.translation().norm() > 1e-3) continue;
      // Both edges lie in the strip, one beyond the other.
      const double offset = pair.strip - 0.002;
      EXPECT_LE(offset, 0.5 * friction * pair.width);
      ++found;
    }
    return found;
  };
  EXPECT_EQ(ridges(0.02), 0);
  EXPECT_EQ(ridges(0.6), 1);
}

TEST(BeyondFaces, AThinRodOfSmallFacetsIsHeldAcrossItsDiameter) {
  // 31 facets 0.6 mm wide: none is a face for a pad, nor is one opposite to another.
  const FeaturePairs features = find_feature_pairs(prism(31, 0.003, 0.03), jaw());
  EXPECT_EQ(features.faces.size(), 2u);
  const std::vector<FeaturePair> pairs = of_kind(features, PairKind::ParallelEdges);
  ASSERT_GE(pairs.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(pairs[i].width, 0.006, 5e-5);
    EXPECT_NEAR(pairs[i].X_PG.linear()(2, 2), 0.0, 1e-6);
    EXPECT_LT(pairs[i].strip, 0.0021);
  }
}

TEST(BeyondFaces, AThinPegGivenAsACylinderIsHeldAcrossItsDiameter) {
  Body body;
  body.name = "peg";
  body.shapes.push_back({Cylinder{0.0025, 0.03}, Pose::Identity()});
  const std::vector<FeaturePair> pairs =
      of_kind(find_feature_pairs(body, jaw()), PairKind::ParallelEdges);
  ASSERT_FALSE(pairs.empty());
  EXPECT_NEAR(pairs[0].width, 0.005, 1e-9) << "exactly: the edges lie on the cylinder";
}

TEST(BeyondFaces, ACylinderWithAnOddNumberOfFacetsIsHeldFromFacetToEdge) {
  const FeaturePairs features = find_feature_pairs(prism(31, 0.02, 0.05), jaw());
  EXPECT_EQ(features.faces.size(), 33u);
  const std::vector<FeaturePair> pairs = of_kind(features, PairKind::FaceEdge);
  ASSERT_GE(pairs.size(), 12u) << "some of 31, those in nearly the same direction left out";
  for (const FeaturePair& pair : pairs) {
    EXPECT_NEAR(pair.width, 0.02 * (1.0 + std::cos(M_PI / 31.0)), 1e-7);
  }
}

TEST(BeyondFaces, ABoxIsHeldByItsFacesFirstAndByOppositeEdgesLast) {
  const FeaturePairs features = find_feature_pairs(box_body("b", {0.04, 0.06, 0.03}), jaw());
  EXPECT_EQ(of_kind(features, PairKind::FaceFace).size(), 3u);
  EXPECT_EQ(of_kind(features, PairKind::ParallelEdges).size(), 6u);
  EXPECT_EQ(features.pairs.size(), 9u) << "no edge that a face beside it serves better";
  EXPECT_EQ(features.pairs[0].kind, PairKind::FaceFace);
  Cell cell = testing::jaw_cell();
  cell.parts.push_back(box_body("b", {0.04, 0.06, 0.03}));
  const Ranking ranking = rank_grasps(cell, 0, translation(0.5, 0.0, 0.0));
  ASSERT_EQ(ranking.ranked.size(), 9u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ranking.ranked[i].pair.kind, PairKind::FaceFace);
    EXPECT_GT(ranking.ranked[i].score, 0.99);
  }
  EXPECT_LT(ranking.ranked[3].score, 0.06);
}

TEST(BeyondFaces, RankingLooksAtTheKindsThatAreAskedFor) {
  Cell cell = testing::jaw_cell();
  cell.parts.push_back(box_body("b", {0.04, 0.06, 0.03}));
  RankingOptions options;
  options.pairs = PairChoice::TwoFaces;
  EXPECT_EQ(rank_grasps(cell, 0, translation(0.5, 0.0, 0.0), options).ranked.size(), 3u);
  options.pairs = PairChoice::BeyondFaces;
  EXPECT_EQ(rank_grasps(cell, 0, translation(0.5, 0.0, 0.0), options).ranked.size(), 6u);
}

TEST(BeyondFaces, AreBoundedInNumberAndTheSameEveryTime) {
  const Body body = prism(180, 0.04, 0.01);
  FeatureOptions options;
  const FeaturePairs first = find_feature_pairs(body, jaw(), options);
  const FeaturePairs again = find_feature_pairs(body, jaw(), options);
  const std::size_t two_faces = of_kind(first, PairKind::FaceFace).size();
  EXPECT_LE(first.pairs.size() - two_faces, 48u);
  EXPECT_GT(first.pairs.size() - two_faces, 8u);
  ASSERT_EQ(first.pairs.size(), again.pairs.size());
  for (std::size_t i = 0; i < first.pairs.size(); ++i) {
    EXPECT_EQ(to_string(first.pairs[i]), to_string(again.pairs[i]));
    EXPECT_EQ(first.pairs[i].X_PG.matrix(), again.pairs[i].X_PG.matrix());
  }
  options.most_beyond_faces = 3;
  EXPECT_EQ(find_feature_pairs(body, jaw(), options).pairs.size(), two_faces + 3);
}

TEST(BeyondFaces, TooWideSaysByHowMuchAndNamesTheFeatures) {
  const FeaturePairs features = find_feature_pairs(prism(5, 0.06, 0.02), jaw());
  const auto fallen =
      std::find_if(features.rejected.begin(), features.rejected.end(),
                   [](const RejectedPair& pair) { return pair.b.kind == FeatureKind::Edge; });
  ASSERT_NE(fallen, features.rejected.end());
  EXPECT_EQ(to_string(fallen->a, fallen->b).substr(0, 5), "face ");
  EXPECT_NE(fallen->reason.find("108.5 mm wide"), std::string::npos) << fallen->reason;
  EXPECT_NE(fallen->reason.find("12.5 mm short"), std::string::npos) << fallen->reason;
}

// How far the part reaches beyond the plane of a pad.
double support_height(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& outward) {
  double height = -1e9;
  for (const Eigen::Vector3d& point : points) height = std::max(height, outward.dot(point));
  return height;
}

TEST(BeyondFaces, PadsSupportRandomPolyhedraAndForcesStayInTheFrictionCones) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.03, 0.03);
  int kinds[5] = {0, 0, 0, 0, 0};
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 5 + trial % 6; ++i) {
      points.emplace_back(place(random), place(random), place(random));
    }
    // Every other one a prism, so that edges are parallel.
    if (trial % 2 == 0) {
      const std::size_t count = points.size();
      for (std::size_t i = 0; i < count; ++i)
        points.push_back(points[i] + Eigen::Vector3d(0, 0, 0.03));
    }
    Body body = hull_body("random", points);
    body.friction = 0.3;
    const TriangleMesh& mesh = *std::get<MeshShape>(body.shapes[0].geometry).mesh;
    for (const FeaturePair& pair : find_feature_pairs(body, jaw()).pairs) {
      ++kinds[static_cast<int>(pair.kind)];
      const Eigen::Vector3d n = pair.X_PG.linear().col(2);
      const Eigen::Vector3d middle = pair.X_PG.translation();
      // A convex part: each pad lies on its supporting plane.
      EXPECT_NEAR(support_height(mesh.vertices, n), n.dot(middle) + 0.5 * pair.width, 2e-4);
      EXPECT_NEAR(support_height(mesh.vertices, -n), -n.dot(middle) + 0.5 * pair.width, 2e-4);
      // The contacts overlap along the closing axis, or are as near as half the friction allows.
      const double lean = pair.kind == PairKind::ParallelEdges ? pair.strip - 0.002 : 0.0;
      EXPECT_LE(lean, 0.5 * body.friction * pair.width + 1e-9);
      if (pair.kind == PairKind::FaceFace) continue;
      ASSERT_FALSE(pair.contact_a.empty());
      ASSERT_FALSE(pair.contact_b.empty());
      EXPECT_TRUE(contains(pair.overlap, Eigen::Vector2d::Zero()));
      if (pair.kind != PairKind::ParallelEdges) {
        EXPECT_FALSE(intersect(pair.contact_a, pair.contact_b).empty());
      }
    }
  }
  for (const PairKind kind : {PairKind::FaceEdge, PairKind::ParallelEdges, PairKind::FaceVertex,
                              PairKind::CrossedEdges}) {
    EXPECT_GT(kinds[static_cast<int>(kind)], 10) << static_cast<int>(kind);
  }
}

TEST(BeyondFaces, RefuseBadOptions) {
  FeatureOptions options;
  options.least_edge = -1.0;
  EXPECT_THROW(find_feature_pairs(prism(5, 0.01, 0.02), jaw(), options), InvalidInput);
  options = {};
  options.friction_use = std::nan("");
  EXPECT_THROW(find_feature_pairs(prism(5, 0.01, 0.02), jaw(), options), InvalidInput);
}

}  // namespace
}  // namespace handey
