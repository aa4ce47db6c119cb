#include "prism.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace handey::world {
namespace {

using Eigen::Vector3d;

constexpr double kExact = 1e-9;  // less is rounding [m]

}  // namespace

Eigen::AlignedBox3d extent(const Prism& solid) {
  Eigen::AlignedBox3d box;
  for (const std::vector<Vector3d>* ring : {&solid.lower, &solid.upper}) {
    for (const Vector3d& corner : *ring) box.extend(corner);
  }
  return box;
}

bool may_meet(const Prism& solid, const PlaceBox& box) {
  const std::size_t n = solid.lower.size();
  std::vector<Vector3d> local;
  for (const std::vector<Vector3d>* ring : {&solid.lower, &solid.upper}) {
    for (const Vector3d& corner : *ring) local.push_back(box.X_OD * corner);
  }
  Eigen::AlignedBox3d reach;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : local) {
    reach.extend(corner);
    middle += corner / static_cast<double>(2 * n);
  }
  if ((reach.min().array() > box.half.array()).any() ||
      (reach.max().array() < -box.half.array()).any()) {
    return false;
  }
  const auto parts = [&](Vector3d normal, const Vector3d& point) {
    if (normal.dot(middle - point) > 0.0) normal = -normal;
    double offset = -std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : local) offset = std::max(offset, normal.dot(corner));
    return -normal.cwiseAbs().dot(box.half) > offset;
  };
  for (const std::size_t ring : {std::size_t{0}, n}) {
    const Vector3d& p = local[ring];
    if (parts((local[ring + n / 3] - p).cross(local[ring + 2 * n / 3] - p), p)) return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (parts((local[n + j] - local[i]).cross(local[n + i] - local[j]), local[i])) return false;
  }
  return true;
}

Shape shape_of(const Prism& solid) {
  Shape shape;
  const Eigen::AlignedBox3d box = extent(solid);
  const auto is_corner = [&](const Vector3d& corner) {
    return (corner - box.min()).cwiseMin(box.max() - corner).isZero(kExact);
  };
  if (solid.lower.size() == 4 && std::all_of(solid.lower.begin(), solid.lower.end(), is_corner) &&
      std::all_of(solid.upper.begin(), solid.upper.end(), is_corner)) {
    shape.geometry = Box{box.sizes()};
    shape.X_BS.translation() = box.center();
    return shape;
  }
  const int n = static_cast<int>(solid.lower.size());
  TriangleMesh mesh;
  mesh.vertices = solid.lower;
  mesh.vertices.insert(mesh.vertices.end(), solid.upper.begin(), solid.upper.end());
  // A camera looks along +z: its upper ends are the nearer ones.
  const Vector3d up = solid.upper[0] - solid.lower[0];
  const bool turned =
      (solid.lower[1] - solid.lower[0]).cross(solid.lower[2] - solid.lower[0]).dot(up) < 0.0;
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.emplace_back(a, turned ? c : b, turned ? b : c);
  };
  for (int i = 2; i < n; ++i) {
    add(0, i, i - 1);
    add(n, n + i - 1, n + i);
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    add(i, j, n + j);
    add(i, n + j, n + i);
  }
  shape.geometry = MeshShape{std::make_shared<const TriangleMesh>(std::move(mesh)), true, true};
  return shape;
}

}  // namespace handey::world
