// The planar faces of a whole part: those of all its shapes, coplanar ones merged, and what of them
// is exposed. A face against which another shape lies, or that is inside one, cannot be held there:
// the test is a thin slab just outside the face. Errs on the small side: a gap thinner than the
// slab counts as covered.
#include "part_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

#include "handey/geometry/section.hpp"
#include "plane_map.hpp"

namespace handey::grasp {
namespace {

// Where a covering shape is looked for, outside a face [m]. Choice: from above the tolerance within
// which triangles are one face (1e-5) to a gap into which no finger goes.
constexpr double kSlabLower = 5e-5;
constexpr double kSlabUpper = 2e-4;

// Faces of different shapes are one if they agree within the tolerances of planar_faces.
bool is_coplanar(const PlanarFace& a, const PlanarFace& b, const PlanarFaceOptions& options) {
  return a.normal.dot(b.normal) > std::cos(options.angle) &&
         std::abs((b.origin - a.origin).dot(a.normal)) < options.distance;
}

void absorb(PlanarFace& face, const PlanarFace& other) {
  const Pose X_FO = face_frame(face).inverse() * face_frame(other);
  face.region = unite({face.region, map_region(other.region, X_FO)});
  face.area = area(face.region);
}

void add_faces(std::vector<PlanarFace>& faces, const Shape& shape) {
  const PlanarFaceOptions options;
  const std::size_t of_other_shapes = faces.size();
  for (PlanarFace& face : planar_faces(tessellate(shape), options)) {
    const auto same =
        std::find_if(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(of_other_shapes),
                     [&](const PlanarFace& other) { return is_coplanar(other, face, options); });
    if (same != faces.begin() + static_cast<std::ptrdiff_t>(of_other_shapes)) {
      absorb(*same, face);
    } else {
      faces.push_back(std::move(face));
    }
  }
}

bool has_no_covered_faces(const Body& part) {
  if (part.shapes.size() != 1) return false;
  const MeshShape* mesh = std::get_if<MeshShape>(&part.shapes.front().geometry);
  return mesh == nullptr || connected_components(*mesh->mesh).size() == 1;
}

Region exposed_region(const Body& part, const PlanarFace& face) {
  const Pose X_FP = face_frame(face).inverse();
  std::vector<Region> covered;
  for (const Shape& shape : part.shapes) {
    Region cover = slab_projection(shape, X_FP, kSlabLower, kSlabUpper);
    if (!cover.empty()) covered.push_back(std::move(cover));
  }
  return covered.empty() ? face.region : subtract(face.region, unite(covered));
}

}  // namespace

std::vector<PlanarFace> part_faces(const Body& part, double least_area) {
  std::vector<PlanarFace> faces;
  for (const Shape& shape : part.shapes) {
    if (std::holds_alternative<Sphere>(shape.geometry)) continue;
    add_faces(faces, shape);
  }
  faces.erase(std::remove_if(faces.begin(), faces.end(),
                             [&](const PlanarFace& face) { return face.area < least_area; }),
              faces.end());
  std::stable_sort(faces.begin(), faces.end(), [](const PlanarFace& a, const PlanarFace& b) {
    return a.area > b.area + 1e-12;
  });
  return faces;
}

ExposedFaces::ExposedFaces(const Body& part, const std::vector<PlanarFace>& faces)
    : part_(part), faces_(faces), none_covered_(has_no_covered_faces(part)) {
  exposed_.resize(faces.size());
}

const Region& ExposedFaces::operator()(int face) {
  const PlanarFace& of = faces_[static_cast<std::size_t>(face)];
  if (none_covered_) return of.region;
  std::optional<Region>& region = exposed_[static_cast<std::size_t>(face)];
  if (!region) region = exposed_region(part_, of);
  return *region;
}

}  // namespace handey::grasp
