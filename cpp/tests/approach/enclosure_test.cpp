// What stands round a hand over a block, in cells where it is known.
#include "handey/approach/enclosure.hpp"

#include <gtest/gtest.h>

#include "handey/errors.hpp"
#include "puma_scene.hpp"

namespace handey {
namespace {

using namespace test;

/// The hand over the block, pointing down, its fingers beside it.
Configuration over_block(const Cell& cell, const SphericalWristSolver& solver) {
  Pose X_WH = Pose::Identity();
  X_WH.linear() = Eigen::AngleAxisd(std::acos(-1.0), Eigen::Vector3d::UnitX()).toRotationMatrix();
  X_WH.translation() = Eigen::Vector3d(0.5, 0.2, 0.04);
  const std::vector<InverseSolution> found = solver.solve(cell.X_WR.inverse() * X_WH).solutions;
  EXPECT_FALSE(found.empty());
  return {found.front().q, 0.08};
}

TEST(Enclosure, IsNothingInTheOpenAndTheRoofUnderOne) {
  const SphericalWristSolver solver(*puma());
  const Cell open = block_on_table();
  CollisionChecker free(make_collision_model(open), open);
  for (const Hit& hit : find_enclosing(free, solver, over_block(open, solver))) {
    EXPECT_TRUE(hit.b == "block" || hit.b == "table") << hit.a << " meets " << hit.b;
  }
  // A collar round the wrist: too low for the hand to rise.
  const Cell roofed = block_on_table({box("roof", {0.3, 0.02, 0.02}, at(0.5, 0.30, 0.32)),
                                      box("other", {0.3, 0.02, 0.02}, at(0.5, 0.10, 0.32)),
                                      box("bar", {0.02, 0.3, 0.02}, at(0.60, 0.2, 0.32))});
  CollisionChecker checker(make_collision_model(roofed), roofed);
  const std::vector<Hit> hits = find_enclosing(checker, solver, over_block(roofed, solver), 0.3);
  ASSERT_FALSE(hits.empty());
  const std::string first = hits.front().b;
  EXPECT_TRUE(first == "roof" || first == "other" || first == "bar") << first;
}

TEST(Enclosure, RefusesADistanceOutOfRange) {
  const SphericalWristSolver solver(*puma());
  const Cell cell = block_on_table();
  CollisionChecker checker(make_collision_model(cell), cell);
  EXPECT_THROW(find_enclosing(checker, solver, cell.start, 0.0), InvalidInput);
}

}  // namespace
}  // namespace handey
