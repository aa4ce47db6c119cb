// The edges of triangle meshes: which triangles meet at each, and the closed loops that remain when
// edges run both ways cancel. Private to the library.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "handey/geometry/polyhedron.hpp"

namespace handey {

/// One side of one triangle, keyed by its end points in ascending order.
struct HalfEdge {
  int low = 0;
  int high = 0;
  int triangle = 0;
  bool forward = true;  ///< the triangle runs from low to high
};

/// All sides of all triangles, sorted by (low, high, triangle); sides of zero length (equal
/// indices) left out.
std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh);

/// Calls visit(begin, end) for each run of half edges that share one edge.
template <typename Visit>
void for_each_edge(const std::vector<HalfEdge>& half_edges, const Visit& visit) {
  std::size_t begin = 0;
  while (begin < half_edges.size()) {
    std::size_t end = begin + 1;
    while (end < half_edges.size() && half_edges[end].low == half_edges[begin].low &&
           half_edges[end].high == half_edges[begin].high) {
      ++end;
    }
    visit(begin, end);
    begin = end;
  }
}

/// The loops left when opposite directed edges cancel: the boundary of a set of faces whose sides
/// are `edges`. The sum of the loops' windings equals that of the faces. Edges that lie on no
/// closed loop are dropped.
std::vector<std::vector<int>> boundary_loops(const std::vector<std::array<int, 2>>& edges);

}  // namespace handey
