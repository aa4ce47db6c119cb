// Where in the unobstructed area to put the fingertips: the point nearest the centre of mass that
// keeps the pad on the face, the middle of the widest place, and points far from these, over all
// connected pieces; and how much of a pad rests on the area at a given pose of the hand. Article,
// grasp planning step 3.
#pragma once

#include <vector>

#include "handey/grasp/features.hpp"

namespace handey {

/// What of one pad rests on a region, the pad's centre at (x, y), its length along theta. Exact.
struct PadPatch {
  double area = 0.0;                                 ///< [m2]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< of the patch, in G [m]
  double gyration = 0.0;                             ///< radius of gyration about its centre [m]
};
PadPatch pad_patch(const Region& region, const PlanarPose& pose, const Gripper& gripper);

/// Area of one pad on `region`, the pad's centre at (x, y), its length along theta [m2]. Exact.
double pad_contact_area(const Region& region, const PlanarPose& pose, const Gripper& gripper);

/// At most `most` points of the region, best first: by the pad's contact there in its best
/// direction and by closeness to the centre of mass, each next one also by its distance from those
/// before (Choice: the product of the three).
/// @param centre_of_mass in (x, y) of G [m]
std::vector<Eigen::Vector2d> fingertip_targets(const Region& unobstructed,
                                               const Eigen::Vector2d& centre_of_mass,
                                               const Gripper& gripper, int most = 5);

/// The point of the region nearest to `point` (itself if inside); `point` if the region is empty.
Eigen::Vector2d nearest_point(const Region& region, const Eigen::Vector2d& point);

}  // namespace handey
