// A median-split tree over triangles, with nearest-point and ray queries.
#include "surface_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "handey/stop.hpp"

namespace handey::collision {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 4;  // triangles; Choice: between tree depth and tests per leaf

/// Nearest point of the segment to the point, squared distance.
double squared_to_segment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double length = edge.squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - a).dot(edge) / length, 0.0, 1.0) : 0.0;
  return (point - a - t * edge).squaredNorm();
}

double squared_to_triangle(const Vector3d& point, const Vector3d& a, const Vector3d& b,
                           const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double size = normal.squaredNorm();
  if (size > 0.0 && normal.dot((b - a).cross(point - a)) >= 0.0 &&
      normal.dot((c - b).cross(point - b)) >= 0.0 && normal.dot((a - c).cross(point - c)) >= 0.0) {
    const double height = normal.dot(point - a);
    return height * height / size;
  }
  return std::min({squared_to_segment(point, a, b), squared_to_segment(point, b, c),
                   squared_to_segment(point, c, a)});
}

bool ray_meets(const Eigen::AlignedBox3d& box, const Vector3d& origin, const Vector3d& direction) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {  // No component of the directions used is zero.
    const double inverse = 1.0 / direction[i];
    double t0 = (box.min()[i] - 1e-9 - origin[i]) * inverse;
    double t1 = (box.max()[i] + 1e-9 - origin[i]) * inverse;
    if (t0 > t1) std::swap(t0, t1);
    enter = std::max(enter, t0);
    leave = std::min(leave, t1);
  }
  return enter <= leave;
}

/// Are two boxes farther apart than `distance`?
bool is_beyond(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double distance) {
  return distance <= 0.0 ? !a.intersects(b) : a.squaredExteriorDistance(b) > distance * distance;
}

}  // namespace

double point_triangle_distance(const Vector3d& point, const Vector3d& a, const Vector3d& b,
                               const Vector3d& c) {
  return std::sqrt(squared_to_triangle(point, a, b, c));
}

SurfaceTree::SurfaceTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vector3d> centres;
  centres.reserve(order_.size());
  for (const Eigen::Vector3i& t : mesh_.triangles) {
    centres.push_back((mesh_.vertices[static_cast<std::size_t>(t[0])] +
                       mesh_.vertices[static_cast<std::size_t>(t[1])] +
                       mesh_.vertices[static_cast<std::size_t>(t[2])]) /
                      3.0);
  }
  if (!order_.empty()) build(0, static_cast<int>(order_.size()), centres);
}

int SurfaceTree::build(int first, int count, std::vector<Vector3d>& centres) {
  throw_if_stopped();
  Node node;
  node.first = first;
  Eigen::AlignedBox3d spread;
  for (int i = first; i < first + count; ++i) {
    const int triangle = order_[static_cast<std::size_t>(i)];
    spread.extend(centres[static_cast<std::size_t>(triangle)]);
    for (int k = 0; k < 3; ++k) {
      node.box.extend(mesh_.vertices[static_cast<std::size_t>(
          mesh_.triangles[static_cast<std::size_t>(triangle)][k])]);
    }
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back(node);
  if (count <= kLeaf) {
    nodes_.back().count = count;
    return index;
  }
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
    const double at_a = centres[static_cast<std::size_t>(a)][axis];
    const double at_b = centres[static_cast<std::size_t>(b)][axis];
    return at_a != at_b ? at_a < at_b : a < b;
  });
  const int left = build(first, count / 2, centres);
  const int right = build(first + count / 2, count - count / 2, centres);
  nodes_[static_cast<std::size_t>(index)].left = left;
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

double SurfaceTree::distance(const Vector3d& point) const {
  double squared = std::numeric_limits<double>::infinity();
  if (!nodes_.empty()) nearest(0, point, squared);
  return std::sqrt(squared);
}

void SurfaceTree::nearest(int index, const Vector3d& point, double& squared) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (node.box.squaredExteriorDistance(point) >= squared) return;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const Eigen::Vector3i& t =
        mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    squared =
        std::min(squared, squared_to_triangle(point, mesh_.vertices[static_cast<std::size_t>(t[0])],
                                              mesh_.vertices[static_cast<std::size_t>(t[1])],
                                              mesh_.vertices[static_cast<std::size_t>(t[2])]));
  }
  if (node.left < 0) return;
  const double to_left =
      nodes_[static_cast<std::size_t>(node.left)].box.squaredExteriorDistance(point);
  const double to_right =
      nodes_[static_cast<std::size_t>(node.right)].box.squaredExteriorDistance(point);
  nearest(to_left <= to_right ? node.left : node.right, point, squared);
  nearest(to_left <= to_right ? node.right : node.left, point, squared);
}

