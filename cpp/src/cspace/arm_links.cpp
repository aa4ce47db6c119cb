// Hulls of the robot's shapes, projected along axis 2.
#include "arm_links.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "polar_raster.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSameSlab = 0.005;  // Choice: slabs that differ by less are one [m]
constexpr double kRounding = 1e-7;   // outlines are grown by this [m]
constexpr int kTurnSides = 16;       // of the polyhedron round what joint 4 turns

/// The pose of a body at zero of all joints, from the body that joint `after` (1 to ...) moves.
Pose pose_at_zero(const Robot& robot, int after, int depth) {
  Pose pose = Pose::Identity();
  for (int j = after; j < depth; ++j) pose = pose * robot.joints[static_cast<std::size_t>(j)].X_PJ;
  return pose;
}

/// Adds a group to those whose slab is nearly the same.
void join(std::vector<LinkGroup>& groups, LinkGroup added) {
  for (LinkGroup& group : groups) {
    if (std::abs(group.slab.lower - added.slab.lower) > kSameSlab ||
        std::abs(group.slab.upper - added.slab.upper) > kSameSlab) {
      continue;
    }
    group.slab.lower = std::min(group.slab.lower, added.slab.lower);
    group.slab.upper = std::max(group.slab.upper, added.slab.upper);
    for (Polygon& outline : added.outlines) group.outlines.push_back(std::move(outline));
    return;
  }
  groups.push_back(std::move(added));
}

std::vector<LinkGroup> groups_of(const RobotBody& body, const Pose& X_EB, const Vector2d& about) {
  std::vector<LinkGroup> groups;
  for (const Shape& shape : body.shapes) {
    std::vector<Vector3d> points = hull_points(shape);
    for (Vector3d& point : points) point = X_EB * point;
    join(groups, outline_of(points, about));
  }
  return groups;
}

struct Line {
  Vector3d point, direction;
};

/// Axis of joint `joint` (0 is the first), with all joints at zero, in the body that joint `after`
/// moves.
Line axis_at_zero(const Robot& robot, int after, int joint) {
  const Pose X = pose_at_zero(robot, after, joint + 1);
  return {X.translation(), X.linear() * robot.joints[static_cast<std::size_t>(joint)].axis};
}

/// The point nearest to the axes after the third, in the body that joint 3 moves.
Vector3d find_wrist(const Robot& robot) {
  const int count = static_cast<int>(robot.joints.size());
  const Vector3d hand = (pose_at_zero(robot, 3, count) * robot.gripper.X_BH).translation();
  // A trace of the hand's own place decides what the axes leave open.
  constexpr double kTrace = 1e-9;
  Eigen::Matrix3d sum = kTrace * Eigen::Matrix3d::Identity();
  Vector3d right = kTrace * hand;
  for (int j = 3; j < std::min(count, 6); ++j) {
    const Line axis = axis_at_zero(robot, 3, j);
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - axis.direction * axis.direction.transpose();
    sum += across;
    right += across * axis.point;
  }
  return sum.ldlt().solve(right);
}

std::vector<Vector3d> points_of(const RobotBody& body) {
  std::vector<Vector3d> points;
  for (const Shape& shape : body.shapes) {
    const std::vector<Vector3d> hull = hull_points(shape);
    points.insert(points.end(), hull.begin(), hull.end());
  }
  return points;
}

/// The body that joint 4 moves, turned all the way, as points whose hull contains it.
std::vector<Vector3d> turned(const Robot& robot, const std::vector<Vector3d>& points) {
  const Vector3d axis = robot.joints[3].axis;
  const double outwards = 1.0 / std::cos(kPi / kTurnSides);
  std::vector<Vector3d> all;
  for (const Vector3d& point : points) {
    const Vector3d along = axis * axis.dot(point), radial = outwards * (point - along);
    const Vector3d sideways = axis.cross(radial);
    for (int i = 0; i < kTurnSides; ++i) {
      const double angle = 2.0 * kPi * i / kTurnSides;
      all.push_back(along + std::cos(angle) * radial + std::sin(angle) * sideways);
    }
  }
  return all;
}

double rest_radius(const Robot& robot, const Vector3d& wrist, const std::vector<int>& depths) {
  double radius = 0.0;
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    if (depths[b] < 5) continue;
    radius = std::max(radius, hand_radius(robot, wrist, depths[b], points_of(robot.bodies[b])));
  }
  return radius;
}

