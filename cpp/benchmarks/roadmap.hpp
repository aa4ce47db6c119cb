// Is there a way at all? A query is fair only if there is one. Random free configurations are
// joined to their neighbours by proved edges; two configurations that can both be joined to one
// component have a way between them. Not guaranteed: that every way there is is known here, so
// queries through the narrowest passages are left out. Takes no part in what is measured.
#pragma once

#include <cstdint>
#include <vector>

#include "handey/handey.hpp"

namespace benchmark {

class Roadmap {
 public:
  /// Keeps a reference to the checker.
  Roadmap(handey::CollisionChecker& checker, std::uint64_t seed, int configurations = 3000);

  bool knows_way(const handey::Configuration& a, const handey::Configuration& b);

 private:
  struct Neighbour {
    double distance = 0.0;
    int node = 0;
  };
  std::vector<Neighbour> nearest(const Eigen::VectorXd& q, int most) const;
  bool is_edge(const handey::Configuration& a, const handey::Configuration& b);
  int component(int node) const;
  std::vector<int> components_of(const handey::Configuration& configuration);
  void join_neighbours();

  handey::CollisionChecker& checker_;
  std::vector<handey::Configuration> nodes_;
  std::vector<int> parent_;
};

}  // namespace benchmark
