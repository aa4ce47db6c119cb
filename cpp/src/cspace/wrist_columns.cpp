#include "wrist_columns.hpp"

#include <algorithm>
#include <cmath>

namespace handey::cspace {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

/// Sets the bits first .. last.
void set_bits(std::uint64_t* words, int first, int last) {
  for (int word = first / 64; word <= last / 64; ++word) {
    const int from = std::max(0, first - 64 * word), to = std::min(63, last - 64 * word);
    words[word] |= (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (63 - to));
  }
}

}  // namespace

WristColumns::WristColumns(const PolarGrid& grid, const std::vector<std::vector<RingSpan>>& spans)
    : first_ring_(grid.rings), words_((grid.row_count + 63) / 64) {
  for (const std::vector<RingSpan>& column : spans) {
    for (const RingSpan& span : column) {
      first_ring_ = std::min(first_ring_, span.ring);
      last_ring_ = std::max(last_ring_, span.ring + 1);
    }
  }
  first_ring_ = std::min(first_ring_, last_ring_);
  rings_.resize(static_cast<std::size_t>(last_ring_ - first_ring_));
  for (std::size_t column = 0; column < spans.size(); ++column) {
    for (const RingSpan& span : spans[column]) {
      std::vector<Stay>& ring = rings_[static_cast<std::size_t>(span.ring - first_ring_)];
      // Parts of one sweep that go on from one another are one stay.
      if (!ring.empty() && ring.back().column == static_cast<int>(column) &&
          span.lower <= ring.back().upper && span.upper >= ring.back().lower) {
        ring.back().lower = std::min(ring.back().lower, span.lower);
        ring.back().upper = std::max(ring.back().upper, span.upper);
      } else {
        ring.push_back({static_cast<int>(column), span.lower, span.upper});
      }
    }
  }
}

void WristColumns::mark(const PolarGrid& grid, const RingSpan& span,
                        std::vector<std::uint64_t>& columns) const {
  if (span.ring < first_ring_ || span.ring >= last_ring_) return;
  const double per_row = 1.0 / grid.row, range = grid.row_count * grid.row;
  for (const Stay& stay : rings_[static_cast<std::size_t>(span.ring - first_ring_)]) {
    // theta2 carries the stay into the span from `lower` to `upper`, and a turn on, and so forth.
    double lower = span.lower - stay.upper - grid.lower;
    double upper = span.upper - stay.lower - grid.lower;
    const double turns = kTurn * std::ceil(-upper / kTurn);
    lower += turns;
    upper += turns;
    std::uint64_t* words = columns.data() + stay.column * words_;
    for (; lower <= range; lower += kTurn, upper += kTurn) {
      const int first = static_cast<int>(std::max(0.0, lower) * per_row);
      const int last = static_cast<int>(std::min(range, upper) * per_row);
      set_bits(words, std::min(first, grid.row_count - 1), std::min(last, grid.row_count - 1));
    }
  }
}

}  // namespace handey::cspace
