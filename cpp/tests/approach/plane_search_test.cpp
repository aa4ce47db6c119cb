// The search by hand (a slot that the slide stalls in, a closed box) and against a flood of the
// same lattice that finds out by plain geometry what is blocked.
#include "handey/approach/plane_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <random>
#include <set>

#include "handey/approach/quasipotential.hpp"
#include "handey/errors.hpp"
#include "small_hand.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using testing::kCell;
using testing::rectangle;
using testing::small_hand;

struct Ground {
  MotionGrid touched, full;
  explicit Ground(int layers = 1)
      : touched({0, 0}, 0.2, kCell, layers), full({0, 0}, 0.2, kCell, layers) {}
  void add(const Region& region, int layer = 0) {
    touched.fill(layer, region);
    full.fill_inside(layer, region);
  }
};

StepAnswer yes(const LatticePoint&, const LatticePoint&) { return StepAnswer::Yes; }

bool are_neighbours(const PlaneSearch& search, const LatticePoint& a, const LatticePoint& b) {
  const int n = search.directions(), turn = ((b.k - a.k) % n + n) % n;
  const int di = std::abs(a.i - b.i), dj = std::abs(a.j - b.j);
  if (turn != 0) return di == 0 && dj == 0 && (turn == 1 || turn == n - 1);
  return std::max(di, dj) == 1;
}

void expect_way(const PlaneSearch& search, const LatticePoint& start,
                const PlaneSearchResult& result) {
  ASSERT_TRUE(result.found());
  ASSERT_GE(result.path.size(), 2u);
  EXPECT_TRUE(result.path.front() == start);
  EXPECT_TRUE(search.is_exit(result.path.back()));
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    EXPECT_TRUE(are_neighbours(search, result.path[i - 1], result.path[i]));
    EXPECT_FALSE(search.is_blocked(result.path[i]));
  }
}

TEST(PlaneSearch, GoesStraightOutOverOpenGround) {
  const Ground ground;
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1);
  const PlaneSearchResult result = search.find_way_out({}, yes);
  expect_way(search, {}, result);
  EXPECT_EQ(result.path.size(), 26u);  // 25 cells of 4 mm
  EXPECT_EQ(result.tests, 25);
}

TEST(PlaneSearch, LeavesASlotThatTheSlideStallsBefore) {
  // A slot round the hand, open ahead of it only: from behind there is no way in, and the hand
  // cannot turn inside.
  Ground ground;
  ground.add(rectangle(-0.060, -0.030, -0.050, 0.030));  // back
  ground.add(rectangle(-0.060, 0.020, 0.030, 0.030));
  ground.add(rectangle(-0.060, -0.030, 0.030, -0.020));
  const GripperOutline hand = small_hand();
  const auto anywhere = [](const PlanarPose&) { return true; };
  for (const double y : {0.0, 0.08, -0.08}) {
    const SlideResult slide =
        slide_to_target(ground.touched, hand, {-0.13, y, 0.0}, {0, 0}, anywhere);
    EXPECT_NE(slide.status, SlideStatus::Reached);
  }
  PlaneSearch search(ground.touched, ground.full, hand, {0, 0, 0}, 0.1);
  const PlaneSearchResult result = search.find_way_out({}, yes);
  expect_way(search, {}, result);
  int farthest_ahead = 0;
  for (const LatticePoint& p : result.path) farthest_ahead = std::max(farthest_ahead, p.i);
  EXPECT_GE(farthest_ahead, 16);  // out past the slot's mouth, the hand's back included
}

TEST(PlaneSearch, ProvesThatAClosedBoxHasNoWayOut) {
  Ground ground;
  ground.add(rectangle(-0.080, -0.080, -0.070, 0.080));
  ground.add(rectangle(0.070, -0.080, 0.080, 0.080));
  ground.add(rectangle(-0.080, 0.070, 0.080, 0.080));
  ground.add(rectangle(-0.080, -0.080, 0.080, -0.070));
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0.01, 0, 0.3}, 0.1);
  EXPECT_FALSE(search.is_open({}));
  const PlaneSearchResult result = search.find_way_out({}, yes);
  EXPECT_EQ(result.status, PlaneSearchStatus::Enclosed);
  EXPECT_EQ(result.tests, 0);
  EXPECT_EQ(result.path.size(), 1u);
}

TEST(PlaneSearch, LooksAtEachPieceInItsOwnLayer) {
  Ground ground(2);
  ground.add(rectangle(-0.05, -0.05, 0.05, 0.05), 1);  // full where the hand has only a small piece
  GripperOutline hand = small_hand();
  hand.pieces.push_back({rectangle(-0.002, -0.002, 0.002, 0.002).loops.front(), 0.02, 0.03});
  PlaneSearch shut(ground.touched, ground.full, hand, {0, 0, 0}, 0.08);
  // Four millimetres are never wholly a cell: close everywhere, blocked nowhere.
  EXPECT_TRUE(shut.is_open({}));
  hand.pieces[1].polygon = rectangle(-0.005, -0.005, 0.005, 0.005).loops.front();
  PlaneSearch blocked(ground.touched, ground.full, hand, {0, 0, 0}, 0.08);
  EXPECT_EQ(blocked.find_way_out({}, yes).status, PlaneSearchStatus::Enclosed);
}