/// A convex solid beside the surface, and how near they are as far as was looked.
struct SurfaceTree::Query {
  const ConvexSolid& solid;
  const Pose& X_MS;
  double least;
  double nearest;           ///< no farther than `enough` counts [m]
  Eigen::AlignedBox3d box;  ///< of the solid, in the mesh's frame
  ConvexSolid triangle;     ///< the one looked at
};

double SurfaceTree::distance(const ConvexSolid& solid, const Pose& X_MS, double least,
                             double enough) const {
  Query query{solid, X_MS, least, std::numeric_limits<double>::infinity(), {}, {}};
  const Eigen::Matrix3d R_SM = X_MS.linear().transpose();
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d along = R_SM.col(axis);
    query.box.min()[axis] = (X_MS * solid.farthest(-along))[axis] - solid.rounding;
    query.box.max()[axis] = (X_MS * solid.farthest(along))[axis] + solid.rounding;
  }
  query.triangle.points.resize(3);
  // Farther than enough is all the same.
  query.nearest = enough + 1e-9 * (1.0 + enough);
  if (!nodes_.empty()) nearest(0, query);
  return query.nearest;
}

void SurfaceTree::nearest(int index, Query& query) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (query.nearest <= query.least) return;
  if (node.left < 0) {
    throw_if_stopped();
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Eigen::Vector3i& t =
          mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
      Eigen::AlignedBox3d box;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d& corner =
            mesh_.vertices[static_cast<std::size_t>(t[static_cast<Eigen::Index>(k)])];
        query.triangle.points[k] = corner;
        box.extend(corner);
      }
      if (is_beyond(box, query.box, query.nearest)) continue;
      query.triangle.centre =
          (query.triangle.points[0] + query.triangle.points[1] + query.triangle.points[2]) / 3.0;
      query.nearest =
          std::min(query.nearest, convex_distance(query.triangle, Pose::Identity(), query.solid,
                                                  query.X_MS, query.least, query.nearest));
      if (query.nearest <= query.least) return;
    }
    return;
  }
  const Eigen::AlignedBox3d& left = nodes_[static_cast<std::size_t>(node.left)].box;
  const Eigen::AlignedBox3d& right = nodes_[static_cast<std::size_t>(node.right)].box;
  const bool left_first =
      left.squaredExteriorDistance(query.box) <= right.squaredExteriorDistance(query.box);
  for (const bool to_left : {left_first, !left_first}) {
    if (is_beyond(to_left ? left : right, query.box, query.nearest)) continue;
    nearest(to_left ? node.left : node.right, query);
  }
}

bool SurfaceTree::contains(const Vector3d& point) const {
  if (nodes_.empty() || !nodes_.front().box.contains(point)) return false;
  // Directions in no special relation to faces and edges that machines have.
  static const std::array<Vector3d, 4> kDirections{
      Vector3d(0.8237, 0.3519, 0.4447), Vector3d(-0.3571, 0.7793, -0.5149),
      Vector3d(0.2347, -0.6131, 0.7543), Vector3d(-0.6689, -0.4517, -0.5903)};
  for (const Vector3d& direction : kDirections) {
    int winding = 0;
    if (winding_along(0, point, direction, winding)) return winding > 0;
  }
  return contains_point(mesh_, point);
}

bool SurfaceTree::winding_along(int index, const Vector3d& point, const Vector3d& direction,
                                int& winding) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (!ray_meets(node.box, point, direction)) return true;
  for (int i = node.first; i < node.first + node.count; ++i) {
    const Eigen::Vector3i& t =
        mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    const Vector3d a = mesh_.vertices[static_cast<std::size_t>(t[0])] - point;
    const Vector3d b = mesh_.vertices[static_cast<std::size_t>(t[1])] - point;
    const Vector3d c = mesh_.vertices[static_cast<std::size_t>(t[2])] - point;
    // Signed volumes: on which side of each edge the ray's line passes.
    const double ab = direction.dot(a.cross(b)), bc = direction.dot(b.cross(c)),
                 ca = direction.dot(c.cross(a));
    const double scale = 1e-12 * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm());
    const bool positive = ab > -scale && bc > -scale && ca > -scale;
    const bool negative = ab < scale && bc < scale && ca < scale;
    if (!positive && !negative) continue;
    if (std::min({std::abs(ab), std::abs(bc), std::abs(ca)}) <= scale) return false;
    const double volume = a.dot(b.cross(c));  // sign: which side of the plane the point is on
    if (std::abs(volume) <= 1e-30) return false;
    if (positive && volume > 0.0) ++winding;
    if (negative && volume < 0.0) --winding;
  }
  if (node.left < 0) return true;
  return winding_along(node.left, point, direction, winding) &&
         winding_along(node.right, point, direction, winding);
}

}  // namespace handey::collision
