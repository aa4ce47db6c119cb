// What of the robot lies in the arm's plane: the links that the second and third joint move, as
// outlines in lateral slabs, and the point about which the hand turns. Errs on the large side: a
// link is within its outlines times their slabs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "handey/cspace/cross_section.hpp"

namespace handey::cspace {

/// All of a link that lies within a lateral slab: convex outlines in the plane.
struct LinkGroup {
  Slab slab;                      ///< along z of E [m]
  std::vector<Polygon> outlines;  ///< in (x, y) of E at q2 = q3 = 0 [m]
};

struct ArmLinks {
  ArmPlane plane;
  std::vector<LinkGroup> upper;  ///< of the body that joint 2 moves; about the origin of E
  std::vector<LinkGroup> lower;  ///< of the body that joint 3 moves; about the elbow
  /// What joint 4 moves, all the way round its axis; empty if that lies within the ball that the
  /// hand beyond it needs anyway. About the elbow.
  std::vector<LinkGroup> turning;
  /// Where the axes after the third meet, or come nearest to each other: in the body that joint 3
  /// moves, and at q2 = q3 = 0 in E, in the plane about the elbow.
  Eigen::Vector3d wrist_in_body = Eigen::Vector3d::Zero();
  Eigen::Vector2d wrist = Eigen::Vector2d::Zero();
  double wrist_lateral = 0.0;
};

/// @return nothing, and why in `reason`, for arms whose second and third axes are not parallel
std::optional<ArmLinks> arm_links(const Robot& robot, std::string* reason);

/// The shadow of points in E along z, in the plane about a point of it.
LinkGroup outline_of(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector2d& about);

/// What an outline about the elbow sweeps while it turns from angle - half to angle + half: the arc
/// of a corner is in the triangle of its ends and the point where the tangents there meet.
Polygon swept(const Polygon& outline, double angle, double half, const Eigen::Vector2d& elbow);

/// Number of arm joints that move each body.
std::vector<int> joint_depths(const Robot& robot);

/// Radius of a ball about the wrist point that holds `points`, fixed to the body that joint `depth`
/// (3 or more) moves, whatever the joints from the fourth on do. @param points in that body
double hand_radius(const Robot& robot, const Eigen::Vector3d& wrist_in_body, int depth,
                   const std::vector<Eigen::Vector3d>& points);

}  // namespace handey::cspace
