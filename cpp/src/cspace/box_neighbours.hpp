// Which boxes of the linked slices share a face, and where a way crosses from one to the other.
#pragma once

#include <algorithm>
#include <cmath>

#include "handey/cspace/free_space.hpp"

namespace handey::cspace {

/// Have the two boxes a point in common?
inline bool touch(const SliceBox& a, const SliceBox& b) {
  for (std::size_t d = 0; d < 4; ++d) {
    if (std::max(a.lower[d], b.lower[d]) > std::min(a.upper[d], b.upper[d])) return false;
  }
  return true;
}

/// Do two boxes that touch lie side by side: along one joint, or the wrist, they only meet, along
/// the others they have a piece in common? Of two boxes of one slice with a fixed wrist the wrist
/// does not count; boxes of different slices meet at the wrist value that they share.
inline bool share_face(const SliceBox& a, const SliceBox& b) {
  int meeting = 0;
  for (std::size_t d = 0; d < 4; ++d) {
    const int lower = std::max(a.lower[d], b.lower[d]), upper = std::min(a.upper[d], b.upper[d]);
    if (lower < upper || (d == 3 && a.slice == b.slice && a.lower[d] == a.upper[d])) continue;
    ++meeting;
  }
  return meeting == 1;
}

/// The coarsest boxes below `index` that are not split and share a face with `other`.
template <class Visit>
void visit_touching(FreeSpace& space, int index, const SliceBox& other, const Visit& visit) {
  if (!touch(space.box(index), other)) return;
  if (space.box(index).first_child < 0) {
    if (space.box(index).state != SliceBox::State::NotProved) {
      if (share_face(space.box(index), other)) visit(index);
      return;
    }
    if (!share_face(space.box(index), other) || !space.split(index)) return;
  }
  const int first = space.box(index).first_child, count = space.box(index).children;
  for (int c = 0; c < count; ++c) visit_touching(space, first + c, other, visit);
}

/// Boxes that share a face with a box, in its own slice and in those linked to it.
template <class Visit>
void visit_neighbours(FreeSpace& space, int index, const Visit& visit) {
  const SliceBox box = space.box(index);
  const CellIndex cell{box.lower[0] >> (Lattice::kLevels - 1),
                       box.lower[1] >> (Lattice::kLevels - 1),
                       box.lower[2] >> (Lattice::kLevels - 1)};
  const auto visit_root = [&](int slice, const CellIndex& at) {
    const int root = space.root(slice, at);
    if (root >= 0) visit_touching(space, root, box, visit);
  };
  constexpr int kUnits = 1 << (Lattice::kLevels - 1);
  if (box.level > 0 || box.wrist_level > 0) visit_root(box.slice, cell);
  for (std::size_t d = 0; d < 3; ++d) {
    CellIndex next = cell;
    if (box.lower[d] % kUnits == 0) {
      --next[d];
      visit_root(box.slice, next);
    }
    if (box.upper[d] % kUnits == 0) {
      next[d] = cell[d] + 1;
      visit_root(box.slice, next);
    }
  }
  if (box.slice == 0) {
    for (int slice = 1; slice < space.first_stance(); slice += 2) visit_root(slice, cell);
  } else if (space.is_stance(box.slice)) {
    return;
  } else if (space.is_range(box.slice)) {
    visit_root(0, cell);
    visit_root(box.slice + 1, cell);
  } else {
    visit_root(box.slice - 1, cell);
  }
}

/// The parts of a split box that share a face with the box before it on the way; all parts for an
/// end (`before` < 0).
template <class Visit>
void visit_parts(FreeSpace& space, int before, int index, const Visit& visit) {
  if (before < 0) return;
  const SliceBox other = space.box(before);
  visit_touching(space, index, other, visit);
}

/// Where to cross from a box to the next on the way from `point` to `aim`: on their common side, as
/// near the straight line as it allows.
inline SlicePoint crossing(const FreeSpace& space, int from, int to, const SlicePoint& point,
                           const SlicePoint& aim) {
  const SliceBox &a = space.box(from), &b = space.box(to);
  const SlicePoint a_lower = space.lower(a), a_upper = space.upper(a);
  const SlicePoint b_lower = space.lower(b), b_upper = space.upper(b);
  SlicePoint lower, upper;
  double share = 0.0;
  for (std::size_t d = 0; d < 4; ++d) {
    lower[d] = std::max(a_lower[d], b_lower[d]);
    upper[d] = std::max(lower[d], std::min(a_upper[d], b_upper[d]));
    if (upper[d] - lower[d] > 1e-12) continue;
    const double way = aim[d] - point[d];
    if (std::abs(way) > 1e-12) share = std::clamp((lower[d] - point[d]) / way, 0.0, 1.0);
  }
  SlicePoint result;
  for (std::size_t d = 0; d < 4; ++d) {
    result[d] = std::clamp(point[d] + share * (aim[d] - point[d]), lower[d], upper[d]);
  }
  return result;
}

}  // namespace handey::cspace
