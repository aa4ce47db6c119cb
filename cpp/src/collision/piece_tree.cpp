#include "piece_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace handey::collision {
namespace {

constexpr int kLeaf = 4;  // Choice: pieces that are looked at one by one

Eigen::AlignedBox3d box_of(const Piece& piece) {
  const Eigen::Vector3d centre = piece.box.X_BO.translation();
  const Eigen::Vector3d reach = piece.box.X_BO.linear().cwiseAbs() * piece.box.half;
  const Eigen::AlignedBox3d box(Eigen::Vector3d(centre - reach), Eigen::Vector3d(centre + reach));
  if (!piece.convex || piece.hull.kind != ConvexSolid::Kind::Points) return box;
  Eigen::AlignedBox3d tight;
  for (const Eigen::Vector3d& point : piece.hull.points) tight.extend(point);
  tight.min().array() -= piece.hull.rounding + 1e-9;
  tight.max().array() += piece.hull.rounding + 1e-9;
  return tight.intersection(box);
}

}  // namespace

PieceTree::PieceTree(const Pieces& pieces) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& piece : pieces) boxes.push_back(box_of(*piece));
  order_.resize(pieces.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (!pieces.empty()) build(0, static_cast<int>(pieces.size()), boxes);
}

int PieceTree::build(int first, int count, const std::vector<Eigen::AlignedBox3d>& boxes) {
  const auto begin = order_.begin() + first, end = begin + count;
  Eigen::AlignedBox3d extent, middles;
  for (auto i = begin; i != end; ++i) {
    const Eigen::AlignedBox3d& box = boxes[static_cast<std::size_t>(*i)];
    extent.extend(box);
    middles.extend(Eigen::Vector3d(box.center()));
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({extent.center(), 0.5 * extent.sizes(), first, count, 0});
  if (count <= kLeaf) return index;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const auto middle = begin + count / 2;
  std::nth_element(begin, middle, end, [&boxes, axis](int a, int b) {
    const double at = boxes[static_cast<std::size_t>(a)].center()(axis);
    const double other = boxes[static_cast<std::size_t>(b)].center()(axis);
    return at != other ? at < other : a < b;
  });
  build(first, count / 2, boxes);
  const int right = build(first + count / 2, count - count / 2, boxes);
  nodes_[static_cast<std::size_t>(index)].count = 0;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

}  // namespace handey::collision
