#include "handey/cspace/slice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "../collision/puma_cell.hpp"
#include "../kinematics/test_arms.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using testing::at;
using testing::box_body;
using testing::Random;

constexpr double kClearance = 1e-4;

Cell six_boxes() {
  Cell cell = testing::puma_cell();
  Random random(6);
  for (int i = 0; i < 5; ++i) {
    const double angle = random.uniform(-1.1, 1.1), radius = random.uniform(0.45, 0.8);
    const Eigen::Vector3d size(random.uniform(0.08, 0.25), random.uniform(0.08, 0.25),
                               random.uniform(0.1, 0.4));
    Pose X = at(radius * std::cos(angle), radius * std::sin(angle), 0.5 * size.z());
    X.rotate(Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()));
    cell.fixtures.push_back(box_body("box" + std::to_string(i), size, X));
  }
  return cell;
}

Cell shelf() {
  Cell cell = testing::puma_cell();
  for (int i = 0; i < 4; ++i) {
    cell.fixtures.push_back(box_body("upright" + std::to_string(i), {0.32, 0.02, 0.8},
                                     at(0.76, -0.39 + 0.26 * i, 0.5)));
    cell.fixtures.push_back(
        box_body("board" + std::to_string(i), {0.32, 0.8, 0.02}, at(0.76, 0.0, 0.11 + 0.26 * i)));
  }
  cell.fixtures.push_back(box_body("back", {0.02, 0.8, 0.8}, at(0.93, 0.0, 0.5)));
  return cell;
}

Cell holding(const Cell& cell) {
  Pose X_HP = at(0.0, 0.01, 0.02);
  X_HP.rotate(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitX()));
  Cell with_bar = cell;
  with_bar.parts.push_back(box_body("bar", {0.03, 0.12, 0.04}, at(-0.5, 0.3, 0.5)));
  return with_bar.with_held(static_cast<int>(with_bar.parts.size()) - 1, X_HP);
}

/// Round the hand pointing straight on, or turned down.
WristRange wrist_about(double q4, double q5, double q6, double half) {
  const Eigen::Vector3d middle(q4, q5, q6), halves(half, half, 2.0 * half);
  return {middle - halves, middle + halves};
}

std::shared_ptr<const ArmTable> puma_table(int level) {
  static std::array<std::shared_ptr<const ArmTable>, 3> tables;
  std::shared_ptr<const ArmTable>& table = tables.at(static_cast<std::size_t>(level));
  ArmTableOptions options;
  options.level = level;
  if (!table) table = make_arm_table(*testing::puma_cell().robot, options);
  return table;
}

std::vector<CellIndex> free_cells(Slice& slice) {
  std::vector<CellIndex> cells;
  const Lattice& lattice = slice.lattice();
  for (int i = 0; i < lattice.cells(slice.level(), 0); ++i) {
    for (int j = 0; j < lattice.cells(slice.level(), 1); ++j) {
      for (int k = 0; k < lattice.cells(slice.level(), 2); ++k) {
        if (slice.is_free({i, j, k})) cells.push_back({i, j, k});
      }
    }
  }
  return cells;
}

bool touches_blocked(Slice& slice, const CellIndex& cell) {
  for (std::size_t j = 0; j < 3; ++j) {
    for (const int step : {-1, 1}) {
      CellIndex next = cell;
      next[j] += step;
      const bool within =
          next[j] >= 0 && next[j] < slice.lattice().cells(slice.level(), static_cast<int>(j));
      if (within && !slice.is_free(next)) return true;
    }
  }
  return false;
}

/// A value of [lower, upper], often one of its limits.
double draw(Random& random, double lower, double upper) {
  const double choice = random.uniform(0.0, 1.0);
  return choice < 0.15 ? lower : choice < 0.3 ? upper : random.uniform(lower, upper);
}

Configuration draw_in(const Slice& slice, const CellIndex& cell, const WristRange& wrist,
                      double opening, Random& random) {
  Configuration q{Eigen::VectorXd(wrist.lower.size() + 3), opening};
  for (int j = 0; j < 3; ++j) {
    const double centre =
        slice.lattice().centre(slice.level(), j, cell[static_cast<std::size_t>(j)]);
    const double half = 0.5 * slice.lattice().cell_width(slice.level(), j);
    q.q(j) = draw(random, centre - half, centre + half);
  }
  for (Eigen::Index j = 3; j < q.q.size(); ++j) {
    q.q(j) = draw(random, wrist.lower(j - 3), wrist.upper(j - 3));
  }
  return q;
}

