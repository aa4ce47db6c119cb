// Makes, splits and proves the boxes of the slices.
#include "handey/cspace/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

constexpr int kUnits = 1 << (Lattice::kLevels - 1);  // finest cells in one of level 0
constexpr int kMostSplits = 10;
constexpr int kWristUnits = 1 << kMostSplits;  // finest intervals of the wrist's range
constexpr double kPi = 3.14159265358979323846;
// Choice: boxes in which the hand can move farther than this are split without a look: nearly none
// of them is free [m].
constexpr double kHopeless = 0.45;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

// Choice: searches that end before so many proofs do without the slice over the whole range, which
// takes about as long to set up.
constexpr int kEasy = 200;

/// Cells over the ranges of the joints; over half a turn beyond start and goals where a joint has
/// no limits.
Lattice lattice_for(const Robot& robot, const Configuration& start,
                    const std::vector<Configuration>& goals) {
  Lattice lattice = make_lattice(robot);
  for (int j = 0; j < 3; ++j) {
    if (!lattice.wraps[at(j)]) continue;
    double least = start.q(j), most = start.q(j);
    for (const Configuration& goal : goals) {
      least = std::min(least, goal.q(j));
      most = std::max(most, goal.q(j));
    }
    const double range = most - least + 2.0 * kPi;
    lattice.wraps[at(j)] = false;
    lattice.lower[at(j)] = least - kPi;
    lattice.count[at(j)] = static_cast<int>(std::ceil(range / lattice.width[at(j)]));
    lattice.width[at(j)] = range / lattice.count[at(j)];
  }
  return lattice;
}

/// Per joint, an upper bound of a hand point's distance from its axis: lengths of the links beyond.
std::vector<double> reach_of(const CollisionChecker& checker) {
  const Robot& robot = *checker.cell().robot;
  double beyond = robot.gripper.X_BH.translation().norm() + robot.gripper.pad_length;
  std::vector<double> reach(robot.joints.size());
  for (std::size_t j = robot.joints.size(); j-- > 0;) {
    reach[j] = beyond;
    beyond += robot.joints[j].X_PJ.translation().norm();
  }
  return reach;
}

}  // namespace

FreeSpace::FreeSpace(CollisionChecker& checker, const Configuration& start,
                     const std::vector<Configuration>& goals, const FreeSpaceOptions& options)
    : checker_(checker),
      prover_(checker, options.clearance),
      options_(options),
      start_(start),
      goals_(goals),
      lattice_(lattice_for(*checker.cell().robot, start, goals)),
      stances_{checker.cell().robot->home.tail(start.q.size() - 3)},
      reach_(reach_of(checker)),
      roots_(at(first_stance())),
      stance_roots_(stances_.size()),
      whole_range_(goals.size()) {
  if (options.table != nullptr) {
    const Lattice& cells = options.table->lattice();
    // Not of use where a joint has no limits: its cells are laid out anew for every motion.
    if (cells.wraps == std::array<bool, 3>{} && cells.lower == lattice_.lower &&
        cells.width == lattice_.width) {
      if (options.table->level() != 0) throw InvalidInput("E_RANGE", "table", "is not of level 0");
    } else {
      options_.table = nullptr;
    }
  }
  const auto require_level = [](int level, const char* name) {
    if (level >= 0 && level < Lattice::kLevels) return;
    throw InvalidInput("E_RANGE", name, std::to_string(level) + ", expected 0 to 3");
  };
  require_level(options.window_level, "window_level");
  require_level(options.outer_level, "outer_level");
  require_level(options.range_level, "range_level");
  require_level(options.home_level, "home_level");
  if (options.wrist_splits < 0 || options.wrist_splits > kMostSplits) {
    throw InvalidInput("E_RANGE", "wrist_splits",
                       std::to_string(options.wrist_splits) + ", expected 0 to 10");
  }
}

FreeSpace::~FreeSpace() = default;

int FreeSpace::add_point(int slice) {
  SliceBox box;
  box.slice = slice;
  box.state = SliceBox::State::Point;
  boxes_.push_back(std::move(box));
  return size() - 1;
}

int FreeSpace::add_stance(const Eigen::VectorXd& q) {
  stances_.push_back(q.tail(q.size() - 3));
  stance_roots_.emplace_back();
  return slices() - 1;
}

SlicePoint FreeSpace::real(const std::array<int, 4>& units) const {
  SlicePoint point{};
  for (int j = 0; j < 3; ++j) {
    point[at(j)] = lattice_.lower[at(j)] + units[at(j)] * lattice_.width[at(j)] / kUnits;
  }
  point[3] = static_cast<double>(units[3]) / kWristUnits;
  return point;
}

