// Shapes into pieces, and the distance of two pieces.
#include "piece.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/stop.hpp"
#include "piece_hulls.hpp"

namespace handey::collision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSegments = 32;  // Choice: half a percent of the radius too large next to a mesh
constexpr std::size_t kBoxTrials = 32;  // triangles whose axes are tried for a small box

OrientedBox box_along(const Matrix3d& axes, const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d extent;
  for (const Vector3d& point : points) extent.extend(axes.transpose() * point);
  OrientedBox box;
  box.X_BO.linear() = axes;
  box.X_BO.translation() = axes * extent.center();
  box.half = 0.5 * extent.sizes();
  return box;
}

/// Right-handed axes with z along `z`, x as near as may be to `x`.
Matrix3d axes_from(const Vector3d& z, const Vector3d& x) {
  Matrix3d axes;
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(x).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

Matrix3d principal_axes(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& point : points) mean += point / static_cast<double>(points.size());
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& point : points) covariance += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance);
  return axes_from(solver.eigenvectors().col(2), solver.eigenvectors().col(1));
}

double size_of(const OrientedBox& box) { return (box.half.array() + 1e-4).prod(); }

/// Frames of the mesh's largest triangles.
std::vector<Matrix3d> triangle_axes(const TriangleMesh& mesh) {
  const auto corner = [&](int t, int k) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(t)][k])];
  };
  std::vector<std::pair<double, int>> by_area;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    by_area.emplace_back(-(corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm(),
                         t);
  }
  const std::size_t count = std::min(kBoxTrials, by_area.size());
  std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count),
                    by_area.end());
  std::vector<Matrix3d> frames;
  for (std::size_t i = 0; i < count; ++i) {
    const int t = by_area[i].second;
    const Vector3d normal = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    if (normal.squaredNorm() < 1e-24) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3d edge = corner(t, (k + 1) % 3) - corner(t, k);
      if (edge.squaredNorm() > 1e-16) frames.push_back(axes_from(normal, edge));
    }
  }
  return frames;
}

void set_box(Piece& piece, const OrientedBox& box) {
  piece.box = box;
  piece.radius = box.half.norm();
}

/// Vertices used by triangles only.
std::vector<Vector3d> used_vertices(const TriangleMesh& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(t[k])] = 1;
  }
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] != 0) points.push_back(mesh.vertices[i]);
  }
  return points;
}

Vector3d mean_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

std::shared_ptr<const Piece> mesh_piece(TriangleMesh mesh, bool solid, bool convex) {
  std::shared_ptr<Piece> piece = std::make_shared<Piece>();
  piece->convex = convex;
  piece->solid = solid;
  set_box(*piece, oriented_box(mesh));
  const std::vector<Vector3d> points = used_vertices(mesh);
  double squared = 0.0;
  for (const Vector3d& point : points) {
    squared = std::max(squared, (point - piece->box.X_BO.translation()).squaredNorm());
  }
  piece->radius = std::sqrt(squared);
  if (convex) {
    piece->hull.kind = ConvexSolid::Kind::Points;
    piece->hull.points = points;
    piece->hull.centre = mean_of(points);
  } else {
    piece->hull.kind = ConvexSolid::Kind::Box;
    piece->hull.X_BC = piece->box.X_BO;
    piece->hull.half = piece->box.half;
    piece->hull.centre = piece->box.X_BO.translation();
  }
  piece->shape.geometry = MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), solid};
  return piece;
}

std::shared_ptr<const Piece> primitive_piece(const Shape& shape) {
  std::shared_ptr<Piece> piece = std::make_shared<Piece>();
  piece->shape = shape;
  piece->hull.centre = shape.X_BS.translation();
  piece->hull.X_BC = shape.X_BS;
  OrientedBox box;
  box.X_BO = shape.X_BS;
  if (const Box* cuboid = std::get_if<Box>(&shape.geometry)) {
    piece->hull.kind = ConvexSolid::Kind::Box;
    box.half = piece->hull.half = 0.5 * cuboid->size;
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    piece->hull.kind = ConvexSolid::Kind::Cylinder;
    box.half = piece->hull.half = {cylinder->radius, cylinder->radius, 0.5 * cylinder->length};
  } else {
    const double radius = std::get<Sphere>(shape.geometry).radius;
    piece->hull.kind = ConvexSolid::Kind::Points;
    piece->hull.points = {shape.X_BS.translation()};
    piece->hull.rounding = radius;
    box.half.setConstant(radius);
  }
  set_box(*piece, box);
  if (std::holds_alternative<Sphere>(shape.geometry)) piece->radius = box.half.x();
  if (std::holds_alternative<Cylinder>(shape.geometry)) {
    piece->radius = Eigen::Vector2d(box.half.x(), box.half.z()).norm();
  }
  return piece;
}

/// A closed mesh by its connected pieces; one that has a cavity stays whole, or the cavity would be
/// filled.
void add_solid_mesh(const TriangleMesh& mesh, Pieces& pieces) {
  const std::vector<TriangleMesh> components = connected_components(mesh);
  throw_if_stopped();
  const bool has_cavity =
      std::any_of(components.begin(), components.end(),
                  [](const TriangleMesh& c) { return inspect_surface(c).volume <= 0.0; });
  if (has_cavity) {
    pieces.push_back(mesh_piece(mesh, true, false));
    return;
  }
  for (const TriangleMesh& component : components) {
    throw_if_stopped();
    pieces.push_back(mesh_piece(component, true, is_convex(component)));
  }
}

}  // namespace

