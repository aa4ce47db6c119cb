// Local planning near obstacles, step 4 of the article: the hand, open, slides in the grasp plane from the border of the grid
// to the fingertip target; the arm follows by inverse kinematics and may not collide; the grasp is where the slide ends,
// if the fingers then overlap the faces enough and the grasp is legal at the destination too.
// Incomplete: a slide may stall; then another start is taken. The path returned is certified edge by edge.
// Article: "Local planning: the quasipotential method", Figures 5 and 6.
#pragma once

#include <string>
#include <vector>

#include "handey/approach/quasipotential.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/grasp/legality.hpp"

namespace handey {

struct ApproachOptions {
  double cell = 0.004;             ///< of the motion grid [m]
  double run_in = 0.10;            ///< distance of the start from the grasp, along the approach [m]
  QuasipotentialOptions slide;
  LegalityOptions legality;
  CertificateOptions certificate;
  double contact_share = 0.3;      ///< accepted overlap of the pad with the unobstructed faces
  bool destination_obstacles_join = false;  ///< article: obstacles moved by T^-1 stand in the way of the approach too
};

enum class ApproachStatus { Found, StartBlocked, Stalled, PoorOverlap, IllegalAtDestination, NotCertified };

struct ApproachResult {
  ApproachStatus status = ApproachStatus::Stalled;
  std::string reason;                  ///< for people, with names and numbers
  GraspPose grasp;                     ///< where the slide ended
  std::vector<Configuration> path;     ///< certified, from the start to the grasp, hand open (opening constant)
  SlideResult slide;                   ///< the raw slide in the grasp plane
  bool found() const { return status == ApproachStatus::Found; }
};

/// Slide from a start `run_in` away toward the grasp pose `aim`, with the arm in the branch of `q_pick` (one of aim.q_pick).
ApproachResult plan_approach(const GraspScene& scene, const SphericalWristSolver& solver, const RankedPair& pair,
                             const GraspPose& aim, const Eigen::VectorXd& q_pick, const ApproachOptions& options = {});

}  // namespace handey
