// Which point of a triangle surface is nearest, and is a point inside the solid that the surface
// bounds? A tree of axis-parallel boxes in the mesh's own frame. Inside is decided by the winding
// along a ray, repeated in another direction whenever the ray passes too near an edge to be sure,
// and by the solid angle if all fail. How far a convex solid is from the surface: triangle by
// triangle, of those whose boxes come near.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "convex_distance.hpp"
#include "handey/geometry/polyhedron.hpp"

namespace handey::collision {

class SurfaceTree {
 public:
  explicit SurfaceTree(const TriangleMesh& mesh);

  /// Distance of the point from the surface [m].
  double distance(const Eigen::Vector3d& point) const;
  /// Distance of a convex solid from the surface; same terms as convex_distance. 0 or less where
  /// they cross or the surface is inside the solid.
  /// @param X_MS  the solid in the mesh's frame
  double distance(const ConvexSolid& solid, const Pose& X_MS, double least, double enough) const;
  /// True if the surface winds round the point.
  bool contains(const Eigen::Vector3d& point) const;

  /// The triangles in patches that lie together. `keep(triangles)` is asked from the whole surface
  /// down; a patch that it does not want is split in two.
  template <class Keep>
  void visit_patches(const Keep& keep) const {
    if (!order_.empty()) visit_patches(0, static_cast<int>(order_.size()), keep);
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0, count = 0;  // leaf: triangles order_[first .. first + count); inner: count = 0
    int left = -1, right = -1;
  };
  struct Query;
  int build(int first, int count, std::vector<Eigen::Vector3d>& centres);
  void nearest(int node, const Eigen::Vector3d& point, double& squared) const;
  void nearest(int node, Query& query) const;
  /// Times the surface crosses the ray outwards less inwards. @return false if an edge is hit
  bool winding_along(int node, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     int& winding) const;

  TriangleMesh mesh_;
  template <class Keep>
  void visit_patches(int first, int count, const Keep& keep) const {
    const std::vector<int> patch(order_.begin() + first, order_.begin() + first + count);
    if (keep(patch) || count == 1) return;
    // The tree splits in the middle too.
    visit_patches(first, count / 2, keep);
    visit_patches(first + count / 2, count - count / 2, keep);
  }

  std::vector<int> order_;
  std::vector<Node> nodes_;
};

/// Distance of a point from a triangle [m].
double point_triangle_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace handey::collision
