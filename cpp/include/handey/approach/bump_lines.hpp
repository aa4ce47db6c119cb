// Bump lines: segments round the gripper at a small distance, moving with it; one that touches a
// filled cell forbids motion along its outward normal. The gripper is given by convex pieces, each
// the shadow of one shape on the grasp plane. Errs on the large side: a piece contains its shape's
// projection, its extent the shape's. Article: Figure 5.
#pragma once

#include <vector>

#include "handey/geometry/polygon.hpp"
#include "handey/grasp/features.hpp"
#include "handey/kinematics/arm.hpp"

namespace handey {

/// One piece of the gripper seen in the grasp plane, in hand coordinates: first = along z of H
/// (approach), second = along x of H for a hand that is not flipped (z_G x z_H).
struct OutlinePiece {
  Polygon polygon;  ///< convex, counter-clockwise [m]
  double lower = 0.0,
         upper = 0.0;  ///< extent along z of G (the closing axis), from the grasp plane [m]
};

/// Gripper at one opening: fingers and palm.
struct GripperOutline {
  std::vector<OutlinePiece> pieces;
  double radius = 0.0;  ///< farthest point from the finger grasp point [m]
};
/// Pieces of the finger bodies and of the body that carries the grasp frame, as far as they lie
/// within `depth` [m] behind the finger grasp point.
/// @param opening  distance between the pads [m]
/// @param flipped  the hand turned half round about its approach axis: y of H along -z of G
/// @throws InvalidInput (E_RANGE) for an opening outside the gripper's, a depth that is not
/// positive
GripperOutline gripper_outline(const Robot& robot, double opening, bool flipped,
                               double depth = 0.25);

struct BumpLine {
  Eigen::Vector2d a, b;    ///< in hand coordinates, counter-clockwise round the piece [m]
  Eigen::Vector2d normal;  ///< outward unit normal: the bump vector
  int layer = 0;           ///< piece
};
/// The edges of each piece grown by `clearance` [m]; a corner sharper than a right angle is cut
/// off, `clearance` ahead.
/// @throws InvalidInput (E_RANGE) unless the clearance is positive, (E_GEOMETRY) for a piece that
/// is not convex and
///         counter-clockwise
std::vector<BumpLine> bump_lines(const GripperOutline& outline, double clearance);

}  // namespace handey
