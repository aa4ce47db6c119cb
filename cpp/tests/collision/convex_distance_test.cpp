#include "../../src/collision/convex_distance.hpp"

#include <gtest/gtest.h>

#include "../../src/collision/overlap.hpp"
#include "../../src/collision/piece.hpp"
#include "puma_cell.hpp"

namespace handey::collision {
namespace {

using handey::testing::Random;

std::shared_ptr<const Piece> piece_of(const Geometry& geometry) {
  return make_pieces({Shape{geometry, Pose::Identity()}}, "test").front();
}

/// Oracle: distance of two polyhedra from FCL's triangle pairs.
double triangle_distance(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB) {
  return surface_distance(a.surface(), X_WA, b.surface(), X_WB, 10.0);
}

TEST(ConvexDistance, BoxesAgreeWithTheDistanceOfTheirTriangles) {
  Random random(3);
  int apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto a = piece_of(Box{Eigen::Vector3d(
        random.uniform(0.01, 0.4), random.uniform(0.001, 0.4), random.uniform(0.01, 0.4))});
    const auto b = piece_of(Box{Eigen::Vector3d(
        random.uniform(0.01, 0.4), random.uniform(0.01, 0.4), random.uniform(0.01, 1.4))});
    const Pose X_WA = random.pose(0.3), X_WB = random.pose(0.3);
    const double proved = convex_distance(a->hull, X_WA, b->hull, X_WB, 0.0, 10.0);
    const double truth = triangle_distance(*a, X_WA, *b, X_WB);
    ASSERT_LE(proved, truth + 1e-9) << i;
    if (proved > 0.0) {
      ++apart;
      ASSERT_NEAR(proved, truth, 2e-6 * truth + 1e-7) << i;
    } else {
      // Surfaces cross, or one is inside: then the middle of one is in the other.
      const Eigen::Vector3d in_b = X_WB.inverse() * X_WA.translation(),
                            in_a = X_WA.inverse() * X_WB.translation();
      ASSERT_TRUE(truth < 1e-7 || b->polyhedral().tree.contains(in_b) ||
                  a->polyhedral().tree.contains(in_a))
          << i;
    }
  }
  EXPECT_GT(apart, 1000);
}

TEST(ConvexDistance, SidesOfBoxesTellNoMoreThanTheDistance) {
  Random random(5);
  const auto size = [&] {
    return Eigen::Vector3d(random.uniform(0.005, 0.3), random.uniform(0.005, 0.3),
                           random.uniform(0.005, 0.6));
  };
  int apart = 0, told = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto a = piece_of(Box{size()}), b = piece_of(Box{size()});
    const Pose X_WA = random.pose(0.3), X_WB = random.pose(0.3);
    const double proved = convex_distance(a->hull, X_WA, b->hull, X_WB, 0.0, 10.0);
    const double sides =
        box_to_box(X_WA * a->box.X_BO, a->box.half, X_WB * b->box.X_BO, b->box.half);
    ASSERT_NEAR(sides, box_to_box(X_WB * b->box.X_BO, b->box.half, X_WA * a->box.X_BO, a->box.half),
                1e-12)
        << i;
    if (proved <= 0.0) {
      ASSERT_LE(sides, 1e-9) << i;
      continue;
    }
    ++apart;
    told += sides > 0.0;
    ASSERT_LE(sides, proved * (1.0 + 2e-6) + 1e-7) << i;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(told, 0.9 * apart) << "edges across each other keep few boxes apart";
}

TEST(ConvexDistance, BallsAndCylindersAreExact) {
  const auto ball = piece_of(Sphere{0.05});
  Pose X = Pose::Identity();
  X.translation().x() = 0.3;
  EXPECT_NEAR(convex_distance(ball->hull, Pose::Identity(), ball->hull, X, 0.0, 1.0), 0.2, 1e-9);
  X.translation().x() = 0.1 - 1e-6;
  EXPECT_LE(convex_distance(ball->hull, Pose::Identity(), ball->hull, X, 0.0, 1.0), 0.0);
  const auto post = piece_of(Cylinder{0.02, 0.2});
  X.translation() = Eigen::Vector3d(0.3, 0.4, 0.0);
  EXPECT_NEAR(convex_distance(post->hull, Pose::Identity(), post->hull, X, 0.0, 1.0), 0.46, 1e-6);
  X.translation() = Eigen::Vector3d(0.0, 0.0, 0.25);
  EXPECT_NEAR(convex_distance(post->hull, Pose::Identity(), post->hull, X, 0.0, 1.0), 0.05, 1e-9);
}

TEST(ConvexDistance, CylindersLieBetweenTheirInnerAndOuterPolyhedra) {
  Random random(8);
  for (int i = 0; i < 600; ++i) {
    const Shape shape_a{Cylinder{random.uniform(0.005, 0.2), random.uniform(0.005, 0.4)},
                        Pose::Identity()};
    const Shape shape_b{Cylinder{random.uniform(0.005, 0.2), random.uniform(0.005, 0.4)},
                        Pose::Identity()};
    const auto a = piece_of(shape_a.geometry), b = piece_of(shape_b.geometry);
    const auto inner = [](const Shape& s) {
      return piece_of(MeshShape{std::make_shared<TriangleMesh>(tessellate(s, 64, false))});
    };
    const Pose X_WA = random.pose(0.3), X_WB = random.pose(0.3);
    const double proved = convex_distance(a->hull, X_WA, b->hull, X_WB, 0.0, 10.0);
    const double most =
        convex_distance(inner(shape_a)->hull, X_WA, inner(shape_b)->hull, X_WB, 0.0, 10.0);
    const double least = triangle_distance(*a, X_WA, *b, X_WB);
    if (most <= 0.0) continue;
    ASSERT_LE(proved, most + 1e-7) << i;
    ASSERT_GE(proved, std::min(least, 0.999 * most) - 0.003) << i;
  }
}

TEST(ConvexDistance, NumbersBeyondTheQuestionKeepTheirSide) {
  Random random(4);
  for (int i = 0; i < 5000; ++i) {
    const auto a = piece_of(Box{Eigen::Vector3d(0.2, 0.05, 0.1)});
    const auto b = piece_of(Cylinder{0.04, 0.2});
    const Pose X_WA = random.pose(0.25), X_WB = random.pose(0.25);
    const double exact = convex_distance(a->hull, X_WA, b->hull, X_WB, 0.0, 10.0);
    const double question = random.uniform(0.0, 0.2);
    if (std::abs(exact - question) < 1e-6) continue;
    EXPECT_EQ(convex_distance(a->hull, X_WA, b->hull, X_WB, question, question) > question,
              exact > question)
        << i;
  }
}

TEST(ConvexDistance, DegenerateMeetingsStayProved) {
  // Faces, edges and corners exactly in line: the simplex is flat again and again.
  const auto box = piece_of(Box{Eigen::Vector3d(0.1, 0.1, 0.1)});
  for (const double gap : {1e-6, 1e-4, 1e-3, 0.01, 0.3}) {
    for (int mask = 1; mask < 27; ++mask) {
      const Eigen::Vector3d side(mask % 3, (mask / 3) % 3, mask / 9);
      Pose X = Pose::Identity();
      for (int k = 0; k < 3; ++k)
        X.translation()[k] = side[k] == 0.0 ? 0.0 : (0.1 + gap) * (side[k] == 1.0 ? 1.0 : -1.0);
      const double truth = gap * std::sqrt((side.array() > 0.0).count());
      EXPECT_NEAR(convex_distance(box->hull, Pose::Identity(), box->hull, X, 0.0, 1.0), truth,
                  1e-6 * truth + 1e-8);
    }
  }
}

TEST(PieceDistance, AMeshThatIsNotConvexAgreesWithItsConvexParts) {
  // An L as one mesh, against the two boxes that make it up.
  const auto l =
      piece_of(MeshShape{std::make_shared<TriangleMesh>(handey::testing::l_mesh(0.3, 0.1))});
  ASSERT_FALSE(l->convex);
  const auto leg = piece_of(Box{Eigen::Vector3d(0.3, 0.1, 0.1)});
  const auto arm = piece_of(Box{Eigen::Vector3d(0.1, 0.1, 0.3)});
  Random random(5);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const double size = i % 2 == 0 ? 0.02 : 0.2;  // small ones are often wholly inside
    const auto other = piece_of(Box{Eigen::Vector3d(size, 0.5 * size, 0.8 * size)});
    const Pose X_WL = random.pose(0.2), X_WO = random.pose(0.2);
    const double whole = piece_distance(*l, X_WL, *other, X_WO, 0.0, 10.0);
    const double parts = std::min(
        piece_distance(*leg, X_WL * handey::testing::at(0.15, 0, 0.05), *other, X_WO, 0.0, 10.0),
        piece_distance(*arm, X_WL * handey::testing::at(0.05, 0, 0.15), *other, X_WO, 0.0, 10.0));
    ASSERT_EQ(whole > 0.0, parts > 0.0) << i << " " << whole << " " << parts;
    if (parts > 0.0) ASSERT_NEAR(whole, parts, 2e-6 * parts + 1e-7);
    if (parts <= 0.0 && triangle_distance(*l, X_WL, *other, X_WO) > 0.0) ++inside;
  }
  EXPECT_GT(inside, 20);
}

