// Where slides start from, and what their attraction point moves along.
#pragma once

#include <optional>
#include <vector>

#include "handey/approach/clearance_path.hpp"

namespace handey {

struct SlideStart {
  PlanarPose pose;                     ///< of the hand
  std::vector<Eigen::Vector2d> route;  ///< the attraction point moves along it; it ends at the aim
};

/// Where the way of greatest clearance begins; the hand turned as at the aim, or, where that way is
/// the finger tips' alone, along it.
/// @param run_in  distance of the start from the aim [m]
std::optional<SlideStart> widest_start(const MotionGrid& grid, const GripperOutline& outline,
                                       const PlanarPose& aim, double run_in);

/// Straight back along the hand first, at three distances; then turned about the finger tips.
std::vector<SlideStart> turned_starts(const PlanarPose& aim, double run_in, double least_run_in);

}  // namespace handey
