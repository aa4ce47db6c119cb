// The relaxation method on two convex solids.
#include "handey/collision/overlap_proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr double kLeastOverlap = 1e-6;  // beyond rounding [m]
constexpr int kSteps = 14;              // Choice: proofs that succeed mostly take 2 to 8
constexpr double kInward = 1e-3;        // how far inside a face a step from outside aims [m]
constexpr double kAim = 1e-4;           // how far beyond enough a step aims [m]

struct Depth {
  double value = std::numeric_limits<double>::infinity();
  Vector3d outward = Vector3d::Zero();
};

/// Depth of a point, both in R; the face's normal in R.
Depth depth_in(const PlacedSolid& placed, const Vector3d& x) {
  const InnerSolid& solid = placed.solid;
  const Vector3d point = placed.X_RS.linear().transpose() * (x - placed.X_RS.translation());
  Depth depth;
  std::size_t face = 0;
  for (std::size_t i = 0; i < solid.normals.size(); ++i) {
    const double here = solid.offsets[i] - solid.normals[i].dot(point);
    if (here < depth.value) {
      depth.value = here;
      face = i;
    }
  }
  depth.outward = placed.X_RS.linear() * solid.normals[face];
  return depth;
}

/// The sum of |v_j| chord_j: how far rotations one after another can carry a point.
double chords(const AxisMotion* axes, int begin, int end, const Vector3d& x, Vector3d* gradient) {
  double sum = 0.0;
  for (int j = begin; j < end; ++j) {
    const Vector3d velocity = axes[j].direction.cross(x - axes[j].point);
    const double speed = velocity.norm();
    sum += axes[j].chord * speed;
    if (gradient != nullptr && speed > 1e-12) {
      *gradient += (axes[j].chord / speed) * velocity.cross(axes[j].direction);
    }
  }
  return sum;
}

/// The joints of the cell turn about axes that are not in line: their motions do not add up. First
/// order exactly, the rest bounded. Rotations R1 R2 R3 x - x = sum (Rj - 1) x plus
/// (R2 - 1)(R3 x - x) + (R1 - 1)(R2 R3 x - x).
double joint_bound(const AxisMotion* axes, int begin, int end, const Vector3d& x,
                   Vector3d* gradient) {
  Vector3d steps[3];
  double rest = 0.0, inner = 0.0;
  const int count = end - begin;
  for (int k = 0; k < count; ++k) {  // inmost first
    const AxisMotion& axis = axes[end - 1 - k];
    const Vector3d velocity = axis.direction.cross(x - axis.point);
    const double speed = velocity.norm();
    steps[k] = axis.sine * velocity;
    rest += axis.versed * speed + axis.chord * inner;
    inner += axis.chord * speed;
  }
  double longest = -1.0;
  int best = 0;
  Vector3d along = Vector3d::Zero();
  for (int signs = 0; signs < (1 << (count - 1)); ++signs) {
    Vector3d sum = steps[0];
    for (int k = 1; k < count; ++k) {
      if ((signs >> (k - 1) & 1) != 0) {
        sum -= steps[k];
      } else {
        sum += steps[k];
      }
    }
    const double length = sum.squaredNorm();
    if (length > longest) {
      longest = length;
      best = signs;
      along = sum;
    }
  }
  longest = std::sqrt(longest);
  if (gradient != nullptr && longest > 1e-12) {
    along /= longest;
    for (int k = 0; k < count; ++k) {
      const AxisMotion& axis = axes[end - 1 - k];
      const bool minus = k > 0 && (best >> (k - 1) & 1) != 0;
      *gradient += (minus ? -axis.sine : axis.sine) * along.cross(axis.direction);
    }
  }
  return longest + rest;
}

}  // namespace

double RelativeMotion::bound(const Vector3d& x, Vector3d* gradient) const {
  Vector3d slope = Vector3d::Zero(), other = Vector3d::Zero();
  Vector3d* const wanted = gradient != nullptr ? &slope : nullptr;
  double result = chords(axes, cell_begin, cell_end, x, wanted);
  if (cell_end - cell_begin > 1) {
    const double joint =
        joint_bound(axes, cell_begin, cell_end, x, gradient != nullptr ? &other : nullptr);
    if (joint < result) {
      result = joint;
      slope = other;
    }
  }
  result += chords(axes, cell_end, free_end, x, wanted);
  if (gradient != nullptr) *gradient = slope;
  return result;
}

bool overlaps_throughout(const PlacedSolid& a, const PlacedSolid& b, const RelativeMotion& motion,
                         Vector3d& x) {
  const Vector3d centre_a = a.X_RS * a.solid.centre, centre_b = b.X_RS * b.solid.centre;
  for (int step = 0; step < kSteps; ++step) {
    const Depth in_a = depth_in(a, x), in_b = depth_in(b, x);
    if (in_a.value < 0.0 || in_b.value < 0.0) {
      const Depth& deeper = in_a.value < in_b.value ? in_a : in_b;
      x += (deeper.value - kInward) * deeper.outward;
      continue;
    }
    Vector3d slope;
    const double excess = in_a.value + in_b.value - motion.bound(x, &slope);
    if (excess > kLeastOverlap) return true;
    slope = -slope - in_a.outward - in_b.outward;
    const double steep = slope.norm();
    if (steep < 1e-9) return false;  // the top
    // By concavity no point of either ball is good enough.
    if (excess + slope.dot(centre_a - x) + steep * a.solid.radius < 0.0) return false;
    if (excess + slope.dot(centre_b - x) + steep * b.solid.radius < 0.0) return false;
    x += slope * ((kAim - excess) / (steep * steep));
  }
  return false;
}

bool plainly_apart(const PlacedSolid& a, const PlacedSolid& b, double motion) {
  const Vector3d centre_a = a.X_RS * a.solid.centre, centre_b = b.X_RS * b.solid.centre;
  if ((centre_a - centre_b).norm() > a.solid.radius + b.solid.radius + motion) return true;
  return depth_in(b, centre_a).value < -(a.solid.radius + motion) ||
         depth_in(a, centre_b).value < -(b.solid.radius + motion);
}

}  // namespace handey
