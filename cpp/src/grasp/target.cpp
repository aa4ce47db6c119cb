// Fingertip targets: a pool of points that keep half a pad's width from the border (as far as each
// piece is that wide), from which the best are taken one by one.
#include "handey/grasp/target.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/stop.hpp"
#include "ranges.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;

// One half-plane of Sutherland and Hodgman: keeps sign * coordinate <= bound. A loop clipped by
// convex sets may get edges that run twice along the border; their areas cancel.
void clip(Polygon& loop, int axis, double sign, double bound, Polygon& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
    const double over_a = sign * a[axis] - bound;
    const double over_b = sign * b[axis] - bound;
    if (over_a <= 0.0) scratch.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
      scratch.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
  }
  loop.swap(scratch);
}

// Of plane loops, about the origin.
struct Moments {
  double area = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  double second = 0.0;  // polar

  void add(const Polygon& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
      const double cross = a.x() * b.y() - a.y() * b.x();
      area += cross / 2.0;
      first += cross / 6.0 * (a + b);
      second += cross / 12.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
  }
};

struct Candidate {
  Eigen::Vector2d point;
  double score;
};

// Pad contact in the best of eight directions.
double best_contact(const Region& region, const Eigen::Vector2d& point, const Gripper& gripper) {
  double best = 0.0;
  for (int i = 0; i < 8; ++i) {
    const PlanarPose pose{point.x(), point.y(), i * kPi / 8.0};
    best = std::max(best, pad_contact_area(region, pose, gripper));
  }
  return best;
}

void add_grid(const Region& region, double spacing, std::vector<Eigen::Vector2d>& pool) {
  Eigen::Vector2d lower = region.loops.front().front(), upper = lower;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) {
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
  }
  // Choice: at most 12 points a side.
  spacing = std::max(spacing, (upper - lower).maxCoeff() / 12.0);
  for (double x = lower.x() + 0.5 * spacing; x < upper.x(); x += spacing) {
    for (double y = lower.y() + 0.5 * spacing; y < upper.y(); y += spacing) {
      const Eigen::Vector2d point(x, y);
      if (contains(region, point)) pool.push_back(point);
    }
  }
}

std::vector<Eigen::Vector2d> target_pool(const Region& unobstructed, const Eigen::Vector2d& centre,
                                         double half_pad, int most_pieces) {
  std::vector<Eigen::Vector2d> pool;
  std::vector<Region> pieces = connected_parts(unobstructed);
  if (static_cast<int>(pieces.size()) > most_pieces) {
    pieces.resize(static_cast<std::size_t>(most_pieces));
  }
  for (const Region& piece : pieces) {
    const InscribedCircle circle = largest_inscribed_circle(piece, 2e-4);
    if (circle.radius <= 0.0) continue;
    pool.push_back(circle.centre);
    const Region inner = offset(piece, -std::min(half_pad, 0.9 * circle.radius));
    if (inner.empty()) continue;
    pool.push_back(nearest_point(inner, centre));
    for (const Polygon& loop : inner.loops) {
      pool.insert(pool.end(), loop.begin(), loop.end());
    }
    add_grid(inner, half_pad, pool);
  }
  return pool;
}

}  // namespace

PadPatch pad_patch(const Region& region, const PlanarPose& pose, const Gripper& gripper) {
  const double c = std::cos(pose.theta), s = std::sin(pose.theta);
  const double half_length = 0.5 * gripper.pad_length, half_width = 0.5 * gripper.pad_width;
  Polygon clipped, scratch;
  Moments moments;
  for (const Polygon& loop : region.loops) {
    clipped.clear();
    Eigen::Vector2d lower(1e9, 1e9), upper(-1e9, -1e9);
    for (const Eigen::Vector2d& point : loop) {
      const double x = point.x() - pose.x, y = point.y() - pose.y;
      clipped.emplace_back(c * x + s * y, c * y - s * x);
      lower = lower.cwiseMin(clipped.back());
      upper = upper.cwiseMax(clipped.back());
    }
    if (lower.x() >= half_length || upper.x() <= -half_length || lower.y() >= half_width ||
        upper.y() <= -half_width) {
      continue;
    }
    clip(clipped, 0, 1.0, half_length, scratch);
    clip(clipped, 0, -1.0, half_length, scratch);
    clip(clipped, 1, 1.0, half_width, scratch);
    clip(clipped, 1, -1.0, half_width, scratch);
    if (clipped.size() >= 3) moments.add(clipped);
  }
  PadPatch patch;
  if (moments.area <= 0.0) return patch;
  patch.area = moments.area;
  const Eigen::Vector2d centre = moments.first / moments.area;
  patch.centre = Eigen::Vector2d(pose.x + c * centre.x() - s * centre.y(),
                                 pose.y + s * centre.x() + c * centre.y());
  patch.gyration = std::sqrt(std::max(0.0, moments.second / moments.area - centre.squaredNorm()));
  return patch;
}

double pad_contact_area(const Region& region, const PlanarPose& pose, const Gripper& gripper) {
  return pad_patch(region, pose, gripper).area;
}

Eigen::Vector2d nearest_point(const Region& region, const Eigen::Vector2d& point) {
  if (region.empty() || contains(region, point)) return point;
  Eigen::Vector2d best = point;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d& a = loop[i];
      const Eigen::Vector2d edge = loop[(i + 1) % loop.size()] - a;
      const double length2 = edge.squaredNorm();
      const double along =
          length2 > 0.0 ? std::clamp((point - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
      const Eigen::Vector2d foot = a + along * edge;
      const double distance = (point - foot).norm();
      if (distance < best_distance) {
        best_distance = distance;
        best = foot;
      }
    }
  }
  return best;
}

std::vector<Eigen::Vector2d> fingertip_targets(const Region& unobstructed,
                                               const Eigen::Vector2d& centre_of_mass,
                                               const Gripper& gripper, int most) {
  grasp::require_in_range(most, 1, 1000, "most");
  grasp::require_in_range(gripper.pad_width, 1e-6, 1.0, "gripper.pad_width");
  grasp::require_in_range(gripper.pad_length, 1e-6, 1.0, "gripper.pad_length");
  if (!centre_of_mass.allFinite()) {
    throw InvalidInput("E_NUMBER", "centre_of_mass", "is not finite, expected two numbers");
  }
  const double pad_area = gripper.pad_width * gripper.pad_length;
  const double half_pad = 0.5 * std::min(gripper.pad_width, gripper.pad_length);

  std::vector<Candidate> candidates;
  for (const Eigen::Vector2d& point : target_pool(unobstructed, centre_of_mass, half_pad, most)) {
    const double contact = best_contact(unobstructed, point, gripper) / pad_area;
    const double lever = (point - centre_of_mass).norm() / gripper.pad_length;
    candidates.push_back({point, contact / (1.0 + lever)});
  }

  std::vector<Eigen::Vector2d> targets;
  while (static_cast<int>(targets.size()) < most) {
    throw_if_stopped();
    const Candidate* best = nullptr;
    double best_score = 0.0;
    for (const Candidate& candidate : candidates) {
      double apart = 1.0;
      for (const Eigen::Vector2d& taken : targets) {
        const double distance = (candidate.point - taken).norm();
        // Choice: two targets within a quarter of the pad's width are the same.
        if (distance < 0.5 * half_pad) apart = 0.0;
        apart = std::min(apart, distance / gripper.pad_length);
      }
      if (candidate.score * apart > best_score + 1e-9) {
        best_score = candidate.score * apart;
        best = &candidate;
      }
    }
    if (best == nullptr) break;
    targets.push_back(best->point);
  }
  return targets;
}

}  // namespace handey