Configuration FreeSpace::configuration(int slice, const SlicePoint& point) const {
  Configuration configuration = start_;
  if (is_stance(slice)) {
    const Eigen::VectorXd& wrist = stances_[at(slice - first_stance())];
    configuration.q.tail(wrist.size()) = wrist;
  } else if (slice > 0) {
    const Eigen::VectorXd& goal = goals_[at(goal_of(slice))].q;
    configuration.q =
        is_range(slice) ? Eigen::VectorXd(start_.q + point[3] * (goal - start_.q)) : goal;
  }
  for (int j = 0; j < 3; ++j) configuration.q(j) = point[at(j)];
  return configuration;
}

SlicePoint FreeSpace::start_point() const { return {start_.q(0), start_.q(1), start_.q(2), 0.0}; }

SlicePoint FreeSpace::goal_point(int goal) const {
  const Eigen::VectorXd& q = goals_[at(goal)].q;
  return {q(0), q(1), q(2), 1.0};
}

double FreeSpace::bound(const SliceBox& box, bool wrist) const {
  double bound = 0.0;
  if (!wrist) {
    for (int j = 0; j < 3; ++j) {
      bound += reach_[at(j)] * lattice_.cell_width(box.level, j) / 2.0;
    }
  } else if (is_range(box.slice)) {
    const Eigen::VectorXd& goal = goals_[at(goal_of(box.slice))].q;
    for (Eigen::Index j = 3; j < goal.size(); ++j) {
      bound += reach_[static_cast<std::size_t>(j)] * std::abs(goal(j) - start_.q(j));
    }
    bound /= static_cast<double>(2 << box.wrist_level);
  }
  return bound;
}

SliceBox::State FreeSpace::prove(int index) {
  SliceBox& box = boxes_[at(index)];
  if (box.state != SliceBox::State::Unknown) return box.state;
  throw_if_stopped();
  if (options_.table != nullptr && is_free_in_whole_range(box)) {
    box.state = SliceBox::State::Free;
    return box.state;
  }
  if (bound(box, false) + bound(box, true) > kHopeless) {
    box.state = SliceBox::State::NotProved;
    return box.state;
  }
  ConfigurationBox configurations;
  const SlicePoint from = lower(box), to = upper(box);
  SlicePoint middle;
  for (std::size_t j = 0; j < 4; ++j) middle[j] = 0.5 * (from[j] + to[j]);
  configurations.centre = configuration(box.slice, middle);
  configurations.half = Eigen::VectorXd::Zero(configurations.centre.q.size());
  for (int j = 0; j < 3; ++j) configurations.half(j) = 0.5 * (to[at(j)] - from[at(j)]);
  if (is_range(box.slice)) {
    const Eigen::VectorXd& goal = goals_[at(goal_of(box.slice))].q;
    for (Eigen::Index j = 3; j < goal.size(); ++j) {
      configurations.half(j) = 0.5 * (to[3] - from[3]) * std::abs(goal(j) - start_.q(j));
    }
  }
  ++proofs_;
  BoxProof proof =
      box.has_near ? prover_.prove(configurations, box.near) : prover_.prove(configurations);
  box.centre_collides = proof.collides;
  if (proof.free) {
    box.state = SliceBox::State::Free;
    box.near.clear();
  } else {
    box.state = SliceBox::State::NotProved;
    box.near = std::move(proof.near);
    box.has_near = true;
  }
  return box.state;
}

bool FreeSpace::is_free_in_whole_range(const SliceBox& box) {
  if (!is_range(box.slice) || box.level > 0 || proofs_ < kEasy) return false;
  std::unique_ptr<Slice>& slice = whole_range_[at(goal_of(box.slice))];
  if (slice == nullptr) {
    const Eigen::Index wrist = start_.q.size() - 3;
    const Eigen::VectorXd from = start_.q.tail(wrist);
    const Eigen::VectorXd to = goals_[at(goal_of(box.slice))].q.tail(wrist);
    SliceOptions slice_options;
    slice_options.clearance = options_.clearance;
    slice = std::make_unique<Slice>(checker_, options_.table,
                                    WristRange{from.cwiseMin(to), from.cwiseMax(to)},
                                    start_.opening, slice_options);
  }
  return slice->is_free({box.lower[0] / kUnits, box.lower[1] / kUnits, box.lower[2] / kUnits});
}

