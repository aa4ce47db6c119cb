// Costs are small integers, so the spreading from the exits is Dijkstra's with one bucket for each
// cost. The cost to go ignores what the step test refuses, so it never overestimates and A* with it
// is complete and takes a cheapest way; ties are broken by the order of the points, so the same
// question has the same answer.
#include "handey/approach/plane_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <unordered_map>

#include "hand_mask.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint8_t kFree = 0, kClose = 1, kBlocked = 2;
constexpr std::int32_t kNever = std::numeric_limits<std::int32_t>::max();

void require(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "plane search", message);
}

void require_valid(const MotionGrid& touched, const GripperOutline& outline, const MotionGrid& full,
                   const GripperOutline& core, const PlanarPose& anchor, double exit,
                   const PlaneSearchOptions& options) {
  if (!std::isfinite(anchor.x) || !std::isfinite(anchor.y) || !std::isfinite(anchor.theta) ||
      !std::isfinite(exit) || !std::isfinite(options.close_cost)) {
    throw InvalidInput("E_NUMBER", "plane search", "anchor, exit and costs must be finite numbers");
  }
  require(touched.side() == full.side() && touched.cell() == full.cell() &&
              touched.corner() == full.corner(),
          "the two grids must have the same place and cell");
  require(static_cast<std::size_t>(touched.layers()) == outline.pieces.size() &&
              static_cast<std::size_t>(full.layers()) == core.pieces.size(),
          "there must be one layer for each piece of the gripper");
  require(touched.is_inside({anchor.x, anchor.y}), "the anchor lies outside the grid");
  require(exit > 0.0 && exit <= 2.0, "exit " + std::to_string(exit) + " m must be in (0, 2]");
  require(options.directions >= 4 && options.directions <= 3600, "directions must be 4 to 3600");
  require(options.close_cost >= 1.0 && options.close_cost <= 20.0, "close_cost must be 1 to 20");
  require(options.most_tests >= 1, "most_tests must be at least 1");
  const double side = 2.0 * std::ceil(exit / touched.cell()) + 5.0;
  require(side * side * options.directions <= 67108864.0, "more than 2^26 lattice points");
}

}  // namespace

PlaneSearch::PlaneSearch(const MotionGrid& touched, const MotionGrid& full,
                         const GripperOutline& outline, const PlanarPose& anchor, double exit,
                         const PlaneSearchOptions& options)
    : PlaneSearch(touched, outline, full, outline, anchor, exit, options) {}

PlaneSearch::PlaneSearch(const MotionGrid& touched, const GripperOutline& outline,
                         const MotionGrid& full, const GripperOutline& core,
                         const PlanarPose& anchor, double exit, const PlaneSearchOptions& options)
    : options_(options), anchor_(anchor), cell_(touched.cell()), exit_(exit) {
  require_valid(touched, outline, full, core, anchor, exit, options);
  half_ = static_cast<int>(std::ceil(exit / cell_ - 1e-9)) + 2;
  const std::size_t side = static_cast<std::size_t>(2 * half_ + 1);
  kind_.assign(side * side * static_cast<std::size_t>(options.directions), kFree);
  classify(touched, outline, full, core);
  close_border();
  spread_costs();
}

/// Where one step leads from a point that is not on the border.
void PlaneSearch::steps(int from, Step (&out)[kSteps]) const {
  // Choice: a turn of five degrees costs as much as a cell; it moves the palm farther than that,
  // the finger tips hardly.
  const int row = 2 * half_ + 1, layer = row * row, n = options_.directions;
  const int k = from / layer;
  const int next = k + 1 < n ? layer : (1 - n) * layer, before = k > 0 ? -layer : (n - 1) * layer;
  const int offsets[kSteps] = {1, -1, row, -row, row + 1, row - 1, 1 - row, -1 - row, next, before};
  const int costs[kSteps] = {2, 2, 2, 2, 3, 3, 3, 3, 2, 2};
  for (int s = 0; s < kSteps; ++s) out[s] = {from + offsets[s], costs[s]};
}

int PlaneSearch::index(const LatticePoint& p) const {
  const int side = 2 * half_ + 1;
  return (p.k * side + p.j + half_) * side + p.i + half_;
}

