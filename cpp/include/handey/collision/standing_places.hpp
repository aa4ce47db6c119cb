// Where on a face can a part be put down? Positions and turns of a low-discrepancy sequence, kept
// if the part stands stably there, within what is asked for, and clear of everything. Clear: lifted
// off the face by a distance, the part is that far from every other body, so what is called clear
// is, but for what lies in the plane of the face itself. Not guaranteed: a place that exists is
// found; longer runs of the sequence find smaller ones. Article: "Regrasping", the choice of
// placements.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/world/resting.hpp"
#include "handey/world/support_faces.hpp"

namespace handey {

struct StandingPlaceOptions {
  int first = 0;  ///< of the sequence
  int count = 32;
  std::uint64_t seed = 0;
  /// Every second sample is taken around this point of the world (x, y), up to `within` away.
  std::optional<Eigen::Vector2d> near_point;
  double within = 0.2;  ///< [m]
  /// All that the part stands on lies in this box of the world (x, y).
  std::optional<Eigen::AlignedBox2d> region;
  bool inside = false;  ///< within the walls of the face's body
  /// Of the centre of mass within what it stands on; half of that of the pose is enough [m].
  double least_margin = 2e-3;
  double clearance = 1e-3;  ///< to all that is not under it [m]
  /// Greater distances, ascending: a place's room is the greatest that it has [m].
  std::vector<double> rooms = {3e-3, 0.01, 0.03, 0.06};
  /// The robot stands here and is kept clear of; none: not looked at.
  std::optional<Configuration> robot;
};

struct StandingPlace {
  Pose X_WP = Pose::Identity();
  double margin = 0.0;  ///< of the centre of mass within what it stands on [m]
  double room = 0.0;    ///< it is at least so far from all that is not under it [m]
};

struct StandingPlaces {
  std::vector<StandingPlace> places;  ///< in the order of the sequence
  // Why the other samples fell:
  int tried = 0, off_the_face = 0, outside_the_region = 0, outside_the_walls = 0, not_clear = 0;
  std::string in_the_way;  ///< what was met most often by those that were not clear
};

/// @param cell  where the other bodies are; what is held is not looked at
/// @param rest  of the part
/// @throws InvalidInput (E_REF, E_RANGE, E_NUMBER, E_DOF)
StandingPlaces find_standing_places(const std::shared_ptr<const CollisionModel>& model,
                                    const Cell& cell, int part, const RestingPose& rest,
                                    const SupportFace& face,
                                    const StandingPlaceOptions& options = {});

}  // namespace handey
