// The hand's solids at both ends, the origin first.
#include "handey/grasp/blocked_poses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "handey/geometry/convex_pieces.hpp"
#include "ranges.hpp"
#include "scene_input.hpp"

namespace handey {
namespace {

/// The part at one of its places.
struct Standing {
  Standing(const GraspScene& scene, const Pose& X_WP, GraspEnd its_end,
           const Eigen::Vector3d& centre, double radius)
      : end(its_end),
        X_RP(scene.cell.X_WR.inverse() * X_WP),
        closed(scene.model, scene.cell.with_part_at(scene.part, X_WP), closed_on(scene.part)),
        solids(closed, X_RP * centre, radius) {}

  static Allowance closed_on(int part) {
    Allowance allowance;
    allowance.closed_on = part;
    return allowance;
  }

  GraspEnd end;
  Pose X_RP;
  CollisionChecker closed;
  HandSolids solids;
};

Eigen::AlignedBox3d box_of(const Body& part) {
  Eigen::AlignedBox3d box;
  for (const Shape& shape : part.shapes) {
    for (const Eigen::Vector3d& point : hull_points(shape)) box.extend(point);
  }
  return box;
}

}  // namespace

struct BlockedPoses::Impl {
  explicit Impl(const GraspScene& scene) : robot(scene.cell.robot) {
    const Body& part = scene.cell.parts[static_cast<std::size_t>(scene.part)];
    const Eigen::AlignedBox3d box = box_of(part);
    const double radius = HandSolids::extent(*robot) + 0.5 * box.diagonal().norm();
    standing[0] =
        std::make_unique<Standing>(scene, part.X_WB, GraspEnd::Origin, box.center(), radius);
    standing[1] = std::make_unique<Standing>(scene, scene.X_WP_goal, GraspEnd::Destination,
                                             box.center(), radius);
  }

  std::optional<PoseBlock> find(const FeaturePair& pair, const Pose& X_PH, double width,
                                const HandMotion& motion) {
    for (const auto& here : standing) {
      const Pose X_RH = here->X_RP * X_PH;
      here->solids.set_width(width);
      const Eigen::Vector3d axis = here->X_RP.linear() * pair.X_PG.linear().col(2);
      const std::optional<HandBlock> hit = here->solids.blocking(X_RH, axis, motion);
      if (!hit) continue;
      return PoseBlock{here->end, here->solids.mover_name(hit->mover),
                       here->solids.other_name(hit->other)};
    }
    return std::nullopt;
  }

  std::shared_ptr<const Robot> robot;
  std::array<std::unique_ptr<Standing>, 2> standing;
};

BlockedPoses::BlockedPoses(const GraspScene& scene) {
  grasp::require_valid_scene(scene);
  impl_ = std::make_unique<Impl>(scene);
}
BlockedPoses::~BlockedPoses() = default;
BlockedPoses::BlockedPoses(BlockedPoses&&) noexcept = default;
BlockedPoses& BlockedPoses::operator=(BlockedPoses&&) noexcept = default;

std::optional<PoseBlock> BlockedPoses::find(const FeaturePair& pair, const PlanarPose& middle,
                                            bool flipped, const HandMotion& motion) {
  for (const double value : {middle.x, middle.y, middle.theta}) {
    grasp::require_in_range(value, -1e3, 1e3, "middle");
  }
  grasp::require_in_range(motion.shift, 0.0, 1e3, "motion.shift");
  grasp::require_in_range(motion.half_turn, 0.0, 1e3, "motion.half_turn");
  const double width =
      std::max(impl_->robot->gripper.min_opening, pair.width_at({middle.x, middle.y}));
  HandMotion moved = motion;
  moved.shift *= 1.0 + pair.taper.norm();  // the fingers follow the width
  return impl_->find(pair, pair.X_PG * hand_in_plane(middle, flipped), width, moved);
}

}  // namespace handey
