// Gross motion and timing: from one side of a wall to the other, every edge proved, then timed
// within the limits. Usage: 04_gross_motion MODELS
#include <cstdio>

#include "puma560.hpp"

int main(int argc, char** argv) {
  using namespace handey;
  const std::string models = argc > 1 ? argv[1] : "models";
  Cell cell = example::table_cell(models);
  cell.fixtures.push_back(example::box("wall", {0.5, 0.02, 0.8}, example::at(0.75, 0.0, 0.4)));
  require_valid(cell);
  CollisionChecker checker(make_collision_model(cell), cell);

  // The arm stretched out level, at the height of its shoulder, to either side of the wall; two
  // goals to choose from.
  const auto stretched = [&](double joint1) {
    Configuration configuration = cell.start;
    configuration.q << joint1, 0.0, -1.5708, 0.0, 0.0, 0.0;
    return configuration;
  };
  const Configuration start = stretched(0.9);
  const std::vector<Configuration> goals = {stretched(-1.2), stretched(-0.9)};

  const MotionResult motion = plan_gross_motion(checker, start, goals);
  if (!motion.found()) {
    std::printf("no way: %s\n", motion.reason.c_str());
    return 1;
  }
  std::printf("%s: %zu waypoints to goal %d of %zu, %d states sampled\n", motion.planner.c_str(),
              motion.path.size(), motion.goal + 1, goals.size(), motion.iterations);
  const TimedPath timed = time_path(*cell.robot, motion.path);
  std::printf("%.2f s in %zu rows\n", timed.duration(), timed.time.size());
  return certify_path(checker, motion.path).is_free() && motion.goal == 1 ? 0 : 1;
}
