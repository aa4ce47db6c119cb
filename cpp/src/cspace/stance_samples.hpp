// Configurations spread evenly over the ranges of all joints: where the search through the slices
// looks for other stances of the wrist. The same sequence every time: Halton's (Halton, Numerische
// Mathematik 2, 1960). Distances count a joint by how far it can move the hand.
#pragma once

#include <vector>

#include "handey/cspace/free_space.hpp"

namespace handey::cspace {

class StanceSamples {
 public:
  explicit StanceSamples(const FreeSpace& space);
  Eigen::VectorXd next();
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  /// From `from` towards `aim`, as far as one step goes.
  Eigen::VectorXd towards(const Eigen::VectorXd& from, const Eigen::VectorXd& aim) const;

 private:
  Eigen::VectorXd lower_, range_, weight_;
  std::vector<int> bases_;  ///< primes
  int count_ = 0;
};

}  // namespace handey::cspace
