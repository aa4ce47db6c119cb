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

struct BoxProof {
  /// Every configuration within scale * half of the centre is proved free, joint by joint (at most
  /// `most_scale`); 1 or more: the whole box. 0: not even the centre.
  double scale = 0.0;
  bool is_free() const { return scale >= 1.0; }
  bool collides = false;        ///< the centre itself is not free
  std::vector<PiecePair> near;  ///< the pairs not proved for the whole box
};

/// One worker on a checker, which it places; not to be shared between threads.
class BoxProver {
 public:
  /// @param clearance least distance proved [m]
  explicit BoxProver(CollisionChecker& checker, double clearance = 1e-4);
  ~BoxProver();
  BoxProver(BoxProver&&) noexcept;

  /// Looks at all pairs that are checked.
  BoxProof prove(const ConfigurationBox& box, double most_scale = 1.0);
  /// Looks at these pairs only: those that were left near for a box that contains this one.
  BoxProof prove(const ConfigurationBox& box, const std::vector<PiecePair>& near);
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
