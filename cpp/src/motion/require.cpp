#include "require.hpp"

#include <cmath>

#include "handey/errors.hpp"

namespace handey::motion {

void require_configuration(const Robot& robot, const Configuration& configuration,
                           const std::string& place) {
  const std::size_t joints = robot.joints.size();
  if (static_cast<std::size_t>(configuration.q.size()) != joints) {
    throw InvalidInput("E_DOF", place,
                       std::to_string(configuration.q.size()) + " joint values, the arm has " +
                           std::to_string(joints) + " joints");
  }
  if (!configuration.q.allFinite() || !std::isfinite(configuration.opening)) {
    throw InvalidInput("E_NUMBER", place, "a joint value or the opening is not finite");
  }
  const std::string violation = limit_violation(robot, configuration.q);
  if (!violation.empty()) throw InvalidInput("E_LIMIT", place, violation);
  const Gripper& gripper = robot.gripper;
  if (configuration.opening < gripper.min_opening - 1e-9 ||
      configuration.opening > gripper.max_opening + 1e-9) {
    throw InvalidInput("E_LIMIT", place,
                       "opening = " + std::to_string(configuration.opening) + " m is not within [" +
                           std::to_string(gripper.min_opening) + ", " +
                           std::to_string(gripper.max_opening) + "] m");
  }
}

}  // namespace handey::motion
