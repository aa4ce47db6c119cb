// Few edges by halving: if the edge to the last point is not free, the farthest free one lies
// between the next point and a point known to be out of reach.
#include "certified_path.hpp"

namespace handey {

CertifiedPath certified_path(CollisionChecker& checker, const std::vector<Configuration>& points,
                             const CertificateOptions& options) {
  CertifiedPath result;
  result.path.push_back(points.front());
  const std::size_t last = points.size() - 1;
  while (result.reached < last) {
    const std::size_t from = result.reached;
    const auto edge_to = [&](std::size_t to) {
      return certify_edge(checker, points[from], points[to], options);
    };
    std::size_t good = last;
    if (!edge_to(last).is_free()) {
      good = from + 1;
      const EdgeResult next = edge_to(good);
      if (!next.is_free()) {
        result.obstacle = next;
        return result;
      }
      for (std::size_t bad = last; bad - good > 1;) {
        const std::size_t middle = good + (bad - good) / 2;
        (edge_to(middle).is_free() ? good : bad) = middle;
      }
    }
    result.reached = good;
    result.path.push_back(points[good]);
  }
  return result;
}

}  // namespace handey
