// Joint ranges cut into equal cells.
#include "handey/cspace/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "handey/errors.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNarrowest = 1e-4;       // [rad]; Choice: indices stay far from overflow
constexpr double kLimitTolerance = 1e-9;  // [rad], as for joint limits

}  // namespace

int Lattice::index_of(int level, int joint, double angle) const {
  const std::size_t j = static_cast<std::size_t>(joint);
  const int number = cells(level, joint);
  double along = angle - lower[j];
  if (wraps[j]) {
    along -= 2.0 * kPi * std::floor(along / (2.0 * kPi));
  } else if (!(along >= -kLimitTolerance &&
               along <= number * cell_width(level, joint) + kLimitTolerance)) {
    return -1;
  }
  if (cell_width(level, joint) == 0.0) return 0;
  const double index = std::floor(along / cell_width(level, joint));
  return static_cast<int>(std::clamp(index, 0.0, number - 1.0));
}

Lattice make_lattice(const Robot& robot, double coarse) {
  if (robot.joints.size() < 3) {
    throw InvalidInput("E_DOF", "robot.joints",
                       "'" + robot.name + "' has " + std::to_string(robot.joints.size()) +
                           " joints, expected at least 3");
  }
  if (!(coarse >= kNarrowest && coarse <= kPi)) {
    throw InvalidInput("E_RANGE", "coarse",
                       "found " + std::to_string(coarse) + ", expected 1e-4 to pi [rad]");
  }
  Lattice lattice;
  for (std::size_t j = 0; j < 3; ++j) {
    const JointLimit& limit = robot.joints[j].limit;
    const bool below = std::isfinite(limit.lower), above = std::isfinite(limit.upper);
    if (below != above || (below && !(limit.lower <= limit.upper))) {
      throw InvalidInput("E_RANGE", "robot.joints." + robot.joints[j].name + ".limit",
                         "found " + std::to_string(limit.lower) + " to " +
                             std::to_string(limit.upper) +
                             ", expected a range in order, or both infinite [rad]");
    }
    lattice.wraps[j] = !below;
    lattice.lower[j] = below ? limit.lower : -kPi;
    const double range = below ? limit.upper - limit.lower : 2.0 * kPi;
    const double number = std::max(1.0, std::ceil(range / coarse - 1e-9));
    if (number > 1e6) {
      throw InvalidInput("E_RANGE", "robot.joints." + robot.joints[j].name + ".limit",
                         "a range of " + std::to_string(range) + " rad is too wide for cells of " +
                             std::to_string(coarse) + " rad");
    }
    lattice.count[j] = static_cast<int>(number);
    lattice.width[j] = range / number;
  }
  return lattice;
}

}  // namespace handey