/// Configurations drawn in free cells, every other one in a cell at the border of the free space,
/// that the exact engine does not call free.
int count_unsound(CollisionChecker& checker, Slice& slice, const WristRange& wrist, int draws,
                  std::uint64_t seed) {
  const std::vector<CellIndex> all = free_cells(slice);
  std::vector<CellIndex> border;
  for (const CellIndex& cell : all) {
    if (touches_blocked(slice, cell)) border.push_back(cell);
  }
  EXPECT_FALSE(border.empty()) << slice.reason();
  if (border.empty()) return draws;
  Random random(seed);
  int unsound = 0;
  for (int i = 0; i < draws; ++i) {
    const std::vector<CellIndex>& cells = i % 2 == 0 ? border : all;
    const double share = random.uniform(0.0, 1.0);
    const CellIndex& cell =
        cells[static_cast<std::size_t>(share * static_cast<double>(cells.size()))];
    const Configuration q = draw_in(slice, cell, wrist, checker.cell().start.opening, random);
    if (checker.is_free(q, kClearance)) continue;
    if (++unsound > 3) continue;
    const std::optional<Hit> hit = checker.find_hit(q, kClearance);
    ADD_FAILURE() << hit->a << " meets " << hit->b << " at " << q.q.transpose() << " in cell "
                  << cell[0] << " " << cell[1] << " " << cell[2];
  }
  return unsound;
}

/// Share of configurations that are free at all sampled wrist values that lie in free cells.
double recall(CollisionChecker& checker, Slice& slice, const WristRange& wrist) {
  Random random(77);
  int free = 0, found = 0;
  for (int i = 0; i < 1500; ++i) {
    Configuration q{Eigen::VectorXd(wrist.lower.size() + 3), checker.cell().start.opening};
    CellIndex cell;
    for (int j = 0; j < 3; ++j) {
      const std::size_t joint = static_cast<std::size_t>(j);
      const Lattice& lattice = slice.lattice();
      q.q(j) = lattice.lower[joint] +
               random.uniform(0.0, 1.0) * lattice.width[joint] * lattice.count[joint];
      cell[static_cast<std::size_t>(j)] = slice.lattice().index_of(slice.level(), j, q.q(j));
    }
    bool is_free = true;
    for (int k = 0; k < 12 && is_free; ++k) {
      for (Eigen::Index j = 3; j < q.q.size(); ++j) {
        q.q(j) = random.uniform(wrist.lower(j - 3), wrist.upper(j - 3));
      }
      is_free = checker.is_free(q, kClearance);
    }
    if (!is_free) continue;
    ++free;
    if (slice.is_free(cell)) ++found;
  }
  return free == 0 ? 0.0 : static_cast<double>(found) / free;
}

struct Trial {
  SliceMode mode;
  int level;
  bool held;
  int draws;
};

/// At least 10^5 configurations over modes, resolutions and hands.
void expect_sound(const Cell& empty_handed, double least_recall) {
  const WristRange wrist = wrist_about(0.3, 0.4, -0.5, 0.25);
  for (const Trial& trial :
       {Trial{SliceMode::Cells, 0, false, 40000}, Trial{SliceMode::Cells, 1, true, 30000},
        Trial{SliceMode::Article, 0, true, 20000}, Trial{SliceMode::Article, 1, false, 20000}}) {
    SCOPED_TRACE("level " + std::to_string(trial.level) + (trial.held ? ", part held" : "") +
                 (trial.mode == SliceMode::Article ? ", tori" : ", cells"));
    const Cell cell = trial.held ? holding(empty_handed) : empty_handed;
    CollisionChecker checker(make_collision_model(cell), cell);
    SliceOptions options;
    options.mode = trial.mode;
    Slice slice(checker, puma_table(trial.level), wrist, cell.start.opening, options);
    EXPECT_EQ(slice.reason(), "");
    EXPECT_EQ(count_unsound(checker, slice, wrist, trial.draws, 11), 0);
    EXPECT_GT(recall(checker, slice, wrist), least_recall);
  }
}

TEST(Slice, CallsNothingFreeThatIsNotAmongBoxesOnATable) { expect_sound(six_boxes(), 0.3); }

TEST(Slice, CallsNothingFreeThatIsNotAmongTwentyFiveObstacles) {
  expect_sound(testing::cluttered_cell(24), 0.1);
}

TEST(Slice, CallsNothingFreeThatIsNotBeforeAShelf) { expect_sound(shelf(), 0.3); }

/// Boxes about an arm that stands at the origin.
Cell cell_of(Robot robot, double reach) {
  Cell cell;
  cell.name = "arm";
  robot.home = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
  cell.robot = std::make_shared<const Robot>(std::move(robot));
  cell.start = {cell.robot->home, cell.robot->gripper.max_opening};
  cell.fixtures.push_back(box_body("table", {1.2, 1.2, 0.05}, at(0.75, 0, -0.05)));
  Random random(120);
  for (int i = 0; i < 8; ++i) {
    const double angle = random.uniform(-3.1, 3.1), radius = random.uniform(0.6, 0.95) * reach;
    Pose X = random.pose(0.0);
    X.translation() = Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle),
                                      random.uniform(0.1, 0.8) * reach);
    const Eigen::Vector3d size(random.uniform(0.03, 0.1), random.uniform(0.03, 0.1),
                               random.uniform(0.03, 0.1));
    cell.fixtures.push_back(box_body("box" + std::to_string(i), size, X));
  }
  return cell;
}

