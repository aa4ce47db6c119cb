// Which grasps of a part are legal where it stands, of many grasps at many places in one call: hand
// open, hand closing, arm and inverse kinematics, with the part there as an obstacle. The same
// tests as legality makes at each end of a pick-and-place, so that a grasp which is compatible with
// two places serves a transfer between them, at the lesser of its two openings (a hand that opens
// less stays within what the closing fingers sweep). Article: "Regrasping", the legality of grasps
// at placements.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "handey/grasp/part_grasps.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

struct CompatibilityOptions {
  double open_clearance = 0.008;  ///< as LegalityOptions: all of it, half, a quarter [m]
  double clearance = 3e-4;        ///< of the whole robot [m]
  int configurations = 2;         ///< of the arm, per grasp: the legal ones of best margin
  int most = 0;                   ///< legal grasps per group at a place, then the next; 0: all
};

/// A grasp that is legal at a place.
struct CompatibleGrasp {
  int grasp = 0;         ///< index
  double opening = 0.0;  ///< the widest of those tried at which it is legal [m]
  double margin = 0.0;   ///< from joint limits and singularities, best configuration, 0..1
  std::vector<Eigen::VectorXd> q;  ///< legal configurations, best margin first
};

struct CompatibleGrasps {
  std::vector<CompatibleGrasp> legal;  ///< ordered by index
  int tried = 0, unreachable = 0, collides = 0;
  std::string worst_reason;  ///< what the hand met most often: "hand hits table: 14 of 48"
};

/// @param model   of the cell
/// @param part    index in cell.parts
/// @param groups  indices of grasps to look at, each group in its order until `most` of it are
///                legal; a grasp of several groups is looked at once
/// @param places  the part in the world, one after the other
/// @throws InvalidInput (E_MISSING, E_REF, E_RANGE, E_NUMBER)
std::vector<CompatibleGrasps> find_compatible_grasps(
    const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
    const SphericalWristSolver& solver, const std::vector<PartGrasp>& grasps,
    const std::vector<std::vector<int>>& groups, const std::vector<Pose>& places,
    const CompatibilityOptions& options = {});

/// Joint margin (0..1, -1: out of reach) of the best grasp of each group at each place, or of one
/// that is nearly as good as can be; collision is not looked at. Row by row: places x groups.
/// @throws InvalidInput (E_MISSING, E_RANGE, E_NUMBER)
std::vector<std::vector<double>> reach_margins(const Cell& cell, const SphericalWristSolver& solver,
                                               const std::vector<PartGrasp>& grasps,
                                               const std::vector<std::vector<int>>& groups,
                                               const std::vector<Pose>& places);

}  // namespace handey
