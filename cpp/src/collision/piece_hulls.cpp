// Boxes as they are, round shapes tessellated from outside, meshes by their hull or by patches of
// their surface. Patches come from the surface tree; one is split as long as its hull would close
// an opening of the solid.
#include "piece_hulls.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"

namespace handey::collision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kThickness = 1e-9;  // half of a flat hull's [m]
constexpr double kFlat = 1e-6;       // thinner point sets become prisms [m]
constexpr double kRoundExcess =
    1.5e-3;  // Choice: a polyhedron may stand out of a round shape by this [m]

SceneHull box_hull(const Pose& X_BC, const Vector3d& half) {
  SceneHull hull;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    hull.points.push_back(X_BC * half.cwiseProduct(sign));
    for (const int bit : {1, 2, 4}) {
      if ((corner & bit) == 0) hull.edges.emplace_back(corner, corner | bit);
    }
  }
  return hull;
}

/// Edges of a polyhedron's faces, each once.
std::vector<std::pair<int, int>> edges_of(const ConvexPolyhedron& polyhedron) {
  std::vector<std::pair<int, int>> edges;
  for (const std::vector<int>& face : polyhedron.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      edges.push_back(std::minmax({face[i], face[(i + 1) % face.size()]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Columns: principal axes, the one of least spread last.
Eigen::Matrix3d principal_axes(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vector3d& point : points) covariance += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Matrix3d axes;
  axes.col(2) = solver.eigenvectors().col(0);
  axes.col(1) = solver.eigenvectors().col(1);
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

/// The outline along the last axis, as thick as the points are: always contains them.
SceneHull prism(const std::vector<Vector3d>& points, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox3d extent;
  std::vector<Vector2d> flat;
  for (const Vector3d& point : points) {
    const Vector3d local = axes.transpose() * point;
    extent.extend(local);
    flat.push_back(local.head<2>());
  }
  Polygon outline = convex_hull(flat);
  if (outline.size() < 3) {
    const Vector2d low = extent.min().head<2>().array() - kThickness;
    const Vector2d high = extent.max().head<2>().array() + kThickness;
    outline = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  }
  SceneHull hull;
  const int count = static_cast<int>(outline.size());
  for (int i = 0; i < count; ++i) {
    const Vector2d& corner = outline[static_cast<std::size_t>(i)];
    for (const double z : {extent.min().z() - kThickness, extent.max().z() + kThickness}) {
      hull.points.push_back(axes * Vector3d(corner.x(), corner.y(), z));
    }
    const int next = (i + 1) % count;
    hull.edges.emplace_back(2 * i, 2 * i + 1);
    hull.edges.emplace_back(2 * i, 2 * next);
    hull.edges.emplace_back(2 * i + 1, 2 * next + 1);
  }
  return hull;
}

/// The fewest sides that keep within the excess; twice for a sphere, which bends both ways.
int segments_for(double radius, int bends) {
  for (const int segments : {8, 12, 16, 24}) {
    const double cosine = std::cos(3.14159265358979323846 / segments);
    if (radius / std::pow(cosine, bends) - radius <= kRoundExcess) return segments;
  }
  return 32;
}

/// Does the hull leave its surface and what is inside it by no more than the excess, as far as
/// points on its faces show?
bool keeps_to_solid(const TriangleMesh& hull, const Polyhedral& mesh, bool solid, double excess) {
  const auto keeps = [&](const Vector3d& point) {
    return mesh.tree.distance(point) <= excess || (solid && mesh.tree.contains(point));
  };
  for (const Eigen::Vector3i& t : hull.triangles) {
    const Vector3d& a = hull.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d& b = hull.vertices[static_cast<std::size_t>(t[1])];
    const Vector3d& c = hull.vertices[static_cast<std::size_t>(t[2])];
    if (!keeps((a + b + c) / 3.0) || !keeps(0.5 * (a + b)) || !keeps(0.5 * (b + c)) ||
        !keeps(0.5 * (c + a))) {
      return false;
    }
  }
  return true;
}

TriangleMesh fan(const Polygon& outline, const Eigen::Matrix3d& axes, double height) {
  TriangleMesh mesh;
  for (const Vector2d& corner : outline) {
    mesh.vertices.push_back(axes * Vector3d(corner.x(), corner.y(), height));
  }
  for (int i = 1; i + 1 < static_cast<int>(outline.size()); ++i) {
    mesh.triangles.emplace_back(0, i, i + 1);
  }
  return mesh;
}

/// A hull and its surface as triangles.
struct Wrapped {
  SceneHull hull;
  TriangleMesh surface;
};

Wrapped wrap(const std::vector<Vector3d>& points) {
  const Eigen::Matrix3d axes = principal_axes(points);
  double low = axes.col(2).dot(points.front()), high = low;
  for (const Vector3d& point : points) {
    low = std::min(low, axes.col(2).dot(point));
    high = std::max(high, axes.col(2).dot(point));
  }
  if (high - low > kFlat) {
    try {
      const ConvexPolyhedron polyhedron = convex_hull(points);
      return {{polyhedron.vertices, edges_of(polyhedron)}, triangulate(polyhedron)};
    } catch (const InvalidInput&) {
      // Flatter than qhull takes: a prism always does.
    }
  }
  std::vector<Vector2d> flat;
  for (const Vector3d& point : points) {
    flat.emplace_back(axes.col(0).dot(point), axes.col(1).dot(point));
  }
  return {prism(points, axes), fan(convex_hull(flat), axes, 0.5 * (low + high))};
}

std::vector<Vector3d> points_of(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  std::vector<int> indices;
  for (const int t : triangles) {
    for (int k = 0; k < 3; ++k) {
      indices.push_back(mesh.triangles[static_cast<std::size_t>(t)][k]);
    }
  }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  std::vector<Vector3d> points;
  for (const int i : indices) points.push_back(mesh.vertices[static_cast<std::size_t>(i)]);
  return points;
}

std::vector<SceneHull> patch_hulls(const Piece& piece, const SceneOptions& options) {
  const Polyhedral& mesh = piece.polyhedral();
  std::vector<SceneHull> hulls;
  mesh.tree.visit_patches([&](const std::vector<int>& triangles) {
    if (static_cast<int>(triangles.size()) > options.patch_triangles) return false;
    Wrapped wrapped = wrap(points_of(mesh.mesh, triangles));
    if (triangles.size() > 1 &&
        !keeps_to_solid(wrapped.surface, mesh, piece.solid, options.patch_excess)) {
      return false;
    }
    hulls.push_back(std::move(wrapped.hull));
    return true;
  });
  return hulls;
}

}  // namespace

SceneHull hull_of_points(const std::vector<Vector3d>& points) { return wrap(points).hull; }

SceneHull hull_of_piece(const Piece& piece) {
  if (const Box* box = std::get_if<Box>(&piece.shape.geometry)) {
    return box_hull(piece.shape.X_BS, 0.5 * box->size);
  }
  if (std::holds_alternative<MeshShape>(piece.shape.geometry)) {
    const TriangleMesh& mesh = *std::get<MeshShape>(piece.shape.geometry).mesh;
    std::vector<int> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    return hull_of_points(points_of(mesh, all));
  }
  int segments = 32;
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&piece.shape.geometry)) {
    segments = segments_for(cylinder->radius, 1);
  } else if (const Sphere* sphere = std::get_if<Sphere>(&piece.shape.geometry)) {
    segments = segments_for(sphere->radius, 2);
  }
  return hull_of_points(tessellate(piece.shape, segments, true).vertices);
}

std::vector<SceneHull> hulls_of_piece(const Piece& piece, const SceneOptions& options) {
  if (piece.convex) return {piece.wrapping()};
  return patch_hulls(piece, options);
}

}  // namespace handey::collision
