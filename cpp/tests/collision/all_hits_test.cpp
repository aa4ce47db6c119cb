// All hits of a configuration against the checker's own first hit, and the hand alone against the
// hand on its arm.
#include "handey/collision/all_hits.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;

bool holds(const std::vector<Hit>& hits, const Hit& hit) {
  return std::any_of(hits.begin(), hits.end(),
                     [&](const Hit& other) { return other.a == hit.a && other.b == hit.b; });
}

TEST(AllHits, HoldTheFirstHitAndAreNoneWhereItIsFree) {
  const Cell cell = cluttered_cell(12);
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(5);
  int several = 0;
  for (int i = 0; i < 500; ++i) {
    const Configuration at = random.configuration(*cell.robot);
    const std::optional<Hit> first = checker.find_hit(at);
    const std::vector<Hit> all = find_all_hits(checker, at);
    ASSERT_EQ(first.has_value(), !all.empty());
    if (first) EXPECT_TRUE(holds(all, *first));
    several += all.size() > 1 ? 1 : 0;
    const std::vector<Hit> hand = find_all_hits(checker, at, HitsOf::Hand);
    const std::vector<Hit> arm = find_all_hits(checker, at, HitsOf::Arm);
    EXPECT_EQ(hand.size() + arm.size(), all.size()) << "each pair once";
    for (const Hit& hit : hand) EXPECT_TRUE(holds(all, hit) && !holds(arm, hit));
  }
  EXPECT_GT(several, 50);
}

TEST(AllHits, OfTheHandAloneAreThoseOfTheHandOnItsArm) {
  const Cell cell = cluttered_cell(12);
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(6);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Configuration at = random.configuration(*cell.robot);
    const Pose X_RH = hand_pose(*cell.robot, at.q);
    const std::vector<Hit> on_arm = find_all_hits(checker, at, HitsOf::Hand);
    const std::vector<Hit> alone = find_hand_hits(checker, X_RH, at.opening);
    ASSERT_EQ(alone.size(), on_arm.size());
    for (const Hit& hit : on_arm) {
      EXPECT_TRUE(holds(alone, hit));
      // Deep by what the same checker measures for the arm's own overlaps.
      double deepest = 0.0;
      for (const Hit& other : robot_overlaps(checker, at, 0.0)) {
        const bool is_hand = other.a == "link6" || other.a == "left_finger" ||
                             other.a == "right_finger" || other.a == hit.a;
        if (is_hand && other.b == hit.b) deepest = std::max(deepest, -other.distance);
      }
      EXPECT_NEAR(hand_depth(checker, X_RH, at.opening, hit.b), deepest, 1e-6);
      ++met;
    }
  }
  EXPECT_GT(met, 30);
}

TEST(AllHits, RefuseNumbersThatAreNotFinite) {
  const Cell cell = cluttered_cell(3);
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_THROW(find_all_hits(checker, cell.start, HitsOf::Everything, NAN), InvalidInput);
  EXPECT_THROW(find_hand_hits(checker, Pose::Identity(), NAN), InvalidInput);
}

}  // namespace
}  // namespace handey
