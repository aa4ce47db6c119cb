// Checks of depth images, holes, and the rows of PNG images.
#include "depth_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "handey/errors.hpp"

namespace handey::world {
namespace {

void require_positive(double value, const char* code, const char* place, const char* unit) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidInput(code, place,
                     "found " + std::to_string(value) + ", expected a number > 0 " + unit);
}

bool is_measured(double depth) { return depth > 0.0; }

}  // namespace

void require_valid(const DepthImage& image) {
  if (image.rows < 1 || image.columns < 1 ||
      image.depths.size() !=
          static_cast<std::size_t>(image.rows) * static_cast<std::size_t>(image.columns)) {
    throw InvalidInput("E_IMAGE", "depths",
                       std::to_string(image.depths.size()) + " depths for " +
                           std::to_string(image.rows) + " rows and " +
                           std::to_string(image.columns) + " columns");
  }
  require_positive(image.fx, "E_CAMERA", "fx", "[pixels]");
  require_positive(image.fy, "E_CAMERA", "fy", "[pixels]");
  if (!std::isfinite(image.cx) || !std::isfinite(image.cy)) {
    throw InvalidInput("E_CAMERA", "cx, cy", "are not finite");
  }
  require_rigid(image.X_WD, "X_WD");
  require_positive(image.far, "E_RANGE", "far", "[m]");
  if (!std::isfinite(image.explained) || image.explained < 0.0) {
    throw InvalidInput("E_RANGE", "explained", "must be finite and not negative [m]");
  }
  bool any = false;
  for (const double depth : image.depths) {
    if (std::isinf(depth) || depth < 0.0) {
      throw InvalidInput("E_NUMBER", "depths",
                         "found " + std::to_string(depth) +
                             ", expected a finite depth >= 0, or NaN for not measured [m]");
    }
    any = any || is_measured(depth);
  }
  if (!any) throw InvalidInput("E_IMAGE", "depths", "no pixel is measured");
}

std::vector<double> closed_holes(const DepthImage& image) {
  std::vector<double> closed = image.depths;
  const int columns = image.columns, last = static_cast<int>(closed.size());
  std::vector<int> hole;
  for (int start = 0; start < last; ++start) {
    if (is_measured(closed[static_cast<std::size_t>(start)])) continue;
    // The pixels of this hole; -1 marks those that are already in the list.
    double nearest = std::numeric_limits<double>::infinity();
    hole.assign(1, start);
    closed[static_cast<std::size_t>(start)] = -1.0;
    const auto look = [&](int i) {
      double& depth = closed[static_cast<std::size_t>(i)];
      if (is_measured(depth)) {
        nearest = std::min(nearest, depth);
      } else if (depth != -1.0) {
        depth = -1.0;
        hole.push_back(i);
      }
    };
    for (std::size_t k = 0; k < hole.size(); ++k) {
      const int i = hole[k], u = i % columns;
      if (u > 0) look(i - 1);
      if (u + 1 < columns) look(i + 1);
      if (i >= columns) look(i - columns);
      if (i + columns < last) look(i + columns);
    }
    for (const int i : hole) closed[static_cast<std::size_t>(i)] = nearest;
  }
  return closed;
}

}  // namespace handey::world

namespace handey {
namespace {

unsigned char paeth(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int to_left = std::abs(guess - left), to_above = std::abs(guess - above),
            to_corner = std::abs(guess - corner);
  if (to_left <= to_above && to_left <= to_corner) return static_cast<unsigned char>(left);
  return static_cast<unsigned char>(to_above <= to_corner ? above : corner);
}

}  // namespace

std::vector<unsigned short> unfilter_png16(const unsigned char* bytes, std::size_t count, int rows,
                                           int columns) {
  const std::size_t width = 2 * static_cast<std::size_t>(std::max(columns, 0));
  if (rows < 1 || columns < 1 || count != static_cast<std::size_t>(rows) * (width + 1)) {
    throw InvalidInput("E_IMAGE", "bytes",
                       std::to_string(count) + " bytes do not make " + std::to_string(rows) +
                           " rows of " + std::to_string(columns) + " pixels");
  }
  // Two bytes of zeros stand left of each row: what the filters see beyond the border.
  std::vector<unsigned char> above(width + 2, 0), row(width + 2, 0);
  std::vector<unsigned short> values;
  values.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int v = 0; v < rows; ++v) {
    const unsigned char* source = bytes + static_cast<std::size_t>(v) * (width + 1);
    const int filter = *source++;
    if (filter > 4) throw InvalidInput("E_IMAGE", "bytes", "a row has an unknown filter");
    for (std::size_t i = 2; i < width + 2; ++i) {
      const int left = row[i - 2], up = above[i], corner = above[i - 2];
      int guess = 0;
      if (filter == 1) guess = left;
      if (filter == 2) guess = up;
      if (filter == 3) guess = (left + up) / 2;
      if (filter == 4) guess = paeth(left, up, corner);
      row[i] = static_cast<unsigned char>(source[i - 2] + guess);
    }
    for (std::size_t i = 2; i < width + 2; i += 2) {
      values.push_back(static_cast<unsigned short>(row[i] << 8 | row[i + 1]));
    }
    std::swap(above, row);
  }
  return values;
}

}  // namespace handey
