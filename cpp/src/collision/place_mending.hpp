// A place on a face that is nearly good is shifted and turned until it is: a pattern search for the
// least area of the part's shadow that lies where it must not, all seen from above. Parts that
// reach over or under each other count as if they met.
// Not guaranteed: that a good place near by is found.
#pragma once

#include <vector>

#include "handey/collision/standing_places.hpp"

namespace handey::collision {

/// The centre of mass of a part over a face, in the face's frame S, and the turn about its normal.
struct PlaceSample {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double turn = 0.0;  ///< [rad]
};

Polygon moved(const Polygon& polygon, const PlaceSample& to);
/// Least distance of a point from the edges of a counter-clockwise convex polygon; negative
/// outside [m].
double margin_of(const Polygon& hull, const Eigen::Vector2d& point);
/// The region that was asked for as a polygon in S.
Polygon region_in_face(const Eigen::AlignedBox2d& region, const SupportFace& face);

class PlaceMender {
 public:
  PlaceMender(const Cell& cell, int part, const RestingPose& rest, const SupportFace& face,
              const StandingPlaceOptions& options);

  /// Is there room at all?
  bool can_fit() const;
  /// Area of what lies where it must not [m2].
  double badness(const PlaceSample& sample) const;
  PlaceSample mended(PlaceSample sample) const;

 private:
  const RestingPose& rest_;
  const Region& enclosed_;
  bool inside_;
  Region around_;   // what stands in the room that the part takes up over the face
  Region allowed_;  // the region asked for; empty for none
  Polygon shadow_;  // of the part with its clearance
};

}  // namespace handey::collision
