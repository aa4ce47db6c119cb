// The scenes and queries of the gross motion benchmark, all from a seed: a table with boxes,
// clutter that hangs in the air, pigeonholes, and tables of growing number of obstacles. Ends are
// free with 1 mm to spare and the hand moves at least 0.3 m between them. That a way exists is not
// guaranteed, but for the pigeonholes: from there the hand can be drawn straight out.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "handey/handey.hpp"

namespace benchmark {

struct Query {
  handey::Configuration start, goal;
  double inside = 0.0;  ///< how far the finger tips are inside a pigeonhole at the goal or, where
                        ///< the start is the end that is inside, there [m]
};

struct Setting {
  handey::Cell cell;
  std::vector<Query> queries;
};

/// Table and 5 boxes on it; the hand is before the robot, less than 0.5 m over the table, at both
/// ends.
std::vector<Setting> table_family(const handey::Cell& table, std::uint64_t seed, int queries);
/// Table and 24 boxes of 5 to 15 cm anywhere within reach.
std::vector<Setting> clutter_family(const handey::Cell& table, std::uint64_t seed, int queries);
/// 3 x 3 pigeonholes, 0.22 to 0.26 m wide and 0.25 m high, before the robot: the hand points
/// horizontally into one of them at one end of the motion, and every fifth time into another one at
/// the other end.
std::vector<Setting> shelf_family(const handey::Cell& table, std::uint64_t seed, int queries);

/// The same queries, ends as in the table family, among the first `boxes` of 400 small boxes: every
/// other one stands on the table, the others float at the edge of the arm's reach and beyond it.
/// The ends are free among all 400.
Setting growth_scene(const handey::Cell& table, std::uint64_t seed, int queries, int boxes);
/// A tray with a wavy floor and a rim, one mesh of 20 160 triangles that is not convex.
Setting tray_scene(const handey::Cell& table, std::uint64_t seed, int queries);

}  // namespace benchmark
