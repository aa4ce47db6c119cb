// At which cells of theta3 does what the forearm carries meet the upper arm? That depends neither
// on the waist nor on theta2.
#pragma once

#include <vector>

#include "slice_layer.hpp"

namespace handey::cspace {

/// The cells of theta3 that the upper arm blocks, in order. Errs on the large side: the hand counts
/// as its balls, and what joint 4 turns as turned all the way round.
std::vector<int> folded_columns(const ArmTable::Impl& table, const SliceScene& scene,
                                LayerWork& work);

}  // namespace handey::cspace
