// Ranking by what stays unobstructed: the article's Figure 4 as a cell, a rib of the part itself,
// and the unobstructed share against sampled points whose fingers are tested one by one.
#include "handey/grasp/ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "handey/errors.hpp"
#include "parts.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::translation;

Ranking rank_faces(const Cell& cell, int part, const Pose& X_WP_goal, RankingOptions options = {}) {
  options.pairs = PairChoice::TwoFaces;
  return rank_grasps(cell, part, X_WP_goal, options);
}

// The layer of the test jaw: finger 10 mm thick, opened 8 mm.
constexpr double kLayer = 0.018;

// Figure 4: block A on a table, free about its two long sides at the origin, but at the destination
// neighbours stand against the long sides and leave the short ones free. At the origin something
// stands near one short side.
Cell figure_4() {
  Cell cell = testing::jaw_cell();
  cell.fixtures.push_back(box_body("table", {2.0, 2.0, 0.05}, translation(0, 0, -0.025)));
  cell.fixtures.push_back(box_body("left", {0.12, 0.02, 0.1}, translation(0.5, 0.036, 0.05)));
  cell.fixtures.push_back(box_body("right", {0.12, 0.02, 0.1}, translation(0.5, -0.036, 0.05)));
  cell.fixtures.push_back(box_body("near", {0.02, 0.02, 0.02}, translation(0.055, 0, 0.01)));
  cell.parts.push_back(box_body("block", {0.08, 0.05, 0.04}, translation(0, 0, 0.02)));
  return cell;
}

double width_of(const Ranking& ranking, std::size_t i) { return ranking.ranked.at(i).pair.width; }

TEST(Ranking, LooksAtTheDestinationTooAsInFigure4) {
  const Cell cell = figure_4();
  const Pose goal = translation(0.5, 0, 0.02);
  RankingOptions origin_only;
  origin_only.use_destination = false;
  const Ranking naive = rank_grasps(cell, 0, goal, origin_only);
  EXPECT_NEAR(width_of(naive, 0), 0.05, 1e-9) << "at the origin alone the long sides are free";
  const Ranking ranking = rank_grasps(cell, 0, goal);
  EXPECT_NEAR(width_of(ranking, 0), 0.08, 1e-9) << "the long sides are blocked at the destination";
  const auto blocked =
      std::find_if(ranking.obstructed.begin(), ranking.obstructed.end(),
                   [](const RankedPair& pair) { return std::abs(pair.pair.width - 0.05) < 1e-9; });
  ASSERT_NE(blocked, ranking.obstructed.end());
  EXPECT_LT(blocked->share, 0.02);
  EXPECT_GT(blocked->share_at_origin, 0.9);
  EXPECT_NE(
      std::find(blocked->obstructing.begin(), blocked->obstructing.end(), "left (destination)"),
      blocked->obstructing.end());
}

TEST(Ranking, IsTheSameWithObstaclesAtTheOriginInsteadOfTheDestination) {
  // T^-1 by hand: the destination's fixtures put about the part at its origin block as much.
  Cell cell = figure_4();
  const Pose goal = translation(0.5, 0, 0.02);
  const Ranking ranking = rank_grasps(cell, 0, goal);
  const Pose T = goal * cell.parts[0].X_WB.inverse();
  Cell pulled_back = cell;
  for (const std::size_t i : {1u, 2u}) {
    pulled_back.fixtures[i].X_WB = T.inverse() * cell.fixtures[i].X_WB;
  }
  const Ranking same = rank_grasps(pulled_back, 0, translation(0.0, 5.0, 0.02));
  ASSERT_EQ(ranking.ranked.size(), same.ranked.size());
  for (std::size_t i = 0; i < same.ranked.size(); ++i) {
    EXPECT_NEAR(ranking.ranked[i].share, same.ranked[i].share, 1e-6);
    EXPECT_EQ(ranking.ranked[i].pair.a.index, same.ranked[i].pair.a.index);
  }
}

