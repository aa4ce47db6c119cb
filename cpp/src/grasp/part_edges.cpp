// The convex edges and corners of a whole part. Triangles that lie in one plane are one face, and
// the pieces of a line in which the same two faces meet are one edge; edges between faces at less
// than the sharp angle are left out unless one of the faces is too small to be held itself: then
// the edge stands for the round that the facets approximate. Cylinders are taken inscribed, so that
// their edges lie on them. What other shapes of the part cover is not asked here: obstruction is.
#include "part_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include "handey/stop.hpp"

namespace handey::grasp {
namespace {

constexpr double kSameLine = 1e-5;  // pieces of an edge this near one line are one [m]
constexpr int kSegments = 32;       // of a cylinder, as its faces have

using Faces = std::pair<int, int>;

// One side of one triangle, keyed by its end points in ascending order.
struct Side {
  int low, high;
  bool forward;  // from low to high
  int triangle;
  std::pair<int, int> ends() const { return {low, high}; }
};

struct Piece {
  Eigen::Vector3d from, to;
  double length() const { return (to - from).norm(); }
};

class EdgeFinder {
 public:
  EdgeFinder(const TriangleMesh& mesh, const FeatureOptions& options, EdgesAndVertices& result)
      : mesh_(mesh), options_(options), result_(result), faces_(planar_faces(mesh)) {
    face_of_.assign(mesh.triangles.size(), -1);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (const int triangle : faces_[f].triangles) {
        face_of_[static_cast<std::size_t>(triangle)] = static_cast<int>(f);
      }
    }
  }

  void find() {
    rays_.resize(mesh_.vertices.size());
    const std::vector<Side> sides = sorted_sides();
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
      throw_if_stopped();
      while (next < sides.size() && sides[next].ends() == sides[i].ends()) ++next;
      // One that runs from low to high comes after one that runs back.
      if (next - i == 2 && sides[i + 1].forward && !sides[i].forward) {
        add_piece(sides[i + 1], sides[i]);
      }
    }
    for (auto& [faces, pieces] : pieces_) {
      throw_if_stopped();
      join(faces, std::move(pieces));
    }
    add_vertices();
  }

 private:
  const PlanarFace& face(int index) const { return faces_[static_cast<std::size_t>(index)]; }
  const Eigen::Vector3d& vertex(int index) const {
    return mesh_.vertices[static_cast<std::size_t>(index)];
  }
  bool is_large(int index) const { return face(index).area >= options_.least_face_area; }

  std::vector<Side> sorted_sides() const {
    std::vector<Side> sides;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int from = mesh_.triangles[t][k], to = mesh_.triangles[t][(k + 1) % 3];
        if (from == to) continue;
        sides.push_back({std::min(from, to), std::max(from, to), from < to, static_cast<int>(t)});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.forward, a.triangle) <
             std::tie(b.low, b.high, b.forward, b.triangle);
    });
    return sides;
  }

  // `left` runs from low to high, `right` back.
  void add_piece(const Side& left, const Side& right) {
    const Eigen::Vector3d from = vertex(left.low), to = vertex(left.high);
    const Eigen::Vector3d along = (to - from).normalized();
    rays_[static_cast<std::size_t>(left.low)].push_back(along);
    rays_[static_cast<std::size_t>(left.high)].push_back(-along);
    const int a = face_of_[static_cast<std::size_t>(left.triangle)];
    const int b = face_of_[static_cast<std::size_t>(right.triangle)];
    if (a < 0 || b < 0 || a == b) return;
    const double sine = face(a).normal.cross(face(b).normal).dot(along);
    if (sine <= 0.0) return;  // concave
    const double turn = std::atan2(sine, face(a).normal.dot(face(b).normal));
    if (turn < options_.sharp_edge && is_large(a) && is_large(b)) return;
    // One key, whichever way the edge runs: the normals keep their order with it.
    if (a < b) {
      pieces_[{a, b}].push_back({from, to});
    } else {
      pieces_[{b, a}].push_back({to, from});
    }
  }

  // Pieces of one line that touch are one edge.
  void join(const Faces& faces, std::vector<Piece> pieces) {
    const Piece longest = *std::max_element(
        pieces.begin(), pieces.end(),
        [](const Piece& a, const Piece& b) { return a.length() < b.length() - 1e-12; });
    const Eigen::Vector3d along = (longest.to - longest.from).normalized();
    const auto place = [&](const Eigen::Vector3d& p) { return along.dot(p - longest.from); };
    std::stable_sort(pieces.begin(), pieces.end(),
                     [&](const Piece& a, const Piece& b) { return place(a.from) < place(b.from); });
    Piece edge = pieces.front();
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      if ((pieces[i].from - edge.to).norm() < kSameLine) {
        edge.to = pieces[i].to;
      } else {
        add_edge(faces, edge);
        edge = pieces[i];
      }
    }
    add_edge(faces, edge);
  }

  void add_edge(const Faces& faces, const Piece& piece) {
    if (piece.length() < options_.least_edge) return;
    result_.edges.push_back({piece.from, piece.to, face(faces.first).normal,
                             face(faces.second).normal, is_large(faces.first),
                             is_large(faces.second)});
  }

  // Corners that have all their edges behind them, seen against their sum or along the mean normal.
  void add_vertices() {
    std::vector<Eigen::Vector3d> normals(mesh_.vertices.size(), Eigen::Vector3d::Zero());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (face_of_[t] < 0) continue;
      for (int k = 0; k < 3; ++k) {
        normals[static_cast<std::size_t>(mesh_.triangles[t][k])] += face(face_of_[t]).normal;
      }
    }
    for (std::size_t v = 0; v < rays_.size(); ++v) {
      throw_if_stopped();
      if (rays_[v].size() < 3) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3d& ray : rays_[v]) sum += ray;
      if (all_behind(rays_[v], -sum) || all_behind(rays_[v], normals[v])) {
        result_.vertices.push_back({mesh_.vertices[v], rays_[v]});
      }
    }
  }

  static bool all_behind(const std::vector<Eigen::Vector3d>& rays, const Eigen::Vector3d& view) {
    return std::all_of(rays.begin(), rays.end(),
                       [&](const Eigen::Vector3d& ray) { return ray.dot(view) < -1e-9; });
  }

  const TriangleMesh& mesh_;
  const FeatureOptions& options_;
  EdgesAndVertices& result_;
  std::vector<PlanarFace> faces_;
  std::vector<int> face_of_;  // by triangle
  std::map<Faces, std::vector<Piece>> pieces_;
  std::vector<std::vector<Eigen::Vector3d>> rays_;  // by vertex
};

}  // namespace

EdgesAndVertices part_edges(const Body& part, const FeatureOptions& options) {
  EdgesAndVertices result;
  for (const Shape& shape : part.shapes) {
    if (std::holds_alternative<Sphere>(shape.geometry)) continue;
    EdgeFinder(tessellate(shape, kSegments, false), options, result).find();
  }
  std::stable_sort(result.edges.begin(), result.edges.end(),
                   [](const PartEdge& a, const PartEdge& b) {
                     return (a.to - a.from).norm() > (b.to - b.from).norm() + 1e-9;
                   });
  return result;
}

}  // namespace handey::grasp