LatticePoint PlaneSearch::point(int index) const {
  const int side = 2 * half_ + 1;
  return {index % side - half_, index / side % side - half_, index / side / side};
}

PlanarPose PlaneSearch::pose(const LatticePoint& p) const {
  const double turn = std::remainder(2.0 * kPi * p.k / options_.directions, 2.0 * kPi);
  return {anchor_.x + p.i * cell_, anchor_.y + p.j * cell_, anchor_.theta + turn};
}

LatticePoint PlaneSearch::nearest(const PlanarPose& pose) const {
  const int n = options_.directions;
  const int k = static_cast<int>(std::lround((pose.theta - anchor_.theta) / (2.0 * kPi) * n));
  const auto cells = [&](double d) {
    return std::clamp(static_cast<int>(std::lround(d / cell_)), 1 - half_, half_ - 1);
  };
  return {cells(pose.x - anchor_.x), cells(pose.y - anchor_.y), ((k % n) + n) % n};
}

bool PlaneSearch::is_exit(const LatticePoint& p) const {
  return cell_ * std::sqrt(p.i * p.i + p.j * p.j) >= exit_ - 1e-9;
}

bool PlaneSearch::is_blocked(const LatticePoint& p) const {
  return kind_[static_cast<std::size_t>(index(p))] == kBlocked;
}

bool PlaneSearch::is_free(const LatticePoint& p) const {
  return kind_[static_cast<std::size_t>(index(p))] == kFree;
}

bool PlaneSearch::is_open(const LatticePoint& p) const {
  return to_exit_[static_cast<std::size_t>(index(p))] != kNever;
}

void PlaneSearch::forbid(const LatticePoint& a, const LatticePoint& b) {
  forbidden_.insert(std::minmax(index(a), index(b)));
}

void PlaneSearch::classify(const MotionGrid& touched, const GripperOutline& outline,
                           const MotionGrid& full, const GripperOutline& core) {
  const Eigen::Vector2d at(anchor_.x, anchor_.y);
  const HandMasks close(touched, outline, at, half_, false), blocked(full, core, at, half_, true);
  for (int k = 0; k < options_.directions; ++k) {
    throw_if_stopped();
    const double theta = pose({0, 0, k}).theta;
    const PointMask is_close = close.at(theta), is_blocked = blocked.at(theta);
    for (int j = -half_; j <= half_; ++j) {
      std::uint8_t* kind = &kind_[static_cast<std::size_t>(index({-half_, j, k}))];
      for (int i = -half_; i <= half_; ++i, ++kind) {
        *kind = is_blocked.is_set(i, j) ? kBlocked : is_close.is_set(i, j) ? kClose : kFree;
      }
    }
  }
}

/// Nothing is asked of the points on the border, so that steps need not look where the lattice
/// ends.
void PlaneSearch::close_border() {
  for (int k = 0; k < options_.directions; ++k) {
    for (int i = -half_; i <= half_; ++i) {
      for (const LatticePoint& p : {LatticePoint{i, -half_, k}, LatticePoint{i, half_, k},
                                    LatticePoint{-half_, i, k}, LatticePoint{half_, i, k}}) {
        kind_[static_cast<std::size_t>(index(p))] = kBlocked;
      }
    }
  }
}

int PlaneSearch::entry_cost(int to, int cost) const {
  const bool close = kind_[static_cast<std::size_t>(to)] != kFree;
  return close ? static_cast<int>(cost * options_.close_cost) : cost;
}