TEST(Ranking, DropsTopAndBottomOfAPartOnATable) {
  Cell cell = testing::jaw_cell();
  cell.fixtures.push_back(box_body("table", {2.0, 2.0, 0.05}, translation(0, 0, -0.025)));
  cell.parts.push_back(box_body("block", {0.08, 0.05, 0.04}, translation(0, 0, 0.02)));
  const Ranking ranking = rank_faces(cell, 0, translation(0.3, 0.0, 0.02));
  ASSERT_EQ(ranking.ranked.size(), 2u);
  ASSERT_EQ(ranking.obstructed.size(), 1u);
  EXPECT_EQ(ranking.obstructed[0].obstructing,
            (std::vector<std::string>{"table", "table (destination)"}));
  // Of the sides, the lowest 2 mm are too near the table.
  EXPECT_NEAR(ranking.ranked[0].share, 0.95, 1e-4);
  EXPECT_NEAR(ranking.ranked[1].share, 0.95, 1e-4);
  // Equal scores: the larger area first.
  EXPECT_GT(ranking.ranked[0].pair.area, ranking.ranked[1].pair.area);
  for (const RankedPair& pair : ranking.ranked) EXPECT_GE(pair.targets.size(), 2u);
}

TEST(Ranking, DoesNotPutASmallFreeFaceBeforeALargeOneNearlyFree) {
  Cell cell = testing::jaw_cell();
  // A plate: its edges are 4 mm thin and wholly free, a small stud stands near its face.
  cell.parts.push_back(box_body("plate", {0.09, 0.09, 0.004}, translation(0, 0, 0.5)));
  cell.fixtures.push_back(box_body("stud", {0.01, 0.01, 0.01}, translation(0.03, 0.03, 0.508)));
  const Ranking ranking = rank_faces(cell, 0, translation(1.0, 0.0, 0.5));
  ASSERT_EQ(ranking.ranked.size(), 3u);
  EXPECT_NEAR(width_of(ranking, 0), 0.004, 1e-9);
  EXPECT_LT(ranking.ranked[0].share, 1.0);
  EXPECT_NEAR(ranking.ranked[1].share, 1.0, 1e-9);
}

TEST(Ranking, TakesOffWhatThePartsOwnRibsObstruct) {
  Cell cell = testing::jaw_cell();
  Body part;
  part.name = "ribbed";
  part.shapes.push_back({Box{{0.08, 0.06, 0.02}}, Pose::Identity()});
  part.shapes.push_back({Box{{0.08, 0.01, 0.005}}, translation(0.0, 0.0, 0.0125)});
  cell.parts.push_back(part);
  const Ranking ranking = rank_faces(cell, 0, translation(0.3, 0.0, 0.0));
  const auto flat =
      std::find_if(ranking.ranked.begin(), ranking.ranked.end(),
                   [](const RankedPair& pair) { return std::abs(pair.pair.width - 0.02) < 1e-9; });
  ASSERT_NE(flat, ranking.ranked.end());
  EXPECT_NEAR(area(flat->unobstructed), 0.08 * 0.05, 1e-7);
  // Two ribs of an H stand out beside its web: nothing of the web's faces is lost but their feet.
  for (const RankedPair& pair : ranking.ranked) {
    for (const Eigen::Vector2d& target : pair.targets) {
      EXPECT_TRUE(contains(pair.unobstructed, target));
    }
  }
}

TEST(Ranking, CountsARibOfAMeshLikeOneOfAShape) {
  const std::optional<Body> cube = testing::shared_part("cube_7_8ths.stl", 0.001);
  if (!cube) GTEST_SKIP() << "no shared data";
  Cell cell = testing::jaw_cell();
  cell.parts.push_back(*cube);
  const Ranking ranking = rank_faces(cell, 0, translation(0.3, 0.0, 0.0));
  // Three pairs of 40 mm, outer faces (one of them three quarters); three of 20 mm, of which the
  // inner faces lie under the walls of the notch only beside, so that a finger stands free on them.
  ASSERT_EQ(ranking.ranked.size(), 6u);
  for (const RankedPair& pair : ranking.ranked) EXPECT_NEAR(pair.share, 1.0, 1e-4);
}

