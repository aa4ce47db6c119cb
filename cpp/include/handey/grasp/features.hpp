// Pairs of planar faces of a part that a parallel jaw can hold: outward normals opposite and away
// from each other, an overlap seen along the normal, a distance that the jaws span. Coplanar faces
// of several shapes are one face; what of a face lies inside or against another shape of the part
// does not count. Facets of a cylinder count: pads on them touch the true cylinder along the
// facet's middle line. Spheres have no face. Not guaranteed: that the material between is unbroken,
// or that a finger gets there (that is ranking and legality). Article, grasp planning step 1.
// Frames: G is the grasp plane: midway between the faces, z the closing axis (normal of the first
// face), x along the longest edge of the overlap, origin in the overlap.
#pragma once

#include <string>
#include <vector>

#include "handey/geometry/polyhedron.hpp"
#include "handey/kinematics/gripper.hpp"
#include "handey/world/body.hpp"

namespace handey {

/// Position and direction of the hand in the grasp plane.
struct PlanarPose {
  double x = 0.0, y = 0.0;  ///< finger grasp point (origin of H) in G [m]
  double theta = 0.0;       ///< direction of the approach axis z of H, from x of G [rad]
};

/// The grasp frame in the plane frame: z_H = (cos, sin, 0), y_H = +z_G, or -z_G if `flipped` (the
/// hand turned half round).
Pose hand_in_plane(const PlanarPose& pose, bool flipped);

struct FacePair {
  int face_a = 0, face_b = 0;    ///< indices into FeaturePairs::faces
  double width = 0.0;            ///< distance between the faces at the origin of G [m]
  Pose X_PG = Pose::Identity();  ///< grasp plane in the part
  Region overlap;                ///< common area seen along z_G, in (x, y) of G [m]
  double area = 0.0;             ///< of the overlap [m2]
  /// How the width grows with x and y of G, for faces that are not quite parallel [m/m].
  Eigen::Vector2d taper = Eigen::Vector2d::Zero();

  double width_at(const Eigen::Vector2d& point) const { return width + taper.dot(point); }
};

enum class Rejection { TooWide, TooThin, LittleOverlap };

/// A pair that the jaws cannot take, and why: what a user asks when there is no grasp.
struct RejectedPair {
  int face_a = 0, face_b = 0;
  double width = 0.0;
  Rejection kind = Rejection::TooWide;
  std::string
      reason;  ///< "88.2 mm wide and 2.0 mm clearance each side, jaws open 85.0 mm: 7.2 mm short"
};

struct FeatureOptions {
  double angle = 0.0087;  ///< most the normals leave antiparallel [rad]. Choice: half a degree
  double least_face_area = 25e-6;  ///< [m2]
  double least_overlap = 25e-6;    ///< [m2]
  double jaw_clearance =
      0.002;  ///< the jaws must open at least this much wider than the part, each side [m]
};

struct FeaturePairs {
  std::vector<PlanarFace>
      faces;  ///< of all shapes of the part, in the part frame; triangles per shape
  std::vector<FacePair> pairs;  ///< that the jaws can span, largest overlap first
  std::vector<RejectedPair> rejected;
};

/// @throws InvalidInput (E_GEOMETRY, E_NUMBER, E_RANGE) for a part without shapes, bad shapes, bad
/// options
FeaturePairs find_feature_pairs(const Body& part, const Gripper& gripper,
                                const FeatureOptions& options = {});

}  // namespace handey