TEST(PlaneSearch, KeepsOffObstaclesWhereThatIsNotFar) {
  Ground ground;
  ground.add(rectangle(-0.2, 0.021, 0.2, 0.04));  // along the way back, one cell off
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1);
  const PlaneSearchResult result = search.find_way_out({}, yes);
  expect_way(search, {}, result);
  for (const LatticePoint& p : result.path) EXPECT_LE(p.j, 0);
}

TEST(PlaneSearch, GoesRoundStepsThatAreForbidden) {
  const Ground ground;
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1);
  const PlaneSearchResult first = search.find_way_out({}, yes);
  expect_way(search, {}, first);
  search.forbid(first.path[3], first.path[4]);
  const PlaneSearchResult second = search.find_way_out({}, yes);
  expect_way(search, {}, second);
  for (std::size_t i = 1; i < second.path.size(); ++i) {
    EXPECT_FALSE(second.path[i - 1] == first.path[3] && second.path[i] == first.path[4]);
  }
}

TEST(PlaneSearch, SaysSoWhenItMayNotAskOnAndHowFarItCame) {
  const Ground ground;
  PlaneSearchOptions options;
  options.most_tests = 10;
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1, options);
  const PlaneSearchResult result = search.find_way_out({}, yes);
  EXPECT_EQ(result.status, PlaneSearchStatus::TestLimit);
  EXPECT_EQ(result.tests, 10);
  EXPECT_EQ(result.path.size(), 11u);
}

TEST(PlaneSearch, ReportsNoWayWhereTheArmRefusesARing) {
  const Ground ground;
  PlaneSearchOptions options;
  options.directions = 12;
  PlaneSearch search(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1, options);
  const auto within = [](const LatticePoint&, const LatticePoint& to) {
    return to.i * to.i + to.j * to.j < 36 ? StepAnswer::Yes : StepAnswer::Never;
  };
  const PlaneSearchResult result = search.find_way_out({}, within);
  EXPECT_EQ(result.status, PlaneSearchStatus::NoWay);
  const LatticePoint& end = result.path.back();  // the farthest that was accepted
  EXPECT_GE(end.i * end.i + end.j * end.j, 34);
}

// Plain geometry: which cells does the placed polygon touch, which does it contain?
struct PlainFlood {
  const Ground& ground;
  const GripperOutline& hand;
  const PlaneSearch& search;
  double anchor_x, anchor_y;

  static Vector2d placed(const PlanarPose& pose, const Vector2d& p) {
    return {pose.x + std::cos(pose.theta) * p.x() - std::sin(pose.theta) * p.y(),
            pose.y + std::sin(pose.theta) * p.x() + std::cos(pose.theta) * p.y()};
  }

  bool is_blocked(const LatticePoint& point) const {
    const PlanarPose pose = search.pose(point);
    for (std::size_t layer = 0; layer < hand.pieces.size(); ++layer) {
      Region piece;
      piece.loops.emplace_back();
      for (const Vector2d& p : hand.pieces[layer].polygon) {
        piece.loops.front().push_back(placed(pose, p));
      }
      for (int row = 0; row < ground.full.side(); ++row) {
        for (int column = 0; column < ground.full.side(); ++column) {
          if (!ground.full.is_filled(static_cast<int>(layer), column, row)) continue;
          const Vector2d corner = ground.full.corner() + kCell * Vector2d(column, row);
          bool inside = true;  // convex: the corners tell
          for (const Vector2d& c :
               {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)}) {
            inside = inside && contains(piece, corner + kCell * c) &&
                     boundary_distance(piece, corner + kCell * c) > 1e-8;
          }
          if (inside) return true;
        }
      }
    }
    return false;
  }
};

