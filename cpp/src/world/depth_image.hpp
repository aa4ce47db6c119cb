// What is checked of a depth image, and how its holes are closed.
#pragma once

#include <vector>

#include "handey/world/depth_map.hpp"

namespace handey::world {

/// @throws InvalidInput (E_IMAGE, E_CAMERA, E_NUMBER, E_RANGE)
void require_valid(const DepthImage& image);

/// The depths, with every pixel that was not measured as near as the nearest measured pixel on the
/// border of its hole: the pixels that hang together by their sides.
std::vector<double> closed_holes(const DepthImage& image);

}  // namespace handey::world