void add_turning(const Robot& robot, const Pose& X_E3, ArmLinks& links) {
  if (robot.joints.size() < 5) return;
  const RobotBody& body = robot.bodies[static_cast<std::size_t>(robot.joints[3].child)];
  const std::vector<Vector3d> points = points_of(body);
  const double rest = rest_radius(robot, links.wrist_in_body, joint_depths(robot));
  if (points.empty() || hand_radius(robot, links.wrist_in_body, 4, points) <= rest) return;
  std::vector<Vector3d> all = turned(robot, points);
  for (Vector3d& point : all) point = X_E3 * robot.joints[3].X_PJ * point;
  links.turning.push_back(outline_of(all, links.plane.elbow));
}

}  // namespace

LinkGroup outline_of(const std::vector<Vector3d>& points, const Vector2d& about) {
  LinkGroup group;
  std::vector<Vector2d> flat;
  group.slab = {points.front().z(), points.front().z()};
  for (const Vector3d& point : points) {
    flat.emplace_back(point.head<2>() - about);
    group.slab.lower = std::min(group.slab.lower, point.z());
    group.slab.upper = std::max(group.slab.upper, point.z());
  }
  group.outlines.push_back(convex_hull(flat));
  return group;
}

Polygon swept(const Polygon& outline, double angle, double half, const Vector2d& elbow) {
  std::vector<Vector2d> points;
  for (const Vector2d& corner : outline) {
    points.push_back(elbow + Eigen::Rotation2Dd(angle - half) * corner);
    points.push_back(elbow + Eigen::Rotation2Dd(angle + half) * corner);
    points.push_back(elbow + Eigen::Rotation2Dd(angle) * corner / std::cos(half));
  }
  Polygon grown;
  grow(convex_hull(points), kRounding, 1.6, grown);
  return grown;
}

std::vector<int> joint_depths(const Robot& robot) {
  std::vector<int> depths(robot.bodies.size(), 0);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    depths[static_cast<std::size_t>(robot.joints[j].child)] = static_cast<int>(j) + 1;
  }
  for (const FingerJoint& finger : robot.gripper.fingers) {
    depths[static_cast<std::size_t>(finger.child)] =
        depths[static_cast<std::size_t>(finger.parent)];
  }
  return depths;
}

double hand_radius(const Robot& robot, const Vector3d& wrist_in_body, int depth,
                   const std::vector<Vector3d>& points) {
  // From axis to axis: the point of each axis that is nearest to the wrist is fixed in the bodies
  // on both sides of the joint, so the way along these points keeps its length.
  double way = 0.0;
  Vector3d last = wrist_in_body;
  for (int j = 3; j < depth; ++j) {
    const Line axis = axis_at_zero(robot, 3, j);
    const Vector3d next =
        axis.point + axis.direction * axis.direction.dot(wrist_in_body - axis.point);
    way += (next - last).norm();
    last = next;
  }
  const Pose X_3B = pose_at_zero(robot, 3, depth);
  double farthest = 0.0;
  for (const Vector3d& point : points) farthest = std::max(farthest, (X_3B * point - last).norm());
  return way + farthest;
}

std::optional<ArmLinks> arm_links(const Robot& robot, std::string* reason) {
  const std::optional<ArmPlane> plane = arm_plane(robot, reason);
  if (!plane) return std::nullopt;
  const std::vector<int> depths = joint_depths(robot);
  for (const FingerJoint& finger : robot.gripper.fingers) {
    if (depths[static_cast<std::size_t>(finger.child)] >= 3) continue;
    if (reason != nullptr) *reason = "the hand is not moved by the third joint";
    return std::nullopt;
  }
  ArmLinks links;
  links.plane = *plane;
  const Pose X_E1 = plane->X_1E.inverse();
  const Pose X_E2 = X_E1 * robot.joints[1].X_PJ, X_E3 = X_E2 * robot.joints[2].X_PJ;
  const auto body = [&](std::size_t joint) -> const RobotBody& {
    return robot.bodies[static_cast<std::size_t>(robot.joints[joint].child)];
  };
  links.upper = groups_of(body(1), X_E2, Vector2d::Zero());
  links.lower = groups_of(body(2), X_E3, plane->elbow);
  links.wrist_in_body = find_wrist(robot);
  const Vector3d wrist = X_E3 * links.wrist_in_body;
  links.wrist = wrist.head<2>() - plane->elbow;
  links.wrist_lateral = wrist.z();
  add_turning(robot, X_E3, links);
  return links;
}

}  // namespace handey::cspace
