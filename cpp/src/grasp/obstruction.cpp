// What stands in the layer outside a face that a finger fills: obstacles, projected on the grasp
// plane. Errs on the large side: projections contain the obstacle, are grown with mitred corners,
// and count whatever reaches into the layer thickened by the clearance.
#include "obstruction.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

#include "bounds.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/geometry/section.hpp"
#include "handey/stop.hpp"
#include "plane_map.hpp"

namespace handey::grasp {
namespace {

// The part's own surface counts from this height over a face [m]. Choice: above the tolerance
// within which triangles are one face (1e-5), below what a pad would notice.
constexpr double kOwnLower = 5e-5;
// Over the plane of a pad on an edge or a vertex [m]. Choice: less than what may give way (5e-4),
// more than an edge may rise that is not quite parallel to the other.
constexpr double kOwnLowerBesideEdge = 4e-4;

Eigen::AlignedBox2d box_of(const Region& region) {
  Eigen::AlignedBox2d box;
  for (const Polygon& loop : region.loops) {
    for (const Eigen::Vector2d& point : loop) box.extend(point);
  }
  return box;
}

/// Of a box at a pose, grown by far more than rounding takes.
Eigen::AlignedBox3d moved_box(const Eigen::AlignedBox3d& box, const Pose& X) {
  const Eigen::Vector3d half =
      X.linear().cwiseAbs() * (0.5 * box.sizes()) + Eigen::Vector3d::Constant(1e-9);
  const Eigen::Vector3d centre = X * box.center();
  return {centre - half, centre + half};
}

constexpr double kShortestEdge = 1e-7;  // of a polygon: shorter has no sure direction [m]
// As of `offset`: corners sharper than 60 degrees are squared.
constexpr double kSharp = 0.5;

/// A convex polygon grown by delta, mitred; nothing if it is not convex.
Polygon grown_convex(const Polygon& polygon, double delta) {
  Polygon points;
  for (const Eigen::Vector2d& point : polygon) {
    if (points.empty() || (point - points.back()).norm() > kShortestEdge) points.push_back(point);
  }
  while (points.size() > 1 && (points.back() - points.front()).norm() <= kShortestEdge) {
    points.pop_back();
  }
  const std::size_t count = points.size();
  if (count < 3) return {};
  std::vector<Eigen::Vector2d> along;
  for (std::size_t i = 0; i < count; ++i) {
    along.push_back((points[(i + 1) % count] - points[i]).normalized());
  }
  Polygon result;
  int rounds = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d &before = along[(i + count - 1) % count], &after = along[i];
    const Eigen::Vector2d out_before(before.y(), -before.x()), out_after(after.y(), -after.x());
    const double sine = before.x() * after.y() - before.y() * after.x();
    if (sine <= 0.0) return {};
    if (before.y() < 0.0 && after.y() >= 0.0) ++rounds;
    const double straightness = 1.0 + before.dot(after);
    if (straightness >= kSharp) {
      result.push_back(points[i] + (delta / straightness) * (out_before + out_after));
    } else {
      const double cut = std::tan(0.25 * std::atan2(sine, before.dot(after)));
      result.push_back(points[i] + delta * (out_before + cut * before));
      result.push_back(points[i] + delta * (out_after - cut * after));
    }
  }
  return rounds == 1 ? result : Polygon{};
}

/// Contains all within delta of the region; as `offset`, but quick for a convex one.
Region grown(const Region& region, double delta) {
  if (region.loops.size() == 1) {
    Polygon polygon = grown_convex(region.loops.front(), delta);
    if (!polygon.empty()) return Region{{std::move(polygon)}};
  }
  return offset(region, delta);
}

bool is_convex_body(const Body& body) {
  if (body.shapes.size() != 1) return false;
  const MeshShape* mesh = std::get_if<MeshShape>(&body.shapes.front().geometry);
  return mesh == nullptr || mesh->convex || is_convex(*mesh->mesh);
}

}  // namespace

void append(Region&& loops, Region& to) {
  to.loops.insert(to.loops.end(), std::make_move_iterator(loops.loops.begin()),
                  std::make_move_iterator(loops.loops.end()));
}

Region loops_near(const Region& region, const Region& other) {
  const Eigen::AlignedBox2d box = box_of(other);
  Region near;
  for (const Polygon& loop : region.loops) {
    Eigen::AlignedBox2d own;
    for (const Eigen::Vector2d& point : loop) own.extend(point);
    if (own.intersects(box)) near.loops.push_back(loop);
  }
  return near;
}

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

Obstruction::Obstruction(const Body& part, const std::vector<PlanarFace>& faces, double layer,
                         double clearance)
    : part_(part),
      faces_(faces),
      layer_(layer),
      clearance_(clearance),
      part_is_convex_(is_convex_body(part)) {}

