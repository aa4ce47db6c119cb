// Planar faces of each shape that look up, joined plane by plane; walls are sections of the body.
#include "handey/world/support_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "handey/errors.hpp"
#include "handey/geometry/section.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSegments = 64;
constexpr double kOnePlane = 2e-5;      // faces this near to a plane are in it [m]
constexpr double kOneNormal = 1e-4;     // their normals leave each other by no more [rad]
constexpr double kSectionDepth = 1e-4;  // of the slab that stands for a section [m]
// Choice: walls whose ends are this near to each other are joined [m].
constexpr double kJoint = 1e-5;

void require_valid(const SupportFaceOptions& options) {
  const std::pair<const char*, double> numbers[] = {{"level", options.level},
                                                    {"least_area", options.least_area},
                                                    {"least_wall", options.least_wall}};
  for (const auto& [name, value] : numbers) {
    if (std::isfinite(value) && value >= 0.0) continue;
    throw InvalidInput(
        "E_RANGE", name,
        "found " + std::to_string(value) + ", expected a finite number, not negative");
  }
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// Frame with z along `normal`, x and y as near to the world's as can be.
Eigen::Matrix3d axes_for(const Vector3d& normal) {
  Eigen::Matrix3d axes;
  axes.col(2) = normal;
  axes.col(0) = (Vector3d::UnitX() - normal.x() * normal).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

/// Faces in one plane, as loops about a point of it.
struct Level {
  Pose X_WS = Pose::Identity();
  std::vector<Region> regions;
};

void add_face(std::vector<Level>& levels, const PlanarFace& face, const Pose& X_WB) {
  const Vector3d normal = X_WB.linear() * face.normal, origin = X_WB * face.origin;
  Level* level = nullptr;
  for (Level& other : levels) {
    const Vector3d z = other.X_WS.linear().col(2);
    const bool near = std::abs(z.dot(origin - other.X_WS.translation())) < kOnePlane;
    if (near && (z - normal).norm() < kOneNormal) level = &other;
  }
  if (level == nullptr) {
    levels.emplace_back();
    level = &levels.back();
    level->X_WS.linear() = axes_for(normal.normalized());
    level->X_WS.translation() = origin;
  }
  const Pose X_SB = level->X_WS.inverse() * X_WB;
  Region region;
  for (const Polygon& loop : face.region.loops) {
    region.loops.emplace_back();
    for (const Vector2d& point : loop) {
      const Vector3d p = face.origin + point.x() * face.u + point.y() * face.v;
      region.loops.back().push_back((X_SB * p).head<2>());
    }
  }
  level->regions.push_back(std::move(region));
}

Region moved(Region region, const Vector2d& by) {
  for (Polygon& loop : region.loops) {
    for (Vector2d& point : loop) point += by;
  }
  return region;
}

Vector2d middle_of(const Region& region) {
  Eigen::AlignedBox2d box;
  for (const Polygon& loop : region.loops) {
    for (const Vector2d& point : loop) box.extend(point);
  }
  return box.center();
}

Region section(const Body& body, const Pose& X_SB, double lower, double upper) {
  std::vector<Region> slabs;
  for (const Shape& shape : body.shapes) {
    throw_if_stopped();
    slabs.push_back(slab_projection(shape, X_SB, lower, upper));
  }
  return offset(unite(slabs), kJoint);
}

/// The loops that run the one way, outer ones (counter-clockwise) or holes, as filled regions.
Region filled(const Region& region, bool outer) {
  std::vector<Region> loops;
  for (Polygon loop : region.loops) {
    if ((signed_area(loop) > 0.0) != outer) continue;
    if (!outer) std::reverse(loop.begin(), loop.end());
    loops.push_back(Region{{std::move(loop)}});
  }
  return unite(loops);
}

SupportFace describe(const Body& body, const Level& level, const SupportFaceOptions& options) {
  SupportFace face;
  Region whole = unite(level.regions);
  const Vector2d middle = middle_of(whole);
  face.region = moved(std::move(whole), -middle);
  face.area = area(face.region);
  face.X_WS = level.X_WS;
  face.X_WS.translation() += level.X_WS.linear().leftCols<2>() * middle;
  const Pose X_SB = face.X_WS.inverse() * body.X_WB;
  const double lower = options.least_wall;
  const Region walls = section(body, X_SB, lower, lower + kSectionDepth);
  // An island within a hole is no part of what the walls enclose.
  face.enclosed = subtract(filled(walls, false), walls);
  constexpr double kFar = 100.0;  // [m]
  face.outline = filled(section(body, X_SB, -kFar, kFar), true);
  return face;
}

}  // namespace

std::vector<SupportFace> support_faces(const Body& body, const SupportFaceOptions& options) {
  require_valid(options);
  require_rigid(body.X_WB, body.name + ".pose");
  std::vector<Level> levels;
  PlanarFaceOptions planar;
  planar.least_area = options.least_area;
  for (const Shape& shape : body.shapes) {
    throw_if_stopped();
    const TriangleMesh mesh = tessellate(shape, kSegments);
    const MeshShape* given = std::get_if<MeshShape>(&shape.geometry);
    std::vector<PlanarFace> faces = planar_faces(mesh, planar);
    if (given != nullptr && !given->solid) {
      const std::vector<PlanarFace> others = planar_faces(turned_over(mesh), planar);
      faces.insert(faces.end(), others.begin(), others.end());
    }
    for (const PlanarFace& face : faces) {
      const double upward = body.X_WB.linear().row(2).dot(face.normal);
      if (upward >= std::cos(options.level)) add_face(levels, face, body.X_WB);
    }
  }
  std::vector<SupportFace> found;
  for (const Level& level : levels) found.push_back(describe(body, level, options));
  const auto key = [](const SupportFace& face) {
    return std::make_pair(-std::llround(face.X_WS.translation().z() * 1e6),
                          -std::llround(face.area * 1e9));
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const SupportFace& a, const SupportFace& b) { return key(a) < key(b); });
  return found;
}

}  // namespace handey
