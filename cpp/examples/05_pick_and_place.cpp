// A whole direct pick-and-place composed from the stages, without Python: the program of a cell
// controller. A block stands between two others and goes to a place beside a third, turned. A step
// that fails sends it to the next grasp. Usage: 05_pick_and_place MODELS
#include <algorithm>
#include <cstdio>
#include <optional>

#include "puma560.hpp"

using namespace handey;

namespace {

struct Step {
  const char* action;
  std::vector<Configuration> path;
};

// Step 4 to 6 for one grasp: from the start to the part, with the part to its goal, and back home.
std::optional<std::vector<Step>> carry_out(const GraspScene& scene,
                                           const SphericalWristSolver& solver,
                                           const RankedPair& pair, const GraspPose& aim,
                                           const Eigen::VectorXd& q_pick) {
  const ApproachResult approach = plan_approach(scene, solver, pair, aim, q_pick);
  if (!approach.found()) return std::nullopt;
  const GraspPose& grasp = approach.grasp;
  const Cell& cell = scene.cell;
  const Cell holding = cell.with_held(scene.part, grasp.X_PH.inverse());
  const Cell placed = cell.with_part_at(scene.part, scene.X_WP_goal);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  const Configuration open_home{cell.robot->home, grasp.opening};
  CollisionChecker empty(scene.model, cell);
  const MotionResult transit = plan_gross_motion(empty, open_home, {approach.path.front()});
  if (!transit.found()) return std::nullopt;

  const Configuration at_part = approach.path.back();
  const Configuration held{at_part.q, grasp.width};
  CollisionChecker closing(scene.model, cell, {scene.part, {}});  // the fingers may touch the part
  if (!certify_edge(closing, at_part, held).is_free()) return std::nullopt;
  CollisionChecker carrying(scene.model, holding);
  CollisionChecker standing(scene.model, holding,
                            {std::nullopt, touching_bodies(*scene.model, cell, scene.part)});
  const RetreatResult depart = plan_retreat(standing, carrying, solver, held, up);
  if (!depart.found) return std::nullopt;

  CollisionChecker at_rest(scene.model, holding,
                           {std::nullopt, touching_bodies(*scene.model, placed, scene.part)});
  CollisionChecker after(scene.model, placed), opening(scene.model, placed, {scene.part, {}});
  for (const Eigen::VectorXd& q_place : grasp.q_place) {
    const Configuration put_down{q_place, grasp.width}, let_go{q_place, grasp.opening};
    RetreatResult deposit = plan_retreat(at_rest, carrying, solver, put_down, up);
    if (!deposit.found) continue;
    const Eigen::Vector3d back = -hand_in_world(cell, q_place).linear().col(2);
    const RetreatResult withdraw = plan_retreat(after, after, solver, let_go, back);
    if (!withdraw.found || !certify_edge(opening, put_down, let_go).is_free()) continue;
    std::reverse(deposit.path.begin(), deposit.path.end());
    const MotionResult transfer =
        plan_gross_motion(carrying, depart.path.back(), {deposit.path.front()});
    if (!transfer.found()) continue;
    const MotionResult home = plan_gross_motion(after, withdraw.path.back(), {open_home});
    if (!home.found()) continue;
    return std::vector<Step>{
        {"transit", transit.path},       {"approach", approach.path}, {"grasp", {at_part, held}},
        {"depart", depart.path},         {"transfer", transfer.path}, {"deposit", deposit.path},
        {"release", {put_down, let_go}}, {"withdraw", withdraw.path}, {"transit", home.path}};
  }
  return std::nullopt;
}

// Steps 1 to 3, then each grasp in turn until one can be carried out.
std::optional<std::vector<Step>> pick_and_place(const GraspScene& scene) {
  const SphericalWristSolver solver(*scene.cell.robot);
  for (const RankedPair& pair : rank_grasps(scene.cell, scene.part, scene.X_WP_goal).ranked) {
    for (const GraspPose& aim : find_legal_grasps(scene, solver, pair).poses) {
      for (const Eigen::VectorXd& q_pick : aim.q_pick) {
        if (auto steps = carry_out(scene, solver, pair, aim, q_pick)) return steps;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  Cell cell = example::table_cell(argc > 1 ? argv[1] : "models");
  const Eigen::Vector3d size(0.04, 0.06, 0.05);
  cell.parts = {example::box("block", size, example::at(0.45, 0.25, 0.025)),
                example::box("near", size, example::at(0.52, 0.25, 0.025)),
                example::box("far", size, example::at(0.38, 0.25, 0.025)),
                example::box("beside", size, example::at(0.45, -0.32, 0.025))};
  require_valid(cell);
  const GraspScene scene{make_collision_model(cell), cell, 0,
                         example::at(0.45, -0.22, 0.025, 1.5708)};

  const std::optional<std::vector<Step>> steps = pick_and_place(scene);
  if (!steps) {
    std::printf("no grasp can be carried out\n");
    return 1;
  }
  double total = 0.0;
  for (const Step& step : *steps) {
    const TimedPath timed = time_path(*cell.robot, step.path);
    std::printf("%-9s %3zu waypoints %6.2f s\n", step.action, step.path.size(), timed.duration());
    total += timed.duration();
  }
  std::printf("in all %.2f s\n", total);
  return 0;
}
