// What a checker keeps apart, as convex hulls, for those who make configuration space obstacles of
// it. Errs on the safe side: a hull contains its piece. A mesh that is not convex is given by the
// hulls of patches of its surface: what is inside it is not covered, so this suits chains of bodies
// that begin outside (the arm from its base on): they cannot get in without crossing the surface.
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

struct SceneHull {
  std::vector<Eigen::Vector3d> points;     ///< vertices of the hull [m]
  std::vector<std::pair<int, int>> edges;  ///< of the hull; a superset is allowed
};

struct SceneMover {
  std::string name;
  int depth = 0;                 ///< number of arm joints that move it
  bool finger = false;           ///< moved by the opening besides
  int body = 0;                  ///< robot body that it is or is held by
  Pose X_BM = Pose::Identity();  ///< in that body: identity but for the held part
  std::vector<SceneHull> hulls;  ///< in the mover's frame
};

struct SceneObstacle {
  std::string name;
  std::vector<SceneHull> hulls;  ///< in the robot frame R
  std::vector<char> checked;     ///< per mover: is it kept apart from this
};

struct Scene {
  std::vector<SceneMover> movers;                ///< robot bodies, base first, then what is held
  std::vector<SceneObstacle> obstacles;          ///< fixtures and parts that stand
  std::vector<std::pair<int, int>> mover_pairs;  ///< movers that are kept apart from each other
};

struct SceneOptions {
  int patch_triangles = 24;  ///< most triangles of a surface patch's hull
  /// Patches are split until their hulls stand out of the solid by no more than this, as far as
  /// samples show: the opening of a shelf is to stay open [m].
  double patch_excess = 0.005;
};

/// @throws InvalidInput (E_RANGE) for options that are not positive
Scene describe_scene(CollisionChecker& checker, const SceneOptions& options = {});

}  // namespace handey
