// What stands in the way of each piece of the gripper: the cell's solids cut to the piece's extent
// along the closing axis and seen along it. Found once for a grasp; grids of any cell size are
// drawn from it. Of meshes with many triangles, such as measured ones, only the skin is drawn: what
// is inside is shut in by it. Errs on the full side otherwise, as the projections do.
#pragma once

#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"
#include "handey/world/cell.hpp"

namespace handey {

class ObstacleLayers {
 public:
  /// All fixtures and parts of the cell but the part that is held.
  /// @param X_WG grasp plane in the world
  /// @param half_size of the square about `centre` in G that matters [m]
  ObstacleLayers(const Cell& cell, const GripperOutline& outline, const Pose& X_WG,
                 const Eigen::Vector2d& centre, double half_size);

  MotionGrid draw(double cell) const;
  /// The cells wholly inside obstacles alone.
  MotionGrid draw_inside(double cell) const;

 private:
  void add(const Body& body, const Pose& X_GB, const GripperOutline& outline);
  void add_skin(const TriangleMesh& mesh, const Pose& X_GS, const GripperOutline& outline);

  Eigen::Vector2d centre_;
  double half_size_;
  std::vector<std::vector<Region>> layers_;
};

}  // namespace handey
