// Sources handed on by two sweeps, down and up; each row by two of its own, right and left.
#include "nearest_column.hpp"

#include <cstddef>

namespace handey::world {

std::vector<std::int32_t> nearest_columns(int rows, int columns, const std::vector<char>& full) {
  constexpr std::uint16_t kFar = 60'000;
  const std::size_t width = static_cast<std::size_t>(columns);
  std::vector<std::uint16_t> steps(full.size(), kFar);
  std::vector<std::int32_t> source(full.size(), -1);
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (full[i] == 0) continue;
    steps[i] = 0;
    source[i] = static_cast<std::int32_t>(i);
  }
  const auto take = [&](std::size_t own, std::size_t other) {
    const std::uint16_t next = static_cast<std::uint16_t>(steps[other] + 1);
    const bool nearer = next < steps[own];
    steps[own] = nearer ? next : steps[own];
    source[own] = nearer ? source[other] : source[own];
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
  return source;
}

}  // namespace handey::world
