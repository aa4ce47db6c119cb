// The planar faces of a whole part: those of all its shapes, coplanar ones merged, and what of them
// is exposed.
#pragma once

#include <optional>
#include <vector>

#include "handey/geometry/polyhedron.hpp"
#include "handey/world/body.hpp"

namespace handey::grasp {

/// Largest area first.
std::vector<PlanarFace> part_faces(const Body& part, double least_area);

/// What of each face is not covered by a shape of the part lying against it, in its own (u, v).
/// Found when first asked for. Keeps references to part and faces.
class ExposedFaces {
 public:
  ExposedFaces(const Body& part, const std::vector<PlanarFace>& faces);

  /// True if no shape of the part can cover a face of it: one shape in one piece.
  bool none_covered() const { return none_covered_; }
  const Region& operator()(int face);

 private:
  const Body& part_;
  const std::vector<PlanarFace>& faces_;
  const bool none_covered_;
  std::vector<std::optional<Region>> exposed_;
};

}  // namespace handey::grasp
