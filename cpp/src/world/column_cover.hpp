// Columns on a grid, each solid between two values w, covered by few convex solids.
// Heights: w is the height. Depths: w is the inverse depth, in which planes stay planes, so that
// one method serves both: a rectangle of columns between two planes is a solid with six faces. The
// rectangle that stands out most for its place is halved until all are within tolerance.
#pragma once

#include <vector>

#include "handey/world/depth_map.hpp"
#include "prism.hpp"

namespace handey::world {

/// How (u, v, w) lies in the map's frame: column u, row v.
struct ColumnSpace {
  bool perspective = false;
  double cell = 0.01;                             ///< heights: side of a column [m]
  double fx = 1.0, fy = 1.0, cx = 0.0, cy = 0.0;  ///< depths [pixels]

  Eigen::Vector3d point(double u, double v, double w) const {
    if (!perspective) return {u * cell, v * cell, w};
    const double z = 1.0 / w;
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }
};

struct Columns {
  int rows = 0, columns = 0;
  std::vector<double> upper;  ///< w of the end that was seen; NaN: the column is empty
  std::vector<double> lower;  ///< w of the other end
  ColumnSpace space;
};

struct Cover {
  std::vector<Prism> solids;  ///< map frame
  double excess = 0.0;
  bool exact_at_places = true;
};

Cover cover_columns(Columns columns, const Pose& X_WD, const DepthMapOptions& options);

}  // namespace handey::world
