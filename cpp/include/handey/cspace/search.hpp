// A way through the free boxes of linked slices, from the start to any of the goals. The search
// goes from both ends at once over boxes that share a face; the way crosses from box to box at
// points of their common faces, so every piece of it lies within one free box. Where both sides can
// be joined by a straight edge that is certified, they are. Boxes are proved only when the search
// comes to them. Deterministic. With a detour of 1 no way through the boxes is quicker than the one
// found, as far as they cross where this one does; with more, the first way found is taken. A
// search that proves hard looks for other stances of the wrist too, taken from a fixed sequence,
// and goes on from them in slices of their own. Not guaranteed: that a way is found wherever there
// is one, above all where the wrist must turn in a narrow place. Article: "Global planning",
// Figure 7.
#pragma once

#include <string>
#include <vector>

#include "handey/collision/certificate.hpp"
#include "handey/cspace/free_space.hpp"

namespace handey {

struct SearchOptions {
  /// Half widths of the windows of finest cells round start and goal, tried one after the other
  /// until there is a way [rad]. Article: windows that widen. Choice: narrower ones than these cost
  /// more than they save.
  std::vector<double> windows{0.6, 1.2};
  int max_proofs = 8000;  ///< boxes proved at most, in all windows
  double detour = 2.0;    ///< weight of the estimate of what is left of the way, at least 1
  CertificateOptions certificate;  ///< of the edges that connect ends which lie in no free box
};

struct SearchResult {
  bool found = false;
  int goal = -1;
  std::vector<Configuration>
      path;             ///< start to goals[goal]; every edge within a free box, or certified
  int proofs = 0;       ///< boxes looked at
  int stances = 0;      ///< other stances of the wrist that the way goes through
  double window = 0.0;  ///< half width that sufficed [rad]
  std::string reason;   ///< why not found
};

SearchResult search_free_space(FreeSpace& space, const SearchOptions& options = {});

}  // namespace handey
