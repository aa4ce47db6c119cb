// Edges of the pieces by supercover; cells by their centres.
#include "hand_on_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace handey {

Eigen::Vector2d turned(const PlanarPose& pose, const Eigen::Vector2d& in_hand) {
  const double c = std::cos(pose.theta), s = std::sin(pose.theta);
  return {c * in_hand.x() - s * in_hand.y(), s * in_hand.x() + c * in_hand.y()};
}

Eigen::Vector2d placed(const PlanarPose& pose, const Eigen::Vector2d& in_hand) {
  return Eigen::Vector2d(pose.x, pose.y) + turned(pose, in_hand);
}

bool touches_filled(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& pose) {
  for (std::size_t layer = 0; layer < outline.pieces.size(); ++layer) {
    const Polygon& polygon = outline.pieces[layer].polygon;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (grid.touches(static_cast<int>(layer), placed(pose, polygon[i]),
                       placed(pose, polygon[(i + 1) % polygon.size()]))) {
        return true;
      }
    }
  }
  return false;
}

bool covers_filled(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& pose) {
  const Eigen::Vector2d& corner = grid.corner();
  for (std::size_t layer = 0; layer < outline.pieces.size(); ++layer) {
    Region piece;
    piece.loops.push_back(outline.pieces[layer].polygon);
    for (Eigen::Vector2d& point : piece.loops.front()) point = placed(pose, point);
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& point : piece.loops.front()) box.extend(point);
    const auto cell_at = [&](double x, double low) {
      return static_cast<int>(
          std::clamp(std::floor((x - low) / grid.cell()), 0.0, grid.side() - 1.0));
    };
    for (int row = cell_at(box.min().y(), corner.y()); row <= cell_at(box.max().y(), corner.y());
         ++row) {
      for (int column = cell_at(box.min().x(), corner.x());
           column <= cell_at(box.max().x(), corner.x()); ++column) {
        if (!grid.is_filled(static_cast<int>(layer), column, row)) continue;
        const Eigen::Vector2d centre =
            corner + grid.cell() * Eigen::Vector2d(column + 0.5, row + 0.5);
        if (contains(piece, centre)) return true;
      }
    }
  }
  return false;
}

}  // namespace handey
