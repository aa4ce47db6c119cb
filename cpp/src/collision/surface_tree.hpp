// Which point of a triangle surface is nearest, and is a point inside the solid that the surface
// bounds? A tree of axis-parallel boxes in the mesh's own frame. Inside is decided by the winding
// along a ray, repeated in another direction whenever the ray passes too near an edge to be sure,
// and by the solid angle if all fail.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "handey/geometry/polyhedron.hpp"

namespace handey::collision {

class SurfaceTree {
 public:
  explicit SurfaceTree(const TriangleMesh& mesh);

  /// Distance of the point from the surface [m].
  double distance(const Eigen::Vector3d& point) const;
  /// True if the surface winds round the point.
  bool contains(const Eigen::Vector3d& point) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  // leaf: triangles order_[first .. first + count); inner: count = 0
    int left = -1, right = -1;
  };
  int build(int first, int count, std::vector<Eigen::Vector3d>& centres);
  void nearest(int node, const Eigen::Vector3d& point, double& squared) const;
  /// Times the surface crosses the ray outwards less inwards. @return false if an edge is hit
  bool winding_along(int node, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     int& winding) const;

  TriangleMesh mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// Distance of a point from a triangle [m].
double point_triangle_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace handey::collision
