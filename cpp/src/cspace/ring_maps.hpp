// Bit maps of the polar cells of the arm's plane. A turn of the second joint shifts what a link
// meets by whole rows, so a map made for one direction serves all: kept are only the rings, times a
// few phases within a row, times runs of 1, 2, 4, ... neighbouring cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "handey/cspace/lattice.hpp"
#include "polar_raster.hpp"

namespace handey::cspace {

/// How the plane and the second joint are cut.
struct PolarGrid {
  double width = 0.02;  ///< of a ring [m]
  int rings = 0;
  int phases = 8;      ///< polar cells in a cell of theta2
  int runs = 6;        ///< maps of 1, 2, ... 2^(runs - 1) neighbouring polar cells
  int row_count = 0;   ///< cells of theta2
  double row = 0.0;    ///< a cell of theta2 [rad]
  double lower = 0.0;  ///< of theta2's range [rad]
  int first_row = 0;   ///< least (row of theta2 - row of the polar cell) that is kept
  int stored_rows = 0;

  PolarGrid() = default;
  PolarGrid(const Lattice& lattice, int level, double ring_width, double reach);
  double bin() const { return row / phases; }
};

/// Where the maps of one group of links are, in the table's bytes.
struct RingMaps {
  int first_ring = 0, last_ring = 0;  ///< the last one is not among them
  std::size_t row_bytes = 0;          ///< bytes of a row of cells of theta3; 1: theta2 alone
  std::size_t map_bytes = 0;
  std::size_t offset = 0;

  /// Sets the sizes. @return the bytes of all maps
  std::size_t lay_out(const PolarGrid& grid, std::size_t row_bytes_in, std::size_t offset_in);
  std::uint8_t* map(const PolarGrid& grid, std::uint8_t* bytes, int run, int ring, int phase) const;
  /// A link that turns with theta2 meets this span at theta2 = 0 and cell `column` of theta3.
  void mark(const PolarGrid& grid, std::uint8_t* bytes, const RingSpan& span, int column) const;
  /// The maps of longer runs from those of single cells.
  void fill_runs(const PolarGrid& grid, std::uint8_t* bytes) const;
  /// Appends maps whose first row_count rows are what an obstacle in this span blocks.
  void collect(const PolarGrid& grid, const std::uint8_t* bytes, const RingSpan& span,
               std::vector<const std::uint8_t*>& maps) const;
};

}  // namespace handey::cspace
