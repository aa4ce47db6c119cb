// Candidate hand poses of one pair, cheapest knowledge first: contact, lever, direction.
#pragma once

#include <string>
#include <vector>

#include "handey/grasp/legality.hpp"
#include "lattice_cells.hpp"
#include "obstruction.hpp"
#include "pad_contact.hpp"

namespace handey::grasp {

/// The pad areas that decide whether a pose has enough contact.
struct ContactDemand {
  double best = 0.0;      ///< what a pad can have on this pair [m2]
  double required = 0.0;  ///< [m2]
  bool is_met(const PadContact& contact) const {
    return contact.both_sides && contact.area >= required;
  }
};
ContactDemand contact_demand(const RankedPair& pair, const Gripper& gripper,
                             const LegalityOptions& options);

struct Candidate {
  PlanarPose pose;
  double contact_area = 0.0;  ///< [m2]
  bool along_edge = false;    ///< approach normal or parallel to a long edge of the overlap
  double promise = 0.0;  ///< the part of the merit known without the arm, less for blocked fingers
  int group = 0;         ///< candidates that differ only by how far the pad is drawn back
  LatticePoint point;    ///< where on the lattice, if it is
};

/// Why places and directions have no candidates.
struct NoCandidates {
  int too_little_contact = 0;  ///< target and direction where the pad at the target has too little
  int would_turn = 0;          ///< where there is contact, but the part's weight would turn it
  std::string turn_reason;     ///< of the one that misses least
  PlanarPose little_contact;   ///< the one that has most of these
  double most_contact = -1.0;  ///< that it has [m2]
  PlanarPose turning;          ///< the one that misses least
  double least_excess = 0.0;   ///< by which it does [m]
};

struct CandidateList : NoCandidates {
  std::vector<Candidate> candidates;  ///< most promising first
};

/// Where the middle of the pads may be.
struct Place {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< in (x, y) of G [m]
  bool is_target = false;
  int column = 0, row = 0;  ///< of the lattice, if it is none
};

/// Is a finger, from its tip back over the pad's length, beside something that stands in its layer?
class FingerRoom {
 public:
  FingerRoom(const RankedPair& pair, const Robot& robot);
  bool is_blocked(const PlanarPose& pose) const;

 private:
  struct Block {
    Region region;
    Eigen::Vector2d centre;
    double radius;  ///< of a circle round it [m]
  };
  void add(Region region);

  Gripper footprint_;          ///< its pad is what a finger covers
  double forward_ = 0.0;       ///< its middle, from that of the pad [m]
  std::vector<Block> blocks_;  ///< one by one where there are no holes
};

/// Makes candidates slot by slot: a slot is a place for the pads and a direction of the hand.
class CandidateMaker {
 public:
  /// Keeps references to all but the options.
  CandidateMaker(const RankedPair& pair, const Robot& robot, const Eigen::Vector2d& down_in_G,
                 const ContactDemand& demand, const Hold& hold, const LegalityOptions& options);
  std::size_t slots() const { return places_.size() * directions_.size(); }
  /// What the options ask for beside the targets.
  const PoseLattice& lattice() const { return lattice_; }
  /// Adds the slot's candidates to the list, or counts why it has none.
  void make(std::size_t slot, CandidateList& list);

 private:
  /// Adds a candidate. @return false if it has too little contact
  bool add(const Candidate& drawn_back, bool is_first, CandidateList& list);

  const RankedPair& pair_;
  const Gripper& gripper_;
  const Eigen::Vector2d& down_in_G_;
  const ContactDemand& demand_;
  const Hold& hold_;
  FingerRoom room_;
  std::vector<double> directions_;
  std::vector<char> along_edge_;  ///< per direction
  std::vector<int> turns_;        ///< per direction, its index in the lattice
  std::vector<Place> places_;     ///< the targets first
  PoseLattice lattice_;
};

/// All of them, most promising first.
/// @param down_in_G  mean over both ends of the world's downward direction in G: the approach from
/// above
CandidateList make_candidates(const RankedPair& pair, const Robot& robot,
                              const Eigen::Vector2d& down_in_G, const ContactDemand& demand,
                              const Hold& hold, const LegalityOptions& options);

/// The part of the merit that needs no arm, 0..0.8.
double planar_merit(const RankedPair& pair, const Gripper& gripper, const PlanarPose& pose,
                    double contact_area, bool along_edge, const Eigen::Vector2d& down_in_G,
                    const ContactDemand& demand);

/// True if theta is along or normal to one of the overlap's long edges.
bool is_along_edge(const RankedPair& pair, double theta);

}  // namespace handey::grasp
