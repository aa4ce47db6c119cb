// Which hand poses are certainly illegal, many at once and without the arm's joints: in all poses
// about one the hand, closed on the part at the origin or at the destination, lies deeper in
// something than any of them lets it move. What is called blocked is illegal however wide the jaws
// open before; not that the rest is legal.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "handey/grasp/fallen.hpp"
#include "handey/grasp/features.hpp"
#include "handey/grasp/hand_solids.hpp"
#include "handey/grasp/legality.hpp"

namespace handey {

/// What blocks hand poses.
struct PoseBlock {
  GraspEnd end = GraspEnd::Origin;
  std::string mover, body;  ///< as in Hit
};

/// One worker for the pairs of a scene: not to be shared between threads.
class BlockedPoses {
 public:
  /// @throws InvalidInput (E_MISSING, E_RANGE, E_NUMBER) as find_legal_grasps
  explicit BlockedPoses(const GraspScene& scene);
  ~BlockedPoses();
  BlockedPoses(BlockedPoses&&) noexcept;
  BlockedPoses& operator=(BlockedPoses&&) noexcept;

  /// What blocks all poses within the motion of `middle`, nothing where that is not proved.
  /// @throws InvalidInput (E_RANGE, E_NUMBER)
  std::optional<PoseBlock> find(const FeaturePair& pair, const PlanarPose& middle, bool flipped,
                                const HandMotion& motion = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace handey
