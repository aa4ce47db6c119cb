// What the forearm carries sweeps the same in a cell of theta3 whatever it is kept apart from, so
// that is made once for all of the upper arm's hulls.
#include "folded_arm.hpp"

namespace handey::cspace {
namespace {

constexpr double kCorner = 0.55;  // Choice: round corners are 4 % too large [rad]

/// By cell of theta3: what an outline about the elbow sweeps, about axis 2 at theta2 = 0.
using Way = std::vector<Polygon>;

std::vector<Way> ways(const ArmTable::Impl& table, const std::vector<Polygon>& outlines) {
  const ArmPlane& plane = table.links.plane;
  const double half = 0.5 * table.lattice.cell_width(table.level, 2);
  std::vector<Way> all(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (int column = 0; column < table.lattice.cells(table.level, 2); ++column) {
      const double angle = plane.elbow_sense * table.lattice.centre(table.level, 2, column);
      all[i].push_back(swept(outlines[i], angle, half, plane.elbow));
    }
  }
  return all;
}

}  // namespace

std::vector<int> folded_columns(const ArmTable::Impl& table, const SliceScene& scene,
                                LayerWork& work) {
  std::vector<std::vector<Way>> of_balls;
  for (const PlaneBall& ball : scene.balls) of_balls.push_back(ways(table, {{ball.centre}}));
  std::vector<Way> of_turning;
  for (const LinkGroup& group : table.links.turning) of_turning = ways(table, group.outlines);
  const std::size_t columns = static_cast<std::size_t>(table.lattice.cells(table.level, 2));
  std::vector<char> blocked(columns, 0);
  WaistCell cell(table.links.plane, 0.0, 0.0);
  Polygon section, grown;
  for (const Standing& standing : scene.upper_arm) {
    cell.place(standing.hull);
    for (const Target& target : work.targets_of(standing.concerns)) {
      cell.cross_section(target.slab, section);
      if (section.empty()) continue;
      grow(section, target.distance, kCorner, grown);
      const bool hand = target.kind == Target::Kind::Hand;
      for (const Way& way : hand ? of_balls[target.ball] : of_turning) {
        for (std::size_t column = 0; column < columns; ++column) {
          if (blocked[column] == 0 && come_near(way[column], grown, 0.0)) blocked[column] = 1;
        }
      }
    }
  }
  std::vector<int> cells;
  for (std::size_t column = 0; column < columns; ++column) {
    if (blocked[column] != 0) cells.push_back(static_cast<int>(column));
  }
  return cells;
}

}  // namespace handey::cspace
