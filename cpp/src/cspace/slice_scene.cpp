// Which mover is what: by the number of joints that move it, and by its place in the hand.
#include "slice_scene.hpp"

#include <algorithm>
#include <cmath>

#include "hand_balls.hpp"
#include "wrist_proof.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector3d;

enum class Role { Base, Waist, Upper, Lower, Turning, Hand };

/// A mover's role, and by ball of the hand the radius that holds it.
struct Actor {
  Role role = Role::Base;
  std::vector<double> radii;
};

Role role_of(const SceneMover& mover, bool held, const ArmTable::Impl& table) {
  if (mover.depth == 0) return Role::Base;
  if (mover.depth == 1) return Role::Waist;
  if (mover.depth == 2) return Role::Upper;
  if (held || mover.finger) return Role::Hand;
  if (mover.depth == 3) return Role::Lower;
  return mover.depth == 4 && !table.turning.empty() ? Role::Turning : Role::Hand;
}

/// The mover's pieces in the body that its last joint moves, fingers at the opening.
void add_pieces(const SceneMover& mover, int index, const Robot& robot, double opening,
                std::vector<HandPiece>& pieces) {
  Pose X = mover.X_BM;
  for (const FingerJoint& finger : robot.gripper.fingers) {
    if (!mover.finger || finger.child != mover.body) continue;
    X = finger.X_PJ * Eigen::Translation3d(0.5 * opening * finger.axis) * X;
  }
  for (const SceneHull& hull : mover.hulls) {
    HandPiece piece{index, mover.depth, {}};
    for (const Vector3d& point : hull.points) piece.points.push_back(X * point);
    pieces.push_back(std::move(piece));
  }
}

struct WristBox {
  const Eigen::VectorXd& lower;
  const Eigen::VectorXd& upper;
  double opening, clearance;
};

/// Finds the roles, the balls of the hand, and whether it keeps clear of the forearm.
std::vector<Actor> cast(const Scene& scene, const Robot& robot, const ArmTable::Impl& table,
                        const WristBox& wrist, SliceScene& result) {
  std::vector<PlaneBall>& balls = result.balls;
  std::vector<Actor> actors(scene.movers.size());
  std::vector<HandPiece> pieces;
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    actors[m].role = role_of(scene.movers[m], m >= robot.bodies.size(), table);
    if (scene.movers[m].depth < 3) continue;
    add_pieces(scene.movers[m], static_cast<int>(m), robot, wrist.opening, pieces);
  }
  result.hand_keeps_clear =
      keeps_clear(robot, pieces, scene.mover_pairs, wrist.lower, wrist.upper, wrist.clearance);
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                              [&](const HandPiece& piece) {
                                return actors[static_cast<std::size_t>(piece.mover)].role !=
                                       Role::Hand;
                              }),
               pieces.end());
  const ArmPlane& plane = table.links.plane;
  const Pose X_E3 = plane.X_1E.inverse() * robot.joints[1].X_PJ * robot.joints[2].X_PJ;
  for (const HandBall& ball :
       hand_balls(robot, table.links.wrist_in_body, pieces, wrist.lower, wrist.upper)) {
    const Vector3d centre = X_E3 * ball.centre;
    PlaneBall in_plane{centre.head<2>() - plane.elbow, centre.z(), {}};
    in_plane.columns = ball.at_wrist ? table.wrist
                                     : WristColumns(table.grid, table.lattice, table.level, plane,
                                                    in_plane.centre);
    balls.push_back(std::move(in_plane));
    for (Actor& actor : actors) actor.radii.resize(balls.size(), 0.0);
    for (const std::pair<int, double>& held : ball.radii) {
      double& radius = actors[static_cast<std::size_t>(held.first)].radii.back();
      radius = std::max(radius, held.second);
    }
  }
  return actors;
}

/// The same hull with its points in the order of their heights along an axis.
SceneHull sorted_along(const Vector3d& axis, const SceneHull& hull) {
  const std::size_t count = hull.points.size();
  std::vector<std::pair<double, int>> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = {axis.dot(hull.points[i]), static_cast<int>(i)};
  }
  std::sort(order.begin(), order.end());
  SceneHull sorted;
  std::vector<int> place(count);
  sorted.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = static_cast<std::size_t>(order[i].second);
    place[from] = static_cast<int>(i);
    sorted.points.push_back(hull.points[from]);
  }
  sorted.edges.reserve(hull.edges.size());
  for (const std::pair<int, int>& edge : hull.edges) {
    sorted.edges.emplace_back(place[static_cast<std::size_t>(edge.first)],
                              place[static_cast<std::size_t>(edge.second)]);
  }
  return sorted;
}

