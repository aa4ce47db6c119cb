#include "stance_samples.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.5;    // Choice: longest step in the weighted distance [rad]
constexpr int kFirst = 20;       // Choice: the first terms of the sequence lie in a line
constexpr int kMostJoints = 24;  // of one sequence

std::vector<int> first_primes(std::size_t count) {
  std::vector<int> primes;
  for (int n = 2; primes.size() < count; ++n) {
    const auto divides = [n](int prime) { return n % prime == 0; };
    if (std::none_of(primes.begin(), primes.end(), divides)) primes.push_back(n);
  }
  return primes;
}

/// The digits of n in this base, mirrored at the point.
double mirrored(int n, int base) {
  double value = 0.0, digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= base;
    value += digit * (n % base);
  }
  return value;
}

}  // namespace

StanceSamples::StanceSamples(const FreeSpace& space) {
  const std::vector<ArmJoint>& joints = space.checker().cell().robot->joints;
  const Eigen::Index n = static_cast<Eigen::Index>(joints.size());
  bases_ = first_primes(std::min<std::size_t>(joints.size(), kMostJoints));
  lower_.resize(n);
  range_.resize(n);
  weight_.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const ArmJoint& joint = joints[static_cast<std::size_t>(j)];
    // Joints without limits: a turn about the start.
    const bool bounded = std::isfinite(joint.limit.upper - joint.limit.lower);
    lower_(j) = bounded ? joint.limit.lower : space.start().q(j) - kPi;
    range_(j) = bounded ? joint.limit.upper - joint.limit.lower : 2.0 * kPi;
    weight_(j) = space.reach(static_cast<int>(j));
  }
  weight_ /= weight_.maxCoeff();
}

Eigen::VectorXd StanceSamples::next() {
  ++count_;
  Eigen::VectorXd q(lower_.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const int base = bases_[static_cast<std::size_t>(j) % bases_.size()];
    q(j) = lower_(j) + range_(j) * mirrored(kFirst + count_, base);
  }
  return q;
}

double StanceSamples::distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  return weight_.cwiseProduct(a - b).norm();
}

Eigen::VectorXd StanceSamples::towards(const Eigen::VectorXd& from,
                                       const Eigen::VectorXd& aim) const {
  const double way = distance(from, aim);
  return way <= kStep ? aim : Eigen::VectorXd(from + kStep / way * (aim - from));
}

}  // namespace handey::cspace
