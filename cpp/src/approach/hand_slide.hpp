// One slide of hand and arm from a start to a grasp pose. The article's slide keeps the bump lines'
// distance from everything, so it stops that far before a grasp close over a table; then the last
// stretch is tried straight, the exact test alone deciding, and after that the slide goes on over
// finer grids with nearer bump lines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hand_reach.hpp"
#include "handey/approach/quasipotential.hpp"
#include "obstacle_layers.hpp"

namespace handey {

/// Where hand and arm went.
struct HandSlide {
  SlideResult slide;               ///< the planar poses
  std::vector<Eigen::VectorXd> q;  ///< one for each
  bool at_aim = false;             ///< ends at the aim itself, turned as the aim is
  std::string reason;              ///< what refused the last step, if it is not at the aim
};

class HandSlider {
 public:
  HandSlider(const GripperOutline& outline, const ObstacleLayers& obstacles, HandReach& reach,
             const PlanarPose& aim, double cell, const QuasipotentialOptions& options);

  /// @param q_start  the arm at `start`, free
  /// @param route  the attraction point moves along it; it ends at the aim
  HandSlide run(const PlanarPose& start, const Eigen::VectorXd& q_start,
                const std::vector<Eigen::Vector2d>& route);
  /// The coarsest grid, drawn when first needed.
  const MotionGrid& grid() { return grid(0); }

 private:
  const MotionGrid& grid(int level);
  void slide(int level, const std::vector<Eigen::Vector2d>& route, HandSlide& so_far);
  void close_in(HandSlide& so_far);
  bool is_at_aim(const PlanarPose& pose) const;

  const GripperOutline& outline_;
  const ObstacleLayers& obstacles_;
  HandReach& reach_;
  PlanarPose aim_;
  double cell_;
  QuasipotentialOptions options_;
  std::vector<std::unique_ptr<MotionGrid>> grids_;  // drawn when first needed
};

}  // namespace handey
