// Local planning near obstacles, step 4 of the article: the hand, open, slides in the grasp plane
// from the border of the grid to the fingertip target; the arm follows by inverse kinematics and
// may not collide; the grasp is where the slide ends, if the fingers then overlap the faces enough
// and the grasp is legal at the destination too. Incomplete: a slide may stall; then another start
// is taken. The path returned is certified edge by edge. Article: "Local planning: the
// quasipotential method", Figures 5 and 6.
#pragma once

#include <string>
#include <vector>

#include "handey/approach/plane_search.hpp"
#include "handey/approach/quasipotential.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/grasp/legality.hpp"

namespace handey {

struct ApproachOptions {
  double cell = 0.004;   ///< of the motion grid; halved up to twice where the slide stalls [m]
  double run_in = 0.10;  ///< distance of the start from the grasp, along the approach [m]
  double least_run_in = 0.04;  ///< shorter starts are tried down to this [m]
  int most_slides =
      8;  ///< slides from different starts; starts where the arm cannot stand do not count
  QuasipotentialOptions slide;
  LegalityOptions legality;
  CertificateOptions certificate;
  double contact_share = 0.3;  ///< accepted overlap of the pad with the unobstructed faces
  bool destination_obstacles_join = false;  ///< article: obstacles moved by T^-1 stand in the way
                                            ///< of the approaching hand too
  PlaneSearchOptions search;
  int search_levels = 1;  ///< lattices searched where the slides stall: of `cell`, then half of it,
                          ///< at most 3; 0: no search. Each costs eight times the one before.
};

enum class ApproachStatus {
  Found,
  StartBlocked,
  Stalled,
  PoorOverlap,
  IllegalAtDestination,
  NotCertified
};

/// Which planner found the way in, in the order in which they are asked.
enum class ApproachPlanner {
  Straight,        ///< the hand runs straight in along its approach axis
  Quasipotential,  ///< the article's slide
  PlaneSearch,     ///< complete search in (x, y, theta) of the grasp plane
  Arm              ///< sampling of the whole arm, out of the plane; never from plan_approach
};

struct ApproachResult {
  ApproachStatus status = ApproachStatus::Stalled;
  ApproachPlanner planner =
      ApproachPlanner::Straight;  ///< that found it; the last one asked, if none did
  std::string reason;             ///< for people, with names and numbers; empty if found
  GraspPose grasp;  ///< where the slide ended; its q_pick is the path's last configuration alone
  std::vector<Configuration>
      path;  ///< certified, from the start to the grasp, hand open (opening constant)
  SlideResult
      slide;  ///< the raw slide in the grasp plane; the one that came nearest, if none arrived
  bool found() const { return status == ApproachStatus::Found; }
};

/// Slide from a start `run_in` away toward the grasp pose `aim`, with the arm in the branch of
/// `q_pick` (one of aim.q_pick). Straight in first; then from nearer, then from starts turned about
/// the fingertips by up to 90 degrees. Where that fails with the hand open as at the aim, it is
/// tried less open, then open as wide as the part is anywhere; then all of them are searched.
/// @throws InvalidInput (E_RANGE, E_NUMBER, E_DOF, E_VALUE) for options out of range, a hand that
/// is not empty, a q_pick
///         that does not put the hand at `aim`
ApproachResult plan_approach(const GraspScene& scene, const SphericalWristSolver& solver,
                             const RankedPair& pair, const GraspPose& aim,
                             const Eigen::VectorXd& q_pick, const ApproachOptions& options = {});

}  // namespace handey
