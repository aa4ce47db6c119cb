// What stands in the layer outside a face that a finger fills: obstacles, projected on the grasp
// plane.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "handey/grasp/ranking.hpp"

namespace handey::grasp {

/// Extent of the fingers about the pad, in the grasp frame.
struct FingerExtent {
  double thickness = 0.0;   ///< from the pad outwards, where the pad is [m]
  double half_width = 0.0;  ///< greatest |x| [m]
  double tip = 0.0;         ///< greatest z: from the pad's centre to the finger's end [m]
  double back = 0.0;        ///< least z (negative) [m]
};
FingerExtent finger_extent(const Robot& robot);

/// Adds the loops of one region to another.
void append(Region&& loops, Region& to);
/// The loops of a region whose boxes meet that of the other: what lies elsewhere takes nothing off
/// the other.
Region loops_near(const Region& region, const Region& other);

/// The part of each body that blocks the fingers beside one pair, and the part's own protrusions.
class Obstruction {
 public:
  Obstruction(const Body& part, const std::vector<PlanarFace>& faces, double layer,
              double clearance);

  /// What of the part stands out beside the faces of the pair, in (x, y) of G; not grown.
  Region own(const FeaturePair& pair);
  /// What of the body blocks the layers of the pair, grown by the clearance, in (x, y) of G. Its
  /// loops overlap where its shapes do: they are not united, which would take most of the time.
  /// @param reach  bodies farther from the overlap than this are not looked at [m]
  Region of_body(const FeaturePair& pair, const Body& body, const Pose& X_PB, double reach);

 private:
  /// Of the body's shapes, along its axes.
  const std::vector<Eigen::AlignedBox3d>& boxes_of(const Body& body);

  /// Frame of one side of a pair in G: z outward, of a face its normal; x = x of G, origin where
  /// the axis of G pierces the plane of the pad.
  Pose side_frame(const FeaturePair& pair, bool side_a) const;
  Region own_on_face(int face);
  Region own_beside(const FeaturePair& pair, bool side_a) const;
  Region part_between(const Pose& X_SP, double lower) const;

  const Body& part_;
  const std::vector<PlanarFace>& faces_;
  double layer_, clearance_;
  bool part_is_convex_;
  std::map<int, Region> own_;  // by face, in its plane: a face is in many pairs
  std::map<const Body*, std::vector<Eigen::AlignedBox3d>> boxes_;
};

}  // namespace handey::grasp