// Is the segment from p along n, `length` long, inside the axis-parallel box at X_PB anywhere?
bool segment_meets_box(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double length,
                       const Body& body, const Pose& X_PB) {
  const Eigen::Vector3d half = 0.5 * std::get<Box>(body.shapes[0].geometry).size;
  const Pose X_BP = X_PB.inverse();
  const Eigen::Vector3d a = X_BP * p, d = X_BP.linear() * n;
  double from = 0.0, to = length;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(d[i]) < 1e-12) {
      if (std::abs(a[i]) > half[i]) return false;
      continue;
    }
    const double t0 = (-half[i] - a[i]) / d[i], t1 = (half[i] - a[i]) / d[i];
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from <= to;
}

TEST(Ranking, ShareAgreesWithSampledPointsWhoseFingersAreTestedOneByOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.07, 0.07), turn(-M_PI, M_PI), unit(-0.5, 0.5);
  RankingOptions options;
  options.finger_clearance = 0.0;
  options.least_share = 0.0;
  int partly = 0;
  for (int trial = 0; trial < 8; ++trial) {
    Cell cell = testing::jaw_cell();
    const Eigen::Vector3d size(0.08, 0.06, 0.05);
    cell.parts.push_back(box_body("block", size));
    const Pose goal = pose_from_xyz_rpy({1.0, place(random), 0.4}, {turn(random), 0.3, 1.0});
    for (int i = 0; i < 6; ++i) {
      const Pose X_PB = pose_from_xyz_rpy({place(random), place(random), place(random)},
                                          {turn(random), turn(random), turn(random)});
      cell.fixtures.push_back(box_body("f" + std::to_string(i), {0.02, 0.03, 0.04},
                                       (i < 3 ? Pose::Identity() : goal) * X_PB));
    }
    const Ranking ranking = rank_faces(cell, 0, goal, options);
    std::vector<RankedPair> all = ranking.ranked;
    all.insert(all.end(), ranking.obstructed.begin(), ranking.obstructed.end());
    ASSERT_EQ(all.size(), 3u);
    const std::vector<NearbyBody> nearby = nearby_bodies(cell, 0, goal);
    for (const RankedPair& ranked : all) {
      const Region& overlap = ranked.pair.overlap;
      constexpr int kSamples = 4000;
      int free = 0, free_at_origin = 0;
      for (int i = 0; i < kSamples; ++i) {
        const Eigen::Vector2d reach = overlap.loops[0][0].cwiseAbs();
        const Eigen::Vector3d at(2 * reach.x() * unit(random), 2 * reach.y() * unit(random), 0.0);
        bool hit_origin = false, hit_destination = false;
        for (const NearbyBody& near : nearby) {
          for (const double side : {1.0, -1.0}) {
            const Eigen::Vector3d n = side * ranked.pair.X_PG.linear().col(2);
            const Eigen::Vector3d p = ranked.pair.X_PG * at + 0.5 * ranked.pair.width * n;
            if (!segment_meets_box(p, n, kLayer, cell.body(near.body), near.X_PB)) continue;
            (near.at_destination ? hit_destination : hit_origin) = true;
          }
        }
        free += !hit_origin && !hit_destination;
        free_at_origin += !hit_origin;
      }
      // Four standard deviations of the sampling.
      EXPECT_NEAR(ranked.share, free / double{kSamples}, 0.032);
      EXPECT_NEAR(ranked.share_at_origin, free_at_origin / double{kSamples}, 0.032);
      partly += ranked.share > 0.1 && ranked.share < 0.9;
    }
  }
  EXPECT_GT(partly, 5);
}

