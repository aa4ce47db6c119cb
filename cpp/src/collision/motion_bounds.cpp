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
    for (Entry& entry : pieces_[m]) entry.beyond.resize(depth + 1);
    movers_[m].beyond.resize(depth + 1);
  }
}

void MotionBounds::set(const Eigen::VectorXd& half_turns, double half_slide) {
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
    const double turn = half_turns_[static_cast<Eigen::Index>(d)];
    if (turn > 0.0) motion += (distance_from_axis(d) + motion) * turn;
    entry.beyond[d] = motion;
  }
}

MotionBounds::Entry& MotionBounds::piece_entry(int m, int p) {
  Entry& entry = pieces_[static_cast<std::size_t>(m)][static_cast<std::size_t>(p)];
  if (entry.stamp == stamp_) return entry;
  const OrientedBox& box = checker_.piece(m, p).box;
  const Pose X_RO = checker_.X_RM[static_cast<std::size_t>(m)] * box.X_BO;
  std::array<Vector3d, 8> corners;
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

}  // namespace handey::collision
