// The shapes that links, fixtures and parts are made of.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "handey/geometry/polyhedron.hpp"
#include "handey/geometry/pose.hpp"

namespace handey {

struct Box {
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< full edge lengths, centred [m]
};
struct Cylinder {
  double radius = 1.0;  ///< [m]
  double length = 1.0;  ///< along z, centred [m]
};
struct Sphere {
  double radius = 1.0;  ///< [m]
};
struct MeshShape {
  std::shared_ptr<const TriangleMesh> mesh;
  bool solid = true;  ///< closed: what is inside collides. false: an open skin (fixtures only)
  /// Known to be closed and convex, but for rounding: it is not looked at again. Where false a mesh
  /// may be convex too.
  bool convex = false;
};
using Geometry = std::variant<Box, Cylinder, Sphere, MeshShape>;

/// A geometry at its pose in the body that has it.
struct Shape {
  Geometry geometry;
  Pose X_BS = Pose::Identity();  ///< shape in body
};

/// @throws InvalidInput (E_GEOMETRY, E_NUMBER) for sizes that are not finite and positive, or a
/// null mesh
void require_valid(const Shape& shape, const std::string& place);

/// The shape as a closed triangle mesh in the body frame. Cylinders and spheres become
/// `segments`-sided polyhedra that contain them (circumscribed) if `outer`, else inscribed ones.
TriangleMesh tessellate(const Shape& shape, int segments = 32, bool outer = true);

/// Points whose convex hull contains the shape (in the body frame); for meshes its hull's vertices.
std::vector<Eigen::Vector3d> hull_points(const Shape& shape);

}  // namespace handey
