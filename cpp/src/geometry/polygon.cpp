// Booleans and offsets of plane regions, on integers of 1e-7 m (Clipper 1, Vatti's algorithm). This
// is the only source that sees Clipper.
#include "handey/geometry/polygon.hpp"

#include <algorithm>
#include <array>
#include <clipper.hpp>
#include <cmath>
#include <string>

#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "mesh_edges.hpp"

namespace handey {
namespace {

using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double kUnitsPerMetre = 1e7;
constexpr double kGreatest =
    1e4;  // [m]; keeps Clipper's products within 128 bits, far beyond any cell
constexpr double kMiterLimit =
    2.0;  // corners sharper than 60 degrees are squared, still outside the true offset
// Choice: vertices nearer than 1.5 units to the line of their neighbours are collinear but for
// rounding.
constexpr double kCleanDistance = 1.5;

constexpr std::size_t kManyLoops = 500;  // Choice: of more, common sides are cancelled first

Path to_path(const Polygon& polygon) {
  Path path;
  path.reserve(polygon.size());
  for (const Eigen::Vector2d& point : polygon) {
    if (!point.allFinite()) {
      throw InvalidInput("E_NUMBER", "region",
                         "a point is not finite, expected finite coordinates");
    }
    if (point.cwiseAbs().maxCoeff() > kGreatest) {
      throw InvalidInput("E_RANGE", "region",
                         "a coordinate of " + std::to_string(point.cwiseAbs().maxCoeff()) +
                             " m, expected at most " + std::to_string(kGreatest) + " m");
    }
    path.emplace_back(std::llround(point.x() * kUnitsPerMetre),
                      std::llround(point.y() * kUnitsPerMetre));
  }
  return path;
}

Paths to_paths(const Region& region) {
  Paths paths;
  paths.reserve(region.loops.size());
  for (const Polygon& loop : region.loops) paths.push_back(to_path(loop));
  return paths;
}

Polygon to_polygon(const Path& path) {
  Polygon polygon;
  polygon.reserve(path.size());
  for (const ClipperLib::IntPoint& point : path) {
    polygon.emplace_back(static_cast<double>(point.X) / kUnitsPerMetre,
                         static_cast<double>(point.Y) / kUnitsPerMetre);
  }
  return polygon;
}

Region to_region(Paths paths) {
  ClipperLib::CleanPolygons(paths, kCleanDistance);
  Region region;
  for (const Path& path : paths) {
    if (path.size() >= 3 && ClipperLib::Area(path) != 0.0) region.loops.push_back(to_polygon(path));
  }
  return region;
}

Region combine(ClipperLib::ClipType type, const Paths& subject, const Paths& clip,
               ClipperLib::PolyFillType fill = ClipperLib::pftNonZero) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(type, result, fill, fill);
  return to_region(std::move(result));
}

void append_parts(const ClipperLib::PolyNode& node, std::vector<Region>& parts) {
  for (const ClipperLib::PolyNode* outer : node.Childs) {
    Paths paths{outer->Contour};
    for (const ClipperLib::PolyNode* hole : outer->Childs) {
      paths.push_back(hole->Contour);
      append_parts(*hole, parts);  // an island in a hole is a part of its own
    }
    Region part = to_region(std::move(paths));
    if (!part.empty()) parts.push_back(std::move(part));
  }
}

// Loops with the same winding number everywhere, without the sides at which neighbours meet.
Paths without_common_sides(const Paths& paths) {
  std::vector<ClipperLib::IntPoint> points;
  for (const Path& path : paths) points.insert(points.end(), path.begin(), path.end());
  const auto is_before = [](const ClipperLib::IntPoint& a, const ClipperLib::IntPoint& b) {
    return a.X != b.X ? a.X < b.X : a.Y < b.Y;
  };
  std::sort(points.begin(), points.end(), is_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto number = [&](const ClipperLib::IntPoint& point) {
    return static_cast<int>(std::lower_bound(points.begin(), points.end(), point, is_before) -
                            points.begin());
  };
  std::vector<std::array<int, 2>> sides;
  for (const Path& path : paths) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      sides.push_back({number(path[i]), number(path[(i + 1) % path.size()])});
    }
  }
  Paths left;
  for (const std::vector<int>& loop : boundary_loops(sides)) {
    left.emplace_back();
    for (const int point : loop) left.back().push_back(points[static_cast<std::size_t>(point)]);
  }
  return left;
}

}  // namespace

double signed_area(const Polygon& polygon) {
  if (polygon.size() < 3) return 0.0;
  double twice = 0.0;
  const Eigen::Vector2d origin = polygon.front();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i] - origin;
    const Eigen::Vector2d b = polygon[i + 1] - origin;
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double area(const Region& region) {
  double sum = 0.0;
  for (const Polygon& loop : region.loops) sum += signed_area(loop);
  return sum;
}

Region unite(const std::vector<Region>& regions) {
  throw_if_stopped();
  Paths all;
  for (const Region& region : regions) {
    for (const Polygon& loop : region.loops) all.push_back(to_path(loop));
  }
  return combine(ClipperLib::ctUnion, all, {});
}

Region region_of_loops(const std::vector<Polygon>& loops) {
  throw_if_stopped();
  Paths paths = to_paths(Region{loops});
  // Clipper takes longer than in proportion, and cannot be stopped.
  if (paths.size() > kManyLoops) paths = without_common_sides(paths);
  return combine(ClipperLib::ctUnion, paths, {}, ClipperLib::pftPositive);
}

Region intersect(const Region& a, const Region& b) {
  return combine(ClipperLib::ctIntersection, to_paths(a), to_paths(b));
}

Region subtract(const Region& a, const Region& b) {
  return combine(ClipperLib::ctDifference, to_paths(a), to_paths(b));
}

Region offset(const Region& region, double delta) {
  if (!std::isfinite(delta) || std::abs(delta) > kGreatest) {
    throw InvalidInput("E_NUMBER", "delta",
                       "found " + std::to_string(delta) + ", expected a finite length [m]");
  }
  const Region clean = unite({region});
  if (delta == 0.0) return clean;
  ClipperLib::ClipperOffset worker(kMiterLimit);
  worker.AddPaths(to_paths(clean), ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  Paths result;
  worker.Execute(result, delta * kUnitsPerMetre);
  return to_region(std::move(result));
}

std::vector<Region> connected_parts(const Region& region) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(to_paths(region), ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  std::vector<Region> parts;
  append_parts(tree, parts);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Region& a, const Region& b) { return area(a) > area(b); });
  return parts;
}

}  // namespace handey
