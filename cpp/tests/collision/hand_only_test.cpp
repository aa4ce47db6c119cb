// Bodies that only the hand is kept apart from, told by a checker of the arm and one of all.
#include "handey/collision/hand_only.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "handey/errors.hpp"
#include "puma_cell.hpp"

namespace handey {
namespace {

using namespace testing;

TEST(HandOnly, TheArmPassesThroughAndTheHandDoesNot) {
  const Cell cell = cluttered_cell(12);
  const auto model = make_collision_model(cell);
  CollisionChecker all(model, cell), hand_only(model, cell);
  std::vector<BodyRef> bodies;
  for (std::size_t i = 0; i < cell.fixtures.size(); ++i) {
    bodies.push_back({BodyRef::Kind::Fixture, static_cast<int>(i)});
  }
  keep_hand_only(hand_only, bodies);
  Random random(5);
  int arm = 0, hand = 0;
  for (int i = 0; i < 3000; ++i) {
    const Configuration at = random.configuration(*cell.robot);
    const std::optional<Hit> hit = all.find_hit(at), again = hand_only.find_hit(at);
    if (!hit) {
      EXPECT_FALSE(again.has_value());
      continue;
    }
    const bool is_fixture =
        std::any_of(cell.fixtures.begin(), cell.fixtures.end(),
                    [&](const Body& fixture) { return fixture.name == hit->b; });
    if (!is_fixture) continue;
    if (hit->a == "link6" || hit->a == "left_finger" || hit->a == "right_finger") {
      ASSERT_TRUE(again.has_value());
      ++hand;
    } else {
      EXPECT_TRUE(!again || again->a != hit->a || again->b != hit->b);
      ++arm;
    }
  }
  EXPECT_GT(arm, 50);
  EXPECT_GT(hand, 50);
}

TEST(HandOnly, RefusesABodyThatDoesNotStandInTheCell) {
  const Cell cell = cluttered_cell(3);
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_THROW(keep_hand_only(checker, {{BodyRef::Kind::Fixture, 99}}), InvalidInput);
}

}  // namespace
}  // namespace handey
