// Poses two centimetres apart keep the joint lines between them within a tenth of a millimetre of
// the hand's straight line.
#include "straight_approach.hpp"

#include <algorithm>
#include <cmath>

#include "certified_path.hpp"
#include "reason.hpp"

namespace handey {

StraightWay straight_way(const ApproachTask& task, HandReach& reach) {
  constexpr double kStep = 0.02;  // [m]
  const PlanarPose& aim = task.aim.in_plane;
  const double run = task.options.run_in;
  const int steps = std::max(1, static_cast<int>(std::ceil(run / kStep - 1e-9)));
  const PlanarPose start{aim.x - run * std::cos(aim.theta), aim.y - run * std::sin(aim.theta),
                         aim.theta};
  StraightWay way;
  std::vector<Configuration> points{reach.with_opening(task.q_pick)};
  for (const PlanarPose& pose : planar_line(aim, start, steps)) {
    const std::optional<Eigen::VectorXd> q = reach.follow(pose, points.back().q);
    if (!q) {
      way.obstacle = reach.reason();
      break;
    }
    points.push_back(reach.with_opening(*q));
  }
  CertifiedPath proved = certified_path(reach.checker(), points, task.options.certificate);
  if (proved.reached + 1 < points.size()) way.obstacle = describe(proved.obstacle.hit);
  way.length = run * static_cast<double>(proved.reached) / steps;
  way.path.assign(proved.path.rbegin(), proved.path.rend());
  return way;
}

}  // namespace handey
