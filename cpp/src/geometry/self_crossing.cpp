// Triangles are swept along the longest axis of the mesh; those whose boxes overlap are tested edge
// against triangle, by signs of volumes.
#include "self_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "handey/stop.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

// Choice: bounds the time of reading a mesh whose triangles all lie over each other.
constexpr long kMostPairs = 4'000'000;
constexpr double kStrict = 1e-9;  // of the cube of the mesh's size: nearer is touching

double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

struct Facet {
  Eigen::Vector3i corners;
  Vector3d lower, upper;
};

class Crossings {
 public:
  Crossings(const TriangleMesh& mesh, double least) : mesh_(mesh), least_(least) {}

  bool cross(const Eigen::Vector3i& a, const Eigen::Vector3i& b) const {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (a[i] == b[j]) return false;
      }
    }
    for (int i = 0; i < 3; ++i) {
      if (passes(a[i], a[(i + 1) % 3], b) || passes(b[i], b[(i + 1) % 3], a)) return true;
    }
    return false;
  }

 private:
  const Vector3d& at(int vertex) const { return mesh_.vertices[static_cast<std::size_t>(vertex)]; }

  bool passes(int from, int to, const Eigen::Vector3i& t) const {
    const Vector3d &p = at(from), &q = at(to), &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
    const double below = volume(a, b, c, p), above = volume(a, b, c, q);
    if (below * above >= 0.0 || std::min(std::abs(below), std::abs(above)) < least_) return false;
    const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
    return std::min({ab, bc, ca}) > least_ || std::max({ab, bc, ca}) < -least_;
  }

  const TriangleMesh& mesh_;
  double least_;
};

}  // namespace

bool crosses_itself(const TriangleMesh& mesh) {
  std::vector<Facet> facets;
  facets.reserve(mesh.triangles.size());
  Vector3d lower = Vector3d::Constant(1e300), upper = -lower;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    facets.push_back({t, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    lower = lower.cwiseMin(facets.back().lower);
    upper = upper.cwiseMax(facets.back().upper);
  }
  Eigen::Index axis = 0;
  const double size = (upper - lower).maxCoeff(&axis);
  std::sort(facets.begin(), facets.end(),
            [axis](const Facet& a, const Facet& b) { return a.lower[axis] < b.lower[axis]; });
  const Crossings crossings(mesh, kStrict * size * size * size);
  long pairs = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    throw_if_stopped();
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      if (facets[j].lower[axis] > facets[i].upper[axis]) break;
      if (++pairs > kMostPairs) return false;
      if ((facets[j].lower.array() > facets[i].upper.array()).any() ||
          (facets[i].lower.array() > facets[j].upper.array()).any()) {
        continue;
      }
      if (crossings.cross(facets[i].corners, facets[j].corners)) return true;
    }
  }
  return false;
}

}  // namespace handey
