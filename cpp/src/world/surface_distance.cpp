// Distances from surfaces, inside and outside alike.
#include "surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace handey::world {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 4;  // triangles

/// Distance from a boundary whose inside has both terms negative.
double distance_from(double across, double along) {
  if (across <= 0.0 && along <= 0.0) return -std::max(across, along);
  return std::hypot(std::max(across, 0.0), std::max(along, 0.0));
}

double distance_from(const Box& box, const Vector3d& p) {
  const Vector3d beyond = p.cwiseAbs() - 0.5 * box.size;
  const double most = beyond.maxCoeff();
  return most <= 0.0 ? -most : beyond.cwiseMax(0.0).norm();
}

double distance_from(const Cylinder& cylinder, const Vector3d& p) {
  return distance_from(p.head<2>().norm() - cylinder.radius,
                       std::abs(p.z()) - 0.5 * cylinder.length);
}

double distance_from(const Sphere& sphere, const Vector3d& p) {
  return std::abs(p.norm() - sphere.radius);
}

double squared_from_segment(const Vector3d& p, const Vector3d& start, const Vector3d& along,
                            double squared) {
  const Vector3d q = p - start;
  const double share = squared > 0.0 ? std::clamp(q.dot(along) / squared, 0.0, 1.0) : 0.0;
  return (q - share * along).squaredNorm();
}

}  // namespace

SurfaceBand::SurfaceBand(const Shape& shape, double within)
    : geometry_(shape.geometry), within_(within) {
  if (const MeshShape* mesh = std::get_if<MeshShape>(&geometry_)) {
    add_mesh(*mesh->mesh);
  } else {
    Vector3d half;
    if (const Box* box = std::get_if<Box>(&geometry_)) {
      half = 0.5 * box->size;
    } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&geometry_)) {
      half = {cylinder->radius, cylinder->radius, 0.5 * cylinder->length};
    } else {
      half.setConstant(std::get<Sphere>(geometry_).radius);
    }
    box_ = {-half, half};
  }
  box_.min().array() -= within_;
  box_.max().array() += within_;
}

SurfaceBand::Triangle SurfaceBand::triangle_of(const Vector3d& a, const Vector3d& b,
                                               const Vector3d& c) {
  Triangle t;
  t.a = a;
  t.ab = b - a;
  t.ac = c - a;
  t.bc = c - b;
  t.abab = t.ab.squaredNorm();
  t.acac = t.ac.squaredNorm();
  t.bcbc = t.bc.squaredNorm();
  t.abac = t.ab.dot(t.ac);
  t.normal = t.ab.cross(t.ac);
  const double length = t.normal.norm();
  if (length > 1e-14) {
    t.normal /= length;
  } else {
    t.normal.setZero();
  }
  return t;
}

bool SurfaceBand::is_near(const Triangle& t, const Vector3d& point) const {
  const Vector3d p = point - t.a;
  const double height = p.dot(t.normal);
  if (std::abs(height) > within_) return false;
  if (!t.normal.isZero(0.0)) {
    const double ab = p.dot(t.ab), ac = p.dot(t.ac);
    const double determinant = t.abab * t.acac - t.abac * t.abac;
    const double u = t.acac * ab - t.abac * ac, v = t.abab * ac - t.abac * ab;
    if (u >= 0.0 && v >= 0.0 && u + v <= determinant) return true;
  }
  const double squared = within_ * within_;
  return squared_from_segment(point, t.a, t.ab, t.abab) <= squared ||
         squared_from_segment(point, t.a, t.ac, t.acac) <= squared ||
         squared_from_segment(point, t.a + t.ab, t.bc, t.bcbc) <= squared;
}

void SurfaceBand::add_mesh(const TriangleMesh& mesh) {
  const auto corner = [&](const Eigen::Vector3i& t, int k) -> const Vector3d& {
    return mesh.vertices[static_cast<std::size_t>(t[k])];
  };
  for (const Eigen::Vector3i& t : mesh.triangles) {
    triangles_.push_back(triangle_of(corner(t, 0), corner(t, 1), corner(t, 2)));
    for (int k = 0; k < 3; ++k) box_.extend(corner(t, k));
  }
  nodes_.emplace_back();
  build(0, 0, static_cast<int>(triangles_.size()));
}

void SurfaceBand::build(int node, int first, int count) {
  Eigen::AlignedBox3d box, middles;
  const auto middle = [](const Triangle& t) { return Vector3d(t.a + (t.ab + t.ac) / 3.0); };
  for (int i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[static_cast<std::size_t>(i)];
    box.extend(t.a);
    box.extend(t.a + t.ab);
    box.extend(t.a + t.ac);
    middles.extend(middle(t));
  }
  box.min().array() -= within_;
  box.max().array() += within_;
  nodes_[static_cast<std::size_t>(node)].box = box;
  nodes_[static_cast<std::size_t>(node)].first = first;
  nodes_[static_cast<std::size_t>(node)].count = count;
  if (count <= kLeaf) return;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const auto begin = triangles_.begin() + first;
  const int half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](const Triangle& s, const Triangle& t) {
    return middle(s)[axis] < middle(t)[axis];
  });
  const int child = static_cast<int>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[static_cast<std::size_t>(node)].first = child;
  nodes_[static_cast<std::size_t>(node)].count = 0;
  build(child, first, half);
  build(child + 1, first + half, count - half);
}

bool SurfaceBand::contains(const Vector3d& point) {
  if (const Box* box = std::get_if<Box>(&geometry_)) return distance_from(*box, point) <= within_;
  if (const Cylinder* c = std::get_if<Cylinder>(&geometry_))
    return distance_from(*c, point) <= within_;
  if (const Sphere* s = std::get_if<Sphere>(&geometry_)) return distance_from(*s, point) <= within_;
  if (is_near(triangles_[static_cast<std::size_t>(last_)], point)) return true;
  std::array<int, 64> stack;
  int depth = 0;
  stack[0] = 0;
  while (depth >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(depth--)])];
    if (!node.box.contains(point)) continue;
    if (node.count == 0) {
      stack[static_cast<std::size_t>(++depth)] = node.first;
      stack[static_cast<std::size_t>(++depth)] = node.first + 1;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      if (!is_near(triangles_[static_cast<std::size_t>(i)], point)) continue;
      last_ = i;
      return true;
    }
  }
  return false;
}

}  // namespace handey::world
