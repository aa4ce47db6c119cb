// Offsets to the nearest full cell, by two sweeps (Danielsson 1980).
#include "nearest_column.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace handey::world {
namespace {

constexpr std::int16_t kNone = std::numeric_limits<std::int16_t>::max();
constexpr int kFarthest = 16000;  // cells; farther ones do not know of each other

struct Offset {
  std::int16_t du = kNone, dv = kNone;
  int squared() const { return int{du} * int{du} + int{dv} * int{dv}; }
};

void take(Offset& own, const Offset& other, int du, int dv) {
  if (other.du == kNone || other.squared() > kFarthest * kFarthest) return;
  const Offset candidate{static_cast<std::int16_t>(other.du + du),
                         static_cast<std::int16_t>(other.dv + dv)};
  if (own.du == kNone || candidate.squared() < own.squared()) own = candidate;
}

}  // namespace

NearestColumns nearest_columns(int rows, int columns, const std::vector<char>& full) {
  const std::size_t width = static_cast<std::size_t>(columns);
  std::vector<Offset> offsets(full.size());
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (full[i] != 0) offsets[i] = {0, 0};
  }
  const auto sweep = [&](Offset* row, const Offset* before) {
    if (before != nullptr) {
      const int step = before < row ? -1 : 1;
      for (int u = 0; u < columns; ++u) take(row[u], before[u], 0, step);
    }
    for (int u = 1; u < columns; ++u) take(row[u], row[u - 1], -1, 0);
    for (int u = columns - 1; u-- > 0;) take(row[u], row[u + 1], 1, 0);
  };
  for (int v = 0; v < rows; ++v) {
    Offset* row = offsets.data() + static_cast<std::size_t>(v) * width;
    sweep(row, v > 0 ? row - width : nullptr);
  }
  for (int v = rows - 1; v-- > 0;) {
    Offset* row = offsets.data() + static_cast<std::size_t>(v) * width;
    sweep(row, row + width);
  }
  NearestColumns result;
  result.source.assign(full.size(), -1);
  result.distance.assign(full.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (offsets[i].du == kNone) continue;
    result.source[i] = static_cast<std::int32_t>(i) + offsets[i].dv * columns + offsets[i].du;
    result.distance[i] = std::sqrt(static_cast<float>(offsets[i].squared()));
  }
  return result;
}

}  // namespace handey::world
