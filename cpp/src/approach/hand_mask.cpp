// Runs of cells of a footprint are looked up as two runs of a power of two that overlap, for which
// the rows of the grid were united beforehand.
#include "hand_mask.hpp"

#include <algorithm>
#include <cmath>

#include "handey/stop.hpp"

namespace handey {

namespace {

Eigen::Vector2d turned(const Eigen::Vector2d& point, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  return {c * point.x() - s * point.y(), s * point.x() + c * point.y()};
}

/// to |= from, shifted down by `shift` bits; `words` of them are written.
void or_shifted(std::uint64_t* to, const std::uint64_t* from, std::size_t words,
                std::size_t shift) {
  const std::size_t whole = shift / 64, rest = shift % 64;
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t value = from[w + whole] >> rest;
    if (rest != 0) value |= from[w + whole + 1] << (64 - rest);
    to[w] |= value;
  }
}

}  // namespace

HandMasks::HandMasks(const MotionGrid& grid, const GripperOutline& outline,
                     const Eigen::Vector2d& anchor, int half, bool inside)
    : outline_(outline), half_(half), inside_(inside), cell_(grid.cell()), side_(grid.side()) {
  const Eigen::Vector2d at = (anchor - grid.corner()) / cell_;
  anchor_column_ = static_cast<int>(std::floor(at.x()));
  anchor_row_ = static_cast<int>(std::floor(at.y()));
  offset_ = at - Eigen::Vector2d(anchor_column_, anchor_row_);
  reach_ = 0.0;
  for (const OutlinePiece& piece : outline.pieces) {
    for (const Eigen::Vector2d& point : piece.polygon) reach_ = std::max(reach_, point.norm());
  }
  // The farthest column that a point of the lattice asks for, on either side of the grid.
  const int far = half + static_cast<int>(std::ceil(reach_ / cell_)) + 2;
  margin_ = std::max(0, far - anchor_column_) + 1;
  const int columns = margin_ + std::max(side_, anchor_column_ + far) + 1;
  // Two words more: shifting reads past the last one asked for.
  words_ = static_cast<std::size_t>(columns / 64 + 3 + (2 * half + 1) / 64);
  const std::size_t rows = static_cast<std::size_t>(side_);
  bits_.assign(outline.pieces.size() * kPowers * rows * words_, 0);
  for (std::size_t layer = 0; layer < outline.pieces.size(); ++layer) {
    throw_if_stopped();
    for (int row = 0; row < side_; ++row) {
      std::uint64_t* base =
          &bits_[((layer * kPowers) * rows + static_cast<std::size_t>(row)) * words_];
      for (int column = 0; column < side_; ++column) {
        if (!grid.is_filled(static_cast<int>(layer), column, row)) continue;
        const std::size_t bit = static_cast<std::size_t>(column + margin_);
        base[bit / 64] |= std::uint64_t{1} << (bit % 64);
      }
      for (int power = 1; power < kPowers; ++power) {
        const std::uint64_t* half_run =
            &bits_[((layer * kPowers + static_cast<std::size_t>(power - 1)) * rows +
                    static_cast<std::size_t>(row)) *
                   words_];
        std::uint64_t* run = &bits_[((layer * kPowers + static_cast<std::size_t>(power)) * rows +
                                     static_cast<std::size_t>(row)) *
                                    words_];
        std::copy(half_run, half_run + words_, run);
        const std::size_t shift = std::size_t{1} << (power - 1);
        or_shifted(run, half_run, words_ - shift / 64 - 1, shift);
      }
    }
  }
}

const std::uint64_t* HandMasks::row_of(std::size_t layer, int power, int row) const {
  return &bits_[((layer * kPowers + static_cast<std::size_t>(power)) *
                     static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(row)) *
                words_];
}

/// The cells of a piece, row by row, the finger grasp point at the anchor.
std::vector<HandMasks::Span> HandMasks::footprint(const Polygon& piece, double theta) const {
  std::vector<Span> spans;
  if (piece.empty()) return spans;
  Region region;
  region.loops.emplace_back();
  for (const Eigen::Vector2d& point : piece) {
    region.loops.front().push_back(turned(point, theta) + cell_ * offset_);
  }
  const int around = static_cast<int>(std::ceil(reach_ / cell_)) + 2;
  // Cell (around, around) of this grid is the anchor's cell.
  MotionGrid stamp(Eigen::Vector2d::Constant(0.5 * cell_), (around + 0.5) * cell_, cell_, 1);
  inside_ ? stamp.fill_inside(0, region) : stamp.fill(0, region);
  for (int row = 0; row < stamp.side(); ++row) {
    int first = 0, last = stamp.side() - 1;
    while (first <= last && !stamp.is_filled(0, first, row)) ++first;
    while (last >= first && !stamp.is_filled(0, last, row)) --last;
    if (first <= last) spans.push_back({row - around, first - around, last - around});
  }
  return spans;
}

void HandMasks::dilate(std::size_t layer, const std::vector<Span>& spans, PointMask& mask) const {
  for (const Span& span : spans) {
    const int length = span.last - span.first + 1;
    int power = 0;
    while (power + 1 < kPowers && (2 << power) <= length) ++power;
    const int run = 1 << power;
    for (int j = -half_; j <= half_; ++j) {
      const int row = anchor_row_ + j + span.row;
      if (row < 0 || row >= side_) continue;
      const std::uint64_t* filled = row_of(layer, power, row);
      // Longer than two runs only where a footprint has more than 256 columns.
      for (int from = span.first; from <= span.last; from += run) {
        const int start = std::min(from, span.last - run + 1);
        const int bit = anchor_column_ + margin_ - half_ + start;
        or_shifted(mask.row(j), filled, mask.words(), static_cast<std::size_t>(bit));
      }
    }
  }
}

PointMask HandMasks::at(double theta) const {
  PointMask mask(half_);
  for (std::size_t layer = 0; layer < outline_.pieces.size(); ++layer) {
    dilate(layer, footprint(outline_.pieces[layer].polygon, theta), mask);
  }
  return mask;
}

}  // namespace handey
