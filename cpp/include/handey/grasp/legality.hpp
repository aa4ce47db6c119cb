// Grasp poses at which hand and arm are legal at both ends: enough of the pads on the features, a
// hold that the part's weight does not turn (soft fingers), inverse kinematics within limits, and
// no collision with the hand open and with the hand closed, at the origin and at the destination (T
// moves the hand with the part). The part stands there as an obstacle for palm, arm and open
// fingers; closed fingers may touch it only by the pads. Complete only for the candidates: targets
// x directions x the hand's two half-turns x pads drawn back from the target. Article: the
// conditions that a grasp must meet at pick-up and at put-down.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"
#include "handey/grasp/fallen.hpp"
#include "handey/grasp/ranking.hpp"
#include "handey/kinematics/spherical_wrist.hpp"

namespace handey {

/// A pick-and-place to plan: the cell with the part at its origin and an empty hand, and where the
/// part is to go.
struct GraspScene {
  std::shared_ptr<const CollisionModel> model;
  Cell cell;
  int part = 0;
  Pose X_WP_goal = Pose::Identity();
};

struct LegalityOptions {
  int directions =
      24;  ///< approach directions per target, evenly spaced; those along edges come on top
  /// Beside the targets, points on a square lattice this far apart over all of the unobstructed
  /// area and half a pad round it; 0: none. For cells in which the targets give nothing [m].
  double spacing = 0.0;
  double open_clearance = 0.008;  ///< the open pads stand this far from the faces, each side, where
                                  ///< jaw and neighbours allow; else half, then a quarter of it [m]
  double clearance = 3e-4;        ///< of the whole robot [m]
  double least_contact_share =
      0.3;  ///< of the pad on the unobstructed area; where no pad can have that, 80 % of the
            ///< best; never under 15 % of the pad or 30 mm2
  double grip_force = 70.0;  ///< of the jaws, for parts whose mass or density is known [N]. Choice:
                             ///< an electric jaw of the size of a hand
  /// Friction of both pads over the part's weight, for parts whose mass is not known. Choice: a
  /// part of 0.3 kg at friction 0.4 in such jaws.
  double grip_ratio = 20.0;
  int most_poses = 16;  ///< returned per pair; then the search stops
  /// Candidates in an order spread over all of them, not the most promising first. Where few are
  /// legal these are found sooner.
  bool spread = false;
};

/// A grasp pose with all the configurations that are legal for it.
struct GraspPose {
  PlanarPose in_plane;
  bool flipped = false;
  Pose X_PH = Pose::Identity();  ///< grasp frame in the part
  double width = 0.0;            ///< opening when closed on the part [m]
  double opening = 0.0;          ///< opening while approaching [m]
  double contact_area = 0.0;     ///< of a pad on the unobstructed area (FeaturePair::overlap) [m2]
  /// Larger is better, 0..1. Choice: 0.35 contact (of what a pad can have) + 0.25 closeness of the
  /// pad to the centre of mass, 1 / (1 + distance / pad length) + 0.20 joint margin (0.35 rad from
  /// a limit or 0.3 from a singularity is full, the worse end counts) + 0.10 approach from above
  /// (mean of both ends) + 0.10 direction along an edge.
  double merit = 0.0;
  std::vector<Eigen::VectorXd>
      q_pick;  ///< legal at the origin, soonest reached from the cell's start first
  std::vector<Eigen::VectorXd> q_place;  ///< at the destination, likewise
};

struct LegalGrasps {
  std::vector<GraspPose> poses;  ///< best merit first
  // How many candidates fell, and where:
  int tried = 0, too_little_contact = 0, would_turn = 0, unreachable_at_origin = 0,
      unreachable_at_destination = 0, collides_at_origin = 0, collides_at_destination = 0;
  std::vector<Fallen> fallen;  ///< the same with what stood in the way; most frequent first
  std::string worst_reason;    ///< of those that got farthest, the one met most often: "hand hits
                               ///< table (destination): 14 of 48"; empty if none fell
};

/// Candidates are tested in the order of the part of their merit that costs nothing to know.
/// @throws InvalidInput (E_REF, E_RANGE, E_NUMBER, E_MISSING)
LegalGrasps find_legal_grasps(const GraspScene& scene, const SphericalWristSolver& solver,
                              const RankedPair& pair, const LegalityOptions& options = {});

class BlockedPoses;

/// The same in portions, for pairs that are to be looked at by turns.
class LegalGraspSearch {
 public:
  /// @param solver  must outlive the search
  /// @param blocked  of the same scene: candidates of the lattice (`spacing`) that it proves to be
  /// illegal are not looked at further, and count where it says they fall; the legal ones are the
  /// same with it and without
  /// @throws InvalidInput as find_legal_grasps
  LegalGraspSearch(const GraspScene& scene, const SphericalWristSolver& solver,
                   const RankedPair& pair, const LegalityOptions& options = {},
                   std::shared_ptr<BlockedPoses> blocked = nullptr);
  ~LegalGraspSearch();
  LegalGraspSearch(LegalGraspSearch&&) noexcept;
  LegalGraspSearch& operator=(LegalGraspSearch&&) noexcept;

  /// No candidate is left, or enough are legal.
  bool is_done() const;
  /// Looks at so many candidates more, at most, each with both half-turns of the hand. With
  /// `spread`, at so many places and directions.
  /// @return the legal ones of these, best merit first; with those of a call that was stopped
  /// before: after Stopped the search goes on where it was
  std::vector<GraspPose> next(int candidates);
  /// What came of all candidates so far.
  LegalGrasps result() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Is the hand pose `pose` of this pair legal at both ends? One pose in, at most one out.
LegalGrasps test_grasp_pose(const GraspScene& scene, const SphericalWristSolver& solver,
                            const RankedPair& pair, const PlanarPose& pose, bool flipped,
                            const LegalityOptions& options = {});

}  // namespace handey
