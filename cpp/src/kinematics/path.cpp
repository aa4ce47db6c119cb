// One inverse solution per hand pose, the one whose largest joint step is least. A step over the
// bound ends the path: it is a change of branch, or a singularity passed too near.
#include "handey/kinematics/path.hpp"

#include <cmath>

#include "handey/errors.hpp"
#include "numbers.hpp"

namespace handey {
namespace {

using kinematics::number_text;

/// The solution whose largest joint step from `q` is least; null if there is none.
const InverseSolution* nearest(const InverseResult& inverse, const Eigen::VectorXd& q) {
  const InverseSolution* best = nullptr;
  double least = 0.0;
  for (const InverseSolution& solution : inverse.solutions) {
    const double step = (solution.q - q).cwiseAbs().maxCoeff();
    if (best && step >= least) continue;
    best = &solution;
    least = step;
  }
  return best;
}

std::string at_pose(std::size_t i) { return "pose " + std::to_string(i) + ": "; }

}  // namespace

HandPathResult follow_hand_path(const SphericalWristSolver& solver,
                                const std::vector<Pose>& X_RH_path, const Eigen::VectorXd& q_start,
                                const HandPathOptions& options) {
  if (!(options.largest_jump > 0.0) || !std::isfinite(options.largest_jump)) {
    throw InvalidInput("E_RANGE", "largest_jump",
                       "is " + number_text(options.largest_jump) + "; expected more than 0 rad");
  }
  if (q_start.size() != 6 || !q_start.allFinite()) {
    throw InvalidInput(q_start.size() != 6 ? "E_DOF" : "E_NUMBER", "q_start",
                       "expected 6 finite joint values [rad]");
  }
  HandPathResult result;
  Eigen::VectorXd q = q_start;
  for (std::size_t i = 0; i < X_RH_path.size(); ++i) {
    const InverseResult inverse = solver.solve(X_RH_path[i], &q);
    const InverseSolution* next = nearest(inverse, q);
    if (!next) {
      result.reason = at_pose(i) + inverse.reason;
      return result;
    }
    Eigen::Index joint = 0;
    const double step = (next->q - q).cwiseAbs().maxCoeff(&joint);
    if (step > options.largest_jump) {
      result.reason = at_pose(i) + "joint " + std::to_string(joint + 1) + " would jump by " +
                      number_text(step, 3) + " rad, more than " +
                      number_text(options.largest_jump, 3);
      return result;
    }
    q = next->q;
    result.path.push_back(q);
  }
  result.complete = true;
  return result;
}

}  // namespace handey
