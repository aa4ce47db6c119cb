// Regrasping: a block is to be turned upside down. No grasp is legal both where it stands and where
// it is to stand; through which of its resting poses can one grasp hand over to another? Usage:
// 06_regrasp MODELS
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numeric>

#include "puma560.hpp"

using namespace handey;

namespace {

// Grasps that are legal with the block at a place, ascending.
std::vector<int> legal_at(const std::shared_ptr<const CollisionModel>& model, const Cell& cell,
                          const SphericalWristSolver& solver, const std::vector<PartGrasp>& grasps,
                          const Pose& X_WP) {
  std::vector<int> all(grasps.size()), legal;
  std::iota(all.begin(), all.end(), 0);
  const std::vector<CompatibleGrasps> found =
      find_compatible_grasps(model, cell, 0, solver, grasps, {all}, {X_WP});
  for (const CompatibleGrasp& grasp : found.front().legal) legal.push_back(grasp.grasp);
  return legal;
}

std::size_t common(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both.size();
}

}  // namespace

int main(int argc, char** argv) {
  Cell cell = example::table_cell(argc > 1 ? argv[1] : "models");
  cell.parts = {example::box("block", {0.06, 0.09, 0.05}, example::at(0.48, 0.26, 0.025, 0.3))};
  require_valid(cell);
  const Body& block = cell.parts.front();
  const Pose upside_down = example::at(0.45, -0.30, 0.025, 1.0) *
                           Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitX());

  const std::shared_ptr<const CollisionModel> model = make_collision_model(cell);
  const SphericalWristSolver solver(*cell.robot);
  const std::vector<PartGrasp> grasps = sample_part_grasps(block, cell.robot);
  const std::vector<int> start = legal_at(model, cell, solver, grasps, block.X_WB);
  const std::vector<int> goal = legal_at(model, cell, solver, grasps, upside_down);
  std::printf("%zu grasps of the block: %zu legal where it stands, %zu upside down, %zu at both\n",
              grasps.size(), start.size(), goal.size(), common(start, goal));

  bool joined = false;
  for (const RestingPose& rest : resting_poses(block)) {
    // The part over a point of the table in reach; the planner looks at many.
    const Pose X_WP = example::at(0.50, 0.0, 0.0) * rest.X_SP;
    const std::vector<int> here = legal_at(model, cell, solver, grasps, X_WP);
    const Eigen::Vector3d up = rest.X_SP.linear().row(2);
    const std::size_t from = common(start, here), on = common(here, goal);
    std::printf("  standing with (%+.0f %+.0f %+.0f) up: put down by %zu, taken on by %zu%s\n",
                up.x(), up.y(), up.z(), from, on, from > 0 && on > 0 ? ": joins" : "");
    joined = joined || (from > 0 && on > 0);
  }
  return common(start, goal) == 0 && joined ? 0 : 1;
}
