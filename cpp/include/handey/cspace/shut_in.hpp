// Can a part come from one place to another at all, whoever carries it? A ball that the part holds
// must come there too, however the part is turned: where it stands and where it is to stand are two
// points, and the ball's centre keeps its radius away from what does not move. Space is cut into
// cubes, finer only where they link the two; a cube is blocked if one convex solid within an
// obstacle is nearer than the radius to all of it. A flood of cubes from one end that runs out
// before it comes to the other, or out of all narrow places, is the proof: no path exists, with
// any grasp, any regrasp, any robot.
// Not guaranteed: that a part which cannot come out is told so; a long one that does not turn in a
// bend still holds a small ball.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "handey/collision/checker.hpp"

namespace handey {

struct ShutInOptions {
  double finest = 0.001;  ///< edge of the smallest cubes [m]
  /// Cubes looked at, and steps from cube to cube, before it is given up. Choice: some 50 ms.
  std::size_t most_cubes = 30000;
  std::size_t most_steps = 1000000;
};

struct ShutIn {
  bool shut_in = false;
  int end = -1;             ///< 0: it does not come away from the first place; 1: to the second
  double radius = 0.0;      ///< of the ball [m]
  double resolution = 0.0;  ///< edge of the smallest cubes that took part [m]
  std::size_t cubes_looked_at = 0;
  std::vector<std::string> bodies;  ///< round the end, those that block most cubes first
  std::string reason;               ///< why it is not proved; empty if it is
};

/// @param checker  of the cell with the part held; what stands there never moves
/// @param X_RP, X_RP_goal  the part in the robot frame where it stands, and where it is to stand
/// @throws InvalidInput (E_REF) if nothing is held, (E_NUMBER, E_RANGE) for wrong poses or options
ShutIn prove_shut_in(CollisionChecker& checker, const Pose& X_RP, const Pose& X_RP_goal,
                     const ShutInOptions& options = {});

}  // namespace handey
