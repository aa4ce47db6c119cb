// What a triangle surface is, by counting the triangles at each edge; volume and centroid by the
// divergence theorem about the middle of the bounding box; inside or outside by the generalised
// winding number (the sum of the solid angles of all triangles), which stays right for overlapping
// pieces and degrades slowly for holes.
#include "handey/geometry/polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "mesh_edges.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Which triangles hang together by edges.
class Connection {
 public:
  explicit Connection(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int item) {
    while (parent(item) != item) {
      parent(item) = parent(parent(item));
      item = parent(item);
    }
    return item;
  }
  void join(int a, int b) {
    const int low = std::min(root(a), root(b));
    const int high = std::max(root(a), root(b));
    parent(high) = low;  // the lowest triangle stays root, so the order is repeatable
  }

 private:
  int& parent(int item) { return parent_[static_cast<std::size_t>(item)]; }
  std::vector<int> parent_;
};

Connection connect(const TriangleMesh& mesh, const std::vector<HalfEdge>& half_edges) {
  throw_if_stopped();
  Connection connection(mesh.triangles.size());
  for_each_edge(half_edges, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin + 1; i < end; ++i) {
      connection.join(half_edges[begin].triangle, half_edges[i].triangle);
    }
  });
  return connection;
}

const Eigen::Vector3d& corner(const TriangleMesh& mesh, const Eigen::Vector3i& triangle,
                              int which) {
  return mesh.vertices[static_cast<std::size_t>(triangle[which])];
}

void measure_extent(const TriangleMesh& mesh, SurfaceReport& report) {
  report.lower = report.upper = corner(mesh, mesh.triangles.front(), 0);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      report.lower = report.lower.cwiseMin(corner(mesh, triangle, k));
      report.upper = report.upper.cwiseMax(corner(mesh, triangle, k));
    }
  }
}

void measure_volume(const TriangleMesh& mesh, SurfaceReport& report) {
  const Eigen::Vector3d middle = 0.5 * (report.lower + report.upper);
  Eigen::Vector3d volume_moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d area_moment = Eigen::Vector3d::Zero();
  double surface = 0.0;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    const Eigen::Vector3d a = corner(mesh, triangle, 0) - middle;
    const Eigen::Vector3d b = corner(mesh, triangle, 1) - middle;
    const Eigen::Vector3d c = corner(mesh, triangle, 2) - middle;
    const double tetrahedron = a.dot(b.cross(c)) / 6.0;
    const double triangle_area = 0.5 * (b - a).cross(c - a).norm();
    report.volume += tetrahedron;
    volume_moment += tetrahedron * 0.25 * (a + b + c);
    surface += triangle_area;
    area_moment += triangle_area * (a + b + c) / 3.0;
  }
  const double box = (report.upper - report.lower).prod();
  report.centroid = middle;
  if (report.closed && std::abs(report.volume) > 1e-9 * box) {
    report.centroid += volume_moment / report.volume;
  } else if (surface > 0.0) {
    report.centroid += area_moment / surface;
  }
}

// Solid angle under which a triangle is seen (Van Oosterom and Strackee 1983), positive from
// behind.
double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double numerator = a.dot(b.cross(c));
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  if (numerator == 0.0) return 0.0;  // in the triangle's plane: no well-defined side
  return 2.0 * std::atan2(numerator, denominator);
}

}  // namespace

void require_valid(const TriangleMesh& mesh, const std::string& place) {
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      throw InvalidInput("E_NUMBER", place, "vertex " + std::to_string(i) + " is not finite");
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    if (triangle.minCoeff() >= 0 && triangle.maxCoeff() < count) continue;
    const int wrong = triangle.minCoeff() < 0 ? triangle.minCoeff() : triangle.maxCoeff();
    throw InvalidInput("E_INDEX", place,
                       "triangle " + std::to_string(t) + " names vertex " + std::to_string(wrong) +
                           ", expected 0 to " + std::to_string(count - 1));
  }
}

SurfaceReport inspect_surface(const TriangleMesh& mesh) {
  require_valid(mesh, "mesh");
  SurfaceReport report;
  if (mesh.triangles.empty()) return report;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  report.consistently_oriented = true;
  for_each_edge(half_edges, [&](std::size_t begin, std::size_t end) {
    const int count = static_cast<int>(end - begin);
    int balance = 0;
    for (std::size_t i = begin; i < end; ++i) balance += half_edges[i].forward ? 1 : -1;
    if (count % 2 != 0) ++report.open_edges;
    if (count > 2) ++report.overfull_edges;
    if (std::abs(balance) != count % 2) report.consistently_oriented = false;
  });
  report.closed = report.open_edges == 0;
  report.manifold = report.overfull_edges == 0;
  Connection connection = connect(mesh, half_edges);
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    if (connection.root(t) == t) ++report.components;
  }
  throw_if_stopped();
  measure_extent(mesh, report);
  measure_volume(mesh, report);
  return report;
}

bool contains_point(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  if (!point.allFinite())
    throw InvalidInput("E_NUMBER", "point", "not finite, expected finite coordinates");
  if (mesh.vertices.empty()) return false;
  Eigen::Vector3d lower = mesh.vertices.front();
  Eigen::Vector3d upper = lower;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
  }
  if ((point.array() < lower.array()).any() || (point.array() > upper.array()).any()) return false;
  require_valid(mesh, "mesh");
  double angle = 0.0;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    angle += solid_angle(corner(mesh, triangle, 0) - point, corner(mesh, triangle, 1) - point,
                         corner(mesh, triangle, 2) - point);
  }
  return angle > 2.0 * kPi;  // winding number above one half
}

std::vector<TriangleMesh> connected_components(const TriangleMesh& mesh) {
  require_valid(mesh, "mesh");
  Connection connection = connect(mesh, sorted_half_edges(mesh));
  std::vector<int> piece_of_root(mesh.triangles.size(), -1);
  std::vector<std::vector<std::size_t>> triangles;  // by piece
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int& piece = piece_of_root[static_cast<std::size_t>(connection.root(static_cast<int>(t)))];
    if (piece < 0) {
      piece = static_cast<int>(triangles.size());
      triangles.emplace_back();
    }
    triangles[static_cast<std::size_t>(piece)].push_back(t);
  }
  std::vector<TriangleMesh> pieces(triangles.size());
  // A vertex may be in several pieces: by vertex, the last one that it was met in, and its number
  // there.
  std::vector<std::pair<std::size_t, int>> last(mesh.vertices.size(), {pieces.size(), 0});
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    throw_if_stopped();
    for (const std::size_t t : triangles[piece]) {
      Eigen::Vector3i triangle;
      for (int k = 0; k < 3; ++k) {
        const std::size_t old = static_cast<std::size_t>(mesh.triangles[t][k]);
        if (last[old].first != piece) {
          last[old] = {piece, static_cast<int>(pieces[piece].vertices.size())};
          pieces[piece].vertices.push_back(mesh.vertices[old]);
        }
        triangle[k] = last[old].second;
      }
      pieces[piece].triangles.push_back(triangle);
    }
  }
  return pieces;
}

}  // namespace handey
