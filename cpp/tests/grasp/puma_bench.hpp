// The Puma at a table, for tests of grasps where a part stands.
#pragma once

#include <memory>
#include <string>

#include "../kinematics/puma.hpp"
#include "handey/world/cell.hpp"
#include "parts.hpp"

namespace handey::testing {

/// A table whose top is z = 0, and a block on it as part 0.
inline Cell block_on_bench() {
  Cell cell;
  cell.name = "bench";
  cell.robot = puma();
  cell.fixtures.push_back(box_body("table", {1.6, 1.4, 0.05}, translation(0.55, 0, -0.025)));
  cell.parts.push_back(box_body("block", {0.04, 0.06, 0.05}, translation(0.50, 0.20, 0.025)));
  cell.start = {puma()->home, 0.1};
  return cell;
}

}  // namespace handey::testing
