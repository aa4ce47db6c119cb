// Do two convex solids overlap wherever the joints between them go within a cell? With the joints
// at the cell's centre, let x be a point inside both, r_A and r_B its depths, and m(x) a bound on
// how far the joints can move a point at x against the other solid. The balls about x and about
// where x goes to still meet if r_A + r_B > m(x). The difference is concave but for the choice of
// the bound, so a few steps of the relaxation method (Agmon, Motzkin 1954) find such a point or
// give up. The claim rests on the point found, not on the search.
#pragma once

#include <vector>

#include "handey/collision/solids.hpp"

namespace handey {

/// An axis at the centre of the cell, in R, and how far its joint goes to either side.
struct AxisMotion {
  Eigen::Vector3d point, direction;
  double chord = 0.0;   ///< 2 sin(half / 2): how far a point at distance 1 goes
  double sine = 0.0;    ///< sin(half)
  double versed = 0.0;  ///< 1 - cos(half)
};

/// The joints between two solids: at most three of a cell, inmost first, then those that may go
/// anywhere.
struct RelativeMotion {
  const AxisMotion* axes = nullptr;
  int cell_begin = 0, cell_end = 0;  ///< joints of the cell: axes[cell_begin, cell_end)
  int free_end = 0;                  ///< joints after them: axes[cell_end, free_end)

  /// Bound on how far a point at x goes [m]; its gradient if asked for.
  double bound(const Eigen::Vector3d& x, Eigen::Vector3d* gradient) const;
};

/// A solid where it is at the centre of the cell.
struct PlacedSolid {
  const InnerSolid& solid;
  const Pose& X_RS;
};

/// @param x where the search begins, in R; left where it ended
bool overlaps_throughout(const PlacedSolid& a, const PlacedSolid& b, const RelativeMotion& motion,
                         Eigen::Vector3d& x);

/// Does a face of either keep A and B apart even if A comes nearer by `motion`? Only one face of
/// each is tried.
bool plainly_apart(const PlacedSolid& a, const PlacedSolid& b, double motion);

}  // namespace handey
