// Depth of overlap of two pieces.
#include "overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "handey/stop.hpp"

namespace handey::collision {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostNormals =
    600;  // Choice: beyond, a finely meshed convex solid is smooth enough
constexpr std::size_t kMostEdges = 64;
constexpr double kNoDirection = 1e-9;  // shorter is no direction
constexpr double kFinestSample =
    2.5e-4;                       // between samples of an edge: half the contact tolerance [m]
constexpr int kMostSamples = 60;  // along one edge

/// Directions, one of each opposite pair, nearly equal ones merged.
class Directions {
 public:
  explicit Directions(std::size_t most) : most_(most) {}

  void add(const Vector3d& vector) {
    const double length = vector.norm();
    if (length < kNoDirection || list_.size() >= most_) return;
    Vector3d unit = vector / length;
    Eigen::Index largest = 0;
    unit.cwiseAbs().maxCoeff(&largest);
    if (unit[largest] < 0.0) unit = -unit;
    const std::array<long, 3> key{std::lround(unit.x() * 1e6), std::lround(unit.y() * 1e6),
                                  std::lround(unit.z() * 1e6)};
    if (seen_.insert(key).second) list_.push_back(unit);
  }
  const std::vector<Vector3d>& list() const { return list_; }

 private:
  std::size_t most_;
  std::set<std::array<long, 3>> seen_;
  std::vector<Vector3d> list_;
};

const Vector3d& corner(const TriangleMesh& mesh, const Eigen::Vector3i& triangle, int k) {
  return mesh.vertices[static_cast<std::size_t>(triangle[k])];
}

void add_normals(const Piece& piece, const Pose& X, Directions& directions) {
  const TriangleMesh& mesh = piece.polyhedral().mesh;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    directions.add(
        X.linear() *
        (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0)));
  }
}

std::vector<Vector3d> edge_directions(const Piece& piece, const Pose& X) {
  Directions directions(kMostEdges);
  const TriangleMesh& mesh = piece.polyhedral().mesh;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k)
      directions.add(X.linear() * (corner(mesh, t, (k + 1) % 3) - corner(mesh, t, k)));
  }
  return directions.list();
}

double reach_along(const ConvexSolid& solid, const Pose& X, const Vector3d& direction) {
  return (X * solid.farthest(X.linear().transpose() * direction)).dot(direction) + solid.rounding;
}

double convex_depth(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB) {
  Directions directions(std::numeric_limits<std::size_t>::max());
  Directions normals(kMostNormals);
  add_normals(a, X_WA, normals);
  for (const Vector3d& normal : normals.list()) directions.add(normal);
  normals = Directions(kMostNormals);
  add_normals(b, X_WB, normals);
  for (const Vector3d& normal : normals.list()) directions.add(normal);
  directions.add(X_WA * a.hull.centre - X_WB * b.hull.centre);  // of two balls: exact
  const std::vector<Vector3d> edges_b = edge_directions(b, X_WB);
  for (const Vector3d& edge_a : edge_directions(a, X_WA)) {
    throw_if_stopped();
    for (const Vector3d& edge_b : edges_b) directions.add(edge_a.cross(edge_b));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& n : directions.list()) {
    throw_if_stopped();
    const double along = reach_along(a.hull, X_WA, n) + reach_along(b.hull, X_WB, -n);
    const double against = reach_along(a.hull, X_WA, -n) + reach_along(b.hull, X_WB, n);
    least = std::min({least, along, against});
  }
  return std::max(0.0, least);
}

/// Depth seen from points on and under the surface of a.
class SampledDepth {
 public:
  SampledDepth(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB)
      : a_(a.polyhedral()),
        b_(b.polyhedral()),
        a_solid_(a.solid),
        b_solid_(b.solid),
        X_BA_(X_WB.inverse() * X_WA) {
    // Only what lies in the box of b can be inside it.
    for (const Vector3d& vertex : b_.mesh.vertices) box_.extend(vertex);
    finest_ = std::max(kFinestSample, box_.diagonal().norm() / 400.0);
  }

  double run() {
    for (const Eigen::Vector3i& t : a_.mesh.triangles) sample(t);
    return deepest_;
  }

 private:
  void sample(const Eigen::Vector3i& t) {
    const std::array<Vector3d, 3> p{corner(a_.mesh, t, 0), corner(a_.mesh, t, 1),
                                    corner(a_.mesh, t, 2)};
    Eigen::AlignedBox3d extent;
    for (const Vector3d& point : p) extent.extend(X_BA_ * point);
    if (!extent.intersects(box_)) return;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (normal.norm() < 1e-16) return;
    inward_ = -normal.normalized();
    const double longest =
        std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    for (std::size_t k = 0; k < 3; ++k) sample_segment(p[k], p[(k + 1) % 3]);
    const int steps = std::clamp(static_cast<int>(longest / (4.0 * finest_)), 3, kMostSamples / 2);
    for (int i = 1; i < steps; ++i) {
      for (int j = 1; i + j < steps; ++j) {
        look_at(p[0] + (p[1] - p[0]) * i / steps + (p[2] - p[0]) * j / steps);
      }
    }
  }

  /// Samples the part of an edge that lies in b's box.
  void sample_segment(const Vector3d& from, const Vector3d& to) {
    const Vector3d start = X_BA_ * from, along = X_BA_ * to - start;
    double enter = 0.0, leave = 1.0;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(along[i]) < 1e-15) continue;
      const double t0 = (box_.min()[i] - start[i]) / along[i],
                   t1 = (box_.max()[i] - start[i]) / along[i];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    if (enter > leave) return;
    const double length = (leave - enter) * along.norm();
    const int steps = std::clamp(static_cast<int>(length / finest_), 2, kMostSamples);
    for (int i = 0; i <= steps; ++i)
      look_at(from + (to - from) * (enter + (leave - enter) * i / steps));
  }

  void look_at(const Vector3d& point) {
    if (!box_.contains(X_BA_ * point)) return;
    throw_if_stopped();
    consider(point, 0.0);
    if (!a_solid_) return;
    for (const double inside : {0.5e-3, 2e-3, 8e-3}) {  // bodies whose surfaces coincide
      const Vector3d deeper = point + inside * inward_;
      if (a_.tree.contains(deeper)) consider(deeper, a_.tree.distance(deeper));
    }
  }

  void consider(const Vector3d& point, double depth_in_a) {
    const Vector3d in_b = X_BA_ * point;
    if (!b_solid_) return;
    if (!b_.tree.contains(in_b)) return;
    deepest_ = std::max(deepest_, depth_in_a + b_.tree.distance(in_b));
  }

  const Polyhedral& a_;
  const Polyhedral& b_;
  bool a_solid_, b_solid_;
  Pose X_BA_;
  Eigen::AlignedBox3d box_;
  Vector3d inward_ = Vector3d::Zero();
  double finest_ = kFinestSample;
  double deepest_ = 0.0;
};

}  // namespace

double overlap_depth(const Piece& a, const Pose& X_WA, const Piece& b, const Pose& X_WB) {
  if (piece_distance(a, X_WA, b, X_WB, 0.0, 0.0) > 0.0) return 0.0;
  if (a.convex && b.convex) return convex_depth(a, X_WA, b, X_WB);
  return std::max(SampledDepth(a, X_WA, b, X_WB).run(), SampledDepth(b, X_WB, a, X_WA).run());
}

}  // namespace handey::collision
