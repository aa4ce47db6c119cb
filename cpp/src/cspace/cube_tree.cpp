#include "cube_tree.hpp"

#include <algorithm>
#include <cmath>

#include "handey/stop.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector3d;

constexpr double kCoarsest = 0.128;  // Choice: edge of the coarsest cubes, at most [m]
constexpr int kSweeps = 8;           // Choice: of the projection; more would gain micrometres

/// No less than the distance of a point from a solid: that of some point of the solid. Dykstra's
/// projections onto the faces' half-spaces lead near the nearest one; what they stop short of is
/// gone towards the centre.
double distance_at_most(const InnerSolid& solid, const Vector3d& point) {
  const std::size_t faces = solid.normals.size();
  Vector3d x = point;
  std::vector<double> given(faces, 0.0);  // how far each half-space has moved it
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double most = 0.0;
    for (std::size_t i = 0; i < faces; ++i) {
      const double beyond = solid.normals[i].dot(x) + given[i] - solid.offsets[i];
      const double moved = std::max(beyond, 0.0);
      x += (given[i] - moved) * solid.normals[i];
      most = std::max(most, std::abs(given[i] - moved));
      given[i] = moved;
    }
    if (most < 1e-7) break;
  }
  const double depth = solid.depth(x);
  if (depth < 0.0) x += depth / (depth - solid.inradius) * (solid.centre - x);
  return (point - x).norm() + 1e-9;
}

}  // namespace

CubeTree::CubeTree(const SolidScene& scene, double radius, const Eigen::AlignedBox3d& box,
                   double finest)
    : radius_(radius), finest_(finest), lower_(box.min()) {
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    for (const InnerSolid& solid : scene.obstacles[i].solids) {
      if (!solid.normals.empty()) solids_.push_back({&solid, static_cast<int>(i)});
    }
  }
  while (finest_ * (2 << levels_) <= kCoarsest * (1.0 + 1e-9)) ++levels_;
  const double coarsest = finest_ * width(0);
  for (std::size_t a = 0; a < 3; ++a) {
    const double extent = box.sizes()[static_cast<Eigen::Index>(a)];
    count_[a] = std::max(1, static_cast<int>(std::ceil(extent / coarsest)));
  }
  for (int i = 0; i < count_[0]; ++i) {
    for (int j = 0; j < count_[1]; ++j) {
      for (int k = 0; k < count_[2]; ++k) {
        Cube cube;
        cube.corner = {i * width(0), j * width(0), k * width(0)};
        cubes_.push_back(std::move(cube));
      }
    }
  }
}

double CubeTree::edge(int level) const { return finest_ * width(level); }

Vector3d CubeTree::centre(int cube) const {
  const Cube& it = cubes_[static_cast<std::size_t>(cube)];
  const double half = 0.5 * width(it.level);
  return lower_ + finest_ * Vector3d(it.corner[0] + half, it.corner[1] + half, it.corner[2] + half);
}

int CubeTree::coarsest_at(const Index& index) const {
  const int whole = width(0);
  int at = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (index[a] < 0 || index[a] >= count_[a] * whole) return kOutside;
    at = at * count_[a] + index[a] / whole;
  }
  return at;
}

int CubeTree::at(const Vector3d& point) const {
  Index index;
  for (std::size_t a = 0; a < 3; ++a) {
    const Eigen::Index axis = static_cast<Eigen::Index>(a);
    index[a] = static_cast<int>(std::floor((point[axis] - lower_[axis]) / finest_));
  }
  int at = coarsest_at(index);
  while (at != kOutside && cubes_[static_cast<std::size_t>(at)].children >= 0) {
    const Cube& cube = cubes_[static_cast<std::size_t>(at)];
    const int half = width(cube.level + 1);
    int child = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      child = 2 * child + (index[a] - cube.corner[a] >= half ? 1 : 0);
    }
    at = cube.children + child;
  }
  return at;
}

