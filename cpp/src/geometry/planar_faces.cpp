// Planar faces of a solid. Triangles are gathered from the largest outward across common edges
// while they fit the plane of the whole cluster (area-weighted); then clusters on one plane with
// one normal are one face, since an engraving may cut islands out of it. The region is what remains
// when the triangles' common edges cancel. Needle-thin triangles have no reliable normal: theirs
// may deviate by as much as rounding explains.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "handey/errors.hpp"
#include "handey/geometry/polyhedron.hpp"
#include "handey/stop.hpp"
#include "mesh_edges.hpp"

namespace handey {
namespace {

// Single-precision files round coordinates by 6e-8 of their size; twice that at both ends of an
// edge.
constexpr double kRelativeNoise = 2.5e-7;
// Seams between triangles that meet along an edge but share no vertices are closed up to this width
// [m].
constexpr double kSeam = 1e-6;

struct Facet {
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();  // normal times twice the area
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double area = 0.0;
  double angle = 0.0;  // most the normal may leave the plane's [rad]
};

struct Cluster {
  Eigen::Vector3d normal_sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre_sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  std::vector<int> triangles;

  Eigen::Vector3d normal() const { return normal_sum.normalized(); }
  Eigen::Vector3d centre() const { return centre_sum / area; }
  void add(int index, const Facet& facet) {
    normal_sum += facet.twice_area;
    centre_sum += facet.area * facet.centre;
    area += facet.area;
    triangles.push_back(index);
  }
};

class FaceFinder {
 public:
  FaceFinder(const TriangleMesh& mesh, const PlanarFaceOptions& options)
      : mesh_(mesh), options_(options) {
    measure_facets();
    link_neighbours();
  }

  std::vector<PlanarFace> find() {
    std::vector<int> order(mesh_.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [this](int a, int b) { return facet(a).area > facet(b).area; });
    std::vector<Cluster> clusters;
    for (const int seed : order) {
      throw_if_stopped();
      if (facet(seed).area > 0.0 && !taken_[static_cast<std::size_t>(seed)]) {
        clusters.push_back(grow(seed));
      }
    }
    std::vector<PlanarFace> faces;
    for (const Cluster& cluster : merge_coplanar(std::move(clusters))) {
      throw_if_stopped();
      PlanarFace face = make_face(cluster);
      if (face.area > 0.0 && face.area >= options_.least_area) faces.push_back(std::move(face));
    }
    // Areas that differ by rounding only are equal, so that the order is repeatable.
    std::stable_sort(faces.begin(), faces.end(), [](const PlanarFace& a, const PlanarFace& b) {
      const long long area_a = std::llround(a.area * 1e12);
      const long long area_b = std::llround(b.area * 1e12);
      return area_a != area_b ? area_a > area_b : a.triangles.front() < b.triangles.front();
    });
    return faces;
  }

 private:
  const Facet& facet(int t) const { return facets_[static_cast<std::size_t>(t)]; }
  const Eigen::Vector3d& corner(int t, int k) const {
    return mesh_
        .vertices[static_cast<std::size_t>(mesh_.triangles[static_cast<std::size_t>(t)][k])];
  }

  void measure_facets() {
    double size = 0.0;
    for (const Eigen::Vector3d& vertex : mesh_.vertices)
      size = std::max(size, vertex.cwiseAbs().maxCoeff());
    const double noise = kRelativeNoise * size;
    facets_.resize(mesh_.triangles.size());
    taken_.assign(mesh_.triangles.size(), false);
    for (int t = 0; t < static_cast<int>(facets_.size()); ++t) {
      Facet& facet = facets_[static_cast<std::size_t>(t)];
      const Eigen::Vector3d ab = corner(t, 1) - corner(t, 0);
      const Eigen::Vector3d ac = corner(t, 2) - corner(t, 0);
      facet.twice_area = ab.cross(ac);
      facet.area = 0.5 * facet.twice_area.norm();
      facet.centre = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
      const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
      const double altitude = longest > 0.0 ? 2.0 * facet.area / longest : 0.0;
      facet.angle = altitude > noise ? options_.angle + noise / altitude : 4.0;
    }
  }

