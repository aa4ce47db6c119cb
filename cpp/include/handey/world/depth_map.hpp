// Obstacles that are known by measurement only: a map of heights, or what a depth camera saw. Both
// are solids made of thousands of columns (of the cones of pixels); here they become a fixture of a
// few convex solids that contains them. Near where parts stand the fixture is the measured solid
// itself; elsewhere it stands out of it by a tolerance that grows with the distance from the work,
// as far as the number of solids allows. How far it does in the end is told.
// What was not measured is solid. Errs on the large side everywhere.
// Article: the depth maps of "Handey: a robot system that recognizes, plans, and manipulates".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "handey/world/body.hpp"
#include "handey/world/cell.hpp"

namespace handey {

/// Heights over a plane: entry (row, column) is a square column of side `cell` about
/// (column * cell, row * cell), solid from z = 0 up to the height.
struct HeightMap {
  int rows = 0, columns = 0;
  std::vector<double> heights;  ///< row by row [m]; NaN: not measured, as high as the highest
  double cell = 0.01;           ///< [m]
  Pose X_WD = Pose::Identity();
};

/// Depths along the optical axis: pixel (row v, column u) looks along ((u - cx) / fx, (v - cy) /
/// fy, 1). Space is solid from a pixel's depth to `far` behind it, over the pixel's whole cone.
struct DepthImage {
  int rows = 0, columns = 0;
  std::vector<double> depths;                     ///< row by row [m]; 0 or NaN: not measured
  double fx = 1.0, fy = 1.0, cx = 0.0, cy = 0.0;  ///< [pixels]
  Pose X_WD = Pose::Identity();                   ///< camera: z forward, x right, y down
  double explained = 0.005;  ///< a pixel this near to a known surface belongs to it [m]
  double far = 0.3;          ///< [m]
};

struct DepthMapOptions {
  double excess = 0.003;      ///< solids may stand out by this much near the work [m]. Choice
  double growth = 0.1;        ///< and this much more per metre of distance from it. Choice
  double most_excess = 0.03;  ///< but no more than this, far from it [m]. Choice
  /// With so many solids the tolerance gives way. Choice: what planning bears
  int most_solids = 160;
  /// Where parts stand, now or in the end. Within `exact_within` of them nothing stands out.
  std::vector<Body> places;
  double exact_within = 0.002;  ///< [m]. Choice: more than the gap of a contact
  /// Nothing beyond the ball about `reach_centre` (world) is kept; by default all is.
  Eigen::Vector3d reach_centre = Eigen::Vector3d::Zero();
  std::optional<double> reach;  ///< [m]
};

/// A depth map as a fixture.
struct MeasuredBody {
  Body body;            ///< without shapes if there is nothing solid within reach
  double excess = 0.0;  ///< no point of a solid is farther than this from what was measured [m]
  bool exact_at_places = true;  ///< false if that would have taken too many solids
};

/// @throws InvalidInput (E_IMAGE, E_NUMBER, E_RANGE) for sizes and numbers that are wrong, or if
/// nothing is measured
MeasuredBody cover_heights(const std::string& name, const HeightMap& map,
                           const DepthMapOptions& options = {});

/// Which pixels (row by row) are measured and lie within `explained` of the surface of a fixture, a
/// part or the robot at its start? Points nearer than 1e-6 m to that limit count as farther.
/// @throws InvalidInput as cover_heights, (E_CAMERA) for a lens that is wrong
std::vector<char> explained_pixels(const DepthImage& image, const Cell& cell);

/// @param explained per pixel: taken out, nothing is behind it. Empty: none
/// @throws InvalidInput as explained_pixels
MeasuredBody cover_depths(const std::string& name, const DepthImage& image,
                          const std::vector<char>& explained, const DepthMapOptions& options = {});

/// A ball (world) that holds every point of the arm and of what it holds, whatever its joints do.
struct ReachBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< [m]
};
ReachBall reach_ball(const Cell& cell);

/// The grey values of a 16-bit PNG, whose rows are unpacked but still filtered: one byte that names
/// the filter, then two bytes a pixel, the high one first.
/// @throws InvalidInput (E_IMAGE) for a wrong number of bytes or an unknown filter
std::vector<unsigned short> unfilter_png16(const unsigned char* bytes, std::size_t count, int rows,
                                           int columns);

}  // namespace handey
