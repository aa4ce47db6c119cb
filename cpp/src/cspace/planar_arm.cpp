// A vertex of one polygon is on an edge of the other where a circle about the origin meets the
// edge: a quadratic. All such contact angles are forbidden, being contacts, and between two
// neighbours nothing changes, so a separating-axis test in the middle tells.
#include "handey/cspace/planar_arm.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "handey/errors.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = 2.0 * 3.14159265358979323846;
constexpr double kTouching = 1e-12;  // gap that counts as touching [m], or nothing between [rad]

/// In [0, 2 pi).
double wrapped(double angle) {
  const double turned = angle - kTurn * std::floor(angle / kTurn);
  return turned < kTurn ? turned : 0.0;
}

Polygon turned(const Polygon& polygon, double angle) {
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(angle).toRotationMatrix();
  Polygon result;
  result.reserve(polygon.size());
  for (const Vector2d& point : polygon) result.emplace_back(rotation * point);
  return result;
}

/// Does a line across `axis` keep them apart?
bool parted_along(const Vector2d& axis, const Polygon& a, const Polygon& b) {
  double low_a = axis.dot(a.front()), high_a = low_a;
  for (const Vector2d& point : a) {
    low_a = std::min(low_a, axis.dot(point));
    high_a = std::max(high_a, axis.dot(point));
  }
  double low_b = axis.dot(b.front()), high_b = low_b;
  for (const Vector2d& point : b) {
    low_b = std::min(low_b, axis.dot(point));
    high_b = std::max(high_b, axis.dot(point));
  }
  return std::max(low_b - high_a, low_a - high_b) > kTouching;
}

/// One of the directions that can part the two is across an edge; along one, if they are segments.
bool parted_by_edges_of(const Polygon& edges, const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vector2d edge = edges[(i + 1) % edges.size()] - edges[i];
    const double length = edge.norm();
    if (length == 0.0) continue;
    if (parted_along(Vector2d(-edge.y(), edge.x()) / length, a, b)) return true;
    if (edges.size() < 3 && parted_along(edge / length, a, b)) return true;
  }
  return false;
}

bool meet(const Polygon& a, const Polygon& b) {
  if (a.size() == 1 && b.size() == 1) return (a.front() - b.front()).norm() <= kTouching;
  return !parted_by_edges_of(a, a, b) && !parted_by_edges_of(b, a, b);
}

/// Nearest and farthest distance of a convex polygon from the origin.
struct Ring {
  double inner = 0.0, outer = 0.0;
};

Ring ring_of(const Polygon& polygon) {
  Ring ring;
  const Polygon origin{Vector2d::Zero()};
  double nearest = polygon.front().norm();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - a;
    const double squared = edge.squaredNorm();
    const double t = squared > 0.0 ? std::clamp(-a.dot(edge) / squared, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + t * edge).norm());
    ring.outer = std::max(ring.outer, a.norm());
  }
  ring.inner = meet(polygon, origin) ? 0.0 : nearest;
  return ring;
}

/// Adds the directions of the points of the edges at the given distance from the origin, less
/// `from`, with a sign.
void add_contacts(const Vector2d& vertex, const Polygon& edges, double sign,
                  std::vector<double>& angles) {
  const double radius = vertex.norm();
  const double direction = std::atan2(vertex.y(), vertex.x());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vector2d& a = edges[i];
    const Vector2d edge = edges[(i + 1) % edges.size()] - a;
    const double length = edge.norm();
    if (length == 0.0) continue;
    // The line's foot, and half the chord that the circle cuts out of it.
    const Vector2d along = edge / length;
    const double foot = -a.dot(along);
    const double distance = std::abs(a.x() * along.y() - a.y() * along.x());
    if (distance > radius + kTouching) continue;
    const double half = std::sqrt(std::max(0.0, (radius - distance) * (radius + distance)));
    for (const double at : {foot - half, foot + half}) {
      if (at < -kTouching || at > length + kTouching) continue;
      const Vector2d point = a + std::clamp(at, 0.0, length) * along;
      angles.push_back(wrapped(sign * (std::atan2(point.y(), point.x()) - direction)));
    }
  }
}

void add_forbidden(const Polygon& link, const Ring& link_ring, const Polygon& obstacle,
                   const Ring& obstacle_ring, std::vector<AngleInterval>& intervals) {
  if (link_ring.inner > obstacle_ring.outer + kTouching ||
      obstacle_ring.inner > link_ring.outer + kTouching) {
    return;
  }
  std::vector<double> angles;
  for (const Vector2d& vertex : link) add_contacts(vertex, obstacle, 1.0, angles);
  for (const Vector2d& vertex : obstacle) add_contacts(vertex, link, -1.0, angles);
  if (angles.empty()) {
    if (meet(link, obstacle)) intervals.push_back({0.0, kTurn});
    return;
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    intervals.push_back({angles[i], angles[i]});
    const bool last = i + 1 == angles.size();
    const double next = last ? angles.front() + kTurn : angles[i + 1];
    if (!meet(turned(link, 0.5 * (angles[i] + next)), obstacle)) continue;
    intervals.push_back({angles[i], std::min(next, kTurn)});
    if (last) intervals.push_back({0.0, angles.front()});
  }
}

