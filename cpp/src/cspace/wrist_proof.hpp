// Does the hand keep clear of the forearm and of itself over a range of the wrist? The joints
// before do not matter. A piece that the range moves is replaced by the hull of what it sweeps, as
// seen from the other piece; a plane between the two is the proof, and where there is none the
// range is halved. Whole turns of a joint cost no more than narrow ones, so wide ranges are proved
// in few steps. Errs on the safe side: what is not proved within the budget is not said to keep
// clear.
#pragma once

#include "hand_balls.hpp"
#include "handey/collision/scene.hpp"

namespace handey::cspace {

/// @param pieces of all movers that three joints or more move
/// @return true: no two of them that are kept apart come within `clearance` of each other
bool keeps_clear(const Robot& robot, const std::vector<HandPiece>& pieces,
                 const std::vector<std::pair<int, int>>& mover_pairs, const Eigen::VectorXd& lower,
                 const Eigen::VectorXd& upper, double clearance);

}  // namespace handey::cspace
