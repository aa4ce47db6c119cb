// Welding looks into the cells of a grid, so points at either side of a cell border still meet.
#include "mesh_cleaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "handey/stop.hpp"
#include "mesh_edges.hpp"

namespace handey {
namespace {

using GridCell = std::array<std::int64_t, 3>;

struct GridCellHash {
  std::size_t operator()(const GridCell& cell) const {
    std::uint64_t hash = 1469598103934665603ull;
    for (const std::int64_t index : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15ull;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

// Remembers points; gives the number of one within the tolerance, else a new number.
class PointIndex {
 public:
  explicit PointIndex(double tolerance) : tolerance_(tolerance), cell_size_(8.0 * tolerance) {}

  int find_or_add(const Eigen::Vector3d& point) {
    const GridCell low = cell(point - Eigen::Vector3d::Constant(tolerance_));
    const GridCell high = cell(point + Eigen::Vector3d::Constant(tolerance_));
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const int found = find_in({x, y, z}, point);
          if (found >= 0) return found;
        }
      }
    }
    const int added = static_cast<int>(points_.size());
    points_.push_back(point);
    cells_[cell(point)].push_back(added);
    return added;
  }

  std::vector<Eigen::Vector3d> take_points() { return std::move(points_); }

 private:
  GridCell cell(const Eigen::Vector3d& point) const {
    return {static_cast<std::int64_t>(std::floor(point.x() / cell_size_)),
            static_cast<std::int64_t>(std::floor(point.y() / cell_size_)),
            static_cast<std::int64_t>(std::floor(point.z() / cell_size_))};
  }

  int find_in(const GridCell& where, const Eigen::Vector3d& point) const {
    const auto found = cells_.find(where);
    if (found == cells_.end()) return -1;
    for (const int index : found->second) {
      if ((points_[static_cast<std::size_t>(index)] - point).norm() <= tolerance_) return index;
    }
    return -1;
  }

  double tolerance_;
  double cell_size_;
  std::vector<Eigen::Vector3d> points_;
  std::unordered_map<GridCell, std::vector<int>, GridCellHash> cells_;
};

bool is_flat(const TriangleMesh& mesh, const Eigen::Vector3i& triangle) {
  const Eigen::Vector3d& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
  const Eigen::Vector3d ab = mesh.vertices[static_cast<std::size_t>(triangle[1])] - a;
  const Eigen::Vector3d ac = mesh.vertices[static_cast<std::size_t>(triangle[2])] - a;
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  return ab.cross(ac).norm() <= 1e-10 * longest2;
}

int count_open_edges(const TriangleMesh& mesh) {
  int open = 0;
  for_each_edge(sorted_half_edges(mesh), [&open](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 != 0) ++open;
  });
  return open;
}

double volume_below(const TriangleMesh& mesh, int t, bool turned) {
  const Eigen::Vector3i& triangle = mesh.triangles[static_cast<std::size_t>(t)];
  const Eigen::Vector3d origin = mesh.vertices.front();
  const Eigen::Vector3d a = mesh.vertices[static_cast<std::size_t>(triangle[0])] - origin;
  const Eigen::Vector3d b = mesh.vertices[static_cast<std::size_t>(triangle[1])] - origin;
  const Eigen::Vector3d c = mesh.vertices[static_cast<std::size_t>(triangle[2])] - origin;
  const double volume = a.dot(b.cross(c)) / 6.0;
  return turned ? -volume : volume;
}

struct Neighbour {
  int triangle;
  bool agrees;  // runs along the common edge the other way
};

// Empty if an edge has more than two triangles.
std::vector<std::vector<Neighbour>> two_sided_neighbours(const TriangleMesh& mesh) {
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh);
  bool overfull = false;
  for_each_edge(half_edges, [&](std::size_t begin, std::size_t end) {
    overfull = overfull || end - begin > 2;
    if (end - begin != 2) return;
    const HalfEdge& a = half_edges[begin];
    const HalfEdge& b = half_edges[begin + 1];
    neighbours[static_cast<std::size_t>(a.triangle)].push_back(
        {b.triangle, a.forward != b.forward});
    neighbours[static_cast<std::size_t>(b.triangle)].push_back(
        {a.triangle, a.forward != b.forward});
  });
  if (overfull) neighbours.clear();
  return neighbours;
}

}  // namespace

TriangleMesh weld(const TriangleMesh& mesh, double tolerance) {
  PointIndex index(tolerance);
  TriangleMesh welded;
  std::vector<int> new_index(mesh.vertices.size(), -1);
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    throw_if_stopped();
    Eigen::Vector3i joined;
    for (int k = 0; k < 3; ++k) {
      int& number = new_index[static_cast<std::size_t>(triangle[k])];
      if (number < 0)
        number = index.find_or_add(mesh.vertices[static_cast<std::size_t>(triangle[k])]);
      joined[k] = number;
    }
    if (joined[0] != joined[1] && joined[1] != joined[2] && joined[2] != joined[0]) {
      welded.triangles.push_back(joined);
    }
  }
  welded.vertices = index.take_points();
  return welded;
}

TriangleMesh drop_flat_triangles(const TriangleMesh& mesh) {
  TriangleMesh kept;
  kept.vertices = mesh.vertices;
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (!is_flat(mesh, triangle)) kept.triangles.push_back(triangle);
  }
  if (kept.triangles.size() == mesh.triangles.size()) return mesh;
  // A flat triangle may join one long edge with two short ones; without it the surface would gape.
  if (!kept.triangles.empty() && count_open_edges(kept) > count_open_edges(mesh)) return mesh;
  return kept;
}

bool orient_consistently(TriangleMesh& mesh) {
  const std::vector<std::vector<Neighbour>> neighbours = two_sided_neighbours(mesh);
  if (neighbours.empty()) return false;
  std::vector<int> state(mesh.triangles.size(), -1);  // 0 as it is, 1 to be turned
  for (std::size_t seed = 0; seed < state.size(); ++seed) {
    if (state[seed] >= 0) continue;
    std::vector<int> piece{static_cast<int>(seed)};
    state[seed] = 0;
    double volume = 0.0;
    bool mixed = false;
    for (std::size_t at = 0; at < piece.size(); ++at) {
      throw_if_stopped();
      const int t = piece[at];
      const int own = state[static_cast<std::size_t>(t)];
      mixed = mixed || own == 1;
      volume += volume_below(mesh, t, own == 1);
      for (const Neighbour& next : neighbours[static_cast<std::size_t>(t)]) {
        int& other = state[static_cast<std::size_t>(next.triangle)];
        const int wanted = next.agrees ? own : 1 - own;
        if (other >= 0 && other != wanted) return false;
        if (other < 0) piece.push_back(next.triangle);
        other = wanted;
      }
    }
    // A piece that was consistent keeps its side, for it may be a cavity.
    if (!mixed || volume >= 0.0) continue;
    for (const int t : piece)
      state[static_cast<std::size_t>(t)] = 1 - state[static_cast<std::size_t>(t)];
  }
  for (std::size_t t = 0; t < state.size(); ++t) {
    if (state[t] == 1) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return true;
}

}  // namespace handey