std::vector<AngleInterval> merged(std::vector<AngleInterval> intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const AngleInterval& a, const AngleInterval& b) { return a.lower < b.lower; });
  std::vector<AngleInterval> result;
  for (const AngleInterval& interval : intervals) {
    if (!result.empty() && interval.lower <= result.back().upper + kTouching) {
      result.back().upper = std::max(result.back().upper, interval.upper);
    } else {
      result.push_back(interval);
    }
  }
  return result;
}

/// Checked, and in the order that the tests above rely on.
Polygon convex(const Polygon& polygon, const char* place) {
  if (polygon.size() < 3) {
    throw InvalidInput("E_EMPTY", place,
                       "found " + std::to_string(polygon.size()) + " points, expected 3 or more");
  }
  for (const Vector2d& point : polygon) {
    if (!point.allFinite()) throw InvalidInput("E_NUMBER", place, "a point is not finite");
  }
  return convex_hull(polygon);
}

/// Convex polygons about a joint.
struct Pieces {
  std::vector<Polygon> polygons;
  std::vector<Ring> rings;
};

Pieces pieces_of(const std::vector<Polygon>& polygons, const char* place) {
  Pieces pieces;
  for (const Polygon& polygon : polygons) {
    pieces.polygons.push_back(convex(polygon, place));
    pieces.rings.push_back(ring_of(pieces.polygons.back()));
  }
  return pieces;
}

std::vector<AngleInterval> forbidden(const Pieces& links, const Pieces& obstacles) {
  std::vector<AngleInterval> intervals;
  for (std::size_t l = 0; l < links.polygons.size(); ++l) {
    for (std::size_t o = 0; o < obstacles.polygons.size(); ++o) {
      add_forbidden(links.polygons[l], links.rings[l], obstacles.polygons[o], obstacles.rings[o],
                    intervals);
    }
  }
  return merged(std::move(intervals));
}

/// The obstacles from the elbow.
Pieces moved(const Pieces& obstacles, const Vector2d& elbow) {
  Pieces pieces = obstacles;
  for (std::size_t o = 0; o < pieces.polygons.size(); ++o) {
    for (Vector2d& point : pieces.polygons[o]) point -= elbow;
    pieces.rings[o] = ring_of(pieces.polygons[o]);
  }
  return pieces;
}

/// All angles less `turn`.
std::vector<AngleInterval> shifted(const std::vector<AngleInterval>& intervals, double turn) {
  std::vector<AngleInterval> result;
  for (const AngleInterval& interval : intervals) {
    const double width = interval.upper - interval.lower;
    if (width >= kTurn) return {{0.0, kTurn}};
    const double lower = wrapped(interval.lower - turn), upper = lower + width;
    result.push_back({lower, std::min(upper, kTurn)});
    if (upper > kTurn) result.push_back({0.0, upper - kTurn});
  }
  return merged(std::move(result));
}

}  // namespace

std::vector<AngleInterval> forbidden_angles(const Polygon& link, const Polygon& obstacle) {
  return forbidden_angles(std::vector<Polygon>{link}, std::vector<Polygon>{obstacle});
}

std::vector<AngleInterval> forbidden_angles(const std::vector<Polygon>& links,
                                            const std::vector<Polygon>& obstacles) {
  return forbidden(pieces_of(links, "link"), pieces_of(obstacles, "obstacle"));
}

std::vector<std::vector<AngleInterval>> planar_slice(const PlanarArm& arm,
                                                     const std::vector<Polygon>& obstacles,
                                                     const std::vector<double>& theta2) {
  const Pieces upper = pieces_of(arm.upper, "arm.upper");
  const Pieces lower = pieces_of(arm.lower, "arm.lower");
  const Pieces standing = pieces_of(obstacles, "obstacles");
  if (!arm.elbow.allFinite()) throw InvalidInput("E_NUMBER", "arm.elbow", "is not finite");
  std::vector<std::vector<AngleInterval>> columns;
  for (const double angle : theta2) {
    if (!std::isfinite(angle)) throw InvalidInput("E_NUMBER", "theta2", "is not finite");
    const bool blocked =
        std::any_of(upper.polygons.begin(), upper.polygons.end(), [&](const Polygon& piece) {
          const Polygon at = turned(piece, angle);
          return std::any_of(standing.polygons.begin(), standing.polygons.end(),
                             [&](const Polygon& obstacle) { return meet(at, obstacle); });
        });
    if (blocked) {
      columns.push_back({{0.0, kTurn}});
      continue;
    }
    const Vector2d elbow = Eigen::Rotation2Dd(angle) * arm.elbow;
    columns.push_back(shifted(forbidden(lower, moved(standing, elbow)), angle));
  }
  return columns;
}

}  // namespace handey
