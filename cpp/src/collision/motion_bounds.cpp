// Motion bounds by joint, from the last joint inwards.
#include "motion_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace handey::collision {

using Eigen::Vector3d;

MotionBounds::MotionBounds(const CollisionChecker::Impl& checker)
    : checker_(checker),
      pieces_(checker.movers.size()),
      movers_(checker.movers.size()),
      axes_(checker.model->robot->joints.size()),
      points_(axes_.size()) {
  for (std::size_t m = 0; m < pieces_.size(); ++m) {
    const std::size_t depth = static_cast<std::size_t>(checker.movers[m].depth);
    pieces_[m].resize(checker.movers[m].geometry->pieces.size());
    for (Entry& entry : pieces_[m]) {
      entry.beyond.resize(depth + 1);
      entry.distance.resize(depth);
    }
    movers_[m].beyond.resize(depth + 1);
    movers_[m].distance.resize(depth);
  }
}

void MotionBounds::set(const Eigen::VectorXd& half_turns, double half_slide, bool together) {
  together_ = together;
  half_turns_ = half_turns;
  half_slide_ = half_slide;
  ++stamp_;
  const std::vector<ArmJoint>& joints = checker_.model->robot->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    // The axis is the same line in the child's frame, which the joint turns about it.
    const Pose& X_RC = checker_.X_RB[static_cast<std::size_t>(joints[j].child)];
    axes_[j] = X_RC.linear() * joints[j].axis;
    points_[j] = X_RC.translation();
  }
}

template <class Distance>
void MotionBounds::fill(Entry& entry, const Mover& mover,
                        const Distance& distance_from_axis) const {
  entry.stamp = stamp_;
  double motion = mover.finger ? half_slide_ : 0.0;
  std::size_t d = static_cast<std::size_t>(mover.depth);
  entry.beyond[d] = motion;
  while (d-- > 0) {
    const double turn = std::abs(half_turns_[static_cast<Eigen::Index>(d)]);
    entry.distance[d] = 0.0;  // not asked for where the joint stands still
    if (turn > 0.0) {
      entry.distance[d] = distance_from_axis(d) + motion;
      motion += entry.distance[d] * turn;
    }
    entry.beyond[d] = motion;
  }
}

MotionBounds::Entry& MotionBounds::piece_entry(int m, int p) {
  Entry& entry = pieces_[static_cast<std::size_t>(m)][static_cast<std::size_t>(p)];
  if (entry.stamp == stamp_) return entry;
  const OrientedBox& box = checker_.piece(m, p).box;
  const Pose X_RO = checker_.X_RM[static_cast<std::size_t>(m)] * box.X_BO;
  std::array<Vector3d, 8>& corners = entry.corners;
  for (std::size_t c = 0; c < 8; ++c) {
    const Vector3d corner((c & 1U) ? box.half.x() : -box.half.x(),
                          (c & 2U) ? box.half.y() : -box.half.y(),
                          (c & 4U) ? box.half.z() : -box.half.z());
    corners[c] = X_RO * corner;
  }
  fill(entry, checker_.movers[static_cast<std::size_t>(m)], [&](std::size_t j) {
    // Distance from a line is convex, so it is greatest at a corner.
    double squared = 0.0;
    for (const Vector3d& corner : corners) {
      const Vector3d arm = corner - points_[j];
      squared = std::max(squared, arm.cross(axes_[j]).squaredNorm());
    }
    return std::sqrt(squared);
  });
  return entry;
}

MotionBounds::Entry& MotionBounds::mover_entry(int m) {
  Entry& entry = movers_[static_cast<std::size_t>(m)];
  if (entry.stamp == stamp_) return entry;
  const Mover& mover = checker_.movers[static_cast<std::size_t>(m)];
  const Vector3d& centre = checker_.mover_centres[static_cast<std::size_t>(m)];
  fill(entry, mover, [&](std::size_t j) {
    return (centre - points_[j]).cross(axes_[j]).norm() + mover.geometry->radius;
  });
  return entry;
}

double MotionBounds::piece_motion(int mover, int piece, int depth) {
  return piece_entry(mover, piece).beyond[static_cast<std::size_t>(depth)];
}

double MotionBounds::mover_motion(int mover, int depth) {
  return mover_entry(mover).beyond[static_cast<std::size_t>(depth)];
}

double MotionBounds::approach(const PiecePair& pair) {
  const auto motion = [this](int mover, int piece, int depth) {
    return piece < 0 ? mover_motion(mover, depth) : piece_motion(mover, piece, depth);
  };
  if (pair.other < 0) return motion(pair.mover, pair.piece, 0);
  // Joints that move both do not change their distance: both are seen from the body that the fewer
  // joints move.
  const int common = std::min(checker_.movers[static_cast<std::size_t>(pair.mover)].depth,
                              checker_.movers[static_cast<std::size_t>(pair.other)].depth);
  return motion(pair.mover, pair.piece, common) + motion(pair.other, pair.other_piece, common);
}

double MotionBounds::piece_motion_along(int m, int p, int depth, const Vector3d& direction) {
  const Entry& entry = piece_entry(m, p);
  const Mover& mover = checker_.movers[static_cast<std::size_t>(m)];
  const std::size_t first = static_cast<std::size_t>(depth);
  const std::size_t last = static_cast<std::size_t>(mover.depth);
  // Velocity along the direction, per joint, is linear in the point: c -> c.g + h. The absolute
  // value of it, and of sums of it, is greatest at a corner.
  std::array<double, 8> linear{};
  std::array<double, 8> sum{};
  double rest = mover.finger ? half_slide_ : 0.0;
  double proximal = 0.0;
  for (std::size_t j = first; j < last; ++j) {
    const double turn = half_turns_[static_cast<Eigen::Index>(j)];
    if (turn == 0.0) continue;
    const Vector3d gradient = direction.cross(axes_[j]) * turn;
    const double offset = gradient.dot(points_[j]);
    for (std::size_t c = 0; c < 8; ++c) {
      const double velocity = gradient.dot(entry.corners[c]) - offset;
      sum[c] += velocity;
      linear[c] += std::abs(velocity);
    }
    // Second derivatives: d2x / dqi dqj is no longer than the distance from the axis of the farther
    // joint; half of the sum over all pairs.
    const double size = std::abs(turn);
    rest += entry.distance[j] * size * (0.5 * size + proximal);
    proximal += size;
  }
  double most = 0.0;
  for (std::size_t c = 0; c < 8; ++c) {
    most = std::max(most, together_ ? std::abs(sum[c]) : linear[c]);
  }
  return most + rest;
}

double MotionBounds::approach_along(const PiecePair& pair, const Vector3d& direction) {
  if (pair.other < 0) return piece_motion_along(pair.mover, pair.piece, 0, direction);
  const int common = std::min(checker_.movers[static_cast<std::size_t>(pair.mover)].depth,
                              checker_.movers[static_cast<std::size_t>(pair.other)].depth);
  return piece_motion_along(pair.mover, pair.piece, common, direction) +
         piece_motion_along(pair.other, pair.other_piece, common, direction);
}

}  // namespace handey::collision
