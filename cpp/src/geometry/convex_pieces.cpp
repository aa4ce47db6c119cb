// Convex hulls by qhull (Barber, Dobkin, Huhdanpaa 1996), its reentrant C interface. Points are
// centred first, so that a small part far from the origin keeps its precision.
#include "handey/geometry/convex_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "handey/errors.hpp"
#include "handey/geometry/point_tree.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

[[noreturn]] void throw_flat(const std::string& found) {
  throw InvalidInput("E_MESH_DEGENERATE", "points",
                     found + ", expected at least four points that are not in one plane");
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// One run of qhull; frees what it took also when it fails. It can be stopped: qhull tells its
// progress to a file, and where that is written it is told to add no more points.
class Hull {
 public:
  explicit Hull(std::vector<double>& coordinates) {
    const cookie_io_functions_t functions{nullptr, &Hull::look, nullptr, nullptr};
    told_.reset(fopencookie(this, "w", functions));
    if (told_) std::setvbuf(told_.get(), nullptr, _IONBF, 0);
    qh_zero(&state_, told_.get());
    // Without Qt: triangles of one plane stay one face. TF: progress after so many facets.
    char command[] = "qhull TF500";
    const int count = static_cast<int>(coordinates.size() / 3);
    status_ =
        qh_new_qhull(&state_, 3, count, coordinates.data(), False, command, nullptr, told_.get());
  }
  ~Hull() {
    qh_freeqhull(&state_, !qh_ALL);
    int blocks = 0;
    int bytes = 0;
    qh_memfreeshort(&state_, &blocks, &bytes);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// @throws Stopped, or whatever else a look threw while qhull ran
  int status() const {
    if (thrown_) std::rethrow_exception(thrown_);
    return status_;
  }
  qhT* state() { return &state_; }

 private:
  // No exception may pass through qhull.
  static ssize_t look(void* hull, const char*, std::size_t size) noexcept {
    Hull& self = *static_cast<Hull*>(hull);
    try {
      if (!self.thrown_) throw_if_stopped();
    } catch (...) {
      self.thrown_ = std::current_exception();
      self.state_.STOPadd = 1;
    }
    return static_cast<ssize_t>(size);
  }

  std::unique_ptr<std::FILE, CloseFile> told_;
  qhT state_;
  int status_ = 0;
  std::exception_ptr thrown_;
};

// The facet's corners as point numbers, counter-clockwise seen from outside.
std::vector<int> ordered_corners(qhT* qh, facetT* facet,
                                 const std::vector<Eigen::Vector3d>& points) {
  std::vector<int> corners;
  setT* vertices = qh_facet3vertex(qh, facet);
  vertexT* vertex = nullptr;
  vertexT** vertexp = nullptr;
  FOREACHvertex_(vertices) { corners.push_back(qh_pointid(qh, vertex->point)); }
  qh_settempfree(qh, &vertices);
  const Eigen::Vector3d outward(facet->normal[0], facet->normal[1], facet->normal[2]);
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  const auto point = [&](std::size_t i) { return points[static_cast<std::size_t>(corners[i])]; };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice_area += (point(i) - point(0)).cross(point(i + 1) - point(0));
  }
  if (twice_area.dot(outward) < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

double volume_of(const TriangleMesh& mesh) { return inspect_surface(mesh).volume; }

/// Is a closed surface one piece without handles, that is, of Euler characteristic 2?
bool is_like_a_ball(const TriangleMesh& mesh, const SurfaceReport& surface) {
  if (!surface.manifold || !surface.consistently_oriented || surface.components != 1) return false;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(triangle[k])] = 1;
  }
  const std::size_t vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  return 2 * vertices == mesh.triangles.size() + 4;
}

}  // namespace

ConvexPolyhedron convex_hull(const std::vector<Eigen::Vector3d>& points) {
  if (points.size() < 4) throw_flat("found " + std::to_string(points.size()) + " points");
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) throw InvalidInput("E_NUMBER", "points", "a point is not finite");
    middle += point / static_cast<double>(points.size());
  }
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * 3);
  for (const Eigen::Vector3d& point : points) {
    for (int k = 0; k < 3; ++k) coordinates.push_back(point[k] - middle[k]);
  }
  Hull hull(coordinates);
  if (hull.status() != 0)
    throw_flat("found " + std::to_string(points.size()) + " points in one plane or line");
  ConvexPolyhedron result;
  std::vector<int> new_index(points.size(), -1);
  qhT* qh = hull.state();
  facetT* facet = nullptr;
  FORALLfacets {
    throw_if_stopped();
    std::vector<int> face = ordered_corners(qh, facet, points);
    for (int& corner : face) {
      int& index = new_index[static_cast<std::size_t>(corner)];
      if (index < 0) {
        index = static_cast<int>(result.vertices.size());
        result.vertices.push_back(points[static_cast<std::size_t>(corner)]);
      }
      corner = index;
    }
    if (face.size() >= 3) result.faces.push_back(std::move(face));
  }
  return result;
}

TriangleMesh triangulate(const ConvexPolyhedron& polyhedron) {
  TriangleMesh mesh;
  mesh.vertices = polyhedron.vertices;
  for (const std::vector<int>& face : polyhedron.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      mesh.triangles.emplace_back(face[0], face[i], face[i + 1]);
  }
  require_valid(mesh, "polyhedron");
  return mesh;
}

bool is_convex(const TriangleMesh& mesh, double tolerance) {
  if (!(tolerance >= 0.0) || !std::isfinite(tolerance)) {
    throw InvalidInput("E_RANGE", "tolerance",
                       "found " + std::to_string(tolerance) + ", expected >= 0 [m]");
  }
  const SurfaceReport surface = inspect_surface(mesh);
  if (!surface.closed || surface.volume <= 0.0) return false;
  const auto corner = [&mesh](const Eigen::Vector3i& triangle, int k) {
    return mesh.vertices[static_cast<std::size_t>(triangle[k])];
  };
  double surface_area = 0.0;
  bool has_needles = false;
  const PointTree corners(mesh.vertices);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    throw_if_stopped();
    const Eigen::Vector3d a = corner(triangle, 0);
    const Eigen::Vector3d ab = corner(triangle, 1) - a;
    const Eigen::Vector3d ac = corner(triangle, 2) - a;
    const Eigen::Vector3d normal = ab.cross(ac);
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    surface_area += 0.5 * normal.norm();
    // A needle has no reliable plane; the comparison of volumes below covers it.
    if (normal.norm() <= 1e-6 * longest * longest || normal.norm() <= tolerance * longest) {
      has_needles = true;
      continue;
    }
    const Eigen::Vector3d unit = normal.normalized();
    if (corners.is_any_beyond(unit, unit.dot(a) + tolerance)) return false;
  }
  // Under all its planes, such a surface goes round its hull once.
  if (!has_needles && is_like_a_ball(mesh, surface)) return true;
  // Refuses bodies that count twice (two copies of one box).
  try {
    const double hull_volume = volume_of(triangulate(convex_hull(mesh.vertices)));
    return std::abs(hull_volume - surface.volume) <=
           2.0 * tolerance * surface_area + 1e-9 * hull_volume;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace handey