void expect_sound_arm(const Cell& cell, const WristRange& wrist) {
  CollisionChecker checker(make_collision_model(cell), cell);
  for (const SliceMode mode : {SliceMode::Cells, SliceMode::Article}) {
    ArmTableOptions table;
    table.level = 1;
    SliceOptions options;
    options.mode = mode;
    Slice slice(checker, make_arm_table(*cell.robot, table), wrist, cell.start.opening, options);
    ASSERT_EQ(slice.reason(), "");
    EXPECT_EQ(count_unsound(checker, slice, wrist, 15000, 5), 0);
    EXPECT_GT(recall(checker, slice, wrist), 0.05);
  }
}

TEST(Slice, ServesTheIrb120WithItsMeshesAndWaistOffset) {
  const std::filesystem::path meshes =
      std::filesystem::path(HANDEY_SOURCE_DIR).parent_path() /
      "shared/data/robots/abb_irb120/abb_irb120_support/meshes/irb120_3_58/collision";
  if (!std::filesystem::exists(meshes)) GTEST_SKIP() << meshes << " is not there";
  Robot robot = testing::irb120();
  const char* files[] = {"base_link", "link_1", "link_2", "link_3", "link_4", "link_5", "link_6"};
  for (std::size_t i = 0; i < 7; ++i) {
    const LoadedMesh loaded = load_mesh((meshes / (std::string(files[i]) + ".stl")).string());
    robot.bodies[i].shapes.push_back(
        {MeshShape{std::make_shared<const TriangleMesh>(loaded.mesh), true}, Pose::Identity()});
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    robot.bodies[static_cast<std::size_t>(finger.child)].shapes.push_back(
        {Box{{0.01, 0.01, 0.04}}, Pose::Identity()});
  }
  const Eigen::Vector3d middle(0.2, 0.5, 0.1), half(0.2, 0.2, 0.4);
  expect_sound_arm(cell_of(robot, 0.6), {middle - half, middle + half});
}

TEST(Slice, ServesAnArmWithOffsetsAndAWaistWithoutLimits) {
  Robot robot = testing::ortho_parallel();
  robot.joints[0].limit.lower = -std::numeric_limits<double>::infinity();
  robot.joints[0].limit.upper = std::numeric_limits<double>::infinity();
  const auto bar = [](double x, double y, double z, const Eigen::Vector3d& size) {
    return Shape{Box{size}, at(x, y, z)};
  };
  robot.bodies[1].shapes = {bar(0.05, 0.0, 0.3, {0.2, 0.1, 0.2})};
  robot.bodies[2].shapes = {bar(0.0, 0.1, 0.3, {0.1, 0.08, 0.7})};
  robot.bodies[3].shapes = {bar(-0.1, 0.0, 0.3, {0.08, 0.08, 0.5})};
  robot.bodies[6].shapes = {bar(0.0, 0.0, 0.05, {0.06, 0.06, 0.04})};
  const Eigen::Vector3d middle(0.0, 0.4, 0.0), half(0.3, 0.3, 3.0);
  expect_sound_arm(cell_of(robot, 1.3), {middle - half, middle + half});
}

TEST(Slice, WholeTurnsOfTheLastJointCostNothingOfTheProof) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Eigen::Vector3d lower(-1.9, -1.4, -4.6), upper(2.9, 1.4, 4.6);
  Slice slice(checker, puma_table(0), {lower, upper}, 0.1);
  EXPECT_EQ(slice.reason(), "");
  EXPECT_EQ(count_unsound(checker, slice, {lower, upper}, 20000, 8), 0);
}

TEST(Slice, KeepsTheClearanceAsked) {
  const Cell cell = six_boxes();
  CollisionChecker checker(make_collision_model(cell), cell);
  const WristRange wrist = wrist_about(0.0, 0.3, 0.0, 0.1);
  SliceOptions options;
  options.clearance = 0.01;
  Slice slice(checker, puma_table(0), wrist, 0.1, options);
  Random random(3);
  const std::vector<CellIndex> cells = free_cells(slice);
  ASSERT_GT(cells.size(), 100u);
  for (int i = 0; i < 3000; ++i) {
    const std::size_t pick =
        static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(cells.size())));
    const Configuration q = draw_in(slice, cells[pick], wrist, 0.1, random);
    ASSERT_TRUE(checker.is_free(q, 0.0099)) << q.q.transpose();
  }
}

