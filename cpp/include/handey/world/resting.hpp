// How can a part rest on a table? Each face of its convex hull that holds the projection of the
// centre of mass is a resting pose. Faces in one plane are one face; of round sides, on which a
// part rolls, only a few poses are kept, as far apart as the options say. Round shapes are
// polyhedra that contain them.
// Not looked at: friction, and tables that are not flat. The probability is that of a part which
// comes to rest after having been dropped without spin or bounce (quasi-static; Goldberg, Mirtich,
// Zhuang, Craig, Carlisle, Canny 1999). Article: "Regrasping", the placements of a part on a table.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "handey/geometry/polygon.hpp"
#include "handey/geometry/pose.hpp"
#include "handey/world/body.hpp"

namespace handey {

struct RestingOptions {
  int segments = 64;  ///< sides of a round shape
  /// Poses that a smaller turn would tip over are left out [rad]. Choice: half a degree.
  double least_tip_angle = 0.01;
  double contact_gap = 6e-4;  ///< what lies this near above the table stands on it (formats) [m]
  double least_width = 2e-3;  ///< of the region that it stands on (formats) [m]
  double rolling = 0.1;       ///< a pose that a smaller turn tips over is one of a round side [rad]
  double rolling_step = 0.4;  ///< poses of a round side are kept this far apart, or more [rad]
};

/// A part standing on the plane z = 0 of a support frame S whose z points up.
struct RestingPose {
  /// The part in S: its lowest point at z = 0, its centre of mass over the origin. The turn about z
  /// is such that the x axis of the part, or y where x is nearly upright, lies along +x of S.
  Pose X_SP = Pose::Identity();
  double margin = 0.0;       ///< of the centre of mass from the nearest edge of the footprint [m]
  double height = 0.0;       ///< of the centre of mass over the plane [m]
  double tip_angle = 0.0;    ///< atan(margin / height): the least turn that tips it over [rad]
  double width = 0.0;        ///< least width of what it stands on [m]
  double probability = 0.0;  ///< of coming to rest so; all those of a part sum up to 1
  double top = 0.0;          ///< height of its highest point [m]
  Polygon footprint;         ///< convex hull of what it stands on, in x, y of S [m]
  Region contact;            ///< what lies within `contact_gap` of the plane, in x, y of S [m]
  Polygon shadow;            ///< convex hull of the whole part seen from above, in x, y of S [m]
};

/// All stable resting poses, the steadiest (greatest tip angle) first; equal ones in the order of
/// the hull's faces, larger ones first.
/// @throws InvalidInput (E_EMPTY, E_NOT_CLOSED, E_RANGE)
std::vector<RestingPose> resting_poses(const Body& part, const RestingOptions& options = {});

/// The part standing with `up` (a direction in its own frame) upwards, stably or not: on a face or
/// on whatever then is lowest. The probability is 0.
/// @throws InvalidInput (E_EMPTY, E_NOT_CLOSED, E_RANGE, E_NUMBER)
RestingPose resting_pose(const Body& part, const Eigen::Vector3d& up,
                         const RestingOptions& options = {});

}  // namespace handey
