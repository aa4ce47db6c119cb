// Which of many points lie farthest along a direction, and which lie beyond a plane? A tree of
// boxes, so that for the corners of a convex solid an answer takes few of them. The answers are
// those of a loop over all points, to the last bit.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace handey {

class PointTree {
 public:
  /// @param points  must outlive the tree, unchanged
  explicit PointTree(const std::vector<Eigen::Vector3d>& points);

  /// The greatest `direction.dot(point)`; minus infinity without points.
  double farthest(const Eigen::Vector3d& direction) const;
  /// Is `direction.dot(point) > level` for any point?
  bool is_any_beyond(const Eigen::Vector3d& direction, double level) const;
  /// Indices of the points with `direction.dot(point) > level`, ascending.
  std::vector<int> beyond(const Eigen::Vector3d& direction, double level) const;

 private:
  struct Node {
    Eigen::Vector3d middle, half;  ///< of the box round them
    int first = 0, count = 0;      ///< points order_[first .. first + count), of a leaf
    int right = -1;                ///< the other half; the first half is the next node; leaf: -1
  };
  void build(int first, int count);
  /// Calls visit(index, reach) for points in boxes that may hold any with a reach of more than
  /// `level`, until it returns false. @param level  may be raised by `visit`
  template <class Visit>
  void visit_beyond(const Eigen::Vector3d& direction, const double& level,
                    const Visit& visit) const;

  const std::vector<Eigen::Vector3d>& points_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace handey
