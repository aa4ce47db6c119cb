// Sources handed on by two sweeps, down and up; each row by two of its own, right and left.
#include "nearest_column.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace handey::world {

NearestColumns nearest_columns(int rows, int columns, const std::vector<char>& full) {
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max() / 2;
  const std::size_t width = static_cast<std::size_t>(columns);
  std::vector<std::int32_t> steps(full.size(), kFar);
  NearestColumns result;
  result.source.assign(full.size(), -1);
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (full[i] == 0) continue;
    steps[i] = 0;
    result.source[i] = static_cast<std::int32_t>(i);
  }
  const auto take = [&](std::size_t own, std::size_t other) {
    const bool nearer = steps[other] + 1 < steps[own];
    steps[own] = nearer ? steps[other] + 1 : steps[own];
    result.source[own] = nearer ? result.source[other] : result.source[own];
  };
  const auto sweep = [&](std::size_t row) {
    for (std::size_t u = 1; u < width; ++u) take(row + u, row + u - 1);
    for (std::size_t u = width - 1; u-- > 0;) take(row + u, row + u + 1);
  };
  for (int v = 0; v < rows; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; v > 0 && u < width; ++u) take(row + u, row + u - width);
    sweep(row);
  }
  for (int v = rows - 1; v-- > 0;) {
    const std::size_t row = static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; u < width; ++u) take(row + u, row + u + width);
    sweep(row);
  }
  result.distance.assign(full.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (steps[i] == 0) result.distance[i] = 0.0f;
    if (steps[i] == 0 || result.source[i] < 0) continue;
    const std::size_t source = static_cast<std::size_t>(result.source[i]);
    const float du = static_cast<float>(i % width) - static_cast<float>(source % width),
                dv = static_cast<float>(i / width) - static_cast<float>(source / width);
    result.distance[i] = std::sqrt(du * du + dv * dv);
  }
  return result;
}

}  // namespace handey::world
