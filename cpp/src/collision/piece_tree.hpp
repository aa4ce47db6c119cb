// Which pieces of a body of many are near a ball: a tree of boxes along the body's axes. Finds the
// same pieces as a look at each, in another order.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "piece.hpp"

namespace handey::collision {

class PieceTree {
 public:
  PieceTree() = default;
  explicit PieceTree(const Pieces& pieces);

  /// Calls visit(index) for every piece whose box along the body's axes is not farther than `gap`
  /// from the ball, and for some that are; stops when visit is true.
  /// @param centre in the body frame [m]
  template <class Visit>
  bool visit_near(const Eigen::Vector3d& centre, double radius, double gap,
                  const Visit& visit) const {
    return !nodes_.empty() && visit_node(0, centre, radius + gap, visit);
  }

 private:
  struct Node {
    Eigen::Vector3d centre, half;
    int first = 0, count = 0;  ///< of order_, if a leaf
    int right = 0;             ///< the left child follows its parent
  };

  int build(int first, int count, const std::vector<Eigen::AlignedBox3d>& boxes);

  template <class Visit>
  bool visit_node(int index, const Eigen::Vector3d& centre, double gap, const Visit& visit) const {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    const Eigen::Vector3d beyond = ((centre - node.centre).cwiseAbs() - node.half).cwiseMax(0.0);
    // A gap below zero is asked for where only what overlaps counts.
    if (beyond.norm() > gap) return false;
    for (int i = node.first; i < node.first + node.count; ++i) {
      if (visit(order_[static_cast<std::size_t>(i)])) return true;
    }
    if (node.count > 0) return false;
    return visit_node(index + 1, centre, gap, visit) || visit_node(node.right, centre, gap, visit);
  }

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace handey::collision
