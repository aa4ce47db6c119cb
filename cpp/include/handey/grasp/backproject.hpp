// What is near the part at its origin, and what will be near it at its destination, both seen from
// the part: destination obstacles moved by T^-1 (article, Figure 4). Other parts stand where they
// stand in the cell.
#pragma once

#include <string>
#include <vector>

#include "handey/world/cell.hpp"

namespace handey {

/// A body seen from the part.
struct NearbyBody {
  BodyRef body;
  std::string name;
  bool at_destination = false;   ///< moved by T^-1
  Pose X_PB = Pose::Identity();  ///< the body in the part frame
};

/// Fixtures and other parts whose bounding box (along the world's axes) comes within `radius` [m]
/// of the part's, at either end: first those at the origin, then those at the destination, each
/// fixtures before parts. A held part is left out.
/// @throws InvalidInput (E_REF, E_NUMBER, E_RANGE)
std::vector<NearbyBody> nearby_bodies(const Cell& cell, int part, const Pose& X_WP_goal,
                                      double radius = 0.25);

}  // namespace handey
