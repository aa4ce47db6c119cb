// Floods over the leaves of a cell tree.
#include "two_floods.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "handey/stop.hpp"

namespace handey::cspace {
namespace {

// Choice: so many times the cells of one way only are cut, as if to get through. Two ends that are
// linked are mostly found so within ten.
constexpr int kDives = 24;
constexpr std::size_t kFirstBatch = 64;  // cells cut at once after that, then twice as many ...

// Choice: on a dive, the detour that is taken to go round a cell in doubt of weight 1 [rad].
constexpr double kDetour = 0.035;

/// What a cell in doubt costs: as much as its edge, so that a way does not look worse once it has
/// been cut.
int weight_of(const TreeCell& cell) {
  return cell.state == CellState::Doubt ? 1 << (Lattice::kLevels - 1 - cell.level) : 0;
}

}  // namespace

bool TwoFloods::Entry::operator<(const Entry& other) const {
  return std::tie(other.distance, other.gap, other.cell) < std::tie(distance, gap, cell);
}

TwoFloods::TwoFloods(CellTree& tree, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
                     std::size_t most_cells, std::size_t& steps_left)
    : tree_(tree),
      ends_{start, goal},
      most_cells_(most_cells),
      steps_left_(steps_left),
      dives_left_(kDives),
      batch_(kFirstBatch) {}

TwoFloods::TwoFloods(CellTree& tree, const Eigen::VectorXd& start, CellTest goal,
                     std::size_t most_cells, std::size_t& steps_left)
    : TwoFloods(tree, start, start, most_cells, steps_left) {
  goal_ = std::move(goal);
}

Link TwoFloods::run() {
  while (true) {
    const Link link = flood();
    if (link != Link::Linked || best_ == 0) return link;
    if (dives_left_ > 0) {
      --dives_left_;
      cut_way();
    } else {
      cut_ways();
    }
  }
}

std::map<int, int> TwoFloods::border() const {
  std::map<int, int> count;
  for (const int id : border_[closed_side_]) ++count[tree_.cell(id).proof];
  return count;
}

void TwoFloods::begin() {
  best_ = kFar;
  blocked_end_ = -1;
  for (std::size_t side = 0; side < 2; ++side) {
    reached_[side].assign(tree_.size(), {});
    queue_[side] = {};
    border_[side].clear();
  }
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<int> leaves;
    if (side == 1 && goal_) {
      find_goal_leaves(leaves);
    } else {
      tree_.leaves_at(ends_[side], leaves);
    }
    for (const int id : leaves) reach(side, id, -1, 0);
    if (queue_[side].empty() && blocked_end_ < 0) blocked_end_ = static_cast<int>(side);
  }
}

void TwoFloods::find_goal_leaves(std::vector<int>& leaves) {
  in_goal_.resize(tree_.size(), -1);
  double nearest = std::numeric_limits<double>::infinity();
  int middle = -1;
  for (int id = 0; id < static_cast<int>(tree_.size()); ++id) {
    const TreeCell& cell = tree_.cell(id);
    if (cell.state == CellState::Cut) continue;
    signed char& known = in_goal_[static_cast<std::size_t>(id)];
    if (known < 0) {
      throw_if_stopped();
      known = goal_(cell.level, cell.index) ? 1 : 0;
    }
    if (known == 0) continue;
    leaves.push_back(id);
    const double gap = tree_.gap(id, ends_[0]);
    if (gap < nearest) {
      nearest = gap;
      middle = id;
    }
  }
  has_goal_ = middle >= 0;
  if (has_goal_) ends_[1] = tree_.middle(middle, ends_[0]);
}

Link TwoFloods::flood() {
  begin();
  for (std::size_t side = 0; true; side = 1 - side) {
    for (std::size_t k = 0; k < 2 && best_ == kFar; ++k) {
      if (!queue_[k].empty()) continue;
      closed_side_ = k;
      return Link::Apart;
    }
    if (best_ != kFar) {
      const bool all_ways = least(0) > tolerated() && least(1) > tolerated();
      if (best_ == 0 || dives_left_ > 0 || all_ways) return Link::Linked;
    }
    if (tree_.cells_looked_at() >= most_cells_ || steps_left_ == 0) return Link::GivenUp;
    step(side);
  }
}

int TwoFloods::least(std::size_t side) const {
  return queue_[side].empty() ? kFar : queue_[side].top().distance;
}

void TwoFloods::step(std::size_t side) {
  throw_if_stopped();
  if (queue_[side].empty()) return;
  const int id = queue_[side].top().cell;
  queue_[side].pop();
  Reached& here = reached_[side][static_cast<std::size_t>(id)];
  if (here.settled) return;
  here.settled = true;
  tree_.neighbours(id, near_);
  steps_left_ -= std::min(steps_left_, near_.size());
  for (const int next : near_) reach(side, next, id, here.distance);
}

void TwoFloods::reach(std::size_t side, int id, int from, int distance) {
  Reached& there = reached_[side][static_cast<std::size_t>(id)];
  if (there.distance <= distance) return;
  if (tree_.look(id) == CellState::Blocked) {
    if (!there.settled) border_[side].push_back(id);
    there.settled = true;
    return;
  }
  const int weight = weight_of(tree_.cell(id));
  if (distance + weight >= there.distance) return;
  there.distance = distance + weight;
  there.from = from;
  const double gap = tree_.gap(id, ends_[1 - side]);
  if (dives_left_ > 0) {
    queue_[side].push({0, kDetour * there.distance + gap, id});
  } else {
    queue_[side].push({there.distance, gap, id});
  }
  const Reached& other = reached_[1 - side][static_cast<std::size_t>(id)];
  if (other.distance == kFar) return;
  const int total = there.distance + other.distance - weight;
  if (total >= best_) return;
  best_ = total;
  meeting_ = id;
}

/// Cuts the cells in doubt on the best way found.
void TwoFloods::cut_way() {
  for (std::size_t side = 0; side < 2; ++side) {
    for (int id = meeting_; id >= 0; id = reached_[side][static_cast<std::size_t>(id)].from) {
      if (tree_.cell(id).state == CellState::Doubt) tree_.cut(id);
    }
  }
}

/// Cuts cells in doubt on any way that is nearly as good as the best.
void TwoFloods::cut_ways() {
  std::size_t left = batch_;
  batch_ *= 2;
  const int cells = static_cast<int>(tree_.size());
  for (int id = 0; id < cells && left > 0; ++id) {
    if (tree_.cell(id).state != CellState::Doubt) continue;
    const int front = reached_[0][static_cast<std::size_t>(id)].distance;
    const int back = reached_[1][static_cast<std::size_t>(id)].distance;
    if (front == kFar || back == kFar) continue;
    if (front + back - weight_of(tree_.cell(id)) > tolerated()) continue;
    tree_.cut(id);
    --left;
  }
}

}  // namespace handey::cspace
