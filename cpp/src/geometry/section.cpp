// What of a solid lies in a slab, seen along the slab's normal. Convex shapes: the hull of the
// projected corners of the clipped polyhedron, exact. Meshes: a vertical line meets the clipped
// solid where it meets an upward triangle inside the slab or the cut through the solid at the
// slab's upper plane, so the region is the union of those; triangles' common edges cancel before
// the union. Open skins: all triangles, upright ones 1e-6 m thick. Meshes that are solids must be
// closed and oriented outward; overlapping bodies are a union.
#include "handey/geometry/section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <unordered_map>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/stop.hpp"
#include "mesh_edges.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSegments = 64;              // of round shapes: their outline grows by 0.12 %
constexpr std::size_t kFewTriangles = 64;  // Choice: of so few, telling a convex solid is cheap
constexpr double kSkinThickness =
    1e-6;  // upright triangles of an open skin have no projected area [m]

struct Slab {
  double lower;
  double upper;
  bool holds(double z) const { return z >= lower && z <= upper; }
};

std::vector<Eigen::Vector3d> transformed(const std::vector<Eigen::Vector3d>& points,
                                         const Pose& pose) {
  std::vector<Eigen::Vector3d> moved;
  moved.reserve(points.size());
  for (const Eigen::Vector3d& point : points) moved.push_back(pose * point);
  return moved;
}

bool misses(const std::vector<Eigen::Vector3d>& points, const Slab& slab) {
  const auto below = [&slab](const Eigen::Vector3d& p) { return p.z() < slab.lower; };
  const auto above = [&slab](const Eigen::Vector3d& p) { return p.z() > slab.upper; };
  return std::all_of(points.begin(), points.end(), below) ||
         std::all_of(points.begin(), points.end(), above);
}

Eigen::Vector2d crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double z) {
  const double t = std::clamp((z - a.z()) / (b.z() - a.z()), 0.0, 1.0);
  return a.head<2>() + t * (b - a).head<2>();
}

Region hull_region(const std::vector<Eigen::Vector2d>& points) {
  const Polygon hull = convex_hull(points);
  if (hull.size() < 3) return {};
  return Region{{hull}};
}

Region convex_projection(const std::vector<Eigen::Vector3d>& vertices,
                         const std::vector<Eigen::Vector3i>& triangles, const Slab& slab) {
  std::vector<Eigen::Vector2d> outline;
  outline.reserve(2 * vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) {
    if (slab.holds(vertex.z())) outline.push_back(vertex.head<2>());
  }
  if (outline.size() == vertices.size()) return hull_region(outline);  // nothing is cut off
  // An edge rises in one of its two triangles.
  for (const Eigen::Vector3i& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = vertices[static_cast<std::size_t>(triangle[k])];
      const Eigen::Vector3d& b = vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      for (const double z : {slab.lower, slab.upper}) {
        if (a.z() < z && b.z() >= z) outline.push_back(crossing(a, b, z));
      }
    }
  }
  return hull_region(outline);
}

