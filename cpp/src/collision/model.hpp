// The collision geometry of a cell: pieces of the robot's bodies, the fixtures and the parts, and
// which robot bodies are checked against each other. Poses are not in it: a checker places the
// pieces.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "handey/collision/checker.hpp"
#include "piece.hpp"
#include "piece_tree.hpp"

namespace handey::collision {

/// All pieces of a body and the ball round them, body frame.
struct BodyGeometry {
  std::string name;
  std::vector<Shape> shapes;  ///< what the pieces were made of
  Pieces pieces;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0.0;
  PieceTree tree;  ///< of bodies with many pieces; else empty
  bool has_tree() const { return static_cast<int>(pieces.size()) > kManyPieces; }
  static constexpr int kManyPieces = 8;  // Choice: fewer are looked at one by one
};

}  // namespace handey::collision

namespace handey {

struct CollisionModel::Impl {
  std::shared_ptr<const Robot> robot;
  std::vector<collision::BodyGeometry> robot_bodies, fixtures, parts;
  std::vector<std::pair<int, int>>
      self_pairs;               ///< robot bodies that are checked against each other
  std::vector<int> depth;       ///< how many arm joints move each robot body
  std::vector<char> is_finger;  ///< of each robot body
};

}  // namespace handey
