// For each empty cell of a grid, a full cell that is near.
#pragma once

#include <cstdint>
#include <vector>

namespace handey::world {

/// The index of a full cell near each cell, itself where it is full; -1 where none is within 60 000
/// steps. Two sweeps hand the source on from neighbour to neighbour: the nearest by steps along
/// rows and columns, so never farther than sqrt(2) times the nearest.
std::vector<std::int32_t> nearest_columns(int rows, int columns, const std::vector<char>& full);

}  // namespace handey::world
