// A shape is cut only for the layers and the square that its bounding box in G meets.
#include "obstacle_layers.hpp"

#include <Eigen/Geometry>

#include "handey/stop.hpp"

namespace handey {

namespace {

// Choice: the union of a thousand triangles costs about a millisecond a layer.
constexpr std::size_t kMostTriangles = 1000;

/// What of a convex polygon in space has sign * z <= sign * height.
std::vector<Eigen::Vector3d> cut(const std::vector<Eigen::Vector3d>& polygon, double sign,
                                 double height) {
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = sign * (a.z() - height) <= 0.0, b_in = sign * (b.z() - height) <= 0.0;
    if (a_in) kept.push_back(a);
    if (a_in != b_in) kept.push_back(a + (height - a.z()) / (b.z() - a.z()) * (b - a));
  }
  return kept;
}

Eigen::AlignedBox3d bounding_box(const Shape& shape, const Pose& X_GB) {
  Eigen::AlignedBox3d box;
  if (const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry)) {
    const Pose X_GS = X_GB * shape.X_BS;
    for (const Eigen::Vector3d& vertex : mesh->mesh->vertices) box.extend(X_GS * vertex);
  } else {
    for (const Eigen::Vector3d& point : hull_points(shape)) box.extend(X_GB * point);
  }
  return box;
}

}  // namespace

ObstacleLayers::ObstacleLayers(const Cell& cell, const GripperOutline& outline, const Pose& X_WG,
                               const Eigen::Vector2d& centre, double half_size)
    : centre_(centre), half_size_(half_size), layers_(outline.pieces.size()) {
  const Pose X_GW = X_WG.inverse(Eigen::Isometry);
  for (const Body& fixture : cell.fixtures) add(fixture, X_GW * fixture.X_WB, outline);
  for (std::size_t i = 0; i < cell.parts.size(); ++i) {
    if (cell.held && cell.held->part == static_cast<int>(i)) continue;
    add(cell.parts[i], X_GW * cell.parts[i].X_WB, outline);
  }
}

void ObstacleLayers::add(const Body& body, const Pose& X_GB, const GripperOutline& outline) {
  for (const Shape& shape : body.shapes) {
    throw_if_stopped();
    const Eigen::AlignedBox3d box = bounding_box(shape, X_GB);
    const Eigen::Vector2d low = box.min().head<2>() - centre_, high = box.max().head<2>() - centre_;
    if (low.maxCoeff() > half_size_ || high.minCoeff() < -half_size_) continue;
    const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry);
    if (mesh && mesh->mesh->triangles.size() > kMostTriangles) {
      add_skin(*mesh->mesh, X_GB * shape.X_BS, outline);
      continue;
    }
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
      const OutlinePiece& piece = outline.pieces[layer];
      if (box.min().z() > piece.upper || box.max().z() < piece.lower) continue;
      layers_[layer].push_back(slab_projection(shape, X_GB, piece.lower, piece.upper));
    }
  }
}

void ObstacleLayers::add_skin(const TriangleMesh& mesh, const Pose& X_GS,
                              const GripperOutline& outline) {
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& vertex : mesh.vertices) vertices.push_back(X_GS * vertex);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    std::vector<Eigen::Vector3d> corners;
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) {
      corners.push_back(vertices[static_cast<std::size_t>(triangle[k])]);
      box.extend(corners.back());
    }
    const Eigen::Vector2d low = box.min().head<2>() - centre_, high = box.max().head<2>() - centre_;
    if (low.maxCoeff() > half_size_ || high.minCoeff() < -half_size_) continue;
    for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
      const OutlinePiece& piece = outline.pieces[layer];
      if (box.min().z() > piece.upper || box.max().z() < piece.lower) continue;
      Polygon shadow;
      for (const Eigen::Vector3d& p : cut(cut(corners, 1.0, piece.upper), -1.0, piece.lower)) {
        shadow.push_back(p.head<2>());
      }
      if (!shadow.empty()) layers_[layer].push_back({{std::move(shadow)}});
    }
  }
}

MotionGrid ObstacleLayers::draw(double cell) const {
  MotionGrid grid(centre_, half_size_, cell, static_cast<int>(layers_.size()));
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    throw_if_stopped();
    for (const Region& region : layers_[layer]) grid.fill(static_cast<int>(layer), region);
  }
  return grid;
}

MotionGrid ObstacleLayers::draw_inside(double cell) const {
  MotionGrid grid(centre_, half_size_, cell, static_cast<int>(layers_.size()));
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    throw_if_stopped();
    for (const Region& region : layers_[layer]) grid.fill_inside(static_cast<int>(layer), region);
  }
  return grid;
}

}  // namespace handey
