// The search that does not give up: is there any way for the hand out of where it grasps, in the
// grasp plane, turning allowed? A lattice in (x, y, theta) through the grasp pose; each point is
// free, close (the hand shares a cell with an obstacle) or blocked (a cell is full of both). From
// all exits the cost to go is spread over what is not blocked; A* follows it from the grasp
// outwards and asks for each point on its way whether hand and arm can be there. Complete at the
// lattice's resolution: no way is reported only where none joins points that are not blocked or
// refused. Not guaranteed: that the motion between two neighbours is free; the caller certifies and
// forbids. Article: the "guaranteed methods" behind the quasipotential. After Barraquand and
// Latombe, IJRR 10(6), 1991; Hart, Nilsson and Raphael, 1968.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "handey/approach/bump_lines.hpp"
#include "handey/approach/grid.hpp"

namespace handey {

struct PlaneSearchOptions {
  int directions = 72;      ///< of the hand, evenly spaced: 5 degrees
  double close_cost = 4.0;  ///< a step to a point that is close costs so much more; at most 20
  int most_tests = 2000;    ///< questions to the step test; then the status is TestLimit
};

enum class PlaneSearchStatus {
  Found,
  Enclosed,   ///< no way out for the hand alone, whatever the arm could do
  NoWay,      ///< none but over points or steps that were refused
  TestLimit,  ///< not known
};

/// anchor + (i, j) cells, turned from it by k directions.
struct LatticePoint {
  int i = 0, j = 0, k = 0;
  bool operator==(const LatticePoint& o) const { return i == o.i && j == o.j && k == o.k; }
};

struct PlaneSearchResult {
  PlaneSearchStatus status = PlaneSearchStatus::NoWay;
  std::vector<LatticePoint> path;  ///< from the start outwards to an exit; if there is none, to the
                                   ///< point accepted that lies farthest out
  int tests = 0;
  bool found() const { return status == PlaneSearchStatus::Found; }
};

/// What the step test says: may hand and arm come to the second point from the first?
enum class StepAnswer {
  Yes,
  NotFromThere,  ///< perhaps from elsewhere
  Never          ///< the point itself is out of the question
};
using StepTest = std::function<StepAnswer(const LatticePoint& from, const LatticePoint& to)>;

class PlaneSearch {
 public:
  /// @param touched  cells that obstacles touch, one layer for each piece of the outline
  /// @param full     cells wholly inside obstacles: same place, cell and layers
  /// @param anchor   the grasp pose, of the frame of the grids
  /// @param exit     distance from the anchor at which the hand is out; its finger grasp point
  /// stays within the next cell [m]
  /// @throws InvalidInput (E_NUMBER, E_RANGE) for grids that do not fit each other or the outline,
  /// an anchor off the grid, options out of range, a lattice of more than 2^26 points
  PlaneSearch(const MotionGrid& touched, const MotionGrid& full, const GripperOutline& outline,
              const PlanarPose& anchor, double exit, const PlaneSearchOptions& options = {});
  /// For a hand whose pieces are not prisms along the closing axis, as with a part in it.
  /// @param outline  contains the hand; its pieces are the layers of `touched`
  /// @param core     prisms that lie within the hand; its pieces are the layers of `full`
  PlaneSearch(const MotionGrid& touched, const GripperOutline& outline, const MotionGrid& full,
              const GripperOutline& core, const PlanarPose& anchor, double exit,
              const PlaneSearchOptions& options = {});

  /// Is there a way out of the point for the hand alone, no step asked about?
  bool is_open(const LatticePoint& point) const;
  bool is_blocked(const LatticePoint& point) const;
  /// Not even close.
  bool is_free(const LatticePoint& point) const;
  /// The step is never taken again, either way.
  void forbid(const LatticePoint& a, const LatticePoint& b);
  /// @param start  taken for granted, blocked or not
  PlaneSearchResult find_way_out(const LatticePoint& start, const StepTest& may_step);

  PlanarPose pose(const LatticePoint& point) const;
  LatticePoint nearest(const PlanarPose& pose) const;
  bool is_exit(const LatticePoint& point) const;
  int half() const { return half_; }
  int directions() const { return options_.directions; }

 private:
  static constexpr int kSteps = 10;
  struct Step {
    int to, cost;  // index of the point, cost in the open
  };
  int index(const LatticePoint& point) const;
  LatticePoint point(int index) const;
  void steps(int from, Step (&out)[kSteps]) const;
  int entry_cost(int to, int cost) const;
  void close_border();
  void classify(const MotionGrid& touched, const GripperOutline& outline, const MotionGrid& full,
                const GripperOutline& core);
  void spread_costs();

  struct Run;  // one find_way_out

  PlaneSearchOptions options_;
  PlanarPose anchor_;
  double cell_, exit_;
  int half_;
  std::vector<std::uint8_t> kind_;     // per point: free, close, blocked
  std::vector<std::int32_t> to_exit_;  // least cost over what is not blocked
  std::set<std::pair<int, int>> forbidden_;
};

}  // namespace handey
