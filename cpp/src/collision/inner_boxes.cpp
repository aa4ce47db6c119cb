// Boxes inside a closed surface, by cutting its box into cells.
#include "inner_boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "handey/collision/solids.hpp"
#include "handey/stop.hpp"

namespace handey::collision {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::size_t kMostCuts = 24;  // along an axis; Choice: at most some 10 000 cells
constexpr int kEvenCuts = 16;
constexpr double kSameCut = 1e-5;  // [m]
// Triangles this near under a cell's faces count as on them; the solids' skin is thicker.
constexpr double kShrink = 0.5 * kInnerSkin;

/// Coordinates at which one axis is cut, ascending.
std::vector<double> cuts_along(int axis, const std::vector<Vector3d>& points, double half) {
  std::vector<double> all;
  for (const Vector3d& point : points) all.push_back(point[axis]);
  std::sort(all.begin(), all.end());
  std::vector<double> cuts;
  for (const double value : all) {
    if (cuts.empty() || value - cuts.back() > kSameCut) cuts.push_back(value);
    if (cuts.size() > kMostCuts) break;
  }
  if (cuts.size() >= 2 && cuts.size() <= kMostCuts) return cuts;
  cuts.clear();
  for (int i = 0; i <= kEvenCuts; ++i) cuts.push_back(half * (2.0 * i / kEvenCuts - 1.0));
  return cuts;
}

/// Do a triangle and a box have a point in common? By separating axes.
bool meet(const std::array<Vector3d, 3>& corners, const AlignedBox3d& box) {
  const Vector3d half = 0.5 * box.sizes();
  std::array<Vector3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = corners[k] - box.center();
  const auto separates = [&](const Vector3d& axis) {
    const double a = p[0].dot(axis), b = p[1].dot(axis), c = p[2].dot(axis);
    const double reach = half.dot(axis.cwiseAbs());
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  for (int i = 0; i < 3; ++i) {
    const Vector3d unit = Vector3d::Unit(i);
    if (separates(unit)) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (separates(unit.cross(p[(k + 1) % 3] - p[k]))) return false;
    }
  }
  return !separates((p[1] - p[0]).cross(p[2] - p[0]));
}

/// The cells between the cuts, and which of them are wholly inside.
class CellGrid {
 public:
  CellGrid(const Piece& piece, const Pose& X_OB) {
    const TriangleMesh& mesh = piece.polyhedral().mesh;
    std::vector<Vector3d> points;
    for (const Vector3d& vertex : mesh.vertices) points.push_back(X_OB * vertex);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = static_cast<std::size_t>(axis);
      cuts_[at] = cuts_along(axis, points, piece.box.half[axis]);
      size_[at] = static_cast<int>(cuts_[at].size()) - 1;
    }
    inside_.assign(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]), 1);
    for (const Eigen::Vector3i& t : mesh.triangles) {
      throw_if_stopped();
      strike_out({points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                  points[static_cast<std::size_t>(t[2])]});
    }
    const Pose X_BO = X_OB.inverse();
    each_cell({0, 0, 0}, size_, [&](const std::array<int, 3>& i) {
      char& inside = inside_[index(i)];
      if (inside != 0 && !piece.polyhedral().tree.contains(X_BO * box(i, i).center())) inside = 0;
    });
  }

  /// Takes boxes of cells until none is left.
  std::vector<AlignedBox3d> boxes() {
    std::vector<AlignedBox3d> result;
    each_cell({0, 0, 0}, size_, [&](const std::array<int, 3>& first) {
      if (inside_[index(first)] == 0) return;
      std::array<int, 3> lower = first, upper = first;
      while (grow(lower, upper)) throw_if_stopped();
      each_cell(lower, {upper[0] + 1, upper[1] + 1, upper[2] + 1},
                [this](const std::array<int, 3>& i) { inside_[index(i)] = 0; });
      result.push_back(box(lower, upper));
    });
    return result;
  }

 private:
  using Index = std::array<int, 3>;

  std::size_t index(const Index& i) const {
    return static_cast<std::size_t>((i[0] * size_[1] + i[1]) * size_[2] + i[2]);
  }
  AlignedBox3d box(const Index& lower, const Index& upper) const {
    AlignedBox3d result;
    for (std::size_t k = 0; k < 3; ++k) {
      const int at = static_cast<int>(k);
      result.min()[at] = cuts_[k][static_cast<std::size_t>(lower[k])];
      result.max()[at] = cuts_[k][static_cast<std::size_t>(upper[k] + 1)];
    }
    return result;
  }
  template <class Visit>
  static void each_cell(const Index& from, const Index& to, const Visit& visit) {
    Index i;
    for (i[0] = from[0]; i[0] < to[0]; ++i[0]) {
      for (i[1] = from[1]; i[1] < to[1]; ++i[1]) {
        for (i[2] = from[2]; i[2] < to[2]; ++i[2]) visit(i);
      }
    }
  }

  void strike_out(const std::array<Vector3d, 3>& corners) {
    Index from, to;
    for (std::size_t k = 0; k < 3; ++k) {
      const int at = static_cast<int>(k);
      const double low = std::min({corners[0][at], corners[1][at], corners[2][at]});
      const double high = std::max({corners[0][at], corners[1][at], corners[2][at]});
      const auto begin = cuts_[k].begin(), end = cuts_[k].end();
      from[k] = std::max(0, static_cast<int>(std::lower_bound(begin, end, low) - begin) - 1);
      to[k] = std::min(size_[k], static_cast<int>(std::upper_bound(begin, end, high) - begin));
    }
    each_cell(from, to, [&](const Index& i) {
      char& inside = inside_[index(i)];
      if (inside == 0) return;
      AlignedBox3d cell = box(i, i);
      cell.min().array() += kShrink;
      cell.max().array() -= kShrink;
      if (meet(corners, cell)) inside = 0;
    });
  }

  bool all_inside(const Index& lower, const Index& upper) const {
    bool all = true;
    each_cell(lower, {upper[0] + 1, upper[1] + 1, upper[2] + 1},
              [&](const Index& i) { all = all && inside_[index(i)] != 0; });
    return all;
  }

  /// Grows a box of cells by the layer that adds most. @return false if none can be added
  bool grow(Index& lower, Index& upper) const {
    double best = 0.0;
    Index best_lower = lower, best_upper = upper;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int side : {-1, 1}) {
        Index low = lower, high = upper;
        (side < 0 ? low : high)[k] += side;
        if (low[k] < 0 || high[k] >= size_[k]) continue;
        const double volume = box(low, high).volume();
        Index layer_low = low, layer_high = high;
        layer_low[k] = layer_high[k] = side < 0 ? low[k] : high[k];
        if (volume <= best || !all_inside(layer_low, layer_high)) continue;
        best = volume;
        best_lower = low;
        best_upper = high;
      }
    }
    lower = best_lower;
    upper = best_upper;
    return best > 0.0;
  }

  std::array<std::vector<double>, 3> cuts_;
  Index size_{};
  std::vector<char> inside_;
};

}  // namespace

std::vector<AlignedBox3d> inner_boxes(const Piece& piece) {
  return CellGrid(piece, piece.box.X_BO.inverse()).boxes();
}

}  // namespace handey::collision