Standing standing_hull(SceneHull hull, const Pose& X, const Vector3d& waist_axis,
                       const Concerns& concerns) {
  for (Vector3d& point : hull.points) point = X * point;
  Standing standing;
  standing.concerns = concerns;
  standing.hull = sorted_along(waist_axis, hull);
  Eigen::AlignedBox3d extent;
  for (const Vector3d& point : standing.hull.points) extent.extend(point);
  standing.centre = extent.center();
  for (const Vector3d& point : standing.hull.points) {
    standing.radius = std::max(standing.radius, (point - standing.centre).norm());
  }
  return standing;
}

void concern(Concerns& concerns, const Actor& actor) {
  switch (actor.role) {
    case Role::Base:
      return;
    case Role::Waist:
      concerns.waist_body = true;
      return;
    case Role::Upper:
      concerns.upper = true;
      return;
    case Role::Lower:
      concerns.lower = true;
      return;
    case Role::Turning:
      concerns.turning = true;
      return;
    case Role::Hand:
      concerns.hand.resize(actor.radii.size(), 0.0);
      for (std::size_t i = 0; i < actor.radii.size(); ++i) {
        concerns.hand[i] = std::max(concerns.hand[i], actor.radii[i]);
      }
      return;
  }
}

/// The hulls of the movers of one role, each with what it is kept apart from beyond its own joint.
std::vector<Standing> own_bodies(const Scene& scene, const std::vector<Actor>& actors, Role role,
                                 const Pose& X, const Vector3d& waist_axis) {
  std::vector<Standing> all;
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    if (actors[m].role != role || scene.movers[m].finger) continue;
    Concerns concerns;
    for (const std::pair<int, int>& pair : scene.mover_pairs) {
      const std::size_t a = static_cast<std::size_t>(pair.first),
                        b = static_cast<std::size_t>(pair.second);
      if (a == m && actors[b].role > role) concern(concerns, actors[b]);
      if (b == m && actors[a].role > role) concern(concerns, actors[a]);
    }
    for (const SceneHull& hull : scene.movers[m].hulls) {
      all.push_back(standing_hull(hull, X * scene.movers[m].X_BM, waist_axis, concerns));
    }
  }
  return all;
}

std::vector<LinkGroup> waist_outlines(const Scene& scene, const std::vector<Actor>& actors,
                                      const ArmPlane& plane) {
  std::vector<LinkGroup> groups;
  const Pose X_E1 = plane.X_1E.inverse();
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    if (actors[m].role != Role::Waist) continue;
    for (const SceneHull& hull : scene.movers[m].hulls) {
      std::vector<Vector3d> points;
      for (const Vector3d& point : hull.points) points.push_back(X_E1 * point);
      groups.push_back(outline_of(points, Eigen::Vector2d::Zero()));
    }
  }
  return groups;
}

}  // namespace

SliceScene make_slice_scene(CollisionChecker& checker, const ArmTable::Impl& table,
                            const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                            double opening, double clearance) {
  const Scene scene = describe_scene(checker);
  const Robot& robot = *checker.cell().robot;
  SliceScene result;
  const std::vector<Actor> actors =
      cast(scene, robot, table, {lower, upper, opening, clearance}, result);
  result.rings = table.grid.rings;
  for (const PlaneBall& ball : result.balls) {
    result.rings = std::max(result.rings, ball.columns.last_ring());
  }
  const ArmPlane& plane = table.links.plane;
  const Vector3d axis = plane.X_RE(0.0).linear() * plane.waist_axis;
  const Pose& X_R1 = plane.X_R1;
  result.standing = own_bodies(scene, actors, Role::Base, Pose::Identity(), axis);
  result.waist = own_bodies(scene, actors, Role::Waist, X_R1, axis);
  result.upper_arm = own_bodies(scene, actors, Role::Upper, X_R1 * robot.joints[1].X_PJ, axis);
  result.waist_body = waist_outlines(scene, actors, plane);
  for (const SceneObstacle& obstacle : scene.obstacles) {
    Concerns concerns;
    for (std::size_t m = 0; m < actors.size(); ++m) {
      if (obstacle.checked[m]) concern(concerns, actors[m]);
    }
    for (const SceneHull& hull : obstacle.hulls) {
      result.standing.push_back(standing_hull(hull, Pose::Identity(), axis, concerns));
    }
  }
  return result;
}

}  // namespace handey::cspace
