// What stands in the layer outside a face that a finger fills: obstacles, projected on the grasp
// plane. Errs on the large side: projections contain the obstacle, are grown with mitred corners,
// and count whatever reaches into the layer thickened by the clearance.
#include "obstruction.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "bounds.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/geometry/section.hpp"
#include "plane_map.hpp"

namespace handey::grasp {
namespace {

// The part's own surface counts from this height over a face [m]. Choice: above the tolerance
// within which triangles are one face (1e-5), below what a pad would notice.
constexpr double kOwnLower = 5e-5;

Eigen::AlignedBox2d box_of(const Region& region) {
  Eigen::AlignedBox2d box;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) box.extend(point);
  }
  return box;
}

bool is_convex_body(const Body& body) {
  if (body.shapes.size() != 1) return false;
  const MeshShape* mesh = std::get_if<MeshShape>(&body.shapes.front().geometry);
  return mesh == nullptr || is_convex(*mesh->mesh);
}

}  // namespace

FingerExtent finger_extent(const Robot& robot) {
  const Gripper& gripper = robot.gripper;
  FingerExtent extent;
  for (const FingerJoint& finger : gripper.fingers) {
    const Pose X_HF = gripper.X_BH.inverse() * finger.X_PJ;
    const double outward = (X_HF.linear() * finger.axis).y() >= 0.0 ? 1.0 : -1.0;
    for (const Shape& shape : robot.bodies[static_cast<std::size_t>(finger.child)].shapes) {
      const Region beside_pad =
          slab_projection(shape, X_HF, -0.5 * gripper.pad_length, 0.5 * gripper.pad_length);
      for (const Polygon& loop : beside_pad.loops) {
        for (const Eigen::Vector2d& point : loop) {
          extent.thickness = std::max(extent.thickness, outward * point.y());
        }
      }
      const Eigen::AlignedBox3d box = bounding_box(shape, X_HF);
      extent.half_width =
          std::max({extent.half_width, std::abs(box.min().x()), std::abs(box.max().x())});
      extent.tip = std::max(extent.tip, box.max().z());
      extent.back = std::min(extent.back, box.min().z());
    }
  }
  return extent;
}

Pose side_frame(const FacePair& pair, const PlanarFace& face, bool side_a) {
  Pose X_GS = Pose::Identity();
  X_GS.linear() =
      rotation_with_z(pair.X_PG.linear().transpose() * face.normal, Eigen::Vector3d::UnitX());
  X_GS.translation().z() = (side_a ? 0.5 : -0.5) * pair.width;
  return X_GS;
}

Obstruction::Obstruction(const Body& part, const std::vector<PlanarFace>& faces, double layer,
                         double clearance)
    : part_(part),
      faces_(faces),
      layer_(layer),
      clearance_(clearance),
      part_is_convex_(is_convex_body(part)) {}

Region Obstruction::own_on_face(int face) {
  const auto known = own_.find(face);
  if (known != own_.end()) return known->second;
  const Pose X_FP = face_frame(faces_[static_cast<std::size_t>(face)]).inverse();
  std::vector<Region> standing_out;
  for (const Shape& shape : part_.shapes) {
    const Eigen::AlignedBox3d box = bounding_box(shape, X_FP);
    if (box.max().z() <= kOwnLower || box.min().z() >= layer_) continue;
    Region region = slab_projection(shape, X_FP, kOwnLower, layer_);
    if (!region.empty()) standing_out.push_back(std::move(region));
  }
  return own_[face] = unite(standing_out);
}

Region Obstruction::own(const FacePair& pair) {
  if (part_is_convex_) return {};
  const Pose X_GP = pair.X_PG.inverse();
  std::vector<Region> both;
  for (const int face : {pair.face_a, pair.face_b}) {
    const Region on_face = own_on_face(face);
    if (on_face.empty()) continue;
    both.push_back(map_region(on_face, X_GP * face_frame(faces_[static_cast<std::size_t>(face)])));
  }
  return both.empty() ? Region{} : unite(both);
}

Region Obstruction::of_body(const FacePair& pair, const Body& body, const Pose& X_PB,
                            double reach) const {
  const Eigen::AlignedBox2d around = box_of(pair.overlap);
  std::vector<Region> found;
  for (const bool side_a : {true, false}) {
    const int face = side_a ? pair.face_a : pair.face_b;
    const Pose X_GS = side_frame(pair, faces_[static_cast<std::size_t>(face)], side_a);
    const Pose X_SB = (pair.X_PG * X_GS).inverse() * X_PB;
    // Seen from behind, y of S is -y of G.
    const double y_sense = side_a ? 1.0 : -1.0;
    Eigen::AlignedBox2d window;
    window.extend(Eigen::Vector2d(around.min().x(), y_sense * around.min().y()));
    window.extend(Eigen::Vector2d(around.max().x(), y_sense * around.max().y()));
    const double lower = -clearance_, upper = layer_ + clearance_;
    for (const Shape& shape : body.shapes) {
      const Eigen::AlignedBox3d box = bounding_box(shape, X_SB);
      if (box.max().z() < lower || box.min().z() > upper) continue;
      const Eigen::AlignedBox2d seen(box.min().head<2>(), box.max().head<2>());
      if (window.exteriorDistance(seen) > reach) continue;
      const Region region = slab_projection(shape, X_SB, lower, upper);
      if (!region.empty()) found.push_back(map_region(region, X_GS));
    }
  }
  return found.empty() ? Region{} : offset(unite(found), clearance_);
}

}  // namespace handey::grasp
