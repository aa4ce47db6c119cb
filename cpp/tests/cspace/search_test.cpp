// Claims about the search through the slices: its paths are certified edge by edge, start and end
// where they should, are the same every time; it serves several goals, and says why it finds none.
#include "handey/cspace/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../collision/puma_cell.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::Random;

struct Query {
  Configuration start, goal;
};

/// Pairs of free configurations that no free straight edge joins.
std::vector<Query> blocked_queries(CollisionChecker& checker, int count, std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&] {
    for (;;) {
      Configuration drawn = random.configuration(*checker.cell().robot);
      drawn.opening = 0.08;
      if (checker.is_free(drawn, 1e-3)) return drawn;
    }
  };
  std::vector<Query> queries;
  while (static_cast<int>(queries.size()) < count) {
    Query query{draw(), draw()};
    if (!certify_edge(checker, query.start, query.goal).is_free()) queries.push_back(query);
  }
  return queries;
}

void expect_equal(const Configuration& a, const Configuration& b) {
  EXPECT_EQ(a.opening, b.opening);
  EXPECT_LE((a.q - b.q).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Search, FindsPathsWhoseEveryEdgeIsFree) {
  const Cell cell = testing::cluttered_cell(12);
  CollisionChecker checker(make_collision_model(cell), cell),
      oracle(make_collision_model(cell), cell);
  int found = 0;
  for (const Query& query : blocked_queries(checker, 30, 21)) {
    FreeSpace space(checker, query.start, {query.goal});
    const SearchResult result = search_free_space(space);
    if (!result.found) {
      EXPECT_FALSE(result.reason.empty());
      continue;
    }
    ++found;
    expect_equal(result.path.front(), query.start);
    expect_equal(result.path.back(), query.goal);
    const EdgeResult proof = certify_path(oracle, result.path, {0.99e-4, 1e-5});
    EXPECT_TRUE(proof.is_free()) << proof.hit.a << " and " << proof.hit.b << " at " << proof.at;
  }
  EXPECT_GE(found, 20);
}

TEST(Search, IsTheSameEveryTime) {
  const Cell cell = testing::cluttered_cell(12);
  CollisionChecker checker(make_collision_model(cell), cell);
  for (const Query& query : blocked_queries(checker, 5, 22)) {
    FreeSpace one(checker, query.start, {query.goal}), other(checker, query.start, {query.goal});
    const SearchResult a = search_free_space(one), b = search_free_space(other);
    ASSERT_EQ(a.found, b.found);
    ASSERT_EQ(a.path.size(), b.path.size());
    for (std::size_t i = 0; i < a.path.size(); ++i) EXPECT_EQ(a.path[i].q, b.path[i].q);
  }
}

TEST(Search, ReachesAnyOfSeveralGoals) {
  const Cell cell = testing::cluttered_cell(12);
  CollisionChecker checker(make_collision_model(cell), cell);
  const std::vector<Query> queries = blocked_queries(checker, 12, 23);
  int found = 0;
  for (std::size_t i = 0; i + 2 < queries.size(); i += 3) {
    const std::vector<Configuration> goals{queries[i].goal, queries[i + 1].goal,
                                           queries[i + 2].goal};
    FreeSpace space(checker, queries[i].start, goals);
    const SearchResult result = search_free_space(space);
    if (!result.found) continue;
    ++found;
    ASSERT_GE(result.goal, 0);
    ASSERT_LT(result.goal, 3);
    expect_equal(result.path.back(), goals[static_cast<std::size_t>(result.goal)]);
    EXPECT_TRUE(certify_path(checker, result.path, {0.99e-4, 1e-5}).is_free());
  }
  EXPECT_GE(found, 2);
}

TEST(Search, LeavesNarrowPlacesByOtherStancesOfTheWrist) {
  const Cell cell = testing::cluttered_cell(25);
  CollisionChecker checker(make_collision_model(cell), cell);
  int by_stances = 0;
  for (const Query& query : blocked_queries(checker, 12, 25)) {
    FreeSpace space(checker, query.start, {query.goal});
    const SearchResult result = search_free_space(space);
    if (!result.found || result.stances == 0) continue;
    ++by_stances;
    EXPECT_TRUE(certify_path(checker, result.path, {0.99e-4, 1e-5}).is_free());
    bool turned = false;  // some joint of the wrist beyond its range from start to goal, not home
    for (const Configuration& on_way : result.path) {
      for (Eigen::Index j = 3; j < 6; ++j) {
        const double from = std::min(query.start.q(j), query.goal.q(j));
        const double to = std::max(query.start.q(j), query.goal.q(j));
        const bool at_home = on_way.q(j) == cell.robot->home(j);
        turned |= !at_home && (on_way.q(j) < from - 1e-3 || on_way.q(j) > to + 1e-3);
      }
    }
    EXPECT_TRUE(turned);
  }
  EXPECT_GT(by_stances, 0);
}

TEST(Search, SaysThatAnEndIsShutIn) {
  // Walls in front of and behind the upright arm, on both sides of the waist: it cannot fall or
  // turn far.
  Cell cell = testing::puma_cell();
  const double walls[4][2] = {{0.45, 0.0}, {-0.45, 0.0}, {0.0, 0.55}, {0.0, -0.55}};
  for (int i = 0; i < 4; ++i) {
    const bool along = walls[i][0] == 0.0;
    cell.fixtures.push_back(box_body("wall" + std::to_string(i),
                                     {along ? 1.2 : 0.1, along ? 0.1 : 1.2, 2.4},
                                     testing::at(walls[i][0], walls[i][1], 1.2)));
  }
  CollisionChecker checker(make_collision_model(cell), cell);
  const Configuration home{cell.robot->home, 0.08};
  ASSERT_TRUE(checker.is_free(home));
  Configuration goal = home;
  goal.q << 0.4, 0.3, -0.3, 0.0, 0.0, 0.0;  // beyond a wall
  ASSERT_FALSE(checker.is_free(goal));
  FreeSpace space(checker, home, {goal});
  const SearchResult result = search_free_space(space);
  EXPECT_FALSE(result.found);
  EXPECT_NE(result.reason.find("goal"), std::string::npos) << result.reason;
}

TEST(Search, StopsAtItsBudget) {
  const Cell cell = testing::cluttered_cell(25);
  CollisionChecker checker(make_collision_model(cell), cell);
  for (const Query& query : blocked_queries(checker, 6, 24)) {
    FreeSpace space(checker, query.start, {query.goal});
    SearchOptions options;
    options.max_proofs = 20;
    const SearchResult result = search_free_space(space, options);
    EXPECT_LE(result.proofs, 1000);
    if (!result.found) EXPECT_FALSE(result.reason.empty());
  }
}

TEST(Search, RefusesOptionsOutOfRange) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Configuration home{cell.robot->home, 0.08};
  FreeSpace space(checker, home, {home});
  SearchOptions options;
  options.windows.clear();
  EXPECT_THROW(search_free_space(space, options), InvalidInput);
  options = {};
  options.detour = 0.5;
  EXPECT_THROW(search_free_space(space, options), InvalidInput);
}

}  // namespace
}  // namespace handey
