// Claims about layers of slices: what is called free is free, and the rest tells the truth about
// the centres.
#include "handey/cspace/layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../collision/puma_cell.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using namespace testing;

WristRange fixed_wrist() {
  const Eigen::Vector3d values(0.3, -0.6, 0.2);
  return {values, values};
}

WristRange turning_wrist() {
  return {Eigen::Vector3d(-0.1, -0.5, -0.2), Eigen::Vector3d(0.2, -0.2, 0.4)};
}

struct Scene {
  Cell cell = cluttered_cell(10);
  std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
  CollisionChecker checker{model, cell};
  Lattice lattice = make_lattice(*cell.robot);
};

/// Random configurations in free cells of a layer that are not free.
int unsound(Scene& scene, const SliceLayer& layer, const WristRange& wrist, int level) {
  Random random(7);
  int wrong = 0, tried = 0;
  while (tried < 20000) {
    const int column = static_cast<int>(random.uniform(0.0, layer.columns));
    const int row = static_cast<int>(random.uniform(0.0, layer.rows));
    if (layer.kinds[static_cast<std::size_t>(row * layer.columns + column)] != CellKind::Free) {
      continue;
    }
    ++tried;
    const auto within = [&](double middle, int joint) {
      const double half = 0.5 * scene.lattice.cell_width(level, joint);
      return middle + random.uniform(-half, half);
    };
    Configuration c;
    c.q.resize(6);
    c.q << within(layer.theta1, 0), within(scene.lattice.centre(level, 1, column), 1),
        within(scene.lattice.centre(level, 2, row), 2), 0.0, 0.0, 0.0;
    for (int j = 0; j < 3; ++j) c.q(3 + j) = random.uniform(wrist.lower(j), wrist.upper(j));
    c.opening = 0.06;
    if (!scene.checker.is_free(c, 0.0)) ++wrong;
  }
  return wrong;
}

int count(const SliceLayer& layer, CellKind kind) {
  return static_cast<int>(std::count(layer.kinds.begin(), layer.kinds.end(), kind));
}

TEST(Layer, FreeCellsAreFreeWhereverTheArmIsInThem) {
  Scene scene;
  for (const int level : {0, 2, 3}) {
    LayerOptions options;
    options.level = level;
    const SliceLayer layer = prove_layer(scene.checker, 0.4, fixed_wrist(), 0.06, options);
    ASSERT_EQ(layer.columns, scene.lattice.cells(level, 1));
    ASSERT_EQ(layer.rows, scene.lattice.cells(level, 2));
    EXPECT_LE(std::abs(layer.theta1 - 0.4), 0.5 * scene.lattice.cell_width(level, 0) + 1e-12);
    ASSERT_GT(count(layer, CellKind::Free), layer.columns);
    EXPECT_EQ(unsound(scene, layer, fixed_wrist(), level), 0) << "level " << level;
  }
}

TEST(Layer, FreeCellsOfARangeAreFreeForEveryWristValue) {
  Scene scene;
  const SliceLayer layer = prove_layer(scene.checker, -0.9, turning_wrist(), 0.06);
  ASSERT_GT(count(layer, CellKind::Free), layer.columns);
  EXPECT_EQ(unsound(scene, layer, turning_wrist(), LayerOptions().level), 0);
}

TEST(Layer, TellsWhetherTheCentresOfTheOtherCellsCollide) {
  Scene scene;
  const SliceLayer layer = prove_layer(scene.checker, 0.4, fixed_wrist(), 0.06);
  ASSERT_GT(count(layer, CellKind::NotProved), 0);
  ASSERT_GT(count(layer, CellKind::Collides), 0);
  for (int row = 0; row < layer.rows; row += 3) {
    for (int column = 0; column < layer.columns; column += 3) {
      const CellKind kind = layer.kinds[static_cast<std::size_t>(row * layer.columns + column)];
      Configuration c;
      c.q.resize(6);
      c.q << layer.theta1, scene.lattice.centre(3, 1, column), scene.lattice.centre(3, 2, row),
          fixed_wrist().lower;
      c.opening = 0.06;
      EXPECT_EQ(scene.checker.is_free(c), kind != CellKind::Collides) << row << ' ' << column;
    }
  }
}

TEST(Layer, FinerCellsProveMore) {
  Scene scene;
  double before = 0.0;
  for (int level = 0; level < Lattice::kLevels; ++level) {
    LayerOptions options;
    options.level = level;
    const SliceLayer layer = prove_layer(scene.checker, 0.4, fixed_wrist(), 0.06, options);
    const double share = count(layer, CellKind::Free) / static_cast<double>(layer.kinds.size());
    EXPECT_GT(share, before);
    before = share;
  }
}

TEST(Layer, NamesWhatIsWrong) {
  Scene scene;
  const auto code = [&](double theta1, const WristRange& wrist, double opening,
                        const LayerOptions& options = {}) -> std::string {
    try {
      prove_layer(scene.checker, theta1, wrist, opening, options);
    } catch (const InvalidInput& error) {
      return error.faults().front().code;
    }
    return "none";
  };
  const WristRange wrist = fixed_wrist();
  LayerOptions too_fine, negative;
  too_fine.level = Lattice::kLevels;
  negative.clearance = -1.0;
  EXPECT_EQ(code(3.0, wrist, 0.06), "E_LIMIT");
  EXPECT_EQ(code(std::nan(""), wrist, 0.06), "E_NUMBER");
  EXPECT_EQ(code(0.4, wrist, 0.2), "E_RANGE");
  EXPECT_EQ(code(0.4, wrist, 0.06, too_fine), "E_RANGE");
  EXPECT_EQ(code(0.4, wrist, 0.06, negative), "E_RANGE");
  EXPECT_EQ(code(0.4, {wrist.lower, wrist.upper.head(2)}, 0.06), "E_DOF");
  EXPECT_EQ(code(0.4, {turning_wrist().upper, turning_wrist().lower}, 0.06), "E_RANGE");
  EXPECT_EQ(code(0.4, {wrist.lower, Eigen::Vector3d(0, 0, INFINITY)}, 0.06), "E_NUMBER");
}

}  // namespace
}  // namespace handey
