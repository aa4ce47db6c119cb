// What a checker keeps apart, from within: convex solids that lie wholly inside the pieces. Two
// bodies whose inner solids overlap collide, so what is proved with them is a proof of collision.
// Errs on the inner side: cylinders and spheres are given by polyhedra inside them, a mesh that is
// not convex by boxes inside it, an open surface by nothing; each face lies kInnerSkin under the
// true one.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

/// How far under the true surface the faces lie: more than what rounding and the tolerance of
/// convexity can amount to [m].
constexpr double kInnerSkin = 1e-5;

/// A bounded convex solid: the points with normals[i] . x <= offsets[i] for all i.
struct InnerSolid {
  std::vector<Eigen::Vector3d> normals;              ///< unit, outward
  std::vector<double> offsets;                       ///< [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< about as deep inside as can be [m]
  double inradius = 0.0;  ///< depth of the centre: of a ball about it that lies inside [m]
  double radius = 0.0;    ///< of a ball about the centre that contains the solid [m]

  /// Least distance from the faces' planes: the radius of the ball about the point that lies
  /// inside; negative outside [m].
  double depth(const Eigen::Vector3d& point) const;
};

/// The solid with convex hull of these points, less the skin.
/// @return a solid without faces if nothing is left
InnerSolid inner_hull(const std::vector<Eigen::Vector3d>& points);

struct SolidMover {
  std::string name;
  int depth = 0;                   ///< number of arm joints that move it
  bool finger = false;             ///< moved by the opening besides
  int body = 0;                    ///< robot body that it is or is held by
  Pose X_BM = Pose::Identity();    ///< in that body: identity but for the held part
  std::vector<InnerSolid> solids;  ///< in the mover's frame
};

struct SolidObstacle {
  std::string name;
  std::vector<InnerSolid> solids;  ///< in the robot frame R
  std::vector<char> checked;       ///< per mover: is it kept apart from this
};

struct SolidScene {
  std::vector<SolidMover> movers;                ///< robot bodies, base first, then what is held
  std::vector<SolidObstacle> obstacles;          ///< fixtures and parts that stand
  std::vector<std::pair<int, int>> mover_pairs;  ///< movers that are kept apart from each other
};

SolidScene describe_solids(CollisionChecker& checker);
/// Of what is held alone, in the part's frame; empty if nothing is.
std::vector<InnerSolid> held_solids(CollisionChecker& checker);

}  // namespace handey
