// What a proof costs: the certificate of a straight joint-space edge beside the usual sampling of
// the same edge every half degree, in the same run, among 25 boxes. The sampling uses the same
// checker, so the difference is the method alone. Edges that the sampling calls free and the
// certificate does not are counted: among them are the gaps between samples. Usage:
// certificate_benchmark MODELS
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "puma560.hpp"

using namespace handey;

namespace {

Cell clutter(const std::string& models) {
  Cell cell = example::table_cell(models);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 25; ++i) {
    const double radius = 0.35 + 0.45 * unit(random), angle = 4.4 * (unit(random) - 0.5);
    const Eigen::Vector3d size(0.05 + 0.1 * unit(random), 0.05 + 0.1 * unit(random),
                               0.05 + 0.1 * unit(random));
    const double height = 0.5 * size.z() + 0.9 * unit(random);
    cell.fixtures.push_back(example::box(
        "box " + std::to_string(i), size,
        example::at(radius * std::cos(angle), radius * std::sin(angle), height, unit(random))));
  }
  return cell;
}

Eigen::VectorXd random_configuration(const Robot& robot, std::mt19937_64& random) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(robot.joints.size()));
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const JointLimit& limit = robot.joints[static_cast<std::size_t>(j)].limit;
    q(j) = std::uniform_real_distribution<double>(limit.lower, limit.upper)(random);
  }
  return q;
}

bool is_free_sampled(CollisionChecker& checker, const Configuration& a, const Configuration& b) {
  const double half_degree = 0.5 * std::acos(-1.0) / 180.0;
  const Eigen::VectorXd step = b.q - a.q;
  const int steps = static_cast<int>(std::ceil(step.cwiseAbs().maxCoeff() / half_degree));
  for (int i = 0; i <= steps; ++i) {
    Configuration sample{a.q + step * i / std::max(1, steps), a.opening};
    if (!checker.is_free(sample, 0.0)) return false;
  }
  return true;
}

template <class Work>
double microseconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

void print_row(const char* name, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const auto at = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  std::printf("%-34s %9.1f %9.1f %9.1f\n", name, at(0.5), at(0.95), times.back());
}

}  // namespace

int main(int argc, char** argv) {
  const Cell cell = clutter(argc > 1 ? argv[1] : "models");
  const Robot& robot = *cell.robot;
  CollisionChecker checker(make_collision_model(cell), cell);
  std::mt19937_64 random(9);
  std::vector<double> check, free_proof, free_samples, blocked_proof, blocked_samples;
  int unproved = 0, edges = 0;
  while (edges < 2000) {
    const Configuration a{random_configuration(robot, random), 0.05};
    bool free = false;
    check.push_back(microseconds([&] { free = checker.is_free(a); }));
    if (!free) continue;
    // An edge as a planner tries it: half a radian in a random direction.
    Configuration b{random_configuration(robot, random), 0.05};
    b.q = a.q + 0.5 * (b.q - a.q).normalized();
    if (!checker.is_free(b)) continue;
    ++edges;
    bool proved = false, sampled = false;
    const double proof = microseconds([&] { proved = certify_edge(checker, a, b).is_free(); });
    const double samples = microseconds([&] { sampled = is_free_sampled(checker, a, b); });
    (proved ? free_proof : blocked_proof).push_back(proof);
    (proved ? free_samples : blocked_samples).push_back(samples);
    if (sampled && !proved) ++unproved;
  }
  std::printf("%-34s %9s %9s %9s\n", "Puma 560, 25 boxes [microseconds]", "median", "p95", "worst");
  print_row("one configuration", check);
  print_row("free edge, certificate", free_proof);
  print_row("free edge, sampled at 0.5 degrees", free_samples);
  print_row("blocked edge, certificate", blocked_proof);
  print_row("blocked edge, sampled", blocked_samples);
  std::printf("%zu of %d edges proved free; %d sampled free are not proved\n", free_proof.size(),
              edges, unproved);
  return 0;
}
