// The pairs of a checker are flags for each mover; those of the arm's links are cleared.
#include "handey/collision/hand_only.hpp"

#include <algorithm>

#include "checker_impl.hpp"
#include "handey/errors.hpp"

namespace handey {

void keep_hand_only(CollisionChecker& checker, const std::vector<BodyRef>& bodies) {
  CollisionChecker::Impl& impl = checker.impl();
  const Gripper& gripper = impl.cell.robot->gripper;
  for (const BodyRef& body : bodies) {
    const auto found = std::find_if(impl.obstacles.begin(), impl.obstacles.end(),
                                    [&](const auto& obstacle) { return obstacle.ref == body; });
    if (found == impl.obstacles.end()) {
      throw InvalidInput("E_REF", "keep_hand_only",
                         "body " + std::to_string(body.index) + " does not stand in the cell");
    }
    const std::size_t index = static_cast<std::size_t>(found - impl.obstacles.begin());
    for (collision::Mover& mover : impl.movers) {
      const bool is_hand = mover.finger || mover.body == gripper.body;
      if (!is_hand) mover.against[index] = 0;
    }
  }
}

}  // namespace handey