OrientedBox oriented_box(const TriangleMesh& mesh) {
  const std::vector<Vector3d> points = used_vertices(mesh);
  OrientedBox best = box_along(Matrix3d::Identity(), points);
  std::vector<Matrix3d> frames = triangle_axes(mesh);
  frames.push_back(principal_axes(points));
  for (const Matrix3d& axes : frames) {
    throw_if_stopped();
    if (!axes.allFinite()) continue;
    const OrientedBox box = box_along(axes, points);
    if (size_of(box) < 0.99 * size_of(best)) best = box;
  }
  best.half.array() += 1e-9;  // What rounding took away from the axes.
  return best;
}

Polyhedral::Polyhedral(TriangleMesh triangles) : mesh(std::move(triangles)), tree(mesh) {
  for (const TriangleMesh& component : connected_components(mesh)) {
    const std::size_t first = static_cast<std::size_t>(component.triangles.front()[0]);
    seeds.push_back(component.vertices[first]);
  }
}

const Polyhedral& Piece::polyhedral() const {
  return polyhedral_.get([this] { return Polyhedral(tessellate(shape, kSegments, true)); });
}

const SurfaceModel& Piece::surface() const {
  return *surface_.get([this] { return make_surface_model(polyhedral().mesh); });
}

const SceneHull& Piece::wrapping() const {
  return wrapping_.get([this] { return hull_of_piece(*this); });
}

const std::vector<SceneHull>& Piece::covering() const {
  return covering_.get([this] { return hulls_of_piece(*this, {}); });
}

Pieces make_pieces(const std::vector<Shape>& shapes, const std::string& place) {
  Pieces pieces;
  for (const Shape& shape : shapes) {
    throw_if_stopped();
    require_valid(shape, place);
    const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry);
    if (mesh == nullptr) {
      pieces.push_back(primitive_piece(shape));
      continue;
    }
    TriangleMesh in_body = tessellate(shape);
    if (in_body.triangles.empty())
      throw InvalidInput("E_MESH_EMPTY", place, "mesh has no triangles");
    if (mesh->convex) {
      pieces.push_back(mesh_piece(std::move(in_body), true, true));
    } else if (mesh->solid) {
      add_solid_mesh(in_body, pieces);
    } else {
      pieces.push_back(mesh_piece(std::move(in_body), false, false));
    }
  }
  return pieces;
}

namespace {

/// Is a connected piece of a's surface inside b? Surfaces must not cross.
bool has_piece_inside(const Polyhedral& a, const Pose& X_WA, const Polyhedral& b,
                      const Pose& X_WB) {
  const Pose X_BA = X_WB.inverse() * X_WA;
  return std::any_of(a.seeds.begin(), a.seeds.end(),
                     [&](const Vector3d& seed) { return b.tree.contains(X_BA * seed); });
}

/// A piece that is not convex from one that is. @param boxes  distance of the first one's box
double mesh_to_convex(const Piece& mesh, const Pose& X_WM, const Piece& convex, const Pose& X_WC,
                      double boxes, double least, double enough) {
  const Pose X_MC = X_WM.inverse(Eigen::Isometry) * X_WC;
  const SurfaceTree& tree = mesh.polyhedral().tree;
  const double surface = tree.distance(convex.hull, X_MC, least, enough);
  if (surface <= least || boxes > 0.0) return surface;
  // The surface does not cross the convex piece: all of it is inside, or none.
  return mesh.solid && tree.contains(X_MC * convex.hull.centre) ? 0.0 : surface;
}

}  // namespace

double piece_distance(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB,
                      double least, double enough, Vector3d* apart) {
  if (a.convex && b.convex) {
    return convex_distance(a.hull, X_WA, b.hull, X_WB, least, enough, apart);
  }
  const double boxes = convex_distance(a.hull, X_WA, b.hull, X_WB, 0.0, enough);
  if (boxes > enough) return boxes;
  throw_if_stopped();
  if (a.convex) return mesh_to_convex(b, X_WB, a, X_WA, boxes, least, enough);
  if (b.convex) return mesh_to_convex(a, X_WA, b, X_WB, boxes, least, enough);
  // A little beyond `enough`, so that reaching the horizon means farther than enough.
  const double surfaces =
      surface_distance(a.surface(), X_WA, b.surface(), X_WB, enough * (1.0 + 1e-9) + 1e-9);
  if (surfaces <= least || boxes > 0.0) return surfaces;
  const Polyhedral& mesh_a = a.polyhedral();
  const Polyhedral& mesh_b = b.polyhedral();
  if (b.solid && has_piece_inside(mesh_a, X_WA, mesh_b, X_WB)) return 0.0;
  if (a.solid && has_piece_inside(mesh_b, X_WB, mesh_a, X_WA)) return 0.0;
  return surfaces;
}

}  // namespace handey::collision
