// Questions about plane regions that need no booleans: membership, distance to the boundary, the
// largest inscribed circle, the convex hull. In floating point; a point on an edge may count as
// inside or outside.
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "handey/errors.hpp"
#include "handey/geometry/polygon.hpp"

namespace handey {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double squared_distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * edge).squaredNorm();
}

int winding(const Polygon& loop, const Eigen::Vector2d& point) {
  int turns = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d& a = loop[i];
    const Eigen::Vector2d& b = loop[(i + 1) % loop.size()];
    if (a.y() <= point.y() && b.y() > point.y() && cross(b - a, point - a) > 0.0) ++turns;
    if (a.y() > point.y() && b.y() <= point.y() && cross(b - a, point - a) < 0.0) --turns;
  }
  return turns;
}

double signed_distance(const Region& region, const Eigen::Vector2d& point) {
  const double distance = boundary_distance(region, point);
  return contains(region, point) ? distance : -distance;
}

// A square of the search; no circle centred in it is larger than `bound`.
struct SquareCell {
  Eigen::Vector2d centre;
  double half = 0.0;
  double distance = 0.0;  // from the centre to the boundary, negative outside
  double bound = 0.0;
  bool operator<(const SquareCell& other) const { return bound < other.bound; }
};

SquareCell make_cell(const Region& region, const Eigen::Vector2d& centre, double half) {
  const double distance = signed_distance(region, centre);
  return {centre, half, distance, distance + half * std::sqrt(2.0)};
}

/// Takes out corners that stand out by less than 1e-12 m from between their neighbours.
void drop_collinear(Polygon& loop) {
  for (std::size_t i = 0; i < loop.size() && loop.size() > 2;) {
    const Eigen::Vector2d& before = loop[(i + loop.size() - 1) % loop.size()];
    const Eigen::Vector2d& after = loop[(i + 1) % loop.size()];
    if (squared_distance(loop[i], before, after) > 1e-24) {
      ++i;
    } else {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

}  // namespace

bool contains(const Region& region, const Eigen::Vector2d& point) {
  int turns = 0;
  for (const Polygon& loop : region.loops) turns += winding(loop, point);
  return turns != 0;
}

double boundary_distance(const Region& region, const Eigen::Vector2d& point) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      nearest2 = std::min(nearest2, squared_distance(point, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return std::sqrt(nearest2);
}

InscribedCircle largest_inscribed_circle(const Region& region, double precision) {
  if (!(precision > 0.0) || !std::isfinite(precision)) {
    throw InvalidInput("E_RANGE", "precision",
                       "found " + std::to_string(precision) + ", expected a length > 0 [m]");
  }
  InscribedCircle best;
  if (region.empty()) return best;
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d upper = -lower;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) {
      if (!point.allFinite()) throw InvalidInput("E_NUMBER", "region", "a point is not finite");
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
  }
  std::priority_queue<SquareCell> open;
  open.push(make_cell(region, 0.5 * (lower + upper), 0.5 * (upper - lower).maxCoeff()));
  while (!open.empty()) {
    const SquareCell cell = open.top();
    open.pop();
    if (cell.distance > best.radius) best = {cell.centre, cell.distance};
    if (cell.bound <= best.radius + precision)
      break;  // the queue is ordered: no other cell is better
    const double half = 0.5 * cell.half;
    for (const double dx : {-half, half}) {
      for (const double dy : {-half, half}) {
        const SquareCell quarter = make_cell(region, cell.centre + Eigen::Vector2d(dx, dy), half);
        if (quarter.bound > best.radius + precision) open.push(quarter);
        if (quarter.distance > best.radius) best = {quarter.centre, quarter.distance};
      }
    }
  }
  return best;
}

Polygon convex_hull(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> sorted = points;
  for (const Eigen::Vector2d& point : sorted) {
    if (!point.allFinite()) throw InvalidInput("E_NUMBER", "points", "a point is not finite");
  }
  std::sort(sorted.begin(), sorted.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  // Monotone chain. No tolerance here: where points differ in x by rounding alone, one that counts
  // as collinear may be the corner of an upright side.
  Polygon hull;
  hull.reserve(sorted.size() + 1);
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& point : sorted) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], point - hull[hull.size() - 2]) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  drop_collinear(hull);
  return hull;
}

}  // namespace handey
