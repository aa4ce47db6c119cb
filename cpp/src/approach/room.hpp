// Where the motion near obstacles may end: the gross motion then starts in a free cell of its
// slice. Article, "Global planning": I' and F'.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "handey/collision/box_certificate.hpp"

namespace handey {

/// Is the robot free wherever its first three joints turn by up to `room` from there [rad]?
bool has_room(BoxProver& prover, const Configuration& configuration, double room);

/// The last of the points, not before `least`, that has room; none if no point has.
std::optional<std::size_t> last_with_room(CollisionChecker& checker,
                                          const std::vector<Configuration>& points,
                                          std::size_t least, double room, double clearance);

}  // namespace handey
