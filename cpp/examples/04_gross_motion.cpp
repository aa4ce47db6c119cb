// Gross motion and timing: from one side of a wall to the other, every edge proved, then timed
// within the limits. Usage: 04_gross_motion MODELS
#include <cstdio>

#include "puma560.hpp"

int main(int argc, char** argv) {
  using namespace handey;
  const std::string models = argc > 1 ? argv[1] : "models";
  Cell cell = example::table_cell(models);
  cell.fixtures.push_back(example::box("wall", {0.5, 0.02, 0.45}, example::at(0.55, 0.0, 0.225)));
  require_valid(cell);
  CollisionChecker checker(make_collision_model(cell), cell);

  // The hand points down, 0.15 m above the table, on either side; any inverse solution will do.
  const SphericalWristSolver solver(*cell.robot);
  const auto above = [&](double x, double y) {
    const Pose X_RH = pose_from_xyz_rpy({x, y, 0.15}, {3.141592653589793, 0.0, 0.0});
    std::vector<Configuration> configurations;
    for (const InverseSolution& solution : solver.solve(X_RH, &cell.robot->home).solutions) {
      const Configuration configuration{solution.q, cell.start.opening};
      if (checker.is_free(configuration)) configurations.push_back(configuration);
    }
    return configurations;
  };
  const std::vector<Configuration> starts = above(0.5, 0.25), goals = above(0.5, -0.25);
  if (starts.empty() || goals.empty()) return 1;

  const MotionResult motion = plan_gross_motion(checker, starts.front(), goals);
  if (!motion.found()) {
    std::printf("no way: %s\n", motion.reason.c_str());
    return 1;
  }
  std::printf("%s: %zu waypoints to goal %d of %zu, %d states sampled\n", motion.planner.c_str(),
              motion.path.size(), motion.goal + 1, goals.size(), motion.iterations);
  const TimedPath timed = time_path(*cell.robot, motion.path);
  std::printf("%.2f s in %zu rows\n", timed.duration(), timed.time.size());
  return certify_path(checker, motion.path).is_free() && timed.duration() > 0.0 ? 0 : 1;
}
