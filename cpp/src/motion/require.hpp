// Is a configuration one of this robot?
#pragma once

#include <string>

#include "handey/kinematics/arm.hpp"

namespace handey::motion {

/// @throws InvalidInput (E_DOF, E_NUMBER, E_LIMIT) naming `place` unless the configuration is of
/// the right length, finite
///   and within the limits of the joints and of the opening (1e-9)
void require_configuration(const Robot& robot, const Configuration& configuration,
                           const std::string& place);

}  // namespace handey::motion
