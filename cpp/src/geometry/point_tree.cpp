// Halves along the longest side of their box, down to a few points.
#include "handey/geometry/point_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "handey/stop.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 8;             // Choice: between depth and tests per leaf
constexpr double kRounding = 1e-14;  // of a sum of three products, as a share of their size

}  // namespace

PointTree::PointTree(const std::vector<Vector3d>& points) : points_(points) {
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

void PointTree::build(int first, int count) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  throw_if_stopped();
  const auto begin = order_.begin() + first;
  const auto at = [this](int point) -> const Vector3d& {
    return points_[static_cast<std::size_t>(point)];
  };
  Eigen::AlignedBox3d box;
  std::for_each(begin, begin + count, [&](int point) { box.extend(at(point)); });
  nodes_[index].middle = box.center();
  // The middle is rounded too.
  nodes_[index].half =
      (box.max() - nodes_[index].middle).cwiseMax(nodes_[index].middle - box.min());
  if (count <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](int a, int b) { return at(a)[axis] < at(b)[axis]; });
  build(first, count / 2);
  nodes_[index].right = static_cast<int>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

template <class Visit>
void PointTree::visit_beyond(const Vector3d& direction, const double& level,
                             const Visit& visit) const {
  const Vector3d size = direction.cwiseAbs();
  // No point of the box reaches farther, whatever rounding does.
  const auto bound = [&](const Node& node) {
    const double middle = direction.dot(node.middle), half = size.dot(node.half);
    return middle + half + kRounding * (size.dot(node.middle.cwiseAbs()) + half);
  };
  // Depth first: no more wait than the tree is deep.
  std::array<std::pair<double, int>, 64> waiting;
  std::size_t count = 0;
  if (!nodes_.empty()) waiting[count++] = {bound(nodes_.front()), 0};
  while (count > 0) {
    const auto [reach, index] = waiting[--count];
    if (!(reach > level)) continue;
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.right >= 0) {
      std::pair<double, int> near{bound(nodes_[static_cast<std::size_t>(index) + 1]), index + 1};
      std::pair<double, int> far{bound(nodes_[static_cast<std::size_t>(node.right)]), node.right};
      if (near.first < far.first) std::swap(near, far);
      waiting[count++] = far;
      waiting[count++] = near;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int point = order_[static_cast<std::size_t>(i)];
      if (!visit(point, direction.dot(points_[static_cast<std::size_t>(point)]))) return;
    }
  }
}

double PointTree::farthest(const Vector3d& direction) const {
  double most = -std::numeric_limits<double>::infinity();
  visit_beyond(direction, most, [&](int, double reach) {
    most = std::max(most, reach);
    return true;
  });
  return most;
}

bool PointTree::is_any_beyond(const Vector3d& direction, double level) const {
  bool found = false;
  visit_beyond(direction, level, [&](int, double reach) {
    found = reach > level;
    return !found;
  });
  return found;
}

std::vector<int> PointTree::beyond(const Vector3d& direction, double level) const {
  std::vector<int> found;
  visit_beyond(direction, level, [&](int point, double reach) {
    if (reach > level) found.push_back(point);
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace handey
