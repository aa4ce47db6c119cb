// Claims about the linked slices: every box called free is free, whatever the wrist does within it;
// boxes tile the joints' ranges.
#include "handey/cspace/free_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "../collision/puma_cell.hpp"
#include "handey/cspace/search.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using testing::box_body;
using testing::Random;

Configuration free_configuration(CollisionChecker& checker, Random& random) {
  for (;;) {
    Configuration drawn = random.configuration(*checker.cell().robot);
    drawn.opening = 0.08;
    if (checker.is_free(drawn, 1e-3)) return drawn;
  }
}

Cell table() {
  Cell cell = testing::puma_cell();
  for (int i = 0; i < 5; ++i) {
    cell.fixtures.push_back(box_body("box" + std::to_string(i), {0.1, 0.15, 0.1 + 0.06 * i},
                                     testing::at(0.35 + 0.1 * i, 0.3 - 0.15 * i, 0.05 + 0.03 * i)));
  }
  return cell;
}

Cell clutter_with_part() {
  Pose X_HP = Pose::Identity();
  X_HP.translation() = Eigen::Vector3d(0.03, 0.0, 0.02);
  return testing::cluttered_cell(25).with_held(0, X_HP);
}

Cell shelf() {
  Cell cell = testing::puma_cell();
  for (int i = 0; i < 4; ++i) {
    cell.fixtures.push_back(box_body("board" + std::to_string(i), {0.3, 0.8, 0.02},
                                     testing::at(0.75, 0, 0.2 + 0.25 * i)));
    cell.fixtures.push_back(box_body("upright" + std::to_string(i), {0.3, 0.02, 0.77},
                                     testing::at(0.75, -0.39 + 0.26 * i, 0.575)));
  }
  return cell;
}

struct NamedCell {
  const char* name;
  Cell (*make)();
};
std::ostream& operator<<(std::ostream& out, const NamedCell& cell) { return out << cell.name; }

class FreeSpaceOf : public ::testing::TestWithParam<NamedCell> {};

// All slices that a search makes: fixed wrists, ranges, home, other stances.
TEST_P(FreeSpaceOf, CallsNoBoxFreeInWhichAConfigurationCollides) {
  const Cell cell = GetParam().make();
  CollisionChecker checker(make_collision_model(cell), cell),
      oracle(make_collision_model(cell), cell);
  Random random(11);
  long sampled = 0;
  std::array<int, 5> boxes{};  // the last: of all stances but home
  for (int query = 0; sampled < 120000 && query < 600; ++query) {
    const Configuration start = free_configuration(checker, random);
    const Configuration goal = free_configuration(checker, random);
    FreeSpace space(checker, start, {goal});
    SearchOptions options;
    options.max_proofs = 1500;
    search_free_space(space, options);
    for (int index = 0; index < space.size(); ++index) {
      const SliceBox& box = space.box(index);
      if (box.state != SliceBox::State::Free) continue;
      ++boxes[static_cast<std::size_t>(std::min(box.slice, 4))];
      const SlicePoint lower = space.lower(box), upper = space.upper(box);
      for (int k = 0; k < 30; ++k, ++sampled) {
        SlicePoint point;
        for (std::size_t d = 0; d < 4; ++d) point[d] = random.uniform(lower[d], upper[d]);
        const Configuration drawn = space.configuration(box.slice, point);
        const std::optional<Hit> hit = oracle.find_hit(drawn, 0.99e-4);
        ASSERT_FALSE(hit.has_value()) << hit->a << " and " << hit->b << ", slice " << box.slice
                                      << " level " << box.level << "." << box.wrist_level;
      }
    }
  }
  EXPECT_GE(sampled, 100000);
  for (const int count : boxes) EXPECT_GT(count, 10);
}

INSTANTIATE_TEST_SUITE_P(Cells, FreeSpaceOf,
                         ::testing::Values(NamedCell{"Table", &table},
                                           NamedCell{"ClutterWithPartHeld", &clutter_with_part},
                                           NamedCell{"Shelf", &shelf}));

TEST(FreeSpace, FindsTheBoxThatHoldsAPoint) {
  const Cell cell = testing::cluttered_cell(25);
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(12);
  const Configuration start = free_configuration(checker, random);
  const Configuration goal = free_configuration(checker, random);
  FreeSpace space(checker, start, {goal});
  space.set_window(0.3);
  for (int i = 0; i < 300; ++i) {
    const Configuration drawn = random.configuration(*cell.robot);
    const SlicePoint point{drawn.q(0), drawn.q(1), drawn.q(2), 0.0};
    const int index = space.box_at(i % 2 == 0 ? 0 : space.home_slice(), point);
    ASSERT_GE(index, 0);
    const SlicePoint lower = space.lower(space.box(index)), upper = space.upper(space.box(index));
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_LE(lower[d], point[d] + 1e-9);
      EXPECT_GE(upper[d], point[d] - 1e-9);
    }
  }
}

TEST(FreeSpace, HasFinestBoxesOfOneDegreeWithinTheWindowOnly) {
  const Cell cell = shelf();
  CollisionChecker checker(make_collision_model(cell), cell);
  Random random(13);
  SearchOptions options;
  options.windows = {0.2};
  int fine = 0;
  for (int query = 0; query < 10; ++query) {
    Configuration start = free_configuration(checker, random);
    while (checker.closest(start, 0.01).a.empty()) start = free_configuration(checker, random);
    FreeSpace space(checker, start, {free_configuration(checker, random)});
    search_free_space(space, options);
    for (int index = 0; index < space.size(); ++index) {
      const SliceBox& box = space.box(index);
      if (box.slice != 0 || box.level < Lattice::kLevels - 1) continue;
      ++fine;
      const SlicePoint lower = space.lower(box), upper = space.upper(box);
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_LE(upper[d] - lower[d], 0.01746);
        // Its parent, twice as wide, reaches into the window.
        const double middle = 0.5 * (lower[d] + upper[d]);
        EXPECT_LE(std::abs(middle - start.q(static_cast<int>(d))), 0.2 + 0.03);
      }
    }
  }
  EXPECT_GT(fine, 0);
}

TEST(FreeSpace, RefusesLevelsThatTheLatticeHasNot) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Configuration home{cell.robot->home, 0.08};
  FreeSpaceOptions options;
  options.window_level = 4;
  EXPECT_THROW(FreeSpace(checker, home, {home}, options), InvalidInput);
  options = {};
  options.wrist_splits = 11;
  EXPECT_THROW(FreeSpace(checker, home, {home}, options), InvalidInput);
}

}  // namespace
}  // namespace handey