TEST(Slice, FindsMoreFreeCellsTheFinerItIs) {
  const Cell cell = six_boxes();
  CollisionChecker checker(make_collision_model(cell), cell);
  const WristRange wrist = wrist_about(0.0, 0.3, 0.0, 0.1);
  double before = 0.0;
  for (int level = 0; level < 3; ++level) {
    Slice slice(checker, puma_table(level), wrist, 0.1);
    const double found = recall(checker, slice, wrist);
    EXPECT_GT(found, before);
    before = found;
  }
}

TEST(Slice, BuildsLayersWhenAsked) {
  const Cell cell = six_boxes();
  CollisionChecker checker(make_collision_model(cell), cell);
  Slice slice(checker, puma_table(0), wrist_about(0.0, 0.3, 0.0, 0.1), 0.1);
  EXPECT_EQ(slice.layers_built(), 0);
  slice.is_free({4, 5, 6});
  slice.is_free({4, 6, 6});
  EXPECT_EQ(slice.layers_built(), 1);
  EXPECT_EQ(slice.blocked(4).size(),
            static_cast<std::size_t>(slice.lattice().cells(0, 1) * slice.words_per_row()));
}

TEST(Slice, CellsPastTheLastOneAreBlocked) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  Slice slice(checker, puma_table(0), wrist_about(0.0, 0.3, 0.0, 0.1), 0.1);
  const int columns = slice.lattice().cells(0, 2);
  ASSERT_NE(columns % 64, 0);
  for (const std::uint64_t word : slice.blocked(20)) {
    EXPECT_EQ(word >> (columns % 64), ~std::uint64_t{0} >> (columns % 64));
  }
}

TEST(Slice, SaysWhenTheHandMayMeetTheForearm) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const Eigen::Vector3d lower(0.0, 1.5, 0.0), upper(0.5, 1.745, 3.0);
  Slice slice(checker, puma_table(0), {lower, upper}, 0.1);
  EXPECT_NE(slice.reason(), "");
  EXPECT_FALSE(slice.is_free({20, 17, 17}));
}

TEST(Slice, ABodyInsideASolidMeshIsNotFree) {
  // The whole arm in a hollow-looking mesh: patches of its surface alone would say it is free.
  Cell cell = testing::puma_cell();
  cell.fixtures.clear();
  cell.parts.clear();
  TriangleMesh mesh = testing::tray_mesh({8.0, 8.0, 4.0}, 4.0);
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(3.141592653589793, Eigen::Vector3d::UnitX()).toRotationMatrix();
  X.translation() = Eigen::Vector3d(0, 0, -2.0);  // its thick floor is all round the arm
  cell.fixtures.push_back(testing::mesh_body("block", mesh, X));
  CollisionChecker checker(make_collision_model(cell), cell);
  ASSERT_FALSE(checker.is_free(cell.start));
  Slice slice(checker, puma_table(0), wrist_about(0.0, 0.3, 0.0, 0.1), 0.1);
  EXPECT_TRUE(free_cells(slice).empty());
  EXPECT_NE(slice.reason(), "");
}

TEST(Slice, RefusesWrongInputs) {
  const Cell cell = testing::puma_cell();
  CollisionChecker checker(make_collision_model(cell), cell);
  const WristRange wrist = wrist_about(0.0, 0.3, 0.0, 0.1);
  const auto code = [&](std::shared_ptr<const ArmTable> table, const WristRange& range,
                        double opening, double clearance) -> std::string {
    SliceOptions options;
    options.clearance = clearance;
    try {
      Slice slice(checker, std::move(table), range, opening, options);
    } catch (const InvalidInput& error) {
      return error.faults().front().code;
    }
    return "";
  };
  EXPECT_EQ(code(puma_table(0), wrist, 0.1, 1e-4), "");
  EXPECT_EQ(code(nullptr, wrist, 0.1, 1e-4), "E_REF");
  EXPECT_EQ(code(puma_table(0), {wrist.upper, wrist.lower}, 0.1, 1e-4), "E_RANGE");
  EXPECT_EQ(code(puma_table(0), {wrist.lower.head<2>(), wrist.upper.head<2>()}, 0.1, 1e-4),
            "E_DOF");
  EXPECT_EQ(code(puma_table(0), wrist, 0.2, 1e-4), "E_RANGE");
  EXPECT_EQ(code(puma_table(0), wrist, 0.1, std::nan("")), "E_RANGE");
  Robot other = *testing::puma_cell().robot;
  other.joints[1].limit.upper -= 0.1;
  EXPECT_EQ(code(make_arm_table(other), wrist, 0.1, 1e-4), "E_REF");
}

}  // namespace
}  // namespace handey
