// For each empty cell of a grid, a full cell that is near.
#pragma once

#include <cstdint>
#include <vector>

namespace handey::world {

struct NearestColumns {
  std::vector<std::int32_t> source;  ///< index of a full cell near each cell; -1: none
  std::vector<float> distance;       ///< to it, between centres [cells]
};

/// Two sweeps that hand the offset to the source on from neighbour to neighbour: the source is
/// full, and nearly always the nearest.
NearestColumns nearest_columns(int rows, int columns, const std::vector<char>& full);

}  // namespace handey::world
