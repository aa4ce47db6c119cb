// Triangle meshes as solids: what is wrong with one, what is inside it, and its planar faces.
// Coplanar triangles are merged against the plane of the whole cluster, not of the neighbour, so a
// face with an engraving, with holes or with 2 000 triangles is one face, and a curved side does
// not drift into one. Article: the polyhedral models of parts from which grasps are chosen.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "handey/geometry/polygon.hpp"

namespace handey {

/// Triangles counter-clockwise seen from outside; vertices welded [m].
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// @throws InvalidInput (E_NUMBER, E_INDEX) naming `place` unless vertices are finite and indices
/// in range
void require_valid(const TriangleMesh& mesh, const std::string& place);

/// What a surface is. A solid is closed, manifold and consistently oriented.
struct SurfaceReport {
  bool closed = false;    ///< every edge is shared by an even number of triangles, none is open
  bool manifold = false;  ///< no edge is shared by more than two triangles
  bool consistently_oriented =
      false;           ///< neighbours run along their common edge in opposite directions
  int components = 0;  ///< pieces not connected by an edge
  int open_edges = 0;
  int overfull_edges = 0;
  double volume = 0.0;  ///< signed [m3]; negative: inside out
  /// Of the solid, uniform density; of the surface where it is not closed. Where bodies of one mesh
  /// overlap, volume and centroid count the overlap twice [m].
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  ///< bounding box [m]
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();
};
SurfaceReport inspect_surface(const TriangleMesh& mesh);

/// True if the point is inside the solid (generalised winding number, so overlapping pieces are a
/// union).
bool contains_point(const TriangleMesh& mesh, const Eigen::Vector3d& point);

/// The pieces of a mesh that share no edge.
std::vector<TriangleMesh> connected_components(const TriangleMesh& mesh);

struct PlanarFaceOptions {
  double angle = 1e-3;      ///< most a triangle's normal leaves the face's [rad]
  double distance = 1e-5;   ///< most a vertex leaves the face's plane [m]
  double least_area = 0.0;  ///< smaller faces are left out [m2]
};

/// A planar face of a solid with its own plane coordinates.
struct PlanarFace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< a point of the plane
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();       ///< in-plane axes; u x v = normal
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();
  Region region;               ///< the face in (u, v) about origin [m]
  double area = 0.0;           ///< [m2]
  std::vector<int> triangles;  ///< indices of the triangles merged
};
/// Largest area first; ties by lowest triangle index, so the order is repeatable. Patches of one
/// plane and one normal are one face with several outer loops, also where they do not touch
/// (islands in an engraving, the two inner flanks of a plus): a pad may lie on both.
/// `connected_parts` of the region tells them apart.
std::vector<PlanarFace> planar_faces(const TriangleMesh& mesh,
                                     const PlanarFaceOptions& options = {});

}  // namespace handey
