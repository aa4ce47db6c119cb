// Does a chain of cells that are not proved blocked link two configurations? Two floods, one from
// either end. Where they meet by way of cells in doubt, some of these are cut and the floods begin
// anew; a flood that comes to its end without meeting the other is the proof that they are apart.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <vector>

#include "cell_tree.hpp"

namespace handey::cspace {

enum class Link { Apart, Linked, GivenUp };

/// May any configuration of a cell be one of an end's?
using CellTest = std::function<bool(int level, const CellIndex& cell)>;

class TwoFloods {
 public:
  /// @param most_cells looked at in the whole tree  @param steps_left neighbours looked up, counted
  /// down
  TwoFloods(CellTree& tree, const Eigen::VectorXd& start, const Eigen::VectorXd& goal,
            std::size_t most_cells, std::size_t& steps_left);
  /// The goal is any of the cells for which the test holds.
  TwoFloods(CellTree& tree, const Eigen::VectorXd& start, CellTest goal, std::size_t most_cells,
            std::size_t& steps_left);

  Link run();
  /// Are there cells at all for which the test holds? After run.
  bool has_goal() const { return has_goal_; }

  /// After Apart: pairs that block cells at the border of the flood that came to its end, and how
  /// many cells each.
  std::map<int, int> border() const;
  /// After Apart: did the start (0) or the goal (1) lie in blocked cells only? -1: neither.
  int blocked_end() const { return blocked_end_; }

 private:
  static constexpr int kFar = std::numeric_limits<int>::max();

  /// How a cell was reached from one end.
  struct Reached {
    int distance = kFar;  ///< sum of the weights of the cells on the way, it included
    int from = -1;
    bool settled = false;
  };
  /// A cell to go on from: the least distance first, among equals the nearest to the other end.
  struct Entry {
    int distance = 0;
    double gap = 0.0;
    int cell = 0;
    bool operator<(const Entry& other) const;
  };

  Link flood();
  void begin();
  void find_goal_leaves(std::vector<int>& leaves);
  void step(std::size_t side);
  void reach(std::size_t side, int id, int from, int distance);
  void cut_way();
  void cut_ways();
  int least(std::size_t side) const;
  int tolerated() const { return best_ + best_ / 2; }

  CellTree& tree_;
  std::array<Eigen::VectorXd, 2> ends_;  ///< of a region: the middle of a cell
  CellTest goal_;                        ///< empty: the goal is ends_[1]
  std::vector<signed char> in_goal_;     ///< by cell: -1 not known
  bool has_goal_ = true;
  std::size_t most_cells_;
  std::size_t& steps_left_;
  std::array<std::vector<Reached>, 2> reached_;
  std::array<std::priority_queue<Entry>, 2> queue_;
  std::array<std::vector<int>, 2> border_;  ///< blocked cells met
  std::vector<int> near_;
  int best_ = kFar;   ///< distance of the best way found from end to end
  int meeting_ = -1;  ///< a cell on it
  int dives_left_;
  std::size_t batch_;
  std::size_t closed_side_ = 0;
  int blocked_end_ = -1;
};

}  // namespace handey::cspace
