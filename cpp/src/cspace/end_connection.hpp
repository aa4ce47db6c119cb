// How a start or goal joins the free boxes of its slice: it lies in one, or a certified edge leads
// to one near it.
#pragma once

#include <vector>

#include "handey/collision/certificate.hpp"
#include "handey/cspace/free_space.hpp"

namespace handey::cspace {

struct EndConnection {
  int box = -1;
  SlicePoint end{};    ///< the start or goal
  SlicePoint point{};  ///< in the box: the end itself, or where the certified edge leads
};

/// @param max_proofs  of the space in all; the end is given up when they are spent
/// @return at most a few, nearest first; empty if there is none
std::vector<EndConnection> connect_end(FreeSpace& space, int slice, const SlicePoint& end,
                                       const CertificateOptions& certificate, int max_proofs);

}  // namespace handey::cspace
