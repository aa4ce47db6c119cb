// A piece: what the collision room makes of one shape, or of one connected piece of a mesh. Boxes,
// cylinders, spheres and convex solids keep an exact support function; other meshes keep their
// surface and, if closed, what is inside it. Errs on the near side: next to a mesh that is not
// convex, cylinders and spheres count as 32-sided polyhedra that contain them.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "convex_distance.hpp"
#include "handey/collision/scene.hpp"
#include "handey/collision/solids.hpp"
#include "handey/geometry/shape.hpp"
#include "mesh_distance.hpp"
#include "surface_tree.hpp"

namespace handey::collision {

/// A box in any direction.
struct OrientedBox {
  Pose X_BO = Pose::Identity();                    ///< box frame (origin at its centre) in the body
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< [m]
};

/// The small oriented box round points: of body axes, principal axes and those of the mesh's
/// largest triangles.
OrientedBox oriented_box(const TriangleMesh& mesh);

/// A piece as triangles, with what is needed to measure against them.
struct Polyhedral {
  explicit Polyhedral(TriangleMesh triangles);
  TriangleMesh mesh;
  SurfaceTree tree;
  std::vector<Eigen::Vector3d> seeds;  ///< one vertex of each connected piece of the surface [m]
};

/// Made when first asked for, by whichever thread asks first.
template <class Value>
class MadeOnce {
 public:
  template <class Make>
  const Value& get(const Make& make) const {
    std::call_once(made_, [&] { value_ = std::make_unique<const Value>(make()); });
    return *value_;
  }

 private:
  mutable std::once_flag made_;
  mutable std::unique_ptr<const Value> value_;
};

/// Immutable once made; shared between threads.
class Piece {
 public:
  bool convex = true;
  bool solid = true;    ///< what is inside it collides
  ConvexSolid hull;     ///< the piece if convex, else the box that contains it
  OrientedBox box;      ///< contains the piece, body frame
  double radius = 0.0;  ///< of the ball round the box's centre that contains the piece [m]
  Shape shape;          ///< box, cylinder, sphere, or the mesh in the body frame

  // All in the body frame, made when first asked for.
  /// The piece as triangles.
  const Polyhedral& polyhedral() const;
  /// The same for distances between two of them.
  const SurfaceModel& surface() const;
  /// A convex polyhedron that contains the piece.
  const SceneHull& wrapping() const;
  /// Convex polyhedra whose union contains a convex piece, or the surface of one that is not; by
  /// the usual options.
  const std::vector<SceneHull>& covering() const;
  /// Convex solids wholly inside it.
  const std::vector<InnerSolid>& inside() const;

 private:
  MadeOnce<Polyhedral> polyhedral_;
  MadeOnce<std::shared_ptr<const SurfaceModel>> surface_;
  MadeOnce<SceneHull> wrapping_;
  MadeOnce<std::vector<SceneHull>> covering_;
  MadeOnce<std::vector<InnerSolid>> inside_;
};

using Pieces = std::vector<std::shared_ptr<const Piece>>;

/// @throws InvalidInput for shapes that are wrong
Pieces make_pieces(const std::vector<Shape>& shapes, const std::string& place);

/// Lower bound of the distance of two pieces; same terms as convex_distance. `apart` is left zero
/// where no plane lies between them that far from both.
double piece_distance(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB,
                      double least, double enough, Eigen::Vector3d* apart = nullptr);

/// Distance of a ball from a box; 0 or less where they overlap [m].
inline double ball_to_box(const Eigen::Vector3d& centre, double radius, const Pose& X_WO,
                          const Eigen::Vector3d& half) {
  const Eigen::Vector3d local = X_WO.linear().transpose() * (centre - X_WO.translation());
  return (local.cwiseAbs() - half).cwiseMax(0.0).norm() - radius;
}

/// A lower bound of the distance of two boxes, by the directions of their sides; 0 or less where
/// none of these lies between them [m].
inline double box_to_box(const Pose& X_WA, const Eigen::Vector3d& half_a, const Pose& X_WB,
                         const Eigen::Vector3d& half_b) {
  const Eigen::Matrix3d R_AB = X_WA.linear().transpose() * X_WB.linear();
  const Eigen::Matrix3d lengths = R_AB.cwiseAbs();
  const Eigen::Vector3d offset =
      X_WA.linear().transpose() * (X_WB.translation() - X_WA.translation());
  const Eigen::Vector3d beyond_a = offset.cwiseAbs() - half_a - lengths * half_b;
  const Eigen::Vector3d beyond_b =
      (R_AB.transpose() * offset).cwiseAbs() - half_b - lengths.transpose() * half_a;
  const double most = std::max(beyond_a.maxCoeff(), beyond_b.maxCoeff());
  if (most <= 0.0) return most;
  return std::max(beyond_a.cwiseMax(0.0).norm(), beyond_b.cwiseMax(0.0).norm());
}

}  // namespace handey::collision
