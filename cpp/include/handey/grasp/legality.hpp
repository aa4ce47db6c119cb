// Grasp poses at which hand and arm are legal at both ends: inverse kinematics within limits and no collision with the hand
// open at the origin, and with the hand open at the destination (T moves the hand with the part).
// Article: the conditions that a grasp must meet at pick-up and at put-down.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/grasp/ranking.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

/// A pick-and-place to plan: the cell with the part at its origin and an empty hand, and where the part is to go.
struct GraspScene {
  std::shared_ptr<const CollisionModel> model;
  Cell cell;
  int part = 0;
  Pose X_WP_goal = Pose::Identity();
};

struct LegalityOptions {
  int directions = 24;            ///< approach directions per target
  double open_clearance = 0.008;  ///< the open pads stand this far from the faces, each side, where the jaw allows [m]
  double clearance = 3e-4;        ///< of the whole robot [m]
  double least_contact_share = 0.3;   ///< of the pad on the unobstructed area
  int most_poses = 64;            ///< returned per pair
};

/// A grasp pose with all the configurations that are legal for it.
struct GraspPose {
  PlanarPose in_plane;
  bool flipped = false;
  Pose X_PH = Pose::Identity();             ///< grasp frame in the part
  double width = 0.0;                       ///< opening when closed on the part [m]
  double opening = 0.0;                     ///< opening while approaching [m]
  double contact_area = 0.0;                ///< of a pad on the unobstructed area [m2]
  double merit = 0.0;                       ///< larger is better
  std::vector<Eigen::VectorXd> q_pick;      ///< legal configurations at the origin, hand open
  std::vector<Eigen::VectorXd> q_place;     ///< at the destination
};

struct LegalGrasps {
  std::vector<GraspPose> poses;             ///< best merit first
  // How many candidates fell, and where:
  int tried = 0, too_little_contact = 0, unreachable_at_origin = 0, unreachable_at_destination = 0,
      collides_at_origin = 0, collides_at_destination = 0;
  std::string worst_reason;                 ///< the reason met most often, with names and numbers
};

LegalGrasps find_legal_grasps(const GraspScene& scene, const SphericalWristSolver& solver, const RankedPair& pair,
                              const LegalityOptions& options = {});

/// Is the hand pose `pose` of this pair legal at both ends? One pose in, at most one out.
LegalGrasps test_grasp_pose(const GraspScene& scene, const SphericalWristSolver& solver, const RankedPair& pair,
                            const PlanarPose& pose, bool flipped, const LegalityOptions& options = {});

}  // namespace handey
