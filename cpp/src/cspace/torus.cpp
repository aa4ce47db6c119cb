// The article's obstacles: the waist's circle in steps; neighbouring steps at which the obstacle
// reaches the slab are one window, and the hull of their sections is the torus's section.
#include <algorithm>
#include <cmath>

#include "handey/cspace/cross_section.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSteps = 360;  // Choice: windows exact to one degree

}  // namespace

std::vector<Torus> torus_of(const ArmPlane& plane, const SceneHull& hull, const Slab& slab) {
  const double width = 2.0 * kPi / kSteps;
  std::vector<Polygon> sections(kSteps);
  // The first one checks the input.
  sections[0] = cross_section(plane, hull, slab, -kPi + 0.5 * width, 0.5 * width);
  for (int i = 1; i < kSteps; ++i) {
    WaistCell cell(plane, -kPi + (i + 0.5) * width, 0.5 * width);
    cell.cross_section(hull, slab, sections[static_cast<std::size_t>(i)]);
  }
  const auto reaches = [&](int step) {
    return !sections[static_cast<std::size_t>((step + kSteps) % kSteps)].empty();
  };
  std::vector<Torus> tori;
  for (int first = 0; first < kSteps; ++first) {
    // A window begins where the step before is clear, or anywhere if none is.
    if (!reaches(first) || (reaches(first - 1) && !(first == 0))) continue;
    int last = first;
    while (last + 1 < first + kSteps && reaches(last + 1)) ++last;
    const bool all_round = last - first + 1 == kSteps;
    if (reaches(first - 1) && !all_round) continue;  // step 0 within a window that began before
    std::vector<Eigen::Vector2d> points;
    for (int step = first; step <= last; ++step) {
      const Polygon& section = sections[static_cast<std::size_t>(step % kSteps)];
      points.insert(points.end(), section.begin(), section.end());
    }
    Torus torus;
    torus.lower = -kPi + first * width;
    torus.upper = all_round ? kPi : -kPi + (last + 1) * width;
    torus.section = convex_hull(points);
    tori.push_back(std::move(torus));
    if (all_round) break;
  }
  return tori;
}

}  // namespace handey
