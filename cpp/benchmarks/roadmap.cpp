#include "roadmap.hpp"

#include <algorithm>
#include <tuple>

#include "query_drawing.hpp"

using namespace handey;

namespace benchmark {
namespace {

constexpr int kNeighbours = 12;  // that a configuration is tried to be joined to

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  // Roughly by how far a joint of the Puma moves the arm.
  static const Eigen::VectorXd weight =
      (Eigen::VectorXd(6) << 1.0, 1.0, 0.6, 0.2, 0.2, 0.05).finished();
  return weight.cwiseProduct(a - b).norm();
}

}  // namespace

Roadmap::Roadmap(CollisionChecker& checker, std::uint64_t seed, int configurations)
    : checker_(checker) {
  Random random(seed);
  for (int i = 0; i < configurations; ++i) {
    nodes_.push_back(random_free(checker, random));
    parent_.push_back(i);
  }
  join_neighbours();
}

std::vector<Roadmap::Neighbour> Roadmap::nearest(const Eigen::VectorXd& q, int most) const {
  std::vector<Neighbour> result;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    result.push_back({distance(nodes_[i].q, q), static_cast<int>(i)});
  }
  const auto end =
      result.begin() + std::min<std::ptrdiff_t>(most, static_cast<std::ptrdiff_t>(result.size()));
  std::partial_sort(result.begin(), end, result.end(), [](const auto& a, const auto& b) {
    return std::tie(a.distance, a.node) < std::tie(b.distance, b.node);
  });
  result.erase(end, result.end());
  return result;
}

bool Roadmap::is_edge(const Configuration& a, const Configuration& b) {
  return certify_edge(checker_, a, b).is_free();
}

int Roadmap::component(int node) const {
  while (parent_[static_cast<std::size_t>(node)] != node) {
    node = parent_[static_cast<std::size_t>(node)];
  }
  return node;
}

// Shortest edges first; what is joined already is not joined again.
void Roadmap::join_neighbours() {
  std::vector<std::tuple<double, int, int>> edges;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (const Neighbour& neighbour : nearest(nodes_[i].q, kNeighbours + 1)) {
      if (neighbour.node != static_cast<int>(i)) {
        edges.emplace_back(neighbour.distance, static_cast<int>(i), neighbour.node);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [length, a, b] : edges) {
    const int one = component(a), other = component(b);
    if (one == other) continue;
    if (is_edge(nodes_[static_cast<std::size_t>(a)], nodes_[static_cast<std::size_t>(b)])) {
      parent_[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  }
}

std::vector<int> Roadmap::components_of(const Configuration& configuration) {
  std::vector<int> result;
  for (const Neighbour& neighbour : nearest(configuration.q, 3 * kNeighbours)) {
    const int candidate = component(neighbour.node);
    if (std::find(result.begin(), result.end(), candidate) != result.end()) continue;
    if (is_edge(configuration, nodes_[static_cast<std::size_t>(neighbour.node)])) {
      result.push_back(candidate);
    }
  }
  return result;
}

bool Roadmap::knows_way(const Configuration& a, const Configuration& b) {
  if (is_edge(a, b)) return true;
  const std::vector<int> from_b = components_of(b);
  for (int candidate : components_of(a)) {
    if (std::find(from_b.begin(), from_b.end(), candidate) != from_b.end()) return true;
  }
  return false;
}

}  // namespace benchmark
