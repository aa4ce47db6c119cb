// A checker's movers and obstacles as convex hulls.
#include "handey/collision/scene.hpp"

#include <cmath>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "piece_hulls.hpp"

namespace handey {
namespace {

SceneMover describe_mover(const collision::Mover& mover) {
  SceneMover described;
  described.name = mover.label;
  described.depth = mover.depth;
  described.finger = mover.finger;
  described.body = mover.body;
  described.X_BM = mover.X_BM;
  for (const auto& piece : mover.geometry->pieces) {
    described.hulls.push_back(piece->wrapping());
  }
  return described;
}

SceneObstacle describe_obstacle(const collision::Obstacle& obstacle, const SceneOptions& options) {
  SceneObstacle described;
  described.name = obstacle.label;
  const SceneOptions usual;
  const bool is_usual = options.patch_triangles == usual.patch_triangles &&
                        options.patch_excess == usual.patch_excess;
  for (const auto& piece : obstacle.geometry->pieces) {
    const std::vector<SceneHull> hulls =
        is_usual ? piece->covering() : collision::hulls_of_piece(*piece, options);
    described.hulls.insert(described.hulls.end(), hulls.begin(), hulls.end());
  }
  for (SceneHull& hull : described.hulls) {
    for (Eigen::Vector3d& point : hull.points) point = obstacle.X_RB * point;
  }
  return described;
}

}  // namespace

Scene describe_scene(CollisionChecker& checker, const SceneOptions& options) {
  if (options.patch_triangles < 1) {
    throw InvalidInput("E_RANGE", "patch_triangles",
                       "found " + std::to_string(options.patch_triangles) + ", expected >= 1");
  }
  if (!(options.patch_excess > 0.0) || !std::isfinite(options.patch_excess)) {
    throw InvalidInput(
        "E_RANGE", "patch_excess",
        "found " + std::to_string(options.patch_excess) + ", expected a length > 0 [m]");
  }
  const CollisionChecker::Impl& impl = checker.impl();
  Scene scene;
  for (const collision::Mover& mover : impl.movers) scene.movers.push_back(describe_mover(mover));
  for (std::size_t o = 0; o < impl.obstacles.size(); ++o) {
    SceneObstacle obstacle = describe_obstacle(impl.obstacles[o], options);
    for (const collision::Mover& mover : impl.movers) obstacle.checked.push_back(mover.against[o]);
    scene.obstacles.push_back(std::move(obstacle));
  }
  scene.mover_pairs = impl.mover_pairs;
  return scene;
}

}  // namespace handey
