// Two floods, one from the start, one from all cells near the part.
#include "handey/cspace/walled_off.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "handey/errors.hpp"
#include "handey/grasp/hand_reach.hpp"
#include "two_floods.hpp"

namespace handey {
namespace {

using cspace::CellTree;
using cspace::Link;
using cspace::TwoFloods;
using Eigen::Vector3d;

constexpr std::size_t kStepsPerCell = 100;  // as in the proof of two ends
constexpr int kCellJoints = 3;

/// Cells that may bring the wrist centre within the hand's length of a part.
class NearPart {
 public:
  NearPart(const Robot& robot, const Lattice& lattice, const SphericalWristSolver& solver,
           const Body& part, const Pose& X_RP)
      : robot_(robot),
        lattice_(lattice),
        X_PR_(X_RP.inverse()),
        length_(hand_length(solver.wrist_reach(), robot.gripper)) {
    for (const Shape& shape : part.shapes) {
      for (const Vector3d& point : hull_points(shape)) box_.extend(point);
    }
    middle_.q = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(robot.joints.size()));
    body_poses(robot_, middle_, X_RB_);
    const Pose& X_RC = X_RB_[static_cast<std::size_t>(robot.joints[2].child)];
    p_CW_ = X_RC.inverse() * (hand_pose(robot, middle_.q) * solver.wrist_reach().p_HC);
  }

  bool operator()(int level, const CellIndex& cell) {
    for (int j = 0; j < kCellJoints; ++j) {
      middle_.q[j] = lattice_.centre(level, j, cell[static_cast<std::size_t>(j)]);
    }
    body_poses(robot_, middle_, X_RB_);
    const Vector3d wrist = X_RB_[static_cast<std::size_t>(robot_.joints[2].child)] * p_CW_;
    // Turns about one axis after the other, inmost first: each moves the point the farther, the
    // farther those before may have moved it from its axis.
    double motion = 0.0;
    for (int j = kCellJoints - 1; j >= 0; --j) {
      const ArmJoint& joint = robot_.joints[static_cast<std::size_t>(j)];
      const Pose& X_RJ = X_RB_[static_cast<std::size_t>(joint.child)];
      const Vector3d axis = X_RJ.linear() * joint.axis;
      const double distance = axis.cross(wrist - X_RJ.translation()).norm();
      motion += 2.0 * std::sin(0.25 * lattice_.cell_width(level, j)) * (distance + motion);
    }
    return std::sqrt(box_.squaredExteriorDistance(X_PR_ * wrist)) <= length_ + motion + 1e-9;
  }

 private:
  const Robot& robot_;
  const Lattice& lattice_;
  Pose X_PR_;
  double length_;
  Eigen::AlignedBox3d box_;
  Vector3d p_CW_;
  Configuration middle_;
  std::vector<Pose> X_RB_;
};

std::vector<std::string> most_first(const std::map<std::string, int>& counted) {
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [name, cells] : counted) sorted.emplace_back(-cells, name);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> names;
  for (auto& [cells, name] : sorted) names.push_back(std::move(name));
  return names;
}

void name_border(const TwoFloods& floods, const BlockedCells::Impl& proofs, WalledOff& result) {
  std::map<std::string, int> others, movers;
  for (const auto& [pair, cells] : floods.border()) {
    const BlockedProof proof = proofs.named(pair);
    others[proof.other] += cells;
    movers[proof.mover] += cells;
  }
  result.bodies = most_first(others);
  result.movers = most_first(movers);
}

void require_inputs(const Robot& robot, const Configuration& start, const Body& part,
                    const SeparationOptions& options) {
  if (static_cast<std::size_t>(start.q.size()) != robot.joints.size() || start.q.size() < 3) {
    throw InvalidInput("E_DOF", "start",
                       std::to_string(start.q.size()) + " joint values, the arm has " +
                           std::to_string(robot.joints.size()) + " joints");
  }
  if (!start.q.allFinite()) throw InvalidInput("E_NUMBER", "start", "a value is not finite");
  const std::string violation = limit_violation(robot, start.q);
  if (!violation.empty()) throw InvalidInput("E_LIMIT", "start", violation);
  if (part.shapes.empty()) {
    throw InvalidInput("E_GEOMETRY", part.name, "has no shapes, expected at least one");
  }
  if (options.finest_level < 0 || options.finest_level >= Lattice::kLevels) {
    throw InvalidInput("E_RANGE", "finest_level",
                       std::to_string(options.finest_level) + ", expected 0 to " +
                           std::to_string(Lattice::kLevels - 1));
  }
}

}  // namespace

WalledOff prove_walled_off(CollisionChecker& checker, const Configuration& start,
                           const SphericalWristSolver& solver, const Body& part, const Pose& X_RP,
                           const SeparationOptions& options) {
  const Robot& robot = *checker.cell().robot;
  require_inputs(robot, start, part, options);
  require_rigid(X_RP, "X_RP");
  WalledOff result;
  if (cspace::coarse_cells(make_lattice(robot)) > cspace::kMostCoarseCells) {
    result.reason = "the first three joints' ranges are too wide";
    return result;
  }
  BlockedCells::Impl proofs(checker, robot.gripper.max_opening, Lattice::kLevels - 1, false);
  CellTree tree(proofs, options.finest_level);
  std::size_t steps_left = options.most_cells * kStepsPerCell;
  TwoFloods floods(tree, start.q, NearPart(robot, proofs.lattice, solver, part, X_RP),
                   options.most_cells, steps_left);
  const Link link = floods.run();
  result.walled_off = link == Link::Apart;
  result.within_limits = floods.has_goal();
  result.cells_looked_at = tree.cells_looked_at();
  for (int j = 0; j < kCellJoints; ++j) {
    result.resolution =
        std::max(result.resolution, proofs.lattice.cell_width(tree.finest_looked_at(), j));
  }
  if (link == Link::Apart) {
    name_border(floods, proofs, result);
  } else if (link == Link::Linked) {
    result.reason = "cells that are not proved blocked lead from the start to the part";
  } else {
    result.reason = "given up after " + std::to_string(tree.cells_looked_at()) + " cells";
  }
  return result;
}

}  // namespace handey
