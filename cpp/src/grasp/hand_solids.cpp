// Solids of the hand against solids of what stands: the proof of cells of joints, with the hand's
// turn in the plane as the one joint and its shift as a turn about an axis far away.
#include "handey/grasp/hand_solids.hpp"

#include <algorithm>
#include <cmath>

namespace handey {
namespace {

constexpr double kFar = 1e3;        // of the axis that stands for a shift [m]
constexpr double kRounding = 1.01;  // a point a metre nearer to it goes less far by a thousandth

bool is_finger(const Robot& robot, int body, const FingerJoint*& joint) {
  for (const FingerJoint& finger : robot.gripper.fingers) {
    if (finger.child != body) continue;
    joint = &finger;
    return true;
  }
  return false;
}

Pose finger_in_hand(const Robot& robot, const FingerJoint& finger, double width) {
  return robot.gripper.X_BH.inverse() * finger.X_PJ *
         Eigen::Translation3d(0.5 * width * finger.axis);
}

}  // namespace

double HandMotion::chord() const { return 2.0 * std::sin(0.5 * std::min(half_turn, 3.14159)); }

HandSolids::HandSolids(CollisionChecker& checker, const Eigen::Vector3d& centre, double radius)
    : robot_(*checker.cell().robot), scene_(describe_solids(checker)) {
  add_base();
  for (std::size_t m = 0; m < scene_.movers.size(); ++m) {
    const SolidMover& mover = scene_.movers[m];
    const FingerJoint* finger = nullptr;
    const bool of_finger = is_finger(robot_, mover.body, finger);
    const bool of_hand = of_finger || mover.body == robot_.gripper.body;
    if (!of_hand) {
      for (const InnerSolid& solid : mover.solids) {
        links_.push_back({static_cast<int>(m), false, &solid, mover.X_BM});
      }
      continue;
    }
    const Pose X_HB = of_finger ? Pose::Identity() : Pose(robot_.gripper.X_BH.inverse());
    for (const InnerSolid& solid : mover.solids) {
      pieces_.push_back({static_cast<int>(m), of_finger, &solid, X_HB * mover.X_BM});
    }
  }
  for (std::size_t o = 0; o < scene_.obstacles.size(); ++o) {
    for (const InnerSolid& solid : scene_.obstacles[o].solids) {
      all_.push_back({static_cast<int>(o), &solid});
      if ((solid.centre - centre).norm() > radius + solid.radius) continue;
      targets_.push_back({static_cast<int>(o), &solid});
    }
  }
}

/// What no joint moves of the robot stands like an obstacle.
void HandSolids::add_base() {
  const auto is_base = [&](int m) { return scene_.movers[static_cast<std::size_t>(m)].depth == 0; };
  for (std::size_t m = 0; m < scene_.movers.size(); ++m) {
    if (!is_base(static_cast<int>(m))) continue;
    SolidObstacle base;
    base.name = scene_.movers[m].name;
    base.solids = scene_.movers[m].solids;
    base.checked.assign(scene_.movers.size(), 0);
    for (const auto& [a, b] : scene_.mover_pairs) {
      if (a == static_cast<int>(m)) base.checked[static_cast<std::size_t>(b)] = 1;
      if (b == static_cast<int>(m)) base.checked[static_cast<std::size_t>(a)] = 1;
    }
    // Only where the base is the root body, whose frame is the robot's.
    if (scene_.movers[m].body == 0) scene_.obstacles.push_back(std::move(base));
  }
}

void HandSolids::set_width(double width) {
  for (Piece& piece : pieces_) {
    const SolidMover& mover = scene_.movers[static_cast<std::size_t>(piece.mover)];
    const FingerJoint* finger = nullptr;
    if (is_finger(robot_, mover.body, finger)) {
      piece.X_HM = finger_in_hand(robot_, *finger, width) * mover.X_BM;
    }
  }
}

std::optional<HandBlock> HandSolids::blocking(const Pose& X_RH, const Eigen::Vector3d& turn_axis,
                                              const HandMotion& motion) {
  AxisMotion axes[2];
  axes[0].point = X_RH.translation();
  axes[0].direction = turn_axis;
  axes[0].chord = motion.chord();
  axes[1].direction = turn_axis;
  axes[1].point = X_RH.translation() + kFar * turn_axis.unitOrthogonal();
  axes[1].chord = kRounding * motion.shift / kFar;
  RelativeMotion relative;
  relative.axes = axes;
  relative.cell_end = 1;
  relative.free_end = 2;
  const auto named = [&](std::size_t p, std::size_t t) {
    last_ = {p, t};
    return HandBlock{pieces_[p].mover, targets_[t].obstacle};
  };
  const auto do_block = [&](std::size_t p, std::size_t t) {
    return blocks(pieces_[p], targets_[t], X_RH * pieces_[p].X_HM, relative, motion.shift);
  };
  if (last_.first < pieces_.size() && last_.second < targets_.size() &&
      do_block(last_.first, last_.second)) {
    return named(last_.first, last_.second);
  }
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (do_block(p, t)) return named(p, t);
    }
  }
  return std::nullopt;
}

