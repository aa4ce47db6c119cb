// The convex pieces of the gripper grown by the clearance: each edge moved out, its ends where the
// neighbours' lines meet it. A corner sharper than a right angle gets a line of its own across it,
// or its spike would reach far ahead.
#include "handey/approach/bump_lines.hpp"

#include <cmath>
#include <string>

#include "handey/errors.hpp"

namespace handey {

namespace {

struct Line {  // the half plane normal . x <= distance
  Eigen::Vector2d normal;
  double distance;
};

Eigen::Vector2d meeting_point(const Line& first, const Line& second) {
  Eigen::Matrix2d normals;
  normals << first.normal.transpose(), second.normal.transpose();
  return normals.inverse() * Eigen::Vector2d(first.distance, second.distance);
}

/// The lines round a convex polygon grown by the clearance, counter-clockwise.
std::vector<Line> grown_lines(const Polygon& polygon, double clearance) {
  constexpr double kParallel = 1e-6;  // [rad]; edges that turn less are one edge
  struct Edge {
    Eigen::Vector2d normal, end;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& end = polygon[(i + 1) % polygon.size()];
    const Eigen::Vector2d along = end - polygon[i];
    const Eigen::Vector2d normal = Eigen::Vector2d(along.y(), -along.x()).normalized();
    if (!edges.empty() && (normal - edges.back().normal).norm() < kParallel) {
      edges.back().end = end;
    } else {
      edges.push_back({normal, end});
    }
  }
  if ((edges.front().normal - edges.back().normal).norm() < kParallel) edges.pop_back();
  std::vector<Line> lines;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector2d& normal = edges[i].normal;
    const Eigen::Vector2d& next = edges[(i + 1) % edges.size()].normal;
    lines.push_back({normal, normal.dot(edges[i].end) + clearance});
    if (normal.dot(next) > -1e-9) continue;
    const Eigen::Vector2d across = (normal + next).normalized();
    lines.push_back({across, across.dot(edges[i].end) + clearance});
  }
  return lines;
}

void require_convex(const OutlinePiece& piece, std::size_t index) {
  const std::string place = "gripper outline, piece " + std::to_string(index);
  const Polygon& p = piece.polygon;
  for (const Eigen::Vector2d& point : p) {
    if (!point.allFinite()) throw InvalidInput("E_NUMBER", place, "a point is not finite");
  }
  if (p.size() < 3 || signed_area(p) <= 0.0) {
    throw InvalidInput("E_GEOMETRY", place,
                       "its polygon must be counter-clockwise with at least three points");
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d u = p[(i + 1) % p.size()] - p[i];
    const Eigen::Vector2d v = p[(i + 2) % p.size()] - p[(i + 1) % p.size()];
    if (u.norm() < 1e-9 || u.x() * v.y() - u.y() * v.x() < -1e-9 * u.norm() * v.norm()) {
      throw InvalidInput("E_GEOMETRY", place,
                         "its polygon must be convex, without repeated points");
    }
  }
}

}  // namespace

std::vector<BumpLine> bump_lines(const GripperOutline& outline, double clearance) {
  if (!std::isfinite(clearance) || clearance <= 0.0) {
    throw InvalidInput("E_RANGE", "bump lines",
                       "clearance " + std::to_string(clearance) + " m must be positive");
  }
  std::vector<BumpLine> result;
  for (std::size_t layer = 0; layer < outline.pieces.size(); ++layer) {
    require_convex(outline.pieces[layer], layer);
    const std::vector<Line> lines = grown_lines(outline.pieces[layer].polygon, clearance);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Line& before = lines[(i + lines.size() - 1) % lines.size()];
      const Line& after = lines[(i + 1) % lines.size()];
      result.push_back({meeting_point(before, lines[i]), meeting_point(lines[i], after),
                        lines[i].normal, static_cast<int>(layer)});
    }
  }
  return result;
}

}  // namespace handey
