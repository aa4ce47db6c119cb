// Turns what stands into maps: which cells of (theta2, theta3) does an obstacle block at a waist
// angle?
#pragma once

#include <cstdint>
#include <vector>

#include "slice_scene.hpp"

namespace handey::cspace {

/// The maps to be united for a layer.
struct LayerMaps {
  std::vector<const std::uint8_t*> upper;   ///< a byte per cell of theta2
  std::vector<const std::uint8_t*> lower;   ///< a row of cells of theta3 per cell of theta2
  std::vector<std::vector<RingSpan>> hand;  ///< by ball: where its centre may not be
  bool all_blocked = false;                 ///< the body that joint 1 moves is in the way

  void clear(std::size_t balls);
};

/// One part of the arm that is kept apart from what stands.
struct Target {
  enum class Kind { WaistBody, Upper, Lower, Hand };
  Kind kind = Kind::Lower;
  Slab slab;
  double distance = 0.0;             ///< obstacles are grown by this in the plane [m]
  const RingMaps* maps = nullptr;    ///< of the link; null for others
  const LinkGroup* group = nullptr;  ///< of the body that joint 1 moves
  std::size_t ball = 0;              ///< of the hand
  double reach = 0.0;                ///< nothing farther from axis 2 concerns it [m]
};

class LayerWork {
 public:
  LayerWork(const ArmTable::Impl& table, const SliceScene& scene, double clearance);

  /// All that is kept apart from something, in order; good until asked again.
  const std::vector<Target>& targets_of(const Concerns& concerns);
  /// Adds what a section of something standing blocks.
  void add(const Target& target, const Polygon& section, LayerMaps& maps);
  /// The sections of something standing at an interval of the waist angle, and what they block.
  /// @param X_ER R in E at the interval's middle
  void add_at(const Standing& standing, const Pose& X_ER, double half_width, WaistCell& cell,
              LayerMaps& maps);

 private:
  void find_targets(const Concerns& concerns);

  const ArmTable::Impl& table_;
  const SliceScene& scene_;
  double margin_;
  PolarRaster raster_;
  std::vector<Target> targets_;
  Concerns targets_of_;  ///< whose the targets are
  std::vector<RingSpan> spans_;
  Polygon section_, grown_, middle_;  ///< middle_: a hand's middle strip, grown
};

/// Do two convex counter-clockwise polygons come within `distance` of each other? May say so where
/// only corners are somewhat farther apart.
bool come_near(const Polygon& a, const Polygon& b, double distance);

}  // namespace handey::cspace
