// The peer: OMPL's RRT-Connect with FCL as most would use them. States are checked every degree of
// joint travel, all else is as OMPL sets it: range 20 % of the space, simplification by
// SimpleSetup::simplifySolution without limits (vertices skipped, shortcuts, B-spline). The
// obstacles are in a dynamic AABB tree made once per scene; boxes, cylinders, spheres and convex
// meshes are FCL's exact shapes, other meshes its bounding volume hierarchies.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "handey/handey.hpp"

namespace benchmark {

struct PeerResult {
  std::vector<handey::Configuration> path;  ///< empty: no exact solution within the limit
  double planning = 0.0;                    ///< CPU of setting up and solving [s]
  double simplifying = 0.0;                 ///< CPU [s]
};

/// The robot's collision geometry, made once.
class PeerRobot {
 public:
  /// @param self_pairs robot bodies to be checked against each other
  PeerRobot(const handey::Robot& robot, std::vector<std::pair<int, int>> self_pairs);
  ~PeerRobot();
  PeerRobot(PeerRobot&&) noexcept;

 private:
  friend class OmplPeer;
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// A planner for one scene.
class OmplPeer {
 public:
  /// Keeps references to both.
  OmplPeer(const handey::Cell& cell, const PeerRobot& robot);
  ~OmplPeer();

  /// @param limit CPU time for solving [s]
  PeerResult plan(const handey::Configuration& start, const handey::Configuration& goal,
                  double limit = 5.0);
  bool is_free(const handey::Configuration& configuration);

  /// Before the first plan, once per process: OMPL allows no more. Also silences it.
  static void seed(std::uint64_t seed);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace benchmark
