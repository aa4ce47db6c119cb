// Is the robot, with what it holds, free of the cell and of itself, and how far from it? Meshes are
// solids: a body wholly inside another collides.
// Which pairs count: robot bodies that an arm joint moves against fixtures and parts; robot bodies
// against each other, but for bodies joined by a joint, pairs that overlap at home and in more than
// 95 % of 1000 random configurations, and the robot file's list; the held part against all of these
// but the fingers.
// Distances are lower bounds: never larger than the truth (to 1e-7 m).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "handey/world/cell.hpp"

namespace handey {

/// Collision geometry of a cell's robot, fixtures and parts, and the robot's ignored pairs.
/// Immutable, shared.
class CollisionModel {
 public:
  struct Impl;  // for this room's sources
  explicit CollisionModel(std::unique_ptr<const Impl> impl);
  ~CollisionModel();
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<const Impl> impl_;
};

/// @param known  a model of any cell: the robot, if it is this very one, and bodies of the same name
/// and shapes are taken from it, which saves milliseconds
/// @throws InvalidInput for invalid cells
std::shared_ptr<const CollisionModel> make_collision_model(
    const Cell& cell, const std::shared_ptr<const CollisionModel>& known = nullptr);

// Names in hits: a robot body by its first link; what is held as "held bracket"; fixtures and parts
// by their names.

/// Contacts that are part of the work; everything else may not touch.
struct Allowance {
  std::optional<int> closed_on;  ///< part the fingers close on without it being held yet: fingers
                                 ///< against it are not checked
  std::vector<BodyRef> held_touches;  ///< bodies the held part may touch where it stands
};

/// The pair that is in the way.
struct Hit {
  std::string a;          ///< "forearm_link", "held bracket", "gripper" ...
  std::string b;          ///< "table", "block", "upper_arm_link" ...
  double distance = 0.0;  ///< [m]; 0 or less where they overlap
};

/// One worker: not to be shared between threads; cheap to make from a model.
class CollisionChecker {
 public:
  /// @param cell where the parts are and what is held now; same robot, fixtures and parts as the
  /// model's
  CollisionChecker(std::shared_ptr<const CollisionModel> model, const Cell& cell,
                   const Allowance& allowance = {});
  ~CollisionChecker();
  CollisionChecker(CollisionChecker&&) noexcept;
  CollisionChecker& operator=(CollisionChecker&&) noexcept;

  const Cell& cell() const;

  /// The first pair found not farther apart than `clearance` [m], if any.
  std::optional<Hit> find_hit(const Configuration& configuration, double clearance = 1e-4);
  bool is_free(const Configuration& configuration, double clearance = 1e-4) {
    return !find_hit(configuration, clearance).has_value();
  }
  /// The closest checked pair; distance is 0 where they overlap. Pairs beyond `horizon` [m] are not
  /// looked at: if there is no other, the names are empty and the distance is `horizon`.
  Hit closest(const Configuration& configuration, double horizon = 0.1);

  struct Impl;  // for the certificate, in the same room
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// Two resting bodies that overlap.
struct Overlap {
  BodyRef a, b;
  std::string name_a, name_b;
  double depth = 0.0;  ///< how far one must be moved to part them, at least [m]
};
/// All pairs of fixtures and parts (held part left out) with a part among them that overlap deeper
/// than `tolerance` [m].
std::vector<Overlap> find_overlaps(const CollisionModel& model, const Cell& cell,
                                   double tolerance = 5e-4);

/// Bodies of the robot, or the held part, that overlap something at a configuration deeper than
/// `tolerance` [m]: all the pairs that the checker looks at, and the base against the parts that
/// stand. `distance` is minus the depth.
std::vector<Hit> robot_overlaps(CollisionChecker& checker, const Configuration& configuration,
                                double tolerance = 5e-4);

/// The bodies that `part`, standing at its place in `cell`, touches or nearly touches.
std::vector<BodyRef> touching_bodies(const CollisionModel& model, const Cell& cell, int part,
                                     double gap = 6e-4);

}  // namespace handey
