// What of an obstacle lies in the way of a link that moves in the arm's plane, while the waist
// turns through an interval: the obstacle's part within the link's lateral slab, projected into the
// plane, as a convex polygon that contains it for every waist angle of the interval. The arm's
// lateral offsets are respected. The article's own form is the torus: one polygon for the whole of
// the waist angles at which an obstacle can matter. Errs on the safe side: the polygon contains the
// true section. Article: "Global planning", Figure 8.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "handey/collision/scene.hpp"
#include "handey/geometry/polygon.hpp"

namespace handey {

/// The plane in which the second and third joint move the arm. Frame E turns with the waist: origin
/// on axis 2 where axis 1 comes nearest, z along axis 2 (lateral), x and y in the plane, y as near
/// to axis 1 as may be (x towards the elbow where axis 1 is parallel to axis 2). At q2 = q3 = 0 the
/// elbow (axis 3) is at `elbow`.
struct ArmPlane {
  Pose X_1E = Pose::Identity();  ///< E in the body that joint 1 moves
  Pose X_R1 = Pose::Identity();  ///< that body in R at q1 = 0
  Eigen::Vector3d waist_point;   ///< a point of axis 1, in E [m]
  Eigen::Vector3d waist_axis;    ///< unit, in E
  Eigen::Vector2d elbow;         ///< axis 3 in the plane at q2 = 0 [m]
  double elbow_sense = 1.0;      ///< +1: q3 turns as q2 does, -1: the other way
  /// E in R at a waist angle.
  Pose X_RE(double q1) const;
};

/// @return nothing, and why in `reason`, unless the arm has three joints and its second and third
/// axes are parallel (1e-6)
std::optional<ArmPlane> arm_plane(const Robot& robot, std::string* reason = nullptr);

/// Lateral extent, along z of E [m].
struct Slab {
  double lower = 0.0, upper = 0.0;
};

/// The cross section of a convex obstacle for the waist angles q1 +- half_width: convex,
/// counter-clockwise in (x, y) of E, three points or more, though it may be as thin as a line;
/// empty if it never reaches the slab.
/// @param hull in R
/// @param half_width of the interval [rad], 0 to pi
/// @throws InvalidInput (E_NUMBER, E_RANGE, E_INDEX) for numbers that are not finite, a slab whose
/// upper bound is below its lower one, a half width out of range, edges of points that are not
/// there. A slab may be infinite.
Polygon cross_section(const ArmPlane& plane, const SceneHull& hull, const Slab& slab, double q1,
                      double half_width);

/// The same for many obstacles and slabs at one interval of the waist, in inner loops: nothing is
/// checked and memory is used again.
class WaistCell {
 public:
  static constexpr double kWidest = 0.5;  ///< half width [rad]
  /// @throws InvalidInput (E_RANGE) for a half width that is not between 0 and kWidest
  WaistCell(const ArmPlane& plane, double q1, double half_width);
  /// The hull whose sections are asked for next; it is not copied. Fastest if its points are sorted
  /// along the waist's axis.
  void place(const SceneHull& hull);
  /// @param section is replaced; empty if the hull never reaches the slab
  void cross_section(const Slab& slab, Polygon& section);
  void cross_section(const SceneHull& hull, const Slab& slab, Polygon& section) {
    place(hull);
    cross_section(slab, section);
  }

 private:
  /// A vertex of the hull from the waist point, in E, and how far it may be taken to reach up and
  /// down z meanwhile [m].
  struct Corner {
    Eigen::Vector3d at;
    double upmost = 0.0, downmost = 0.0;
  };
  /// What a corner sweeps where that is parallel to x [m].
  struct Level {
    double y, lower, upper;
    Level(double y_in, double lower_in, double upper_in)
        : y(y_in), lower(lower_in), upper(upper_in) {}
  };
  void set_reaches();
  void add_swept(const Eigen::Vector3d& corner);
  void add_clipped(double lower, double upper);
  void take_hull(Polygon& section);
  void take_hull_of_levels(Polygon& section);

  Eigen::Matrix3d R_ER_;
  Eigen::Vector3d p_R_;  // of the waist in R
  Eigen::Vector3d axis_, forward_, across_;
  Eigen::Vector2d waist_;
  double sine_ = 0.0, cosine_ = 1.0, outwards_ = 1.0, waist_lateral_ = 0.0;
  bool edge_on_ = false;
  const SceneHull* hull_ = nullptr;
  std::vector<Corner> corners_;
  double highest_ = 0.0, lowest_ = 0.0;              // of the reaches up and down [m]
  double least_upmost_ = 0.0, most_downmost_ = 0.0;  // of them too
  double rise_ = 0.0, sink_ = 0.0;                   // slabs are widened by these [m]
  bool has_whole_ = false;
  Polygon whole_;  ///< section in a slab that holds all of the hull
  std::vector<Eigen::Vector2d> swept_;
  std::vector<Level> levels_;
};

/// The article's obstacle: one polygon for all the waist angles in [lower, upper] at which the
/// obstacle can reach the slab (Figure 8).
struct Torus {
  double lower = 0.0, upper = 0.0;  ///< [rad]; upper may pass pi: the interval goes on round
  Polygon section;                  ///< in (x, y) of E [m]
};
/// Sorted by `lower`, which is in [-pi, pi); windows are exact to 1 degree, on the large side.
/// Obstacles that surround the axis give one torus all the way round, from -pi to pi.
/// @throws InvalidInput as cross_section does
std::vector<Torus> torus_of(const ArmPlane& plane, const SceneHull& hull, const Slab& slab);

}  // namespace handey