// A polygon of kSegments sides around the largest disc of the sphere within the slab.
Region sphere_projection(const Eigen::Vector3d& centre, double radius, const Slab& slab) {
  const double off = std::max({slab.lower - centre.z(), centre.z() - slab.upper, 0.0});
  if (off >= radius) return {};
  const double outer = std::sqrt(radius * radius - off * off) / std::cos(kPi / kSegments);
  Polygon polygon;
  for (int i = 0; i < kSegments; ++i) {
    const double angle = 2.0 * kPi * i / kSegments;
    polygon.push_back(centre.head<2>() + outer * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return Region{{polygon}};
}

// Clips triangles to the slab and gathers the sides of what is left, by the numbers of their end
// points.
class MeshProjection {
 public:
  MeshProjection(std::vector<Eigen::Vector3d> vertices, const Slab& slab)
      : vertices_(std::move(vertices)), slab_(slab) {
    for (const Eigen::Vector3d& vertex : vertices_) points_.push_back(vertex.head<2>());
  }

  Region of_solid(const std::vector<Eigen::Vector3i>& triangles) {
    throw_if_stopped();
    for (const Eigen::Vector3i& triangle : triangles) {
      const Outline outline = clip(triangle);
      if (doubled_area(triangle) > 0.0) add_sides(outline.points, false);
      if (outline.leaves >= 0) edges_.push_back({outline.returns, outline.leaves});
    }
    return region_of_loops(loops());
  }

  Region of_skin(const std::vector<Eigen::Vector3i>& triangles) {
    throw_if_stopped();
    std::vector<Polygon> upright;
    for (const Eigen::Vector3i& triangle : triangles) {
      const Outline outline = clip(triangle);
      if (outline.points.empty()) continue;
      const double doubled = doubled_area(triangle);
      add_sides(outline.points, doubled < 0.0);
      if (std::abs(doubled) <= kSkinThickness * longest_side(triangle)) {
        upright.push_back(thickened(outline.points));
      }
    }
    std::vector<Polygon> all = loops();
    all.insert(all.end(), upright.begin(), upright.end());
    return region_of_loops(all);
  }

 private:
  struct Outline {
    std::vector<int> points;  // of the part within the slab, in the triangle's order
    int leaves = -1;          // where the triangle's boundary leaves the slab upward
    int returns = -1;         // and where it comes back
  };

  const Eigen::Vector3d& vertex(int index) const {
    return vertices_[static_cast<std::size_t>(index)];
  }

  double doubled_area(const Eigen::Vector3i& triangle) const {
    const Eigen::Vector2d ab = (vertex(triangle[1]) - vertex(triangle[0])).head<2>();
    const Eigen::Vector2d ac = (vertex(triangle[2]) - vertex(triangle[0])).head<2>();
    return ab.x() * ac.y() - ab.y() * ac.x();
  }

  double longest_side(const Eigen::Vector3i& triangle) const {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      longest =
          std::max(longest, (vertex(triangle[(k + 1) % 3]) - vertex(triangle[k])).head<2>().norm());
    }
    return longest;
  }

  Outline clip(const Eigen::Vector3i& triangle) {
    Outline outline;
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      const double za = vertex(a).z();
      const double zb = vertex(b).z();
      if (slab_.holds(za)) outline.points.push_back(a);
      if (za < slab_.lower && zb >= slab_.lower) outline.points.push_back(cut(a, b, false));
      if (za <= slab_.upper && zb > slab_.upper) {
        outline.leaves = cut(a, b, true);
        outline.points.push_back(outline.leaves);
      }
      if (za > slab_.upper && zb <= slab_.upper) {
        outline.returns = cut(a, b, true);
        outline.points.push_back(outline.returns);
      }
      if (za >= slab_.lower && zb < slab_.lower) outline.points.push_back(cut(a, b, false));
    }
    return outline;
  }

  // The point where an edge crosses a plane of the slab: the same number for both triangles at the
  // edge.
  int cut(int a, int b, bool at_upper) {
    const int low = std::min(a, b);
    const int high = std::max(a, b);
    const std::uint64_t key =
        static_cast<std::uint64_t>(low) * vertices_.size() + static_cast<std::uint64_t>(high);
    const auto [found, is_new] =
        cuts_[at_upper ? 1 : 0].emplace(key, static_cast<int>(points_.size()));
    if (is_new) {
      points_.push_back(crossing(vertex(low), vertex(high), at_upper ? slab_.upper : slab_.lower));
    }
    return found->second;
  }

  void add_sides(const std::vector<int>& outline, bool reverse) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const int a = outline[i];
      const int b = outline[(i + 1) % outline.size()];
      if (reverse) {
        edges_.push_back({b, a});
      } else {
        edges_.push_back({a, b});
      }
    }
  }

  std::vector<Polygon> loops() const {
    std::vector<Polygon> polygons;
    for (const std::vector<int>& loop : boundary_loops(edges_)) {
      Polygon polygon;
      for (const int point : loop) polygon.push_back(points_[static_cast<std::size_t>(point)]);
      polygons.push_back(std::move(polygon));
    }
    return polygons;
  }

  Polygon thickened(const std::vector<int>& outline) const {
    std::vector<Eigen::Vector2d> corners;
    for (const int point : outline) {
      for (const double dx : {-kSkinThickness, kSkinThickness}) {
        for (const double dy : {-kSkinThickness, kSkinThickness}) {
          corners.push_back(points_[static_cast<std::size_t>(point)] + Eigen::Vector2d(dx, dy));
        }
      }
    }
    return convex_hull(corners);
  }

  std::vector<Eigen::Vector3d> vertices_;
  Slab slab_;
  std::vector<Eigen::Vector2d> points_;  // the vertices, then the cuts
  std::array<std::unordered_map<std::uint64_t, int>, 2> cuts_;
  std::vector<std::array<int, 2>> edges_;
};

bool is_known_convex(const MeshShape& shape) {
  if (shape.convex || !shape.solid) return shape.convex;
  return shape.mesh->triangles.size() <= kFewTriangles && is_convex(*shape.mesh);
}

}  // namespace

Region slab_projection(const Shape& shape, const Pose& X_GB, double lower, double upper) {
  require_rigid(X_GB, "X_GB");
  require_valid(shape, "shape");
  if (!std::isfinite(lower) || !std::isfinite(upper) || lower > upper) {
    std::ostringstream text;
    text << "found lower " << lower << ", upper " << upper
         << ", expected finite heights, lower <= upper [m]";
    throw InvalidInput("E_RANGE", "slab", text.str());
  }
  const Slab slab{lower, upper};
  const Pose X_GS = X_GB * shape.X_BS;
  if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
    return sphere_projection(X_GS.translation(), sphere->radius, slab);
  }
  const MeshShape* mesh = std::get_if<MeshShape>(&shape.geometry);
  if (mesh == nullptr) {
    TriangleMesh polyhedron = tessellate(Shape{shape.geometry, X_GS}, kSegments, true);
    return misses(polyhedron.vertices, slab)
               ? Region{}
               : convex_projection(polyhedron.vertices, polyhedron.triangles, slab);
  }
  std::vector<Eigen::Vector3d> vertices = transformed(mesh->mesh->vertices, X_GS);
  if (misses(vertices, slab)) return {};
  if (is_known_convex(*mesh)) {
    return convex_projection(vertices, mesh->mesh->triangles, slab);
  }
  MeshProjection projection(std::move(vertices), slab);
  return mesh->solid ? projection.of_solid(mesh->mesh->triangles)
                     : projection.of_skin(mesh->mesh->triangles);
}

}  // namespace handey
