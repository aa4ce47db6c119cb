// The gripper's shadow on the grasp plane: each shape of the fingers and of the hand's body, as the
// hull of its points seen along the closing axis, with its extent along that axis.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "handey/approach/bump_lines.hpp"
#include "handey/errors.hpp"

namespace handey {

namespace {

/// What of a convex polygon has a first coordinate of at least `least`.
Polygon cut_below(const Polygon& polygon, double least) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    if (a.x() >= least) result.push_back(a);
    if ((a.x() >= least) != (b.x() >= least)) {
      const double part = (least - a.x()) / (b.x() - a.x());
      result.emplace_back(least, a.y() + part * (b.y() - a.y()));
    }
  }
  return result;
}

}  // namespace

GripperOutline gripper_outline(const Robot& robot, double opening, bool flipped, double depth) {
  const Gripper& gripper = robot.gripper;
  if (!(opening >= gripper.min_opening - 1e-9 && opening <= gripper.max_opening + 1e-9)) {
    throw InvalidInput("E_RANGE", "gripper outline",
                       "opening " + std::to_string(opening) + " m; the jaw opens from " +
                           std::to_string(gripper.min_opening) + " to " +
                           std::to_string(gripper.max_opening) + " m");
  }
  if (!std::isfinite(depth) || depth <= 0.0) {
    throw InvalidInput("E_RANGE", "gripper outline", "depth must be positive");
  }
  // The hand is rigid but for the fingers, so any arm configuration serves.
  const std::vector<Pose> X_RB = body_poses(robot, {robot.home, opening});
  const Pose X_HR =
      (X_RB[static_cast<std::size_t>(gripper.body)] * gripper.X_BH).inverse(Eigen::Isometry);
  const double side = flipped ? -1.0 : 1.0;
  GripperOutline outline;
  for (const int body : {gripper.fingers[0].child, gripper.fingers[1].child, gripper.body}) {
    const Pose X_HB = X_HR * X_RB[static_cast<std::size_t>(body)];
    for (const Shape& shape : robot.bodies[static_cast<std::size_t>(body)].shapes) {
      std::vector<Eigen::Vector2d> shadow;
      OutlinePiece piece;
      piece.lower = std::numeric_limits<double>::infinity();
      piece.upper = -piece.lower;
      for (const Eigen::Vector3d& point : hull_points(shape)) {
        const Eigen::Vector3d p = X_HB * point;
        shadow.emplace_back(p.z(), side * p.x());
        piece.lower = std::min(piece.lower, side * p.y());
        piece.upper = std::max(piece.upper, side * p.y());
      }
      piece.polygon = convex_hull(cut_below(convex_hull(shadow), -depth));
      if (piece.polygon.size() < 3) continue;
      for (const Eigen::Vector2d& point : piece.polygon) {
        outline.radius = std::max(outline.radius, point.norm());
      }
      outline.pieces.push_back(piece);
    }
  }
  return outline;
}

}  // namespace handey
