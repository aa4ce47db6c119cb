// For each empty cell of a grid, a full cell that is near.
#pragma once

#include <cstdint>
#include <vector>

namespace handey::world {

struct NearestColumns {
  std::vector<std::int32_t> source;  ///< index of a full cell near each cell; -1: none is full
  std::vector<float> distance;       ///< to it, between centres [cells]
};

/// Two sweeps hand the source on from neighbour to neighbour: the nearest by steps along rows and
/// columns, so never farther than sqrt(2) times the nearest.
NearestColumns nearest_columns(int rows, int columns, const std::vector<char>& full);

}  // namespace handey::world
