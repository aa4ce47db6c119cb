// Proves that a whole box of configurations is free: the pair of pieces that is farther apart in
// the middle than it can come nearer by anywhere in the box is done with for the box and every box
// within it. What is not proved is not called free. The same bounds as the certificate of an edge.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

/// Two pieces that are to be kept apart: of a mover (a robot body, or the held part after them),
/// and of another mover or of what stands.
struct PiecePair {
  int mover = 0, piece = 0;
  int other = 0,
      other_piece = 0;  ///< other: a mover, or -1 and other_piece is an index of obstacle pieces
};

/// Configurations within `half` of `centre`, joint by joint [rad]; one opening.
struct ConfigurationBox {
  Configuration centre;
  Eigen::VectorXd half;
};

/// A pair that is not proved yet, and the direction along which its first piece lay beyond its
/// second when it was last looked at (zero: none is known), which mostly still holds near by.
struct NearPair {
  PiecePair pair;
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
};

struct BoxProof {
  bool free = false;           ///< every configuration of the box is free
  bool collides = false;       ///< the centre itself was found not to be free
  std::vector<NearPair> near;  ///< pairs not proved for the whole box, or not looked at; the one
                               ///< that failed first
};

/// One worker on a checker, which it places; not to be shared between threads.
class BoxProver {
 public:
  /// @param clearance least distance proved [m]
  explicit BoxProver(CollisionChecker& checker, double clearance = 1e-4);
  ~BoxProver();
  BoxProver(BoxProver&&) noexcept;

  /// Looks at all pairs that are checked, until one fails.
  BoxProof prove(const ConfigurationBox& box);
  /// Looks at these pairs only: those that were left near for a box that contains this one.
  BoxProof prove(const ConfigurationBox& box, const std::vector<NearPair>& near);
  /// Looks only at pairs that the joints before `joint` do not move against each other (hand
  /// against forearm, hand against itself), and splits the box until it is proved or `evaluations`
  /// are spent.
  /// @return true: no such pair comes together anywhere in the box
  bool prove_beyond(int joint, const ConfigurationBox& box, int evaluations = 400);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace handey
