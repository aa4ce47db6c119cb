// Steps in x, y and turn, halved where none is better.
#include "place_mending.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/geometry/section.hpp"
#include "handey/stop.hpp"

namespace handey::collision {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kWider = 1.02;     // clearance that is mended for, over that which is tested
constexpr double kNothing = 1e-9;   // smaller areas are rounding [m2]
constexpr int kMostSteps = 50;      // Choice: of one search
constexpr double kFinest = 1e-4;    // its least step [m]
constexpr std::size_t kMany = 200;  // Choice: of measured obstacles' shapes; such are left out

}  // namespace

Polygon moved(const Polygon& polygon, const PlaceSample& to) {
  const Eigen::Rotation2Dd turn(to.turn);
  Polygon result;
  result.reserve(polygon.size());
  for (const Vector2d& point : polygon) result.push_back(turn * point + to.at);
  return result;
}

double margin_of(const Polygon& hull, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  if (hull.size() < 3) return -least;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d to = hull[i] - point;
    const Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    least = std::min(least, along.y() * to.x() - along.x() * to.y());
  }
  return least;
}

Polygon region_in_face(const Eigen::AlignedBox2d& region, const SupportFace& face) {
  const Pose X_SW = face.X_WS.inverse();
  std::vector<Vector2d> corners;
  for (int i = 0; i < 4; ++i) {
    const Vector2d at = region.corner(static_cast<Eigen::AlignedBox2d::CornerType>(i));
    corners.push_back((X_SW * Vector3d(at.x(), at.y(), face.X_WS.translation().z())).head<2>());
  }
  return convex_hull(corners);
}

PlaceMender::PlaceMender(const Cell& cell, int part, const RestingPose& rest,
                         const SupportFace& face, const StandingPlaceOptions& options)
    : rest_(rest), enclosed_(face.enclosed), inside_(options.inside) {
  std::vector<Region> shadows;
  const Pose X_SW = face.X_WS.inverse();
  const auto add = [&](const Body& body) {
    if (body.shapes.size() > kMany) return;
    for (const Shape& shape : body.shapes) {
      shadows.push_back(slab_projection(shape, X_SW * body.X_WB, options.clearance, rest.top));
    }
  };
  for (const Body& fixture : cell.fixtures) add(fixture);
  for (std::size_t i = 0; i < cell.parts.size(); ++i) {
    const int index = static_cast<int>(i);
    if (index != part && !(cell.held && cell.held->part == index)) add(cell.parts[i]);
  }
  around_ = unite(shadows);
  const Region grown = offset(Region{{rest.shadow}}, kWider * options.clearance);
  shadow_ = grown.empty() ? rest.shadow : grown.loops.front();
  if (options.region) allowed_ = Region{{region_in_face(*options.region, face)}};
}

bool PlaceMender::can_fit() const {
  const double foot = signed_area(rest_.footprint);
  return (!inside_ || foot <= area(enclosed_)) && (allowed_.empty() || foot <= area(allowed_));
}

double PlaceMender::badness(const PlaceSample& sample) const {
  const Region foot{{moved(rest_.footprint, sample)}};
  double sum = area(intersect(Region{{moved(shadow_, sample)}}, around_));
  if (!allowed_.empty()) sum += area(subtract(foot, allowed_));
  if (inside_) sum += area(subtract(foot, enclosed_));
  return sum;
}

PlaceSample PlaceMender::mended(PlaceSample sample) const {
  double bad = badness(sample);
  double step = 0.25 * std::sqrt(signed_area(rest_.shadow));
  double radius = kFinest;
  for (const Vector2d& corner : rest_.shadow) radius = std::max(radius, corner.norm());
  for (int i = 0; i < kMostSteps && bad > kNothing && step > kFinest; ++i) {
    throw_if_stopped();
    PlaceSample best = sample;
    double least = bad;
    for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                Vector3d(0, -1, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
      const PlaceSample other{sample.at + step * way.head<2>(),
                              sample.turn + step / radius * way.z()};
      const double value = badness(other);
      if (value >= least) continue;
      least = value;
      best = other;
    }
    if (least < bad) {
      sample = best;
      bad = least;
    } else {
      step *= 0.5;
    }
  }
  return sample;
}

}  // namespace handey::collision
