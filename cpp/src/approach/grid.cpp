// Cells of the grasp plane. A segment is cut into its stretch in each row of cells; the columns
// under that stretch are the cells it touches. A region is its border, cell by cell, and the cells
// whose centres it encloses: a cell that no border touches is wholly inside or wholly outside.
#include "handey/approach/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "handey/errors.hpp"

namespace handey {

namespace {

// Choice: far below any length that matters, far above rounding at metre scale; a segment this near
// a cell touches it.
constexpr double kTouch = 1e-9;
constexpr int kMostCells = 4096;

int checked_side(const Eigen::Vector2d& centre, double half_size, double cell) {
  if (!centre.allFinite() || !std::isfinite(half_size) || !std::isfinite(cell)) {
    throw InvalidInput("E_NUMBER", "motion grid",
                       "centre, half size and cell must be finite numbers");
  }
  if (half_size <= 0.0 || cell <= 0.0) {
    throw InvalidInput("E_RANGE", "motion grid",
                       "half size " + std::to_string(half_size) + " m and cell " +
                           std::to_string(cell) + " m must be positive");
  }
  const double cells = std::ceil(2.0 * half_size / cell - kTouch);
  if (cells > kMostCells) {
    throw InvalidInput("E_RANGE", "motion grid",
                       "half size " + std::to_string(half_size) + " m with cells of " +
                           std::to_string(cell) + " m needs more than 4096 cells a side");
  }
  return std::max(1, static_cast<int>(cells));
}

}  // namespace

MotionGrid::MotionGrid(const Eigen::Vector2d& centre, double half_size, double cell, int layers)
    : centre_(centre),
      half_size_(half_size),
      cell_(cell),
      side_(checked_side(centre, half_size, cell)),
      layers_(layers) {
  if (layers < 1 || layers > 256) {
    throw InvalidInput("E_RANGE", "motion grid",
                       std::to_string(layers) + " layers; there must be 1 to 256");
  }
  corner_ = centre - Eigen::Vector2d::Constant(0.5 * side_ * cell);
  filled_.assign(index(layers, 0, 0), 0);
}

bool MotionGrid::is_inside(const Eigen::Vector2d& point) const {
  return (point - centre_).cwiseAbs().maxCoeff() <= half_size_ + kTouch;
}

template <typename Visit>
bool MotionGrid::visit_cells(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                             const Visit& visit) const {
  // In units of cells from the corner, low end in y first.
  Eigen::Vector2d low = (a - corner_) / cell_, high = (b - corner_) / cell_;
  if (low.y() > high.y()) std::swap(low, high);
  const double touch = kTouch / cell_;
  const double last = static_cast<double>(side_ - 1);
  if (high.y() < -touch || low.y() > side_ + touch) return false;
  const int first_row = static_cast<int>(std::clamp(std::floor(low.y() - touch), 0.0, last));
  const int last_row = static_cast<int>(std::clamp(std::floor(high.y() + touch), 0.0, last));
  const double rise = high.y() - low.y();
  for (int row = first_row; row <= last_row; ++row) {
    double enter = 0.0, leave = 1.0;  // along the segment, within this row
    if (rise > touch) {
      enter = std::clamp((row - touch - low.y()) / rise, 0.0, 1.0);
      leave = std::clamp((row + 1 + touch - low.y()) / rise, 0.0, 1.0);
    }
    const double x0 = low.x() + enter * (high.x() - low.x());
    const double x1 = low.x() + leave * (high.x() - low.x());
    const double first = std::floor(std::min(x0, x1) - touch);
    const double final = std::floor(std::max(x0, x1) + touch);
    if (final < 0.0 || first > last) continue;
    const int last_column = static_cast<int>(std::min(final, last));
    for (int column = static_cast<int>(std::max(first, 0.0)); column <= last_column; ++column) {
      if (visit(column, row)) return true;
    }
  }
  return false;
}

void MotionGrid::require_fits(int layer, const Region& region) const {
  if (layer < 0 || layer >= layers_) {
    throw InvalidInput("E_RANGE", "motion grid",
                       "layer " + std::to_string(layer) + "; the grid has layers 0 to " +
                           std::to_string(layers_ - 1));
  }
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) {
      if (!point.allFinite()) {
        throw InvalidInput("E_NUMBER", "motion grid", "a point of the region is not finite");
      }
    }
  }
}

void MotionGrid::fill(int layer, const Region& region) {
  require_fits(layer, region);
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      visit_cells(loop[i], loop[(i + 1) % loop.size()], [&](int column, int row) {
        filled_[index(layer, column, row)] = 1;
        return false;
      });
    }
  }
  visit_interior(region, [&](int first, int last, int row) {
    std::fill_n(filled_.begin() + static_cast<std::ptrdiff_t>(index(layer, first, row)),
                last - first + 1, std::uint8_t{1});
  });
}

void MotionGrid::fill_inside(int layer, const Region& region) {
  require_fits(layer, region);
  // Cells that the border touches, per row, so as not to forget what is filled already.
  std::vector<std::vector<int>> border(static_cast<std::size_t>(side_));
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      visit_cells(loop[i], loop[(i + 1) % loop.size()], [&](int column, int row) {
        border[static_cast<std::size_t>(row)].push_back(column);
        return false;
      });
    }
  }
  for (std::vector<int>& columns : border) std::sort(columns.begin(), columns.end());
  visit_interior(region, [&](int first, int last, int row) {
    const std::vector<int>& columns = border[static_cast<std::size_t>(row)];
    auto next = std::lower_bound(columns.begin(), columns.end(), first);
    for (int column = first; column <= last; ++column) {
      while (next != columns.end() && *next < column) ++next;
      if (next == columns.end() || *next != column) filled_[index(layer, column, row)] = 1;
    }
  });
}

template <typename Visit>
void MotionGrid::visit_interior(const Region& region, const Visit& visit) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) {
      low = std::min(low, point.y());
      high = std::max(high, point.y());
    }
  }
  if (!(high - low > cell_)) return;  // its border fills all the cells it meets
  const auto row_at = [&](double y) {
    return static_cast<int>(std::clamp((y - corner_.y()) / cell_, 0.0, side_ - 1.0));
  };
  std::vector<std::pair<double, int>> crossings;  // x in cells, change of the winding number
  for (int row = row_at(low); row <= row_at(high); ++row) {
    const double y = corner_.y() + (row + 0.5) * cell_;
    crossings.clear();
    for (const Polygon& loop : region.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& a = loop[i];
        const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
        if ((a.y() > y) == (b.y() > y)) continue;
        const double x = a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        crossings.emplace_back((x - corner_.x()) / cell_, a.y() > y ? 1 : -1);
      }
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
      winding += crossings[k].second;
      if (winding == 0) continue;
      // Cells whose centre lies between this crossing and the next.
      const double first = std::ceil(crossings[k].first - 0.5);
      const double last = std::floor(crossings[k + 1].first - 0.5);
      if (last < 0.0 || first > side_ - 1) continue;
      const int start = static_cast<int>(std::max(first, 0.0));
      const int end = static_cast<int>(std::min(last, static_cast<double>(side_ - 1)));
      if (start <= end) visit(start, end, row);
    }
  }
}

bool MotionGrid::touches(int layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  return visit_cells(a, b, [&](int column, int row) { return is_filled(layer, column, row); });
}

}  // namespace handey
