// Edges are found by sorting, which is repeatable and needs no hash.
#include "mesh_edges.hpp"

#include <algorithm>
#include <tuple>

#include "handey/stop.hpp"

namespace handey {
namespace {

using Edge = std::array<int, 2>;

// What is left of each undirected edge when its two directions cancel, sorted by start.
std::vector<Edge> cancel_opposite(const std::vector<Edge>& edges) {
  std::vector<std::tuple<int, int, int>> keyed;  // low, high, +1 or -1
  keyed.reserve(edges.size());
  for (const Edge& edge : edges) {
    if (edge[0] == edge[1]) continue;
    const bool forward = edge[0] < edge[1];
    keyed.emplace_back(std::min(edge[0], edge[1]), std::max(edge[0], edge[1]), forward ? 1 : -1);
  }
  throw_if_stopped();
  std::sort(keyed.begin(), keyed.end());
  throw_if_stopped();
  std::vector<Edge> left;
  for (std::size_t i = 0; i < keyed.size();) {
    const auto [low, high, first] = keyed[i];
    int net = first;
    std::size_t j = i + 1;
    for (; j < keyed.size() && std::get<0>(keyed[j]) == low && std::get<1>(keyed[j]) == high; ++j) {
      net += std::get<2>(keyed[j]);
    }
    for (; net > 0; --net) left.push_back({low, high});
    for (; net < 0; ++net) left.push_back({high, low});
    i = j;
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const int a = mesh.triangles[t][side];
      const int b = mesh.triangles[t][(side + 1) % 3];
      if (a == b) continue;
      half_edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  }
  throw_if_stopped();
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.forward) <
           std::tie(b.low, b.high, b.triangle, b.forward);
  });
  return half_edges;
}

std::vector<std::vector<int>> boundary_loops(const std::vector<std::array<int, 2>>& edges) {
  const std::vector<Edge> left = cancel_opposite(edges);
  std::vector<bool> used(left.size(), false);
  const auto unused_from = [&](int vertex) {
    auto found = std::lower_bound(left.begin(), left.end(), vertex,
                                  [](const Edge& edge, int value) { return edge[0] < value; });
    std::size_t index = static_cast<std::size_t>(found - left.begin());
    while (index < left.size() && left[index][0] == vertex && used[index]) ++index;
    return index < left.size() && left[index][0] == vertex ? index : left.size();
  };
  std::vector<std::vector<int>> loops;
  for (std::size_t start = 0; start < left.size(); ++start) {
    if (used[start]) continue;
    throw_if_stopped();
    std::vector<int> loop;
    std::size_t at = start;
    // As many edges leave each vertex as enter it, so the walk can only end where it began.
    while (at < left.size()) {
      used[at] = true;
      loop.push_back(left[at][0]);
      if (left[at][1] == left[start][0]) break;
      at = unused_from(left[at][1]);
    }
    if (at < left.size()) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace handey
