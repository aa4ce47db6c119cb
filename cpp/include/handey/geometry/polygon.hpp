// Plane regions with holes: area, union, intersection, difference, offset, the largest inscribed
// circle. Booleans run on integers (Clipper, 1e-7 m), so they are robust; results are exact to
// about 1e-7 m. Not guaranteed: features thinner than 1e-7 m survive.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace handey {

/// A closed polygon; the last point joins the first. Counter-clockwise encloses area, clockwise is
/// a hole [m].
using Polygon = std::vector<Eigen::Vector2d>;

/// A plane region: outer loops counter-clockwise, holes clockwise (non-zero winding).
struct Region {
  std::vector<Polygon> loops;
  bool empty() const { return loops.empty(); }
};

/// Area of one loop, positive counter-clockwise [m2].
double signed_area(const Polygon& polygon);
/// Area of a region, holes taken off [m2].
double area(const Region& region);

Region unite(const std::vector<Region>& regions);
/// The points that `loops` wind around more often counter-clockwise than clockwise; loops may cross
/// and overlap.
Region region_of_loops(const std::vector<Polygon>& loops);
Region intersect(const Region& a, const Region& b);
Region subtract(const Region& a, const Region& b);
/// Grown (delta > 0) or shrunk (delta < 0) by delta [m], mitred corners: a grown region contains
/// the true offset.
Region offset(const Region& region, double delta);
/// One region per connected piece, each outer loop with its holes, largest area first.
std::vector<Region> connected_parts(const Region& region);

bool contains(const Region& region, const Eigen::Vector2d& point);
/// Distance of a point to the nearest edge of the region, inside or outside [m]; infinite for an
/// empty region.
double boundary_distance(const Region& region, const Eigen::Vector2d& point);

struct InscribedCircle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< [m]; 0 for an empty region
};
/// The largest circle inside a region, to `precision` [m] (quadtree search, "pole of
/// inaccessibility").
InscribedCircle largest_inscribed_circle(const Region& region, double precision = 1e-4);

/// Convex hull, counter-clockwise, without collinear points.
Polygon convex_hull(const std::vector<Eigen::Vector2d>& points);

}  // namespace handey