void PlaneSearch::spread_costs() {
  to_exit_.assign(kind_.size(), kNever);
  const std::size_t buckets = static_cast<std::size_t>(3 * 20 + 1);
  std::vector<std::vector<int>> open(buckets);
  std::size_t waiting = 0;
  for (int at = 0; at < static_cast<int>(kind_.size()); ++at) {
    if (kind_[static_cast<std::size_t>(at)] != kFree || !is_exit(point(at))) continue;
    to_exit_[static_cast<std::size_t>(at)] = 0;
    open[0].push_back(at);
    ++waiting;
  }
  Step before[kSteps];  // a step and its way back cost the same in the open
  for (int cost = 0; waiting > 0; ++cost) {
    throw_if_stopped();
    std::vector<int> bucket;
    bucket.swap(open[static_cast<std::size_t>(cost) % buckets]);
    waiting -= bucket.size();
    for (const int at : bucket) {
      if (to_exit_[static_cast<std::size_t>(at)] != cost) continue;
      steps(at, before);
      for (const Step& from : before) {
        const std::size_t to = static_cast<std::size_t>(from.to);
        if (kind_[to] == kBlocked) continue;
        const int total = cost + entry_cost(at, from.cost);
        if (total >= to_exit_[to]) continue;
        to_exit_[to] = total;
        open[static_cast<std::size_t>(total) % buckets].push_back(from.to);
        ++waiting;
      }
    }
  }
}

/// One search; what the step test said is remembered for its length by the caller.
struct PlaneSearch::Run {
  // Cheapest first; then the one nearer to the exit; then by index.
  using Entry = std::tuple<int, int, int, int>;  // total, to go, point, from

  const PlaneSearch& search;
  const StepTest& may_step;
  PlaneSearchResult result;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  struct Reached {
    int cost, from;
  };
  std::unordered_map<int, Reached> reached;
  std::set<int> never;

  int to_exit(int at) const { return search.to_exit_[static_cast<std::size_t>(at)]; }

  void expand(int at) {
    const int cost = reached.at(at).cost;
    Step next[kSteps];
    search.steps(at, next);
    for (const Step& step : next) {
      const int to = step.to;
      if (to_exit(to) == kNever || reached.count(to) != 0 || never.count(to) != 0) continue;
      if (search.forbidden_.count(std::minmax(at, to)) != 0) continue;
      open.emplace(cost + search.entry_cost(to, step.cost) + to_exit(to), to_exit(to), to, at);
    }
  }

  /// Takes an entry off the queue. @return true if its point was reached by it
  bool take(const Entry& entry) {
    const auto [total, to_go, at, from] = entry;
    if (reached.count(at) != 0 || never.count(at) != 0) return false;
    ++result.tests;
    const StepAnswer answer = may_step(search.point(from), search.point(at));
    if (answer == StepAnswer::Never) never.insert(at);
    if (answer != StepAnswer::Yes) return false;
    reached[at] = {total - to_go, from};
    return true;
  }

  void trace(int at) {
    for (int p = at; p >= 0; p = reached.at(p).from) result.path.push_back(search.point(p));
    std::reverse(result.path.begin(), result.path.end());
  }

  void go(const LatticePoint& start) {
    const int first = search.index(start);
    reached[first] = {0, -1};
    int farthest = first;
    const auto squared = [&](int at) {
      const LatticePoint p = search.point(at);
      return p.i * p.i + p.j * p.j;
    };
    expand(first);
    while (!open.empty()) {
      throw_if_stopped();
      if (result.tests >= search.options_.most_tests) {
        result.status = PlaneSearchStatus::TestLimit;
        break;
      }
      const Entry entry = open.top();
      open.pop();
      if (!take(entry)) continue;
      const int at = std::get<2>(entry);
      if (squared(at) > squared(farthest)) farthest = at;
      if (to_exit(at) == 0) {
        result.status = PlaneSearchStatus::Found;
        farthest = at;
        break;
      }
      expand(at);
    }
    trace(farthest);
  }
};

PlaneSearchResult PlaneSearch::find_way_out(const LatticePoint& start, const StepTest& may_step) {
  if (!may_step) throw InvalidInput("E_VALUE", "plane search", "there must be a step test");
  require(std::max(std::abs(start.i), std::abs(start.j)) < half_ && start.k >= 0 &&
              start.k < options_.directions,
          "the start lies off the lattice");
  Run run{*this, may_step, {}, {}, {}, {}};
  Step next[kSteps];
  steps(index(start), next);
  const bool any = std::any_of(std::begin(next), std::end(next), [this](const Step& step) {
    return to_exit_[static_cast<std::size_t>(step.to)] != kNever;
  });
  if (!any) {
    run.result.status = PlaneSearchStatus::Enclosed;
    run.result.path.push_back(start);
    return run.result;
  }
  run.go(start);
  return run.result;
}

}  // namespace handey
