// Polygons of mesh files as triangles: a fan where the polygon is convex, else by cutting ears in
// its own plane (Meisters 1975). A polygon with no ear left (it crosses itself) ends as a fan.
#include <cmath>

#include "mesh_formats.hpp"

namespace handey {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The polygon seen along its normal (Newell's, which needs no three good corners),
// counter-clockwise.
Corners project(const std::vector<int>& polygon, const TriangleMesh& mesh) {
  const auto point = [&](std::size_t i) -> const Eigen::Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(polygon[i % polygon.size()])];
  };
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    normal += (point(i) - point(0)).cross(point(i + 1) - point(0));
  if (!(normal.norm() > 0.0)) return {};
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.normalized().cross(u);
  Corners corners;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    corners.emplace_back(u.dot(point(i) - point(0)), v.dot(point(i) - point(0)));
  }
  return corners;
}

bool is_convex_polygon(const Corners& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t n = corners.size();
    if (turn(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]) <= 0.0) return false;
  }
  // All turns to the left and one turn in all: no star.
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    if (turn(corners[0], corners[i], corners[i + 1]) < 0.0) return false;
  }
  return true;
}

bool is_ear(const Corners& corners, const std::vector<std::size_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const Eigen::Vector2d& a = corners[left[(at + n - 1) % n]];
  const Eigen::Vector2d& b = corners[left[at]];
  const Eigen::Vector2d& c = corners[left[(at + 1) % n]];
  if (turn(a, b, c) <= 0.0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& p = corners[left[i]];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
  }
  return true;
}

}  // namespace

void append_triangulated(const std::vector<int>& polygon, TriangleMesh& mesh) {
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const Corners corners = polygon.size() > 3 ? project(polygon, mesh) : Corners{};
  if (!corners.empty() && !is_convex_polygon(corners)) {
    std::size_t at = 0;
    std::size_t since_cut = 0;
    while (left.size() > 3 && since_cut < left.size()) {
      const std::size_t n = left.size();
      at %= n;
      if (is_ear(corners, left, at)) {
        mesh.triangles.emplace_back(polygon[left[(at + n - 1) % n]], polygon[left[at]],
                                    polygon[left[(at + 1) % n]]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
        since_cut = 0;
      } else {
        ++at;
        ++since_cut;
      }
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) {
    mesh.triangles.emplace_back(polygon[left[0]], polygon[left[i]], polygon[left[i + 1]]);
  }
}

}  // namespace handey