Pose Obstruction::side_frame(const FeaturePair& pair, bool side_a) const {
  const Feature& feature = side_a ? pair.a : pair.b;
  Eigen::Vector3d outward(0.0, 0.0, side_a ? 1.0 : -1.0);
  if (feature.kind == FeatureKind::Face) {
    outward =
        pair.X_PG.linear().transpose() * faces_[static_cast<std::size_t>(feature.index)].normal;
  }
  Pose X_GS = Pose::Identity();
  X_GS.linear() = rotation_with_z(outward, Eigen::Vector3d::UnitX());
  X_GS.translation().z() = (side_a ? 0.5 : -0.5) * pair.width;
  return X_GS;
}

Region Obstruction::part_between(const Pose& X_SP, double lower) const {
  std::vector<Region> standing_out;
  for (const Shape& shape : part_.shapes) {
    throw_if_stopped();
    const Eigen::AlignedBox3d box = bounding_box(shape, X_SP);
    if (box.max().z() <= lower || box.min().z() >= layer_) continue;
    Region region = slab_projection(shape, X_SP, lower, layer_);
    if (!region.empty()) standing_out.push_back(std::move(region));
  }
  return standing_out.empty() ? Region{} : unite(standing_out);
}

Region Obstruction::own_on_face(int face) {
  const auto known = own_.find(face);
  if (known != own_.end()) return known->second;
  const Pose X_FP = face_frame(faces_[static_cast<std::size_t>(face)]).inverse();
  return own_[face] = part_between(X_FP, kOwnLower);
}

Region Obstruction::own_beside(const FeaturePair& pair, bool side_a) const {
  const Pose X_GS = side_frame(pair, side_a);
  return map_region(part_between((pair.X_PG * X_GS).inverse(), kOwnLowerBesideEdge), X_GS);
}

Region Obstruction::own(const FeaturePair& pair) {
  if (part_is_convex_) return {};
  const Pose X_GP = pair.X_PG.inverse();
  std::vector<Region> both;
  for (const bool side_a : {true, false}) {
    const Feature& feature = side_a ? pair.a : pair.b;
    Region beside;
    if (feature.kind == FeatureKind::Face) {
      const PlanarFace& face = faces_[static_cast<std::size_t>(feature.index)];
      beside = map_region(own_on_face(feature.index), X_GP * face_frame(face));
    } else {
      beside = own_beside(pair, side_a);
    }
    if (!beside.empty()) both.push_back(std::move(beside));
  }
  return both.empty() ? Region{} : unite(both);
}

const std::vector<Eigen::AlignedBox3d>& Obstruction::boxes_of(const Body& body) {
  const auto [entry, is_new] = boxes_.try_emplace(&body);
  if (is_new) {
    for (const Shape& shape : body.shapes) {
      entry->second.push_back(bounding_box(shape, Pose::Identity()));
    }
  }
  return entry->second;
}

Region Obstruction::of_body(const FeaturePair& pair, const Body& body, const Pose& X_PB,
                            double reach) {
  const std::vector<Eigen::AlignedBox3d>& boxes = boxes_of(body);
  const Eigen::AlignedBox2d around = box_of(pair.overlap);
  Region blocking;
  for (const bool side_a : {true, false}) {
    const Pose X_GS = side_frame(pair, side_a);
    const Pose X_SB = (pair.X_PG * X_GS).inverse() * X_PB;
    // Seen from behind, y of S is -y of G.
    const double y_sense = side_a ? 1.0 : -1.0;
    Eigen::AlignedBox2d window;
    window.extend(Eigen::Vector2d(around.min().x(), y_sense * around.min().y()));
    window.extend(Eigen::Vector2d(around.max().x(), y_sense * around.max().y()));
    const double lower = -clearance_, upper = layer_ + clearance_;
    const auto is_beyond = [&](const Eigen::AlignedBox3d& box) {
      if (box.max().z() < lower || box.min().z() > upper) return true;
      const Eigen::AlignedBox2d seen(box.min().head<2>(), box.max().head<2>());
      return window.exteriorDistance(seen) > reach;
    };
    for (std::size_t i = 0; i < body.shapes.size(); ++i) {
      const Shape& shape = body.shapes[i];
      // The box of a box is larger, and costs next to nothing.
      if (is_beyond(moved_box(boxes[i], X_SB)) || is_beyond(bounding_box(shape, X_SB))) continue;
      throw_if_stopped();
      const Region region = slab_projection(shape, X_SB, lower, upper);
      if (!region.empty()) append(grown(map_region(region, X_GS), clearance_), blocking);
    }
  }
  return blocking;
}

}  // namespace handey::grasp
