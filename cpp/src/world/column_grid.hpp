// Columns on a grid, and quick answers about rectangles of them: where the full ones are, which
// planes they lie along, and where a rectangle is best cut in two.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "column_cover.hpp"

namespace handey::world {

/// Rows [v0, v1), columns [u0, u1).
struct Rectangle {
  int v0 = 0, v1 = 0, u0 = 0, u1 = 0;
  int size() const { return (v1 - v0) * (u1 - u0); }
};

/// w = at + a u + b v, u and v from a rectangle's first cell.
struct Plane {
  double at = 0.0, a = 0.0, b = 0.0;
  double operator()(double u, double v) const { return at + a * u + b * v; }
  double step() const;  ///< most that it changes across a cell
};

constexpr std::size_t kSpreads = 2;  // besides none

class ColumnGrid {
 public:
  /// @param empty_cost  of an empty column in a rectangle, as the square of w: what is best cut
  ColumnGrid(Columns columns, double empty_cost);

  bool is_full(std::size_t i) const { return full_[i] != 0; }
  /// Ends of the column, or of a full one near it. Spread 1 or 2: the farthest ends that are
  /// reached from this column over neighbours, as many columns aside along each side, without
  /// leaving what is solid: what lies between is so near to something solid.
  double upper(std::size_t i, std::size_t spread) const {
    return spread == 0 ? upper_[i] : static_cast<double>(wide_upper_[spread - 1][i]);
  }
  double lower(std::size_t i, std::size_t spread) const {
    return spread == 0 ? lower_[i] : static_cast<double>(wide_lower_[spread - 1][i]);
  }
  /// To that one, between centres [cells].
  double distance(std::size_t i) const;
  std::size_t index(int v, int u) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  Rectangle all() const { return {0, rows_, 0, width_}; }
  /// The least rectangle about the full columns within; false if there is none.
  bool trim(Rectangle& rectangle) const;
  /// Of least squares through the upper ends of the full columns (of some, where they are many).
  Plane regression(const Rectangle& rectangle) const;
  /// Cuts a rectangle of more than one column where the two are best described by planes.
  void cut(const Rectangle& rectangle, Rectangle& one, Rectangle& two) const;
  /// The convex polygon about the full columns, counter-clockwise with u to the right and v up,
  /// within the rectangle, of few corners. u and v from its first cell.
  std::vector<Eigen::Vector2d> outline(const Rectangle& rectangle) const;

 private:
  struct Sums {
    double n = 0, u = 0, v = 0, w = 0, uu = 0, uv = 0, vv = 0, uw = 0, vw = 0, ww = 0;
    void add(double x, double y, double z);
    void add(const Sums& other, double sign);
    double residual() const;  ///< sum of squares about the plane of least squares
    Plane plane() const;
  };
  /// Sums over all tiles above and to the left.
  struct SumTable {
    int tile = 1, rows = 0, columns = 0;
    std::vector<Sums> sums;
    Sums of(int v0, int v1, int u0, int u1) const;
  };

  void fill_empty();
  template <class From>
  void spread(const std::vector<From>& upper, const std::vector<From>& lower,
              std::vector<float>& wide_upper, std::vector<float>& wide_lower) const;
  void count();
  SumTable table_of(const Rectangle& rectangle, int tile) const;
  int count_in(const Rectangle& rectangle) const;
  double cost(const SumTable& table, const Rectangle& rectangle, const Rectangle& origin) const;

  int rows_, width_;
  double empty_cost_;
  std::vector<char> full_;
  std::vector<double> upper_, lower_;
  std::array<std::vector<float>, kSpreads> wide_upper_, wide_lower_;
  std::vector<std::int32_t> source_;  // full column near each
  std::vector<std::int32_t> counts_;  // full columns above and to the left
  SumTable tiles_;
};

}  // namespace handey::world
