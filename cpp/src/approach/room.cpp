// One box of configurations for each point, from the last one back.
#include "room.hpp"

#include <algorithm>

namespace handey {

bool has_room(BoxProver& prover, const Configuration& configuration, double room) {
  Eigen::VectorXd half = Eigen::VectorXd::Zero(configuration.q.size());
  half.head(std::min<Eigen::Index>(3, half.size())).setConstant(room);
  return prover.prove({configuration, half}).free;
}

std::optional<std::size_t> last_with_room(CollisionChecker& checker,
                                          const std::vector<Configuration>& points,
                                          std::size_t least, double room, double clearance) {
  BoxProver prover(checker, clearance);
  for (std::size_t i = points.size(); i-- > least;) {
    if (has_room(prover, points[i], room)) return i;
  }
  return std::nullopt;
}

}  // namespace handey
