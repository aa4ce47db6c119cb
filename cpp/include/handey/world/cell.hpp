// The cell: robot, fixtures, parts, and which part is in the hand. A value: an edit returns a new
// cell.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "handey/kinematics/arm.hpp"
#include "handey/world/body.hpp"

namespace handey {

/// A fixture or a part of a cell, by kind and index.
struct BodyRef {
  enum class Kind { Fixture, Part };
  Kind kind = Kind::Fixture;
  int index = 0;
  bool operator==(const BodyRef& other) const { return kind == other.kind && index == other.index; }
};

struct HeldPart {
  int part = 0;                  ///< index in Cell::parts
  Pose X_HP = Pose::Identity();  ///< the part in the grasp frame
};

struct Cell {
  std::string name;
  std::shared_ptr<const Robot> robot;
  Pose X_WR = Pose::Identity();  ///< the URDF's root link in the world
  std::vector<Body> fixtures;    ///< never move
  std::vector<Body> parts;       ///< can be picked up; a held part's X_WB is not used
  std::optional<HeldPart> held;
  Configuration start;

  const Body& body(const BodyRef& ref) const;
  /// @throws InvalidInput (E_REF) with the legal names
  int part_index(const std::string& name) const;
  Cell with_part_at(int part, const Pose& X_WP) const;
  Cell with_held(int part, const Pose& X_HP) const;
  /// The held part stands at X_WP, nothing is held.
  Cell with_released(const Pose& X_WP) const;
};

/// @throws InvalidInput naming the first body, pose or number that is wrong
void require_valid(const Cell& cell);

/// Grasp frame in the world: X_WR * X_RH(q).
Pose hand_in_world(const Cell& cell, const Eigen::VectorXd& q);

}  // namespace handey
