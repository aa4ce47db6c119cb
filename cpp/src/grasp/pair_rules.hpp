// What all pairs of features have in common, whatever their kind: that the jaws must span them,
// what they are worth against each other.
#pragma once

#include <optional>

#include "handey/grasp/features.hpp"
#include "ranges.hpp"

namespace handey::grasp {

/// Contacts with edges and vertices are drawn this wide [m]. Choice: far above the grid of plane
/// regions, far below the least length that counts.
constexpr double kContactWidth = 2e-4;
/// An edge or a vertex counts where it is this far inside the pad's border [m].
constexpr double kInsidePad = 1e-3;

/// A pad must have this much of an edge [m].
constexpr double kLeastContactLength = 1.5e-3;

/// What a pair is worth against two faces. Choice: two faces are tried first unless next to nothing
/// of them is free; then a line on a face, two lines, a point on a face, two lines that cross.
inline double kind_worth(PairKind kind) {
  switch (kind) {
    case PairKind::FaceFace:
      return 1.0;
    case PairKind::FaceEdge:
      return 0.10;
    case PairKind::ParallelEdges:
      return 0.05;
    case PairKind::FaceVertex:
      return 0.03;
    case PairKind::CrossedEdges:
      return 0.02;
  }
  return 0.0;
}

inline std::optional<RejectedPair> reject_width(const FeaturePair& pair, const Gripper& gripper,
                                                const FeatureOptions& options) {
  RejectedPair rejected{pair.a, pair.b, pair.width, Rejection::TooWide, ""};
  const double needed = pair.width + 2.0 * options.jaw_clearance;
  if (needed > gripper.max_opening) {
    rejected.reason = millimetres(pair.width) + " mm wide and " +
                      millimetres(options.jaw_clearance) + " mm clearance each side, jaws open " +
                      millimetres(gripper.max_opening) +
                      " mm: " + millimetres(needed - gripper.max_opening) + " mm short";
    rejected.by = needed - gripper.max_opening;
    return rejected;
  }
  if (pair.width < gripper.min_opening) {
    rejected.kind = Rejection::TooThin;
    rejected.reason = millimetres(pair.width) + " mm wide, jaws close to " +
                      millimetres(gripper.min_opening) +
                      " mm: " + millimetres(gripper.min_opening - pair.width) + " mm too thin";
    rejected.by = gripper.min_opening - pair.width;
    return rejected;
  }
  return std::nullopt;
}

/// Middle of the region if that is in it, else of its widest place.
inline Eigen::Vector2d middle_of(const Region& region) {
  double twice_area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
      const double cross = a.x() * b.y() - a.y() * b.x();
      twice_area += cross;
      moment += cross * (a + b) / 3.0;
    }
  }
  const Eigen::Vector2d centroid = moment / twice_area;
  return contains(region, centroid) ? centroid : largest_inscribed_circle(region).centre;
}

}  // namespace handey::grasp
