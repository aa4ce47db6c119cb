// Reads STL (binary and text), OBJ and PLY meshes strictly: sizes are checked before memory is
// taken, every fault has a name and a place, vertices are welded. No archives, no references to
// other files are followed.
#pragma once

#include <string>
#include <vector>

#include "handey/geometry/polyhedron.hpp"

namespace handey {

struct MeshFileOptions {
  Eigen::Vector3d scale =
      Eigen::Vector3d::Ones();  ///< file unit to metres, per axis, finite and > 0
  bool must_be_closed = false;  ///< an open surface is then an error (E_NOT_CLOSED), as for parts
  double greatest_size = 20.0;  ///< a larger bounding box is taken for a wrong unit (E_UNITS) [m]
  std::size_t most_triangles = 1'000'000;
  std::size_t most_bytes = 64u << 20;
};

struct LoadedMesh {
  TriangleMesh mesh;
  SurfaceReport surface;
  std::vector<std::string> warnings;  ///< "inside out: flipped", ...
};

/// @throws InvalidInput with codes E_PATH, E_MESH_EMPTY, E_MESH_TRUNCATED, E_MESH_FORMAT, E_NUMBER,
/// E_RANGE,
///   E_MESH_DEGENERATE, E_NOT_CLOSED, E_NOT_MANIFOLD, E_INDEX, E_TOO_BIG, E_UNITS, E_UNSUPPORTED,
///   E_SCALE
LoadedMesh load_mesh(const std::string& path, const MeshFileOptions& options = {});

}  // namespace handey
