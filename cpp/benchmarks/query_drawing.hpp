// How queries are drawn: random numbers that are the same on every machine, free configurations,
// and what all queries have in common.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "gross_scenes.hpp"

namespace benchmark {

constexpr double kEndClearance = 1e-3;  ///< of start and goal [m]
constexpr double kLeastTravel = 0.3;    ///< of the hand from start to goal [m]
constexpr int kQueriesPerScene = 10;
constexpr std::uint64_t kRoadmapSeed = 7;

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(between(0.0, count)); }

 private:
  std::mt19937_64 generator_;
};

/// Uniform within the joints' limits, the gripper open.
inline handey::Configuration random_free(handey::CollisionChecker& checker, Random& random) {
  const handey::Robot& robot = *checker.cell().robot;
  handey::Configuration drawn{robot.home, robot.gripper.max_opening};
  for (int attempt = 0; attempt < 100000; ++attempt) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const handey::JointLimit& limit = robot.joints[j].limit;
      drawn.q(static_cast<Eigen::Index>(j)) = random.between(limit.lower, limit.upper);
    }
    if (checker.is_free(drawn, kEndClearance)) return drawn;
  }
  throw std::runtime_error("no free configuration in this scene");
}

inline bool are_apart(const handey::Cell& cell, const handey::Configuration& a,
                      const handey::Configuration& b) {
  const Eigen::Vector3d travel = handey::hand_in_world(cell, a.q).translation() -
                                 handey::hand_in_world(cell, b.q).translation();
  return travel.norm() >= kLeastTravel;
}

/// Scenes of ten queries each, from random numbers of their own.
/// @param make_scene (random, number of queries) to a setting
template <class MakeScene>
std::vector<Setting> draw_settings(std::uint64_t seed, int queries, const MakeScene& make_scene) {
  std::vector<Setting> settings;
  for (int done = 0; done < queries; done += kQueriesPerScene) {
    Random random(seed * 1000003 + settings.size());
    settings.push_back(make_scene(random, std::min(kQueriesPerScene, queries - done)));
  }
  return settings;
}

}  // namespace benchmark
