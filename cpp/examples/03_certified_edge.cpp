// Collision: the closest pair at a configuration, and the proof that a straight motion in joint
// space is free, which no sampling of the motion gives. Usage: 03_certified_edge MODELS
#include <cstdio>

#include "puma560.hpp"

namespace {

handey::Configuration turned(const handey::Cell& cell, double joint1, double joint2) {
  handey::Configuration configuration = cell.start;
  configuration.q(0) = joint1;
  configuration.q(1) = joint2;
  return configuration;
}

bool report(const char* motion, const handey::EdgeResult& edge) {
  if (edge.is_free()) {
    std::printf("%s: free, proved with %d configurations\n", motion, edge.evaluations);
  } else {
    std::printf("%s: %s meets %s at %.0f %% of the way\n", motion, edge.hit.a.c_str(),
                edge.hit.b.c_str(), 100.0 * edge.at);
  }
  return edge.is_free();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace handey;
  const std::string models = argc > 1 ? argv[1] : "models";
  Cell cell = example::table_cell(models);
  // A thin blade: an edge check in steps of a degree would jump over it.
  cell.fixtures.push_back(example::box("blade", {0.6, 0.001, 0.8}, example::at(0.75, 0.0, 0.4)));
  require_valid(cell);
  CollisionChecker checker(make_collision_model(cell), cell);

  const Configuration left = turned(cell, 0.9, 0.0), right = turned(cell, -0.9, 0.0);
  const Hit closest = checker.closest(left);
  std::printf("closest at the left: %s and %s, %.1f mm\n", closest.a.c_str(), closest.b.c_str(),
              1e3 * closest.distance);
  std::printf("no point moves farther than %.2f m from left to right\n",
              motion_bound(checker, left, right));

  const bool up = report("up from the left", certify_edge(checker, left, turned(cell, 0.9, 1.0)));
  const bool across = report("across the blade", certify_edge(checker, left, right));
  return up && !across ? 0 : 1;
}