// A box as the overlapping boxes of a grid, each half as large again as its cell.
Body in_overlapping_pieces(const Body& whole, int count) {
  const Eigen::Vector3d size = std::get<Box>(whole.shapes.front().geometry).size;
  Body body = whole;
  body.shapes.clear();
  for (int i = 0; i < count * count * count; ++i) {
    const Eigen::Vector3d cell = size / count;
    Eigen::Vector3d lower(i % count, i / count % count, i / (count * count));
    lower = lower.cwiseProduct(cell) - 0.5 * size;
    const Eigen::Vector3d upper = (lower + 1.5 * cell).cwiseMin(0.5 * size);
    Shape shape{Box{upper - lower}, Pose::Identity()};
    shape.X_BS.translation() = 0.5 * (lower + upper);
    body.shapes.push_back(shape);
  }
  return body;
}

TEST(Ranking, IsTheSameForObstaclesOfManyOverlappingShapes) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-0.06, 0.06), turn(-M_PI, M_PI);
  int partly = 0;
  for (int trial = 0; trial < 10; ++trial) {
    Cell whole = testing::jaw_cell();
    whole.parts.push_back(box_body("block", {0.08, 0.06, 0.05}));
    for (int i = 0; i < 4; ++i) {
      const Pose X_WB = pose_from_xyz_rpy({place(random), place(random), place(random)},
                                          {turn(random), turn(random), turn(random)});
      whole.fixtures.push_back(box_body("f" + std::to_string(i), {0.02, 0.04, 0.06}, X_WB));
    }
    Cell pieces = whole;
    for (Body& body : pieces.fixtures) body = in_overlapping_pieces(body, 3);
    const Pose goal = translation(0.03, 0.01, 0.02);
    RankingOptions options;
    options.least_share = 0.0;
    const Ranking one = rank_faces(whole, 0, goal, options);
    const Ranking many = rank_faces(pieces, 0, goal, options);
    ASSERT_EQ(one.ranked.size(), many.ranked.size());
    for (std::size_t i = 0; i < one.ranked.size(); ++i) {
      const RankedPair &a = one.ranked[i], &b = many.ranked[i];
      EXPECT_EQ(to_string(a.pair), to_string(b.pair));
      EXPECT_NEAR(a.share, b.share, 1e-4);
      EXPECT_NEAR(a.share_at_origin, b.share_at_origin, 1e-4);
      EXPECT_EQ(a.obstructing, b.obstructing);
      const Region blocked_a = unite({a.blocked}), blocked_b = unite({b.blocked});
      // Farther off, pieces are left out that the whole is not.
      const Region around = offset(a.pair.overlap, whole.robot->gripper.pad_length);
      EXPECT_LT(area(subtract(intersect(blocked_a, around), blocked_b)), 1e-7)
          << "nothing solid may be lost";
      EXPECT_LT(area(intersect(b.unobstructed, blocked_b)), 1e-9);
      partly += b.share > 0.1 && b.share < 0.9;
    }
  }
  EXPECT_GT(partly, 5);
}

TEST(Ranking, OfRealPartsPutsTheLargeOppositeFacesFirst) {
  const std::optional<Body> cube = testing::shared_part("xyz_cube_20mm.stl", 0.001);
  if (!cube) GTEST_SKIP() << "no shared data";
  Cell cell = testing::jaw_cell();
  cell.parts.push_back(*cube);
  const Ranking ranking = rank_faces(cell, 0, translation(0.3, 0.0, 0.0));
  ASSERT_GE(ranking.ranked.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ranking.ranked[static_cast<std::size_t>(i)].pair.width, 0.02, 1e-5);
    EXPECT_GT(ranking.ranked[static_cast<std::size_t>(i)].pair.area, 250e-6);
  }
}

TEST(Ranking, RefusesBadInputs) {
  const Cell cell = figure_4();
  EXPECT_THROW(rank_grasps(cell, 1, Pose::Identity()), InvalidInput);
  RankingOptions options;
  options.finger_clearance = -1.0;
  EXPECT_THROW(rank_grasps(cell, 0, Pose::Identity(), options), InvalidInput);
  EXPECT_THROW(rank_grasps(Cell{}, 0, Pose::Identity()), InvalidInput);
}

}  // namespace
}  // namespace handey
