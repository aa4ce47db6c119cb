// A slow, plain collision test to check the fast one by: all shapes as closed triangle meshes
// (round ones inscribed, so that it never says too much), triangles against triangles by separating
// axes, and the solid angle for what is inside. Shares no code with the collision room.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "puma_cell.hpp"

namespace handey::testing {

class SolidsOracle {
 public:
  explicit SolidsOracle(const Cell& cell) : cell_(cell) {
    for (const RobotBody& body : cell.robot->bodies) bodies_.push_back(solids_of(body.shapes));
    if (cell.held) held_ = solids_of(cell.parts[static_cast<std::size_t>(cell.held->part)].shapes);
    const Pose X_RW = cell.X_WR.inverse();
    for (const Body& body : cell.fixtures) add_standing(body, X_RW);
    for (std::size_t i = 0; i < cell.parts.size(); ++i) {
      if (!cell.held || cell.held->part != static_cast<int>(i)) add_standing(cell.parts[i], X_RW);
    }
    for (const FingerJoint& finger : cell.robot->gripper.fingers) fingers_.push_back(finger.child);
  }

  /// Empty if free, else the pair. Robot bodies that are joined, or neighbours but one, are left
  /// out.
  std::string collision(const Configuration& configuration) const {
    const std::vector<Pose> poses = body_poses(*cell_.robot, configuration);
    std::vector<std::vector<Solid>> placed;
    for (std::size_t b = 0; b < bodies_.size(); ++b) placed.push_back(place(bodies_[b], poses[b]));
    std::vector<Solid> held;
    if (cell_.held) {
      held = place(held_, poses[static_cast<std::size_t>(cell_.robot->gripper.body)] *
                              cell_.robot->gripper.X_BH * cell_.held->X_HP);
    }
    for (std::size_t b = 0; b < placed.size(); ++b) {
      const std::string& name = cell_.robot->bodies[b].name;
      for (const auto& [label, solids] : standing_) {
        if (b > 0 && meet(placed[b], solids)) return name + " " + label;
      }
      for (std::size_t c = b + 3; c < placed.size(); ++c) {
        if (is_finger(c) || is_finger(b)) continue;
        if (meet(placed[b], placed[c])) return name + " " + cell_.robot->bodies[c].name;
      }
      if (!is_finger(b) && meet(placed[b], held)) return name + " held";
    }
    for (const auto& [label, solids] : standing_) {
      if (meet(held, solids)) return "held " + label;
    }
    return "";
  }

 private:
  struct Solid {
    TriangleMesh mesh;
    Eigen::AlignedBox3d box;
  };

  bool is_finger(std::size_t body) const {
    return std::find(fingers_.begin(), fingers_.end(), static_cast<int>(body)) != fingers_.end();
  }

  static std::vector<Solid> solids_of(const std::vector<Shape>& shapes) {
    std::vector<Solid> solids;
    for (const Shape& shape : shapes) solids.push_back(boxed(tessellate(shape, 16, false)));
    return solids;
  }

  static Solid boxed(TriangleMesh mesh) {
    Solid solid{std::move(mesh), {}};
    for (const Eigen::Vector3d& v : solid.mesh.vertices) solid.box.extend(v);
    return solid;
  }

  static std::vector<Solid> place(const std::vector<Solid>& solids, const Pose& X) {
    std::vector<Solid> placed;
    for (const Solid& solid : solids) {
      TriangleMesh mesh = solid.mesh;
      for (Eigen::Vector3d& v : mesh.vertices) v = X * v;
      placed.push_back(boxed(std::move(mesh)));
    }
    return placed;
  }

  void add_standing(const Body& body, const Pose& X_RW) {
    standing_.emplace_back(body.name, place(solids_of(body.shapes), X_RW * body.X_WB));
  }

  using Triangle = std::array<Eigen::Vector3d, 3>;

  static Triangle triangle(const TriangleMesh& mesh, const Eigen::Vector3i& t) {
    return {mesh.vertices[static_cast<std::size_t>(t[0])],
            mesh.vertices[static_cast<std::size_t>(t[1])],
            mesh.vertices[static_cast<std::size_t>(t[2])]};
  }

  static bool separates(const Eigen::Vector3d& axis, const Triangle& a, const Triangle& b) {
    if (axis.squaredNorm() < 1e-24) return false;
    const auto [min_a, max_a] = std::minmax({axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2])});
    const auto [min_b, max_b] = std::minmax({axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2])});
    return max_a < min_b || max_b < min_a;
  }

  static bool cross_each_other(const Triangle& a, const Triangle& b) {
    const Eigen::Vector3d normal_a = (a[1] - a[0]).cross(a[2] - a[0]);
    const Eigen::Vector3d normal_b = (b[1] - b[0]).cross(b[2] - b[0]);
    if (separates(normal_a, a, b) || separates(normal_b, a, b)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (separates((a[(i + 1) % 3] - a[i]).cross(b[(j + 1) % 3] - b[j]), a, b)) return false;
      }
    }
    return true;
  }

  static bool meet(const std::vector<Solid>& many, const std::vector<Solid>& others) {
    for (const Solid& a : many) {
      for (const Solid& b : others) {
        if (a.box.intersects(b.box) && solids_meet(a, b)) return true;
      }
    }
    return false;
  }

  static bool solids_meet(const Solid& a, const Solid& b) {
    for (const Eigen::Vector3i& t : a.mesh.triangles) {
      const Triangle one = triangle(a.mesh, t);
      Eigen::AlignedBox3d box(one[0]);
      box.extend(one[1]).extend(one[2]);
      if (!box.intersects(b.box)) continue;
      for (const Eigen::Vector3i& u : b.mesh.triangles) {
        if (cross_each_other(one, triangle(b.mesh, u))) return true;
      }
    }
    return contains_point(b.mesh, a.mesh.vertices.front()) ||
           contains_point(a.mesh, b.mesh.vertices.front());
  }

  const Cell cell_;
  std::vector<std::vector<Solid>> bodies_;
  std::vector<Solid> held_;
  std::vector<std::pair<std::string, std::vector<Solid>>> standing_;
  std::vector<int> fingers_;
};

}  // namespace handey::testing
