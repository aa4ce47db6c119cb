#include "separating_axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

using namespace handey;
using Eigen::Vector3d;

namespace benchmark {
namespace {

constexpr double kTolerance = 1e-5;  // depths up to this do not count [m]

void add_direction(std::vector<Vector3d>& directions, const Vector3d& direction) {
  const bool known = std::any_of(directions.begin(), directions.end(), [&](const Vector3d& other) {
    return other.cross(direction).squaredNorm() < 1e-20;
  });
  if (!known) directions.push_back(direction);
}

void bound(Solid& solid) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : solid.points) box.extend(point);
  solid.centre = box.center();
  for (const Vector3d& point : solid.points) {
    solid.radius = std::max(solid.radius, (point - solid.centre).norm());
  }
}

Vector3d normal_of(const TriangleMesh& mesh, const Eigen::Vector3i& triangle) {
  const auto at = [&](int corner) {
    return mesh.vertices[static_cast<std::size_t>(triangle(corner))];
  };
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

Solid convex_solid(const TriangleMesh& mesh) {
  Solid solid;
  solid.points = mesh.vertices;
  std::map<std::pair<int, int>, Vector3d> first_normal;  // of an edge's two triangles
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Vector3d normal = normal_of(mesh, triangle);
    add_direction(solid.normals, normal);
    for (int k = 0; k < 3; ++k) {
      const std::pair<int, int> ends = std::minmax({triangle(k), triangle((k + 1) % 3)});
      const auto found = first_normal.emplace(ends, normal);
      const bool flat = found.second || found.first->second.cross(normal).norm() < 1e-9;
      if (flat) continue;  // seen once so far, or inside a face
      add_direction(solid.edges, (mesh.vertices[static_cast<std::size_t>(ends.first)] -
                                  mesh.vertices[static_cast<std::size_t>(ends.second)])
                                     .normalized());
    }
  }
  bound(solid);
  return solid;
}

std::vector<Solid> triangles(const TriangleMesh& mesh) {
  std::vector<Solid> result;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    Solid solid;
    for (int k = 0; k < 3; ++k) {
      solid.points.push_back(mesh.vertices[static_cast<std::size_t>(triangle(k))]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      solid.edges.push_back((solid.points[(k + 1) % 3] - solid.points[k]).normalized());
    }
    solid.normals = {normal_of(mesh, triangle)};
    bound(solid);
    result.push_back(std::move(solid));
  }
  return result;
}

// How far the two overlap along an axis; negative: how far they are apart along it.
double overlap(const Solid& a, const Solid& b, const Vector3d& axis) {
  const auto extent = [&axis](const Solid& solid) {
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    for (const Vector3d& point : solid.points) {
      const double along = axis.dot(point);
      lower = std::min(lower, along);
      upper = std::max(upper, along);
    }
    return std::make_pair(lower, upper);
  };
  const auto first = extent(a), second = extent(b);
  return std::min(first.second - second.first, second.second - first.first);
}

}  // namespace

std::vector<Solid> solids_of(const std::vector<Shape>& shapes) {
  std::vector<Solid> result;
  for (const Shape& shape : shapes) {
    for (const TriangleMesh& piece : connected_components(tessellate(shape, 64, false))) {
      if (is_convex(piece)) {
        result.push_back(convex_solid(piece));
      } else {
        const std::vector<Solid> skin = triangles(piece);
        result.insert(result.end(), skin.begin(), skin.end());
      }
    }
  }
  return result;
}

void place_solid(const Solid& solid, const Pose& X, Solid& placed) {
  const auto turn = [&X](const std::vector<Vector3d>& from, std::vector<Vector3d>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = X.linear() * from[i];
  };
  turn(solid.normals, placed.normals);
  turn(solid.edges, placed.edges);
  placed.points.resize(solid.points.size());
  for (std::size_t i = 0; i < solid.points.size(); ++i) placed.points[i] = X * solid.points[i];
  placed.centre = X * solid.centre;
  placed.radius = solid.radius;
}

double overlap_depth(const Solid& a, const Solid& b) {
  if ((a.centre - b.centre).squaredNorm() > std::pow(a.radius + b.radius, 2)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  const auto is_apart = [&](const Vector3d& axis) {
    least = std::min(least, overlap(a, b, axis));
    return least <= kTolerance;
  };
  for (const Vector3d& normal : a.normals) {
    if (is_apart(normal)) return 0.0;
  }
  for (const Vector3d& normal : b.normals) {
    if (is_apart(normal)) return 0.0;
  }
  for (const Vector3d& edge_a : a.edges) {
    for (const Vector3d& edge_b : b.edges) {
      const Vector3d axis = edge_a.cross(edge_b);
      const double length = axis.norm();
      if (length > 1e-9 && is_apart(axis / length)) return 0.0;
    }
  }
  return least;
}

double deepest(const std::vector<Solid>& a, const std::vector<Solid>& b) {
  double result = 0.0;
  for (const Solid& one : a) {
    for (const Solid& other : b) result = std::max(result, overlap_depth(one, other));
  }
  return result;
}

}  // namespace benchmark
