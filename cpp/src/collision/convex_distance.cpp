// Gilbert-Johnson-Keerthi. The point of the simplex nearest to the origin is found by trying every
// face of the simplex that holds the newest point: slower than region tests by nanoseconds, and
// nothing to get wrong in degenerate cases.
#include "convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace handey::collision {
namespace {

using Eigen::Vector3d;

constexpr int kMostIterations = 48;    // Choice: polytopes take 3-8, two cylinders up to 30
constexpr double kAbsoluteGap = 1e-8;  // between upper and lower bound, then it is exact enough [m]
constexpr double kRelativeGap = 1e-6;
constexpr double kDegenerate = 1e-24;  // squared size of a face that is no face [m2 or m4]

/// A simplex of the Minkowski difference A - B, at most four points.
struct Simplex {
  std::array<Vector3d, 4> points;
  int count = 0;
};

/// A face of a simplex and its point nearest to the origin.
struct Nearest {
  Vector3d point = Vector3d::Zero();
  double squared = std::numeric_limits<double>::infinity();
  std::array<int, 4> face{};
  int count = 0;
};

void take(Nearest& best, const Vector3d& point, std::array<int, 4> face, int count) {
  const double squared = point.squaredNorm();
  if (squared < best.squared) best = {point, squared, face, count};
}

void try_edge(const Simplex& s, int i, int j, Nearest& best) {
  const Vector3d& a = s.points[static_cast<std::size_t>(i)];
  const Vector3d edge = s.points[static_cast<std::size_t>(j)] - a;
  const double length = edge.squaredNorm();
  if (length < kDegenerate) return;
  const double t = -a.dot(edge) / length;
  if (t <= 0.0 || t >= 1.0) return;
  take(best, a + t * edge, {i, j, 0, 0}, 2);
}

void try_triangle(const Simplex& s, int i, int j, int k, Nearest& best) {
  const Vector3d& a = s.points[static_cast<std::size_t>(i)];
  const Vector3d& b = s.points[static_cast<std::size_t>(j)];
  const Vector3d& c = s.points[static_cast<std::size_t>(k)];
  const Vector3d normal = (b - a).cross(c - a);
  const double size = normal.squaredNorm();
  if (size < kDegenerate * kDegenerate) return;
  const Vector3d foot = normal * (normal.dot(a) / size);
  if (normal.dot((b - a).cross(foot - a)) <= 0.0) return;
  if (normal.dot((c - b).cross(foot - b)) <= 0.0) return;
  if (normal.dot((a - c).cross(foot - c)) <= 0.0) return;
  take(best, foot, {i, j, k, 0}, 3);
}

/// Is the origin inside the tetrahedron?
bool encloses_origin(const Simplex& s) {
  constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{
      {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
  for (const std::array<std::size_t, 4>& f : kFaces) {
    const Vector3d normal =
        (s.points[f[1]] - s.points[f[0]]).cross(s.points[f[2]] - s.points[f[0]]);
    const double apex = normal.dot(s.points[f[3]] - s.points[f[0]]);
    const double origin = -normal.dot(s.points[f[0]]);
    if (apex * origin <= 0.0) return false;
  }
  return true;
}

/// Nearest point of the simplex, among the faces that hold its last point.
Nearest nearest_to_origin(const Simplex& s) {
  Nearest best;
  const int last = s.count - 1;
  if (s.count == 4 && encloses_origin(s)) {
    best.squared = 0.0;
    best.count = 4;
    return best;
  }
  take(best, s.points[static_cast<std::size_t>(last)], {last, 0, 0, 0}, 1);
  for (int i = 0; i < last; ++i) try_edge(s, i, last, best);
  for (int i = 0; i < last; ++i) {
    for (int j = i + 1; j < last; ++j) try_triangle(s, i, j, last, best);
  }
  return best;
}

Simplex keep(const Simplex& s, const Nearest& nearest) {
  Simplex kept;
  for (int i = 0; i < nearest.count; ++i) {
    kept.points[static_cast<std::size_t>(kept.count++)] =
        s.points[static_cast<std::size_t>(nearest.face[static_cast<std::size_t>(i)])];
  }
  return kept;
}

}  // namespace

Vector3d ConvexSolid::farthest(const Vector3d& direction) const {
  if (kind == Kind::Points) {
    const Vector3d* best = &points.front();
    double value = best->dot(direction);
    for (const Vector3d& point : points) {
      const double here = point.dot(direction);
      if (here > value) {
        value = here;
        best = &point;
      }
    }
    return *best;
  }
  const Vector3d local = X_BC.linear().transpose() * direction;
  Vector3d point;
  if (kind == Kind::Box) {
    for (int i = 0; i < 3; ++i) point[i] = local[i] < 0.0 ? -half[i] : half[i];
  } else {
    const double across = std::sqrt(local.x() * local.x() + local.y() * local.y());
    const double scale = across > 1e-300 ? half.x() / across : 0.0;
    point = Vector3d(local.x() * scale, local.y() * scale, local.z() < 0.0 ? -half.z() : half.z());
  }
  return X_BC * point;
}

double convex_distance(const ConvexSolid& a, const Pose& X_WA, const ConvexSolid& b,
                       const Pose& X_WB, double least, double enough, Vector3d* apart) {
  const double rounding = a.rounding + b.rounding;
  const auto difference_support = [&](const Vector3d& direction) -> Vector3d {
    const Vector3d in_a = X_WA.linear().transpose() * direction;
    const Vector3d in_b = X_WB.linear().transpose() * -direction;
    return X_WA * a.farthest(in_a) - X_WB * b.farthest(in_b);
  };
  Vector3d nearest = X_WA * a.centre - X_WB * b.centre;
  double upper = std::numeric_limits<double>::infinity();
  double lower = -std::numeric_limits<double>::infinity();
  Simplex simplex;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    double length = nearest.norm();
    if (length < 1e-12) {
      if (simplex.count > 0) return std::min(lower, -rounding);
      nearest = Vector3d::UnitX();  // Centres coincide: any direction starts.
      length = 1.0;
    }
    const Vector3d point = difference_support(-nearest);
    const double bound = nearest.dot(point) / length - rounding;
    if (bound > lower) {
      lower = bound;
      if (apart != nullptr) *apart = nearest / length;
    }
    if (lower > enough) return lower;
    if (std::isfinite(upper) && upper - lower <= kAbsoluteGap + kRelativeGap * upper) return lower;
    for (int i = 0; i < simplex.count; ++i) {
      if ((simplex.points[static_cast<std::size_t>(i)] - point).squaredNorm() < kDegenerate)
        return lower;
    }
    simplex.points[static_cast<std::size_t>(simplex.count++)] = point;
    const Nearest next = nearest_to_origin(simplex);
    if (next.count == 4) return std::min(lower, -rounding);
    const double distance = std::sqrt(next.squared) - rounding;
    if (distance <= least) return std::min(lower, least);
    if (distance >= upper) return lower;  // Rounding stops the descent: what is proved stands.
    upper = distance;
    nearest = next.point;
    simplex = keep(simplex, next);
  }
  return lower;
}

double convex_distance_along(const ConvexSolid& a, const Pose& X_WA, const ConvexSolid& b,
                             const Pose& X_WB, const Vector3d& direction) {
  const Vector3d near_a = X_WA * a.farthest(X_WA.linear().transpose() * -direction);
  const Vector3d far_b = X_WB * b.farthest(X_WB.linear().transpose() * direction);
  return direction.dot(near_a - far_b) - a.rounding - b.rounding;
}

}  // namespace handey::collision
