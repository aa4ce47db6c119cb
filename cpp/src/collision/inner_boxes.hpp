// Which boxes lie wholly inside a closed surface? The surface's own oriented box is cut at the
// vertices' coordinates, where they are few (machined parts, shelves, trays: the boxes then fill
// the solid), else evenly; cells that no triangle meets and whose centre is inside are merged into
// boxes. Errs on the inner side: thin walls aslant to the box's axes are lost.
#pragma once

#include <vector>

#include "piece.hpp"

namespace handey::collision {

/// Boxes inside the solid, in the frame of piece.box, disjoint but for their faces.
std::vector<Eigen::AlignedBox3d> inner_boxes(const Piece& piece);

}  // namespace handey::collision
