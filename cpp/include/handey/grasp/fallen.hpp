// Why candidate hand poses fell, counted: by the test, the end of the pick-and-place, what met
// what, and the joint, each with the pose that missed least. A candidate counts where it fell
// first: tests that cost less come first, the origin before the destination (with `spread`, the end
// where the one before fell), and of the inverse solutions at an end the last that was looked at.
// What stands in the way most often need not be the cause; that is diagnosis.
#pragma once

#include <optional>
#include <string>

#include "handey/geometry/pose.hpp"

namespace handey {

enum class FallKind {
  TooWide,        ///< for the jaws; in a diagnosis only
  LittleContact,  ///< the pads would lie on too little of the features
  Slips,          ///< friction does not hold the part's weight
  Turns,          ///< the part's weight would turn it in the jaws
  OutOfReach,     ///< the wrist's centre is nowhere where the arm can bring it
  JointLimit,     ///< the wrist's centre is within reach, a joint is past its limit
  Collision
};

/// Where the part stands meanwhile; contact and hold are the same at both.
enum class GraspEnd { Both, Origin, Destination };

/// Candidates that fell alike.
struct Fallen {
  FallKind kind = FallKind::Collision;
  GraspEnd end = GraspEnd::Both;
  std::string mover, body;  ///< of a collision, as in Hit, but "hand" for the hand's own body
  int joint = -1;           ///< past its limit
  int count = 0;
  /// How much the nearest missed: [m], of a joint [rad]; not known of a collision, whose depth is
  /// not looked at, nor of contact.
  std::optional<double> least;
  std::string text;  ///< of the nearest: "wrist centre 112 mm beyond reach"
  // The nearest hand pose; where that is not known, the most promising one.
  Pose X_PH = Pose::Identity();  ///< grasp frame in the part
  double opening = 0.0;          ///< as the hand comes [m]; 0 if it was not looked at
  double width = 0.0;            ///< closed on the part [m]
};

}  // namespace handey