bool FreeSpace::may_split_cells(const SliceBox& box) const {
  if (is_range(box.slice)) return box.level < options_.range_level;
  if (is_stance(box.slice)) return box.level < options_.home_level;
  if (box.level < options_.outer_level) return true;
  if (box.level >= options_.window_level) return false;
  const Configuration& end = box.slice == 0 ? start_ : goals_[at(goal_of(box.slice))];
  const SlicePoint from = lower(box), to = upper(box);
  for (int j = 0; j < 3; ++j) {
    if (from[at(j)] > end.q(j) + window_ || to[at(j)] < end.q(j) - window_) return false;
  }
  return true;
}

bool FreeSpace::prefers_wrist(const SliceBox& box) const {
  if (!is_range(box.slice) || box.wrist_level >= options_.wrist_splits) return false;
  return !may_split_cells(box) || bound(box, true) > bound(box, false);
}

bool FreeSpace::split(int index) {
  if (boxes_[at(index)].first_child >= 0) return true;
  const SliceBox& box = boxes_[at(index)];
  if (prefers_wrist(box)) {
    add_children(index, true);
  } else if (may_split_cells(box)) {
    add_children(index, false);
  } else {
    return false;
  }
  return true;
}

void FreeSpace::add_children(int index, bool wrist) {
  const int first = size();
  const int count = wrist ? 2 : 8;
  SliceBox parent = boxes_[at(index)];
  boxes_[at(index)].first_child = first;
  boxes_[at(index)].children = count;
  boxes_[at(index)].near.clear();
  for (int c = 0; c < count; ++c) {
    SliceBox child;
    child.lower = parent.lower;
    child.upper = parent.upper;
    for (int d = wrist ? 3 : 0; d < (wrist ? 4 : 3); ++d) {
      const int middle = (parent.lower[at(d)] + parent.upper[at(d)]) / 2;
      const bool high = wrist ? c == 1 : ((c >> d) & 1) != 0;
      (high ? child.lower : child.upper)[at(d)] = middle;
    }
    child.slice = parent.slice;
    child.level = parent.level + (wrist ? 0 : 1);
    child.wrist_level = parent.wrist_level + (wrist ? 1 : 0);
    child.has_near = parent.has_near;
    child.near = parent.near;
    boxes_.push_back(std::move(child));
  }
}

int FreeSpace::root(int slice, const CellIndex& cell) {
  const std::array<int, 3>& count = lattice_.count;
  for (std::size_t j = 0; j < 3; ++j) {
    if (cell[j] < 0 || cell[j] >= count[j]) return -1;
  }
  const int key = (cell[0] * count[1] + cell[1]) * count[2] + cell[2];
  int* found = nullptr;
  if (is_stance(slice)) {
    found = &stance_roots_[at(slice - first_stance())].try_emplace(key, -1).first->second;
  } else {
    std::vector<int>& roots = roots_[at(slice)];
    if (roots.empty()) roots.assign(at(count[0] * count[1] * count[2]), -1);
    found = &roots[at(key)];
  }
  int& root = *found;
  if (root >= 0) return root;
  root = size();
  SliceBox box;
  box.slice = slice;
  for (std::size_t j = 0; j < 3; ++j) {
    box.lower[j] = cell[j] * kUnits;
    box.upper[j] = box.lower[j] + kUnits;
  }
  box.lower[3] = slice == 0 || is_range(slice) ? 0 : kWristUnits;
  box.upper[3] = slice == 0 ? 0 : kWristUnits;
  if (is_stance(slice)) box.lower[3] = box.upper[3] = kWristUnits / 2;
  boxes_.push_back(std::move(box));
  return root;
}

CellIndex FreeSpace::cell_of(const SlicePoint& point) const {
  CellIndex cell{};
  for (std::size_t j = 0; j < 3; ++j) {
    const double cells = (point[j] - lattice_.lower[j]) / lattice_.width[j];
    cell[j] = std::min(static_cast<int>(std::floor(cells)), lattice_.count[j] - 1);
    if (cells < 0.0 && cells > -1e-6) cell[j] = 0;
  }
  return cell;
}

int FreeSpace::box_at(int slice, const SlicePoint& point) {
  int index = root(slice, cell_of(point));
  while (index >= 0 && prove(index) != SliceBox::State::Free && split(index)) {
    const SliceBox& box = boxes_[at(index)];
    const SlicePoint middle = lower(boxes_[at(box.first_child + box.children - 1)]);
    int child = 0;
    if (box.children == 2) {
      child = point[3] > middle[3] ? 1 : 0;
    } else {
      for (int d = 0; d < 3; ++d) child |= (point[at(d)] > middle[at(d)] ? 1 : 0) << d;
    }
    index = box.first_child + child;
  }
  return index;
}

}  // namespace handey
