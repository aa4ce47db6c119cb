// How the local planners word why they stopped: lengths in millimetres, the pair in the way by name.
#pragma once

#include <string>

#include "handey/collision/checker.hpp"

namespace handey {

/// "12.3 mm"
std::string millimetres(double metres);
/// "gripper meets table"
std::string describe(const Hit& hit);

}  // namespace handey
