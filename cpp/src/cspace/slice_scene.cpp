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

Standing standing_hull(SceneHull hull, const Pose& X) {
  Standing standing;
  standing.hull = std::move(hull);
  Eigen::AlignedBox3d extent;
  for (Vector3d& point : standing.hull.points) {
    point = X * point;
    extent.extend(point);
  }
  standing.centre = extent.center();
  for (const Vector3d& point : standing.hull.points) {
    standing.radius = std::max(standing.radius, (point - standing.centre).norm());
  }
  return standing;
}

void concern(Standing& standing, const Actor& actor) {
  switch (actor.role) {
    case Role::Base:
      return;
    case Role::Waist:
      standing.waist_body = true;
      return;
    case Role::Upper:
      standing.upper = true;
      return;
    case Role::Lower:
      standing.lower = true;
      return;
    case Role::Turning:
      standing.turning = true;
      return;
    case Role::Hand:
      standing.hand.resize(actor.radii.size(), 0.0);
      for (std::size_t i = 0; i < actor.radii.size(); ++i) {
        standing.hand[i] = std::max(standing.hand[i], actor.radii[i]);
      }
      return;
  }
}

/// The hulls of the movers of one role, each with what it is kept apart from beyond its own joint.
std::vector<Standing> own_bodies(const Scene& scene, const std::vector<Actor>& actors, Role role,
                                 const Pose& X) {
  std::vector<Standing> all;
  for (std::size_t m = 0; m < scene.movers.size(); ++m) {
    if (actors[m].role != role || scene.movers[m].finger) continue;
    Standing concerns;
    for (const std::pair<int, int>& pair : scene.mover_pairs) {
      const std::size_t a = static_cast<std::size_t>(pair.first),
                        b = static_cast<std::size_t>(pair.second);
      if (a == m && actors[b].role > role) concern(concerns, actors[b]);
      if (b == m && actors[a].role > role) concern(concerns, actors[a]);
    }
    for (const SceneHull& hull : scene.movers[m].hulls) {
      Standing standing = standing_hull(hull, X * scene.movers[m].X_BM);
      standing.waist_body = concerns.waist_body;
      standing.upper = concerns.upper;
      standing.lower = concerns.lower;
      standing.turning = concerns.turning;
      standing.hand = concerns.hand;
      all.push_back(std::move(standing));
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
  const Pose& X_R1 = table.links.plane.X_R1;
  result.standing = own_bodies(scene, actors, Role::Base, Pose::Identity());
  result.waist = own_bodies(scene, actors, Role::Waist, X_R1);
  result.upper_arm = own_bodies(scene, actors, Role::Upper, X_R1 * robot.joints[1].X_PJ);
  result.waist_body = waist_outlines(scene, actors, table.links.plane);
  for (const SceneObstacle& obstacle : scene.obstacles) {
    for (const SceneHull& hull : obstacle.hulls) {
      Standing standing = standing_hull(hull, Pose::Identity());
      for (std::size_t m = 0; m < actors.size(); ++m) {
        if (obstacle.checked[m]) concern(standing, actors[m]);
      }
      result.standing.push_back(std::move(standing));
    }
  }
  return result;
}

}  // namespace handey::cspace
