// Pairs of features of a part that a parallel jaw can hold at once: two faces, a face and an edge
// or a vertex opposite to it, two edges, parallel or crossed. A pad rests on a feature if its
// direction lies in the feature's normal cone: a face's one normal, an edge's arc from one face to
// the other, a vertex's cone. Coplanar faces of several shapes are one face; what of a face lies
// inside or against another shape of the part does not count. Facets of a cylinder count: pads on
// them touch the true cylinder along the facet's middle line; where facets are too small to be
// faces, the edges between them stand for the round. Spheres have neither. Not guaranteed: that the
// material between is unbroken, or that a finger gets there (that is ranking and legality).
// Article, grasp planning step 1, which has parallel faces only.
// Frames: G is the grasp plane: midway between the features, z the closing axis (toward feature a),
// x along the longest edge of the overlap, origin in the overlap.
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

enum class FeatureKind { Face, Edge, Vertex };

/// One of a part's features: an index into FeaturePairs::faces, edges or vertices.
struct Feature {
  FeatureKind kind = FeatureKind::Face;
  int index = 0;
};
/// "face 3", "edge 12".
std::string to_string(const Feature& feature);

/// A convex edge, straight, as long as the same two faces meet in it.
struct PartEdge {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d normal_a = Eigen::Vector3d::UnitX();  ///< outward, of one face that meets in it
  Eigen::Vector3d normal_b = Eigen::Vector3d::UnitY();  ///< and of the other
  bool face_a = true, face_b = true;  ///< large enough to be held as a face itself
};

/// A convex corner.
struct PartVertex {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  std::vector<Eigen::Vector3d> rays;  ///< unit vectors along the edges that leave it
};

/// How jaws can hold two features, best first: see RankedPair::score.
enum class PairKind { FaceFace, FaceEdge, ParallelEdges, FaceVertex, CrossedEdges };

struct FeaturePair {
  PairKind kind = PairKind::FaceFace;
  Feature a, b;                  ///< a face comes before an edge or a vertex
  double width = 0.0;            ///< distance between the features at the origin of G [m]
  Pose X_PG = Pose::Identity();  ///< grasp plane in the part
  /// Where the pads' middle belongs, in (x, y) of G [m]. Of two faces the common area seen along
  /// z_G. An edge stands there as a strip FeaturePair::strip wide, a vertex as a square, each cut
  /// to the face opposite to it; of parallel edges, the common length.
  Region overlap;
  double area = 0.0;   ///< of the overlap [m2]
  double strip = 0.0;  ///< width of the strip [m]; 0 for two faces
  /// What each pad touches, in (x, y) of G: the whole face; an edge or vertex 0.2 mm wide. Empty
  /// for two faces: there it is the overlap.
  Region contact_a, contact_b;
  /// How the width grows with x and y of G, for features that are not quite parallel [m/m].
  Eigen::Vector2d taper = Eigen::Vector2d::Zero();

  double width_at(const Eigen::Vector2d& point) const { return width + taper.dot(point); }
};
/// "faces 3/5", "face 3 / edge 12".
std::string to_string(const Feature& a, const Feature& b);
inline std::string to_string(const FeaturePair& pair) { return to_string(pair.a, pair.b); }

enum class Rejection { TooWide, TooThin, LittleOverlap };

/// A pair that the jaws cannot take, and why: what a user asks when there is no grasp.
struct RejectedPair {
  Feature a, b;
  double width = 0.0;
  Rejection kind = Rejection::TooWide;
  std::string
      reason;  ///< "88.2 mm wide and 2.0 mm clearance each side, jaws open 85.0 mm: 7.2 mm short"
  double by = 0.0;  ///< how much is lacking [m]; of an overlap [m2]
};

struct FeatureOptions {
  double angle = 0.0087;  ///< most the normals leave antiparallel [rad]. Choice: half a degree
  double least_face_area = 25e-6;  ///< [m2]
  double least_overlap = 25e-6;    ///< of two faces [m2]
  double jaw_clearance =
      0.002;  ///< the jaws must open at least this much wider than the part, each side [m]
  bool beyond_faces = true;    ///< look for pairs with edges and vertices too
  double least_edge = 0.002;   ///< shorter edges are left out [m]
  double sharp_edge = 0.035;   ///< edges between faces at a smaller angle are left out [rad]
  double friction_use = 0.5;   ///< share of a part's friction angle that the line between the
                               ///< contacts of two edges may lean from the closing axis
  int most_edges = 512;        ///< the longest are paired with each other
  int most_beyond_faces = 48;  ///< pairs with edges or vertices that are kept, the best
};

struct FeaturePairs {
  std::vector<PlanarFace>
      faces;  ///< of all shapes of the part, in the part frame; triangles per shape
  std::vector<PartEdge> edges;       ///< convex, longest first; empty if faces only
  std::vector<PartVertex> vertices;  ///< convex; empty if faces only
  std::vector<FeaturePair> pairs;    ///< that the jaws can span: two faces, largest overlap first;
                                     ///< then the others, most promising first
  std::vector<RejectedPair> rejected;  ///< pairs of faces all; of the others the nearest misses
  int beyond_faces = 0;  ///< pairs with edges or vertices that the jaws can span, kept or not
};

/// @throws InvalidInput (E_GEOMETRY, E_NUMBER, E_RANGE) for a part without shapes, bad shapes, bad
/// options
FeaturePairs find_feature_pairs(const Body& part, const Gripper& gripper,
                                const FeatureOptions& options = {});

}  // namespace handey
