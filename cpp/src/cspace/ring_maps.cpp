// Rows are counted from the polar cell: row j of a map is for the cell of theta2 that is j rows
// above the row in which the polar cell begins.
#include "ring_maps.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

int floor_int(double value) { return static_cast<int>(std::floor(value)); }

}  // namespace

PolarGrid::PolarGrid(const Lattice& lattice, int level, double ring_width, double reach)
    : width(ring_width) {
  // Choice: polar cells of no less than half a degree, runs of four cells of theta2.
  phases = std::max(2, 8 >> std::max(0, level - 1));
  runs = level < 2 ? 6 : 7 - level;
  rings = floor_int(reach / width) + 1;
  row_count = lattice.cells(level, 1);
  row = lattice.cell_width(level, 1);
  lower = lattice.lower[1];
  // Polar cells begin within one turn above the lower limit; longer runs look a few rows back.
  const int margin = (1 << (runs - 1)) / phases + 2;
  first_row = -(floor_int(kTurn / row) + 1 + margin);
  stored_rows = row_count - first_row;
}

std::size_t RingMaps::lay_out(const PolarGrid& grid, std::size_t row_bytes_in,
                              std::size_t offset_in) {
  row_bytes = row_bytes_in;
  map_bytes = row_bytes * static_cast<std::size_t>(grid.stored_rows);
  offset = offset_in;
  return map_bytes * static_cast<std::size_t>(grid.runs * grid.phases * (last_ring - first_ring));
}

std::uint8_t* RingMaps::map(const PolarGrid& grid, std::uint8_t* bytes, int run, int ring,
                            int phase) const {
  const int index = (run * (last_ring - first_ring) + ring - first_ring) * grid.phases + phase;
  return bytes + offset + static_cast<std::size_t>(index) * map_bytes;
}

void RingMaps::mark(const PolarGrid& grid, std::uint8_t* bytes, const RingSpan& span,
                    int column) const {
  const std::uint8_t bit = static_cast<std::uint8_t>(1U << (column % 8));
  const std::size_t byte = static_cast<std::size_t>(column / 8);
  for (int phase = 0; phase < grid.phases; ++phase) {
    std::uint8_t* rows = map(grid, bytes, 0, span.ring, phase) + byte;
    // The cell of theta2 [j row, (j + 1) row] carries the span over the polar cell at some turn.
    const double lower = phase * grid.bin() - span.upper;
    const double upper = (phase + 1) * grid.bin() - span.lower;
    const int least = floor_int((grid.first_row * grid.row - upper) / kTurn);
    const int most = floor_int((grid.row_count * grid.row - lower) / kTurn) + 1;
    for (int turn = least; turn <= most; ++turn) {
      const double from = (lower + turn * kTurn) / grid.row - 1.0;
      const double to = (upper + turn * kTurn) / grid.row;
      const int first = std::max(grid.first_row, static_cast<int>(std::ceil(from - 1e-9)));
      const int last = std::min(grid.row_count - 1, floor_int(to + 1e-9));
      for (int row = first; row <= last; ++row) {
        rows[static_cast<std::size_t>(row - grid.first_row) * row_bytes] |= bit;
      }
    }
  }
}

void RingMaps::fill_runs(const PolarGrid& grid, std::uint8_t* bytes) const {
  for (int run = 1; run < grid.runs; ++run) {
    const int half = 1 << (run - 1);
    for (int ring = first_ring; ring < last_ring; ++ring) {
      for (int phase = 0; phase < grid.phases; ++phase) {
        const std::uint8_t* near = map(grid, bytes, run - 1, ring, phase);
        const std::uint8_t* far = map(grid, bytes, run - 1, ring, (phase + half) % grid.phases);
        const std::size_t shift =
            static_cast<std::size_t>((phase + half) / grid.phases) * row_bytes;
        std::uint8_t* both = map(grid, bytes, run, ring, phase);
        for (std::size_t i = 0; i < shift; ++i) both[i] = near[i];
        for (std::size_t i = shift; i < map_bytes; ++i) {
          both[i] = static_cast<std::uint8_t>(near[i] | far[i - shift]);
        }
      }
    }
  }
}

void RingMaps::collect(const PolarGrid& grid, const std::uint8_t* bytes, const RingSpan& span,
                       std::vector<const std::uint8_t*>& maps) const {
  if (span.ring < first_ring || span.ring >= last_ring) return;
  const double begin = span.lower - grid.lower;
  const double lower = begin - kTurn * std::floor(begin / kTurn);
  const double upper = lower + std::min(kTurn, span.upper - span.lower);
  if (upper > kTurn) {
    collect(grid, bytes, {span.ring, grid.lower, grid.lower + upper - kTurn}, maps);
  }
  const double per_bin = 1.0 / grid.bin();
  const int first = static_cast<int>(lower * per_bin);
  const int last = static_cast<int>(std::min(upper, kTurn) * per_bin);
  int run = 0;
  while (run + 1 < grid.runs && (2 << run) <= last - first + 1) ++run;
  const int length = 1 << run;
  const std::uint8_t* all = map(grid, const_cast<std::uint8_t*>(bytes), run, span.ring, 0);
  for (int at = first;; at += length) {
    at = std::min(at, last + 1 - length);
    const std::size_t phase = static_cast<std::size_t>(at % grid.phases);
    const int row = at / grid.phases;
    maps.push_back(all + phase * map_bytes +
                   static_cast<std::size_t>(-row - grid.first_row) * row_bytes);
    if (at + length > last) break;
  }
}

}  // namespace handey::cspace