/// Each triangle as four, so often.
TriangleMesh subdivided(TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) {
    TriangleMesh finer;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const int first = static_cast<int>(finer.vertices.size());
      for (int k = 0; k < 3; ++k) {
        finer.vertices.push_back(mesh.vertices[static_cast<std::size_t>(t[k])]);
      }
      for (int k = 0; k < 3; ++k) {
        finer.vertices.push_back(0.5 * (mesh.vertices[static_cast<std::size_t>(t[k])] +
                                        mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])]));
      }
      for (const Eigen::Vector3i& part : {Eigen::Vector3i(0, 3, 5), Eigen::Vector3i(3, 1, 4),
                                          Eigen::Vector3i(5, 4, 2), Eigen::Vector3i(3, 4, 5)}) {
        finer.triangles.emplace_back(part.array() + first);
      }
    }
    mesh = std::move(finer);
  }
  return mesh;
}

TEST(PieceDistance, OfAConvexPieceFromAFineMeshAgreesWithTheirTriangles) {
  const auto l = piece_of(
      MeshShape{std::make_shared<TriangleMesh>(subdivided(handey::testing::l_mesh(0.3, 0.1), 3))});
  ASSERT_FALSE(l->convex);
  Random random(6);
  int apart = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto other = piece_of(Box{Eigen::Vector3d(
        random.uniform(0.005, 0.1), random.uniform(0.005, 0.1), random.uniform(0.005, 0.3))});
    const Pose X_WL = random.pose(0.25), X_WO = random.pose(0.25);
    const double truth = triangle_distance(*l, X_WL, *other, X_WO);
    const double answer = piece_distance(*other, X_WO, *l, X_WL, 0.0, 10.0);
    if (answer > 0.0) {
      ++apart;
      ASSERT_NEAR(answer, truth, 2e-6 * truth + 1e-7) << i;
    } else {
      const bool inside = l->polyhedral().tree.contains(X_WL.inverse() * X_WO.translation());
      ASSERT_TRUE(truth < 1e-7 || inside) << i;
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_LT(apart, 1450);
}

TEST(PieceDistance, AShortHorizonKeepsItsSideAndIsExactBelow) {
  const auto l =
      piece_of(MeshShape{std::make_shared<TriangleMesh>(handey::testing::l_mesh(0.3, 0.1))});
  const auto other = piece_of(Box{Eigen::Vector3d(0.1, 0.05, 0.08)});
  Random random(10);
  int below = 0;
  for (int i = 0; i < 4000; ++i) {
    const Pose X_WL = random.pose(0.2), X_WO = random.pose(0.2);
    const double exact = piece_distance(*l, X_WL, *other, X_WO, 0.0, 10.0);
    const double enough = random.uniform(0.0, 0.3);
    if (std::abs(exact - enough) < 1e-6) continue;
    const double answer = piece_distance(*l, X_WL, *other, X_WO, 0.0, enough);
    ASSERT_EQ(answer > enough, exact > enough) << i;
    if (exact >= enough) continue;
    ++below;
    ASSERT_NEAR(answer, exact, 1e-9) << i;
  }
  EXPECT_GT(below, 500);
}

TEST(PieceDistance, ACavityIsNotFilled) {
  // A hollow box: the inner surface is turned inwards. What floats in it is free, what touches its
  // wall is not.
  TriangleMesh hollow = handey::testing::box_mesh({0.4, 0.4, 0.4});
  const TriangleMesh inner = handey::testing::box_mesh({0.3, 0.3, 0.3});
  const int first = static_cast<int>(hollow.vertices.size());
  for (const Eigen::Vector3d& v : inner.vertices) hollow.vertices.push_back(v);
  for (const Eigen::Vector3i& t : inner.triangles) {
    hollow.triangles.emplace_back(first + t[0], first + t[2], first + t[1]);
  }
  const auto shell = piece_of(MeshShape{std::make_shared<TriangleMesh>(hollow)});
  const auto small = piece_of(Box{Eigen::Vector3d(0.1, 0.1, 0.1)});
  const Pose X = Pose::Identity();
  EXPECT_NEAR(piece_distance(*shell, X, *small, X, 0.0, 1.0), 0.1, 1e-9);
  const Pose in_wall = handey::testing::at(0.175, 0, 0);
  const auto tiny = piece_of(Box{Eigen::Vector3d(0.01, 0.01, 0.01)});
  EXPECT_LE(piece_distance(*shell, X, *tiny, in_wall, 0.0, 1.0), 0.0);
  EXPECT_LE(piece_distance(*tiny, in_wall, *shell, X, 0.0, 1.0), 0.0);
}

TEST(SurfaceTree, AgreesWithTheSolidAngleAndWithAllTriangles) {
  const TriangleMesh mesh = handey::testing::tray_mesh({0.3, 0.2, 0.1}, 0.05);
  const SurfaceTree tree(mesh);
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d point = random.vector(0.25);
    ASSERT_EQ(tree.contains(point), contains_point(mesh, point));
    double least = 1.0;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const auto v = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
      least = std::min(least, point_triangle_distance(point, v(0), v(1), v(2)));
    }
    ASSERT_NEAR(tree.distance(point), least, 1e-12);
  }
}

TEST(OverlapDepth, MovingByTheDepthPartsBoxesAndByLessDoesNot) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const auto a = piece_of(Box{Eigen::Vector3d(0.2, 0.1, 0.15)});
    const auto b = piece_of(Box{Eigen::Vector3d(0.1, 0.3, 0.05)});
    const Pose X_WA = random.pose(0.1), X_WB = random.pose(0.1);
    const double depth = overlap_depth(*a, X_WA, *b, X_WB);
    if (depth == 0.0) continue;
    bool parted = false;
    for (int k = 0; k < 2000; ++k) {  // no direction parts them with 1 % less
      Pose moved = X_WA;
      moved.translation() += 0.99 * depth * random.vector(1.0).normalized();
      parted = parted || piece_distance(*a, moved, *b, X_WB, 0.0, 0.0) > 0.0;
    }
    EXPECT_FALSE(parted) << i;
  }
}

}  // namespace
}  // namespace handey::collision
