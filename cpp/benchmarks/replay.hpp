// Is a path free? Looked at every 0.25 degrees by code that neither planner uses: separating axes
// (separating_axes.hpp). What the planners and the replay share is the robot: its shapes and
// body_poses. Not guaranteed: contacts shorter than the step between two samples are not seen.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "separating_axes.hpp"

namespace benchmark {

struct Contact {
  std::string a, b;    ///< empty: none
  double depth = 0.0;  ///< [m]
  double at = 0.0;     ///< of a path, in edges
};

struct ReplayResult {
  Contact deepest;     ///< of those deeper than the tolerance
  std::string reason;  ///< empty: the path is valid
  bool is_valid() const { return reason.empty(); }
};

/// Robot bodies that are checked against each other: all but those that do not move against each
/// other, those joined by a joint, the robot file's list, and those that overlap at home and in
/// more than 950 of 1000 random configurations. The rule is handey's, the code is not.
std::vector<std::pair<int, int>> checked_self_pairs(const handey::Robot& robot);

class Replay {
 public:
  Replay(const handey::Cell& cell, std::vector<std::pair<int, int>> self_pairs);

  /// The deepest contact deeper than 0.01 mm.
  Contact find_contact(const handey::Configuration& configuration);
  /// Also false: a path that does not lead from start to goal, or leaves the joints' limits.
  ReplayResult check(const std::vector<handey::Configuration>& path,
                     const handey::Configuration& start, const handey::Configuration& goal);

 private:
  struct Obstacle {
    std::string name;
    std::vector<Solid> solids;  // in R
    Eigen::AlignedBox3d box;
  };
  void place(const handey::Configuration& configuration);

  handey::Cell cell_;
  std::vector<std::pair<int, int>> self_pairs_;
  std::vector<std::vector<Solid>> bodies_, placed_;  // by robot body: in its frame, in R
  std::vector<Obstacle> obstacles_;
  std::vector<handey::Pose> poses_;
};

}  // namespace benchmark
