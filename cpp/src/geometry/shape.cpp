// Boxes, cylinders, spheres and meshes as triangles and as points. Round shapes become polyhedra
// that contain them (faces tangent) or are contained in them (vertices on the surface).
#include "handey/geometry/shape.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kFewestSegments = 3;
constexpr int kMostSegments = 4096;

void require_positive(double value, const char* name, const std::string& place) {
  if (std::isfinite(value) && value > 0.0) return;
  std::ostringstream text;
  text << name << " is " << value << ", expected a finite length > 0 [m]";
  throw InvalidInput(std::isfinite(value) ? "E_GEOMETRY" : "E_NUMBER", place, text.str());
}

struct RequireValid {
  const std::string& place;
  void operator()(const Box& box) const {
    for (int k = 0; k < 3; ++k) require_positive(box.size[k], "a box's edge", place);
  }
  void operator()(const Cylinder& cylinder) const {
    require_positive(cylinder.radius, "a cylinder's radius", place);
    require_positive(cylinder.length, "a cylinder's length", place);
  }
  void operator()(const Sphere& sphere) const {
    require_positive(sphere.radius, "a sphere's radius", place);
  }
  void operator()(const MeshShape& shape) const {
    if (!shape.mesh || shape.mesh->triangles.empty()) {
      throw InvalidInput("E_GEOMETRY", place,
                         "a mesh shape has no triangles, expected at least one");
    }
    handey::require_valid(*shape.mesh, place);
  }
};

TriangleMesh box_mesh(const Box& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5,
                               corner & 4 ? 0.5 : -0.5);
    mesh.vertices.push_back(box.size.cwiseProduct(sign));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh cylinder_mesh(const Cylinder& cylinder, int segments, bool outer) {
  TriangleMesh mesh;
  const double radius = outer ? cylinder.radius / std::cos(kPi / segments) : cylinder.radius;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * kPi * i / segments;
    for (const double z : {-0.5, 0.5}) {
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                 z * cylinder.length);
    }
  }
  for (int i = 0; i < segments; ++i) {
    const int low = 2 * i;
    const int next = 2 * ((i + 1) % segments);
    mesh.triangles.emplace_back(low, next, next + 1);
    mesh.triangles.emplace_back(low, next + 1, low + 1);
    if (i >= 1 && i + 1 < segments) {
      mesh.triangles.emplace_back(0, next, low);
      mesh.triangles.emplace_back(1, low + 1, next + 1);
    }
  }
  return mesh;
}

// Meridians and parallels; the outer one is scaled until its nearest face touches the sphere.
TriangleMesh sphere_mesh(const Sphere& sphere, int segments, bool outer) {
  TriangleMesh mesh;
  const int rings = std::max(2, segments / 2);  // bands between the poles
  mesh.vertices.emplace_back(0.0, 0.0, -1.0);
  for (int ring = 1; ring < rings; ++ring) {
    const double latitude = -0.5 * kPi + kPi * ring / rings;
    for (int i = 0; i < segments; ++i) {
      const double angle = 2.0 * kPi * i / segments;
      mesh.vertices.emplace_back(std::cos(latitude) * std::cos(angle),
                                 std::cos(latitude) * std::sin(angle), std::sin(latitude));
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, 1.0);
  const int top = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int ring, int i) { return 1 + (ring - 1) * segments + i % segments; };
  for (int i = 0; i < segments; ++i) {
    mesh.triangles.emplace_back(0, at(1, i + 1), at(1, i));
    mesh.triangles.emplace_back(top, at(rings - 1, i), at(rings - 1, i + 1));
    for (int ring = 1; ring + 1 < rings; ++ring) {
      mesh.triangles.emplace_back(at(ring, i), at(ring, i + 1), at(ring + 1, i + 1));
      mesh.triangles.emplace_back(at(ring, i), at(ring + 1, i + 1), at(ring + 1, i));
    }
  }
  double nearest = outer ? std::numeric_limits<double>::infinity() : 1.0;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (!outer) break;
    const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Eigen::Vector3d& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Eigen::Vector3d& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    nearest = std::min(nearest, normal.dot(a));
  }
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= sphere.radius / nearest;
  return mesh;
}

struct Tessellate {
  int segments;
  bool outer;
  TriangleMesh operator()(const Box& box) const { return box_mesh(box); }
  TriangleMesh operator()(const Cylinder& cylinder) const {
    return cylinder_mesh(cylinder, segments, outer);
  }
  TriangleMesh operator()(const Sphere& sphere) const {
    return sphere_mesh(sphere, segments, outer);
  }
  TriangleMesh operator()(const MeshShape& shape) const { return *shape.mesh; }
};

}  // namespace

void require_valid(const Shape& shape, const std::string& place) {
  require_rigid(shape.X_BS, place);
  std::visit(RequireValid{place}, shape.geometry);
}

TriangleMesh tessellate(const Shape& shape, int segments, bool outer) {
  require_valid(shape, "shape");
  if (segments < kFewestSegments || segments > kMostSegments) {
    throw InvalidInput("E_RANGE", "segments",
                       "found " + std::to_string(segments) + ", expected " +
                           std::to_string(kFewestSegments) + " to " +
                           std::to_string(kMostSegments));
  }
  TriangleMesh mesh = std::visit(Tessellate{segments, outer}, shape.geometry);
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = shape.X_BS * vertex;
  return mesh;
}

std::vector<Eigen::Vector3d> hull_points(const Shape& shape) {
  TriangleMesh mesh = tessellate(shape);
  if (!std::holds_alternative<MeshShape>(shape.geometry)) return std::move(mesh.vertices);
  try {
    return convex_hull(mesh.vertices).vertices;
  } catch (const InvalidInput&) {
    return std::move(
        mesh.vertices);  // a flat skin has no solid hull; its own points span the same set
  }
}

}  // namespace handey
