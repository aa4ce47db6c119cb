// The scenes and queries of the gross motion benchmark, all from a seed: a table with boxes,
// clutter that hangs in the air, pigeonholes, and tables of growing number of obstacles. Ends are
// free with 1 mm to spare, the hand moves at least 0.3 m between them, and a way between them is
// known to exist (roadmap.hpp; out of a pigeonhole: the hand drawn straight back). Queries that
// begin or end in a pocket of free space, as random ones in clutter often do, are not among them.
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

/// A scene of the clutter family whose free space falls into parts; no way is known between start
/// and goal, and nearly always there is none.
Setting pocket_setting(const handey::Cell& table, std::uint64_t seed, int queries);

/// The same queries, ends as in the table family and the straight edge blocked, among the boxes of
/// a table scene and small ones up to the counts: every other one of these stands on the table, the
/// others float at the edge of the arm's reach and beyond it. A way is known among the most.
/// @param counts at least 5
std::vector<Setting> growth_settings(const handey::Cell& table, std::uint64_t seed, int queries,
                                     const std::vector<int>& counts);
/// A tray with a wavy floor and a rim, stood on its side before the robot: one mesh of 20 160
/// triangles that is not convex. The straight edge is blocked.
Setting tray_setting(const handey::Cell& table, std::uint64_t seed, int queries);

}  // namespace benchmark