  void link_neighbours() {
    neighbours_.resize(mesh_.triangles.size());
    const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh_);
    for_each_edge(half_edges, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t j = begin; j < end; ++j) {
          if (i == j || half_edges[i].forward == half_edges[j].forward) continue;
          neighbours_[static_cast<std::size_t>(half_edges[i].triangle)].push_back(
              half_edges[j].triangle);
        }
      }
    });
  }

  bool fits(int t, const Eigen::Vector3d& normal, const Eigen::Vector3d& centre) const {
    for (int k = 0; k < 3; ++k) {
      if (std::abs(normal.dot(corner(t, k) - centre)) > options_.distance) return false;
    }
    if (facet(t).angle > 3.0) return true;
    const Eigen::Vector3d& own = facet(t).twice_area;
    return std::atan2(normal.cross(own).norm(), normal.dot(own)) <= facet(t).angle;
  }

  Cluster grow(int seed) {
    Cluster cluster;
    cluster.add(seed, facet(seed));
    taken_[static_cast<std::size_t>(seed)] = true;
    for (std::size_t at = 0; at < cluster.triangles.size(); ++at) {
      throw_if_stopped();
      const Eigen::Vector3d normal = cluster.normal();
      const Eigen::Vector3d centre = cluster.centre();
      for (const int next : neighbours_[static_cast<std::size_t>(cluster.triangles[at])]) {
        if (taken_[static_cast<std::size_t>(next)] || !fits(next, normal, centre)) continue;
        taken_[static_cast<std::size_t>(next)] = true;
        cluster.add(next, facet(next));
      }
    }
    return release_misfits(std::move(cluster));
  }

  // The plane moves a little while a cluster grows; whoever no longer fits is given back and seeds
  // its own.
  Cluster release_misfits(Cluster cluster) {
    const Eigen::Vector3d normal = cluster.normal();
    const Eigen::Vector3d centre = cluster.centre();
    Cluster kept;
    for (std::size_t i = 0; i < cluster.triangles.size(); ++i) {
      const int t = cluster.triangles[i];
      if (i == 0 || fits(t, normal, centre)) {
        kept.add(t, facet(t));
      } else {
        taken_[static_cast<std::size_t>(t)] = false;
      }
    }
    return kept;
  }

  // Joins each cluster to the largest one on whose plane it lies. Only the largest one's plane
  // counts, so a chain of almost coplanar clusters cannot creep around a curve.
  std::vector<Cluster> merge_coplanar(std::vector<Cluster> clusters) const {
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const Cluster& a, const Cluster& b) { return a.area > b.area; });
    std::vector<Eigen::Vector3d> normals;
    for (const Cluster& cluster : clusters) normals.push_back(cluster.normal());
    std::vector<std::size_t> by_x(clusters.size());
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    std::sort(by_x.begin(), by_x.end(), [&normals](std::size_t a, std::size_t b) {
      return normals[a].x() < normals[b].x() || (normals[a].x() == normals[b].x() && a < b);
    });
    std::vector<bool> merged(clusters.size(), false);
    std::vector<Cluster> result;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      if (merged[i]) continue;
      throw_if_stopped();
      const Eigen::Vector3d centre = clusters[i].centre();
      Cluster sum = clusters[i];
      auto at =
          std::lower_bound(by_x.begin(), by_x.end(), normals[i].x() - options_.angle,
                           [&normals](std::size_t a, double x) { return normals[a].x() < x; });
      for (; at != by_x.end() && normals[*at].x() <= normals[i].x() + options_.angle; ++at) {
        if (*at <= i || merged[*at] || (normals[*at] - normals[i]).norm() > options_.angle)
          continue;
        const std::vector<int>& members = clusters[*at].triangles;
        if (!std::all_of(members.begin(), members.end(),
                         [&](int t) { return fits(t, normals[i], centre); })) {
          continue;
        }
        merged[*at] = true;
        for (const int t : members) sum.add(t, facet(t));
      }
      result.push_back(std::move(sum));
    }
    return result;
  }

  PlanarFace make_face(const Cluster& cluster) const {
    PlanarFace face;
    face.normal = cluster.normal();
    face.origin = cluster.centre();
    face.triangles = cluster.triangles;
    std::sort(face.triangles.begin(), face.triangles.end());
    // The world axis most nearly in the plane gives u, so that faces of boxes have axes along the
    // edges.
    int axis = 0;
    face.normal.cwiseAbs().minCoeff(&axis);
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    face.u = (along - along.dot(face.normal) * face.normal).normalized();
    face.v = face.normal.cross(face.u);
    std::vector<std::array<int, 2>> edges;
    for (const int t : face.triangles) {
      const Eigen::Vector3i& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      for (int k = 0; k < 3; ++k) edges.push_back({triangle[k], triangle[(k + 1) % 3]});
    }
    std::vector<Polygon> loops;
    for (const std::vector<int>& loop : boundary_loops(edges)) {
      Polygon polygon;
      for (const int vertex : loop) {
        const Eigen::Vector3d from_origin =
            mesh_.vertices[static_cast<std::size_t>(vertex)] - face.origin;
        polygon.emplace_back(face.u.dot(from_origin), face.v.dot(from_origin));
      }
      loops.push_back(std::move(polygon));
    }
    face.region = region_of_loops(loops);
    if (may_have_seams(face.region)) face.region = close_seams(face.region);
    face.area = handey::area(face.region);
    return face;
  }

  // Where triangles meet along an edge but share no vertices, rounding leaves seams of no width:
  // between loops or as a notch in one. One convex loop has none.
  static bool may_have_seams(const Region& region) {
    if (region.loops.size() != 1) return true;
    const Polygon& loop = region.loops.front();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d in = loop[(i + 1) % loop.size()] - loop[i];
      const Eigen::Vector2d out = loop[(i + 2) % loop.size()] - loop[(i + 1) % loop.size()];
      if (in.x() * out.y() - in.y() * out.x() < 0.0) return true;
    }
    return false;
  }

  static Region close_seams(const Region& region) { return offset(offset(region, kSeam), -kSeam); }

  const TriangleMesh& mesh_;
  const PlanarFaceOptions& options_;
  std::vector<Facet> facets_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<bool> taken_;
};

}  // namespace

std::vector<PlanarFace> planar_faces(const TriangleMesh& mesh, const PlanarFaceOptions& options) {
  require_valid(mesh, "mesh");
  for (const double value : {options.angle, options.distance, options.least_area}) {
    if (!(value >= 0.0) || !std::isfinite(value)) {
      throw InvalidInput("E_RANGE", "PlanarFaceOptions",
                         "found " + std::to_string(value) + ", expected finite numbers >= 0");
    }
  }
  return FaceFinder(mesh, options).find();
}

}  // namespace handey
