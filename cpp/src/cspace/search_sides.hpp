// The two sides of the search through the slices: what each has reached, and what it goes on with.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "end_connection.hpp"
#include "handey/cspace/free_space.hpp"

namespace handey::cspace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// How long the arm takes from point to point at its velocity limits.
class Clock {
 public:
  explicit Clock(const FreeSpace& space, const Robot& robot) {
    for (std::size_t j = 0; j < 3; ++j) speed_[j] = robot.joints[j].limit.velocity;
    for (const Configuration& goal : space.goals()) {
      double wrist = 0.0;
      for (Eigen::Index j = 3; j < goal.q.size(); ++j) {
        wrist = std::max(wrist, std::abs(goal.q(j) - space.start().q(j)) /
                                    robot.joints[static_cast<std::size_t>(j)].limit.velocity);
      }
      wrist_.push_back(wrist);
    }
  }
  double time(const SlicePoint& a, const SlicePoint& b, int goal) const {
    double time = goal < 0 ? 0.0 : wrist_[static_cast<std::size_t>(goal)] * std::abs(a[3] - b[3]);
    for (std::size_t j = 0; j < 3; ++j) time = std::max(time, std::abs(a[j] - b[j]) / speed_[j]);
    return time;
  }

 private:
  std::array<double, 3> speed_{};
  std::vector<double> wrist_;
};

struct Label {
  double cost = kInfinity;  ///< from this side's end to the entry [s]
  int before = -1;  ///< box that this one was entered from, or minus two minus an end's index
  int goal = -1;    ///< of the goals' side: which goal this leads to
  SlicePoint entry{};
};

struct Open {
  double estimate, cost;
  long order;
  int box, before, goal;
  SlicePoint entry;
  bool operator<(const Open& other) const {  // the queue gives the greatest first
    if (estimate != other.estimate) return estimate > other.estimate;
    if (cost != other.cost) return cost < other.cost;
    return order > other.order;
  }
};

/// The same open boxes in another order: farthest from this side's end first, whatever the way
/// costs. It leads out of narrow places, where the estimate sees no difference between the boxes.
struct Farther {
  bool operator()(const std::pair<double, Open>& a, const std::pair<double, Open>& b) const {
    return a.first != b.first ? a.first < b.first : a.second.order > b.second.order;
  }
};

struct Side {
  std::priority_queue<Open> open;
  std::priority_queue<std::pair<double, Open>, std::vector<std::pair<double, Open>>, Farther>
      outward;
  std::vector<Label> labels;  ///< per box; finite cost: expanded
  std::vector<EndConnection> ends;
  std::vector<int> beacons;  ///< boxes reached that the other side leaps to
  int turn = 0, leaps = 0, turns = 0;
  int next_leap = 0, next_stance = 0;  ///< at so many proofs
};

}  // namespace handey::cspace
