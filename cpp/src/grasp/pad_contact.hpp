// What the pads touch at a pose of the hand, and whether the part, held so, turns or slips under
// its own weight.
#pragma once

#include <string>

#include "handey/grasp/legality.hpp"

namespace handey::grasp {

struct PadContact {
  double area = 0.0;  ///< of a pad on the unobstructed overlap [m2]
  bool both_sides =
      false;  ///< each pad has what a plan's check asks of its feature, and a little more
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the contacts, in G [m]
  double radius = 0.0;  ///< effective, of the friction torque about the closing axis [m]
};
PadContact pad_contact(const RankedPair& pair, const PlanarPose& pose, const Gripper& gripper);

/// The soft-finger test of a part.
class Hold {
 public:
  Hold(const Body& part, const LegalityOptions& options);

  /// How far from the contacts' centre the centre of mass may lie [m]; negative: the part slips.
  double reach(const PadContact& contact) const;
  /// By how much that is exceeded [m]; 0 or less if the part is held.
  double excess(const RankedPair& pair, const PadContact& contact) const;
  /// Friction does not carry the part's weight, wherever it is held.
  bool slips() const { return ratio_ <= 1.0; }
  /// Why the part is not held, with numbers.
  std::string reason(const RankedPair& pair, const PadContact& contact) const;

 private:
  double mass_;  // 0 if unknown [kg]
  double friction_, force_;
  double ratio_;  // friction of both pads over weight
};

}  // namespace handey::grasp
