// The free space of one gross motion: slices over the first three joints, linked. The wrist stands
// at its start values in the start's slice, at a goal's values in the goal's slice, and is anywhere
// between in the range slice that links the two; where the range is too wide, it is split. One more
// slice has the wrist as at home, and the search adds slices with other stances of the wrist. Each
// slice is a tree of boxes: coarse cells, split on demand where they are not proved free as a
// whole, down to the finest cells within a window round the ends, and to coarser ones elsewhere.
// Conservative: a box called free is free for every configuration in it (BoxProver). What is not
// called free may be free. Serves any arm of three joints or more. Article: "Global planning",
// Figure 7: I, I', F', F.
#pragma once

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

#include "handey/collision/box_certificate.hpp"
#include "handey/cspace/lattice.hpp"
#include "handey/cspace/slice.hpp"

namespace handey {

struct FreeSpaceOptions {
  int window_level = 3;  ///< finest level within the windows: 3 is 1 degree (article)
  int outer_level = 1;   ///< finest level of the ends' slices outside their windows
  int range_level = 1;   ///< finest level of the range slices
  int home_level =
      1;  ///< finest level of the slices with the wrist as at home and at other stances
  int wrist_splits = 3;     ///< the wrist's range is halved at most so often
  double clearance = 1e-4;  ///< least distance proved [m]
  /// Of level 0: coarse cells over the whole range of the wrist are then free where the union of
  /// its maps leaves them free (Slice). Choice: null, by proofs alone, which is quicker: the slice
  /// over a wide range costs more than it saves.
  std::shared_ptr<const ArmTable> table;
};

/// The first three joints and how far the wrist is from start (0) to goal (1).
using SlicePoint = std::array<double, 4>;

/// A box of one slice: a node of its tree. Bounds in units of the finest cells and of the finest
/// wrist interval.
struct SliceBox {
  /// Point: a single free configuration, that lies in no free box; its bounds mean nothing.
  enum class State : unsigned char { Unknown, Free, NotProved, Point };
  std::array<int, 4> lower{}, upper{};
  int slice = 0;  ///< 0: start; 1 + 2 g: range to goal g; 2 + 2 g: goal g; then stances
  int level = 0, wrist_level = 0;
  State state = State::Unknown;
  bool centre_collides = false;
  int first_child = -1, children = 0;
  bool has_near = false;
  std::vector<NearPair> near;  ///< pairs that its parts need to look at
};

/// Trees of boxes, made and proved when asked for. Keeps a reference to the checker.
class FreeSpace {
 public:
  /// @throws InvalidInput (E_DOF, E_RANGE) for arms of fewer than three joints, or options out of
  /// range
  FreeSpace(CollisionChecker& checker, const Configuration& start,
            const std::vector<Configuration>& goals, const FreeSpaceOptions& options = {});
  ~FreeSpace();

  int slices() const { return first_stance() + static_cast<int>(stances_.size()); }
  /// The slices from here on have the wrist at a stance of its own.
  int first_stance() const { return 1 + 2 * static_cast<int>(goals_.size()); }
  /// The first of them: as at home.
  int home_slice() const { return first_stance(); }
  bool is_stance(int slice) const { return slice >= first_stance(); }
  bool is_range(int slice) const { return slice % 2 == 1 && !is_stance(slice); }
  static int goal_of(int slice) { return (slice - 1) / 2; }
  const Configuration& start() const { return start_; }
  const std::vector<Configuration>& goals() const { return goals_; }
  CollisionChecker& checker() { return checker_; }
  const CollisionChecker& checker() const { return checker_; }

  /// Half width of the windows of the finest cells round the ends [rad].
  void set_window(double half_width) { window_ = half_width; }

  const SliceBox& box(int index) const { return boxes_[static_cast<std::size_t>(index)]; }
  int size() const { return static_cast<int>(boxes_.size()); }
  int proofs() const { return proofs_; }

  /// Proves the box, or fails to, once.
  SliceBox::State prove(int index);
  /// Splits a box that is not proved, if it may be split: its children, else none.
  bool split(int index);
  /// A slice more, with the wrist as in q.
  int add_stance(const Eigen::VectorXd& q);
  /// A box of state Point in a slice; it has no neighbours.
  int add_point(int slice);
  /// The coarsest box of a slice at these cells of level 0, or -1 outside the joints' ranges.
  int root(int slice, const CellIndex& cell);
  /// The cell of level 0 of a point.
  CellIndex cell_of(const SlicePoint& point) const;
  /// Proves and splits down to the box that holds the point: free, or the finest that is not; -1
  /// outside the ranges.
  int box_at(int slice, const SlicePoint& point);

  SlicePoint lower(const SliceBox& box) const { return real(box.lower); }
  SlicePoint upper(const SliceBox& box) const { return real(box.upper); }
  Configuration configuration(int slice, const SlicePoint& point) const;
  SlicePoint start_point() const;
  SlicePoint goal_point(int goal) const;
  /// How far a point of the hand can be from a joint's axis [m].
  double reach(int joint) const { return reach_[static_cast<std::size_t>(joint)]; }
  /// Width of a finest cell [rad].
  double finest(int joint) const { return lattice_.cell_width(Lattice::kLevels - 1, joint); }

 private:
  SlicePoint real(const std::array<int, 4>& units) const;
  bool may_split_cells(const SliceBox& box) const;
  bool prefers_wrist(const SliceBox& box) const;
  double bound(const SliceBox& box, bool wrist) const;
  void add_children(int index, bool wrist);
  bool is_free_in_whole_range(const SliceBox& box);

  CollisionChecker& checker_;
  BoxProver prover_;
  FreeSpaceOptions options_;
  Configuration start_;
  std::vector<Configuration> goals_;
  Lattice lattice_;
  std::vector<Eigen::VectorXd> stances_;  ///< values of the wrist, home first [rad]
  std::vector<double> reach_;  ///< per joint: how far a point of the hand can be from its axis [m]
  std::vector<std::vector<int>> roots_;  ///< per slice, by cell of level 0; -1: not made
  std::vector<std::unordered_map<int, int>> stance_roots_;  ///< likewise
  std::vector<SliceBox> boxes_;
  std::vector<std::unique_ptr<Slice>> whole_range_;  ///< per goal, made when first asked for
  double window_ = 0.0;
  int proofs_ = 0;
};

}  // namespace handey
