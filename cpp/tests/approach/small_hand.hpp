// A small hand and straight obstacles in the grasp plane.
#pragma once

#include <cmath>

#include "handey/approach/bump_lines.hpp"

namespace handey::testing {

constexpr double kCell = 0.004;  // of the motion grid [m]

inline Region rectangle(double x0, double y0, double x1, double y1) {
  using Eigen::Vector2d;
  return {{{Vector2d(x0, y0), Vector2d(x1, y0), Vector2d(x1, y1), Vector2d(x0, y1)}}};
}

/// A hand 30 mm wide and 50 mm long, its finger grasp point 5 mm behind its tip.
inline GripperOutline small_hand() {
  GripperOutline outline;
  outline.pieces.push_back({rectangle(-0.045, -0.015, 0.005, 0.015).loops.front(), -0.01, 0.01});
  outline.radius = std::hypot(0.045, 0.015);
  return outline;
}

}  // namespace handey::testing
