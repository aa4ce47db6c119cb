// Nearest boxes first, by rings of finest cells round the end.
#include "end_connection.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

// Choice: so many boxes are enough to leave an end by, and so many edges are tried for them.
constexpr std::size_t kEnough = 3;
constexpr int kMostEdges = 60;
constexpr int kRings[] = {1, 2, 4, 8, 16};  // in finest cells

}  // namespace

std::vector<EndConnection> connect_end(FreeSpace& space, int slice, const SlicePoint& end,
                                       const CertificateOptions& certificate, int max_proofs) {
  std::vector<EndConnection> connections;
  const int own = space.box_at(slice, end);
  if (own < 0) return connections;
  if (space.box(own).state == SliceBox::State::Free) {
    connections.push_back({own, end, end});
    return connections;
  }
  std::vector<int> seen{own};
  const Configuration from = space.configuration(slice, end);
  int edges = 0;
  for (const int ring : kRings) {
    for (int k = 0; k < 27; ++k) {
      const int step[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
      if (k == 13) continue;
      if (space.proofs() > max_proofs) return connections;
      SlicePoint there = end;
      for (int j = 0; j < 3; ++j) {
        there[static_cast<std::size_t>(j)] += step[j] * ring * space.finest(j);
      }
      const int box = space.box_at(slice, there);
      if (box < 0 || space.box(box).state != SliceBox::State::Free) continue;
      if (std::find(seen.begin(), seen.end(), box) != seen.end()) continue;
      seen.push_back(box);
      if (++edges > kMostEdges) return connections;
      const SlicePoint lower = space.lower(space.box(box)), upper = space.upper(space.box(box));
      // Into the box as far as its middle, or the point of it nearest to the end where it is large.
      for (std::size_t j = 0; j < 3; ++j) {
        const double inset =
            std::min(0.5 * (upper[j] - lower[j]), space.finest(static_cast<int>(j)));
        there[j] = std::clamp(there[j], lower[j] + inset, upper[j] - inset);
      }
      if (!certify_edge(space.checker(), from, space.configuration(slice, there), certificate)
               .is_free()) {
        continue;
      }
      connections.push_back({box, end, there});
      if (connections.size() >= kEnough) return connections;
    }
  }
  return connections;
}

}  // namespace handey::cspace
