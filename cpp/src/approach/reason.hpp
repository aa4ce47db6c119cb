// How the local planners word why they stopped: lengths in millimetres, angles in degrees, the pair
// in the way by name.
#pragma once

#include <string>

#include "handey/collision/checker.hpp"

namespace handey {

/// "12.3 mm"
std::string millimetres(double metres);
/// "12.3 degrees"
std::string degrees(double radians);
/// "gripper meets table"
std::string describe(const Hit& hit);

}  // namespace handey