void CubeTree::cut(int cube) {
  const int first = static_cast<int>(cubes_.size());
  for (int child = 0; child < 8; ++child) {
    const Cube& parent = cubes_[static_cast<std::size_t>(cube)];
    Cube part;
    part.level = parent.level + 1;
    const int half = width(part.level);
    part.corner = {parent.corner[0] + (child & 4 ? half : 0),
                   parent.corner[1] + (child & 2 ? half : 0),
                   parent.corner[2] + (child & 1 ? half : 0)};
    part.near = parent.near;
    cubes_.push_back(std::move(part));
  }
  cubes_[static_cast<std::size_t>(cube)].children = first;
  cubes_[static_cast<std::size_t>(cube)].near.clear();
}

CubeKind CubeTree::kind(int cube) {
  Cube& it = cubes_[static_cast<std::size_t>(cube)];
  if (it.kind == CubeKind::Unknown) classify(it);
  return it.kind;
}

void CubeTree::classify(Cube& cube) {
  throw_if_stopped();
  ++looked_at_;
  deepest_ = std::max(deepest_, cube.level);
  const double half = 0.5 * width(cube.level) * finest_;
  const double about = half * std::sqrt(3.0);  // radius of the ball that holds the cube
  const Vector3d corner(cube.corner[0], cube.corner[1], cube.corner[2]);
  const Vector3d middle = lower_ + finest_ * corner + Vector3d::Constant(half);
  std::vector<int> near;
  const auto look_at = [&](int index) {
    const Solid& it = solids_[static_cast<std::size_t>(index)];
    const InnerSolid& solid = *it.solid;
    if ((middle - solid.centre).norm() - solid.radius >= radius_ + about) return false;
    if (-solid.depth(middle) >= radius_ + about) return false;
    near.push_back(index);
    if (about >= radius_ + solid.inradius) return false;
    if (distance_at_most(solid, middle) + about >= radius_) return false;
    cube.blocker = it.obstacle;
    return true;
  };
  bool blocked = false;
  if (cube.level == 0) {
    for (std::size_t i = 0; i < solids_.size() && !blocked; ++i)
      blocked = look_at(static_cast<int>(i));
  } else {
    for (std::size_t i = 0; i < cube.near.size() && !blocked; ++i) blocked = look_at(cube.near[i]);
  }
  cube.kind = blocked ? CubeKind::Blocked : near.empty() ? CubeKind::Free : CubeKind::Doubt;
  cube.near = blocked ? std::vector<int>{} : std::move(near);
}

void CubeTree::collect(int cube, const Index& lower, const Index& upper,
                       std::vector<int>& found) const {
  const Cube& it = cubes_[static_cast<std::size_t>(cube)];
  const int wide = width(it.level);
  for (std::size_t a = 0; a < 3; ++a) {
    if (it.corner[a] >= upper[a] || it.corner[a] + wide <= lower[a]) return;
  }
  if (it.children < 0) {
    found.push_back(cube);
    return;
  }
  for (int child = 0; child < 8; ++child) collect(it.children + child, lower, upper, found);
}

void CubeTree::neighbours(int cube, std::vector<int>& found) const {
  found.clear();
  const Cube& it = cubes_[static_cast<std::size_t>(cube)];
  const int wide = width(it.level);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool upward : {false, true}) {
      // The layer of smallest cubes beside this one lies in one of the coarsest.
      Index lower = it.corner, upper;
      for (std::size_t a = 0; a < 3; ++a) upper[a] = lower[a] + wide;
      lower[axis] = upward ? upper[axis] : lower[axis] - 1;
      upper[axis] = lower[axis] + 1;
      const int coarsest = coarsest_at(lower);
      if (coarsest == kOutside) {
        found.push_back(kOutside);
      } else {
        collect(coarsest, lower, upper, found);
      }
    }
  }
}

}  // namespace handey::cspace
