// The way of greatest clearance for the hand that keeps its direction: where a slide starts from,
// and where its attraction point moves along. What the finger grasp point may not take is the
// filled cells dilated by the whole hand as it is turned; distances from there are exact; the
// widest path comes from the border in to the target (Dijkstra, the least clearance on the way as
// large as can be, ties by length). Where the hand as a whole finds none, its finger tips alone are
// asked: discs as wide as each finger; the hand will have to turn on that way. Not guaranteed: that
// the hand finds room there, or that no way exists where none is found; that is plane_search.
// Article: "Local planning", the improvement under study. After Felzenszwalb and Huttenlocher,
// Theory of Computing 8, 2012.
#pragma once

#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

struct ClearancePath {
  std::vector<Eigen::Vector2d> points;  ///< a cell apart, from the border to the target; empty if
                                        ///< there is no way [m]
  double clearance = 0.0;               ///< the least on the way, but for its last three cells [m]
  bool whole_hand = true;               ///< false: found for the finger tips alone
  bool found() const { return !points.empty(); }
};

/// Within three cells of the target the way may lead over what is not free: a grasp close over a
/// table shares cells with it.
/// @param target  of the hand; its direction is kept
/// @param exit    the way begins that far from the target [m]
/// @param enough  more clearance is worth nothing [m]
/// @throws InvalidInput (E_NUMBER, E_RANGE) for layers and pieces that differ in number, a target
/// off the grid, lengths that are not positive or more than 2 m
ClearancePath clearance_path(const MotionGrid& grid, const GripperOutline& outline,
                             const PlanarPose& target, double exit, double enough = 0.02);

/// The pieces that reach ahead of the finger grasp point, each as a disc (an octagon round it)
/// about that point as wide as the piece is there; the others as nothing, so that layers keep their
/// pieces.
GripperOutline finger_tips(const GripperOutline& outline);

/// Distance of each cell's centre from the nearest marked one, in cells; infinite if none is.
/// @param marked  side x side, row by row
std::vector<double> distance_transform(const std::vector<char>& marked, int side);

}  // namespace handey