std::optional<HandBlock> HandSolids::deep_in_arm(const Configuration& closed, double depth) {
  body_poses(robot_, closed, X_RB_);
  AxisMotion axis;
  axis.direction = Eigen::Vector3d::UnitZ();
  axis.point = kFar * Eigen::Vector3d::UnitX();
  axis.chord = kRounding * depth / kFar;
  RelativeMotion shift;
  shift.axes = &axis;
  shift.free_end = 1;
  const auto do_block = [&](std::size_t p, std::size_t t) {
    const Piece& piece = links_[p];
    const int body = scene_.movers[static_cast<std::size_t>(piece.mover)].body;
    return blocks(piece, all_[t], X_RB_[static_cast<std::size_t>(body)] * piece.X_HM, shift, depth);
  };
  if (last_link_.first < links_.size() && last_link_.second < all_.size() &&
      do_block(last_link_.first, last_link_.second)) {
    return HandBlock{links_[last_link_.first].mover, all_[last_link_.second].obstacle};
  }
  for (std::size_t p = 0; p < links_.size(); ++p) {
    for (std::size_t t = 0; t < all_.size(); ++t) {
      if (!do_block(p, t)) continue;
      last_link_ = {p, t};
      return HandBlock{links_[p].mover, all_[t].obstacle};
    }
  }
  return std::nullopt;
}

bool HandSolids::blocks(const Piece& piece, const Target& target, const Pose& X_RM,
                        const RelativeMotion& motion, double shift) const {
  const SolidObstacle& obstacle = scene_.obstacles[static_cast<std::size_t>(target.obstacle)];
  if (obstacle.checked[static_cast<std::size_t>(piece.mover)] == 0) return false;
  const InnerSolid &a = *piece.solid, &b = *target.solid;
  if (a.inradius + b.inradius <= shift) return false;
  const Eigen::Vector3d centre = X_RM * a.centre;
  if ((centre - b.centre).norm() > a.radius + b.radius) return false;
  static const Pose kIdentity = Pose::Identity();
  const PlacedSolid placed_a{a, X_RM}, placed_b{b, kIdentity};
  if (plainly_apart(placed_a, placed_b, 0.0)) return false;
  Eigen::Vector3d x = a.radius < b.radius ? centre : b.centre;
  return overlaps_throughout(placed_a, placed_b, motion, x);
}

const std::string& HandSolids::mover_name(int mover) const {
  return scene_.movers[static_cast<std::size_t>(mover)].name;
}

const std::string& HandSolids::other_name(int other) const {
  return scene_.obstacles[static_cast<std::size_t>(other)].name;
}

double HandSolids::extent(const Robot& robot) {
  double farthest = 0.0;
  for (std::size_t body = 0; body < robot.bodies.size(); ++body) {
    const FingerJoint* finger = nullptr;
    const bool of_finger = is_finger(robot, static_cast<int>(body), finger);
    if (!of_finger && static_cast<int>(body) != robot.gripper.body) continue;
    const Pose X_HB = of_finger ? finger_in_hand(robot, *finger, robot.gripper.max_opening)
                                : Pose(robot.gripper.X_BH.inverse());
    for (const Shape& shape : robot.bodies[body].shapes) {
      for (const Eigen::Vector3d& point : hull_points(shape)) {
        farthest = std::max(farthest, (X_HB * point).norm());
      }
    }
  }
  return farthest;
}

}  // namespace handey
