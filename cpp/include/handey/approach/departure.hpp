// The way out in the grasp plane, for a hand that holds a part or is open round one: departure from
// the origin and withdrawal; reversed, the deposit. The planners are those of the approach, with
// the held part as part of the hand: the article's slide in from where there is room, driven
// backwards, then the complete search in (x, y, theta). The arm follows; every edge is certified
// for the whole robot with what it holds.
// The plane is that of the hand's x and z axes at the start. Not guaranteed: that up lies in it,
// which it does for a hand that points down or whose x axis is upright; a way out of the plane is
// not looked for. It starts where all is clear already; plan_retreat leaves contact first.
// Article: "Local planning"; "Global planning" for where it ends (I' and F').
#pragma once

#include <string>
#include <vector>

#include "handey/approach/approach.hpp"

namespace handey {

struct DepartureOptions {
  double cell = 0.004;      ///< of grid and lattice [m]
  double least = 0.02;      ///< it ends no nearer to its start [m]
  double most = 0.10;       ///< out is that far from the start; it may then end before [m]
  double clearance = 2e-4;  ///< of the whole robot at the poses tried [m]
  /// As RetreatOptions: it ends at the last of its poses where the first three joints are free by
  /// so much to either side; if none is, another end is looked for [rad]. 0: not asked.
  double room = 0.0175;
  int most_slides = 3;  ///< slides from different starts; 0: none
  QuasipotentialOptions slide;
  PlaneSearchOptions search;
  int search_levels = 1;  ///< lattices searched where no slide comes in: of `cell`, then half of
                          ///< it, at most 3; 0: no search
  CertificateOptions certificate;
};

struct DepartureResult {
  bool found = false;
  ApproachPlanner planner = ApproachPlanner::Quasipotential;  ///< that found it, or was asked last
  std::vector<Configuration> path;  ///< certified, from the start outwards; empty if not found
  std::vector<PlanarPose> poses;    ///< of the hand, before the path was shortened; the start is
                                    ///< (0, 0, 0), x along the hand's approach axis
  bool has_room = false;            ///< it ends where `room` is free; false if that was not asked
  std::string reason;               ///< why not found, with names and numbers
};

/// @param checker  of the cell with what is held, if anything is
/// @param start    free
/// @throws InvalidInput (E_DOF, E_NUMBER, E_RANGE, E_VALUE) for wrong lengths, options out of
/// range, a start that is not free
DepartureResult plan_departure(CollisionChecker& checker, const SphericalWristSolver& solver,
                               const Configuration& start, const DepartureOptions& options = {});

}  // namespace handey