TEST(PlaneSearch, FindsAWayWheneverAFloodOfTheSameLatticeDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.075, 0.075), size(0.008, 0.05);
  PlaneSearchOptions options;
  options.directions = 12;
  int ways = 0, none = 0;
  for (int round = 0; round < 12; ++round) {
    Ground ground;
    for (int n = 0; n < 11; ++n) {
      const double x = place(random), y = place(random), w = size(random), h = size(random);
      if (std::hypot(x, y) < 0.03) continue;
      ground.add(rectangle(x - w, y - 0.3 * h, x + w, y + 0.3 * h));
    }
    const GripperOutline hand = small_hand();
    PlaneSearch search(ground.touched, ground.full, hand, {0.0013, -0.0007, 0.2}, 0.06, options);
    const PlainFlood plain{ground, hand, search, 0.0013, -0.0007};
    // What the step test refuses, at random but always the same.
    const auto may_step = [&](const LatticePoint& from, const LatticePoint& to) {
      const std::size_t at = static_cast<std::size_t>((to.k * 101 + to.j + 50) * 101 + to.i + 50);
      if (at * 2654435761u % 97 < 22) return StepAnswer::Never;
      const std::size_t way =
          at * 31 + static_cast<std::size_t>(from.i * 5 + from.j * 3 + from.k + 500);
      return way * 2654435761u % 89 < 8 ? StepAnswer::NotFromThere : StepAnswer::Yes;
    };
    const PlaneSearchResult result = search.find_way_out({}, may_step);

    std::set<std::tuple<int, int, int>> reached{{0, 0, 0}};
    std::queue<LatticePoint> open;
    open.push({});
    bool out = false;
    while (!open.empty() && !out) {
      const LatticePoint p = open.front();
      open.pop();
      for (int di = -1; di <= 1; ++di) {
        for (int dj = -1; dj <= 1; ++dj) {
          for (int dk = -1; dk <= 1; ++dk) {
            if ((dk != 0) == (di != 0 || dj != 0)) continue;
            const LatticePoint to{p.i + di, p.j + dj, (p.k + dk + 12) % 12};
            if (std::max(std::abs(to.i), std::abs(to.j)) > search.half()) continue;
            if (reached.count({to.i, to.j, to.k}) != 0 || plain.is_blocked(to)) continue;
            if (may_step(p, to) != StepAnswer::Yes) continue;
            reached.insert({to.i, to.j, to.k});
            open.push(to);
            // An exit is a point where the hand shares no cell with an obstacle.
            out = out || (search.is_exit(to) && search.is_free(to));
          }
        }
      }
    }
    EXPECT_EQ(result.found(), out) << "round " << round;
    if (result.found()) expect_way(search, {}, result);
    (out ? ways : none) += 1;
  }
  EXPECT_GT(ways, 2);
  EXPECT_GT(none, 2);
}

TEST(PlaneSearch, MasksNoPointWhereTheHandLiesOnNoObstacle) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (int round = 0; round < 5; ++round) {
    Ground ground;
    std::vector<Region> obstacles;
    for (int n = 0; n < 6; ++n) {
      const double x = place(random), y = place(random);
      obstacles.push_back(rectangle(x, y, x + 0.02, y + 0.013));
      ground.add(obstacles.back());
    }
    const GripperOutline hand = small_hand();
    const PlaneSearch search(ground.touched, ground.full, hand, {0.002, 0.001, -0.4}, 0.08);
    for (int k = 0; k < search.directions(); k += 7) {
      for (int j = -20; j <= 20; ++j) {
        for (int i = -20; i <= 20; ++i) {
          Region piece;
          piece.loops.emplace_back();
          for (const Vector2d& p : hand.pieces[0].polygon) {
            piece.loops.front().push_back(PlainFlood::placed(search.pose({i, j, k}), p));
          }
          double shared = 0.0;
          for (const Region& obstacle : obstacles) shared += area(intersect(piece, obstacle));
          // Free: no overlap. Blocked: an overlap of at least a cell.
          if (search.is_free({i, j, k})) EXPECT_LT(shared, 1e-9);
          if (search.is_blocked({i, j, k})) EXPECT_GE(shared, kCell * kCell - 1e-9);
        }
      }
    }
  }
}

TEST(PlaneSearch, GivesTheSameWayTwice) {
  Ground ground;
  ground.add(rectangle(-0.08, -0.03, -0.06, 0.05));
  for (int i = 0; i < 2; ++i) {
    PlaneSearch a(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1);
    PlaneSearch b(ground.touched, ground.full, small_hand(), {0, 0, 0}, 0.1);
    const PlaneSearchResult one = a.find_way_out({}, yes), two = b.find_way_out({}, yes);
    ASSERT_EQ(one.path.size(), two.path.size());
    for (std::size_t k = 0; k < one.path.size(); ++k) EXPECT_TRUE(one.path[k] == two.path[k]);
  }
}

TEST(PlaneSearch, RefusesWhatDoesNotFit) {
  const Ground ground;
  const GripperOutline hand = small_hand();
  const MotionGrid coarse({0, 0}, 0.2, 0.005, 1);
  EXPECT_THROW(PlaneSearch(ground.touched, coarse, hand, {0, 0, 0}, 0.1), InvalidInput);
  EXPECT_THROW(PlaneSearch(ground.touched, ground.full, hand, {0.5, 0, 0}, 0.1), InvalidInput);
  EXPECT_THROW(PlaneSearch(ground.touched, ground.full, hand, {0, NAN, 0}, 0.1), InvalidInput);
  EXPECT_THROW(PlaneSearch(ground.touched, ground.full, hand, {0, 0, 0}, -0.1), InvalidInput);
  PlaneSearchOptions options;
  options.directions = 2;
  EXPECT_THROW(PlaneSearch(ground.touched, ground.full, hand, {0, 0, 0}, 0.1, options),
               InvalidInput);
  options = {};
  options.close_cost = 0.5;
  EXPECT_THROW(PlaneSearch(ground.touched, ground.full, hand, {0, 0, 0}, 0.1, options),
               InvalidInput);
  PlaneSearch search(ground.touched, ground.full, hand, {0, 0, 0}, 0.1);
  EXPECT_THROW(search.find_way_out({}, nullptr), InvalidInput);
}

}  // namespace
}  // namespace handey
