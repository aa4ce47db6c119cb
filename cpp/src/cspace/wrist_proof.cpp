// The plane is sought by Gilbert's method; any direction in which the two sets of points leave a
// gap proves it, however the direction was found.
#include "wrist_proof.hpp"

#include <algorithm>
#include <cmath>

#include "handey/stop.hpp"
#include "swept_points.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector3d;

constexpr int kBudget = 600;         // Choice: hulls compared for one pair of pieces
constexpr std::size_t kMost = 100;   // Choice: a point that becomes more is not worth a look
constexpr int kSteps = 24;           // of the search for a plane
constexpr double kNarrowest = 2e-3;  // ranges are not halved below this motion [m]

const Vector3d& farthest(const std::vector<Vector3d>& points, const Vector3d& direction) {
  const Vector3d* best = &points.front();
  double most = direction.dot(*best);
  for (const Vector3d& point : points) {
    const double along = direction.dot(point);
    if (along > most) {
      most = along;
      best = &point;
    }
  }
  return *best;
}

/// Is there a plane with more than `gap` between the hulls of the two?
bool are_parted(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b, double gap) {
  Vector3d between = a.front() - b.front();
  for (int step = 0; step < kSteps; ++step) {
    const double length = between.norm();
    if (length < gap) return false;
    const Vector3d difference = farthest(a, -between) - farthest(b, between);
    const double along = between.dot(difference);
    if (along > gap * length) return true;
    // The point of the segment from `between` to `difference` that is nearest to the origin.
    const Vector3d step_to = difference - between;
    const double squared = step_to.squaredNorm();
    if (squared < 1e-18) return false;
    const double share = std::clamp(-between.dot(step_to) / squared, 0.0, 1.0);
    if (share * std::sqrt(squared) < 1e-9) return false;
    between += share * step_to;
  }
  return false;
}

/// Two pieces over a range that is halved until they are proved apart.
class PairProof {
 public:
  PairProof(const Robot& robot, const HandPiece& still, const HandPiece& moved, double gap)
      : robot_(robot), still_(still), moved_(moved), gap_(gap) {}

  bool prove(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    throw_if_stopped();
    if (budget_-- <= 0) return false;
    if (sweep_growth(still_.depth, moved_.depth, lower, upper) <= kMost &&
        are_parted(still_.points,
                   sweep_points(robot_, still_.depth, moved_.depth, lower, upper, moved_.points),
                   gap_)) {
      return true;
    }
    const int widest = widest_motion(lower, upper);
    if (widest < 0) return false;
    const double middle = 0.5 * (lower(widest) + upper(widest));
    Eigen::VectorXd below = upper, above = lower;
    below(widest) = middle;
    above(widest) = middle;
    return prove(lower, below) && prove(above, upper);
  }

 private:
  /// The joint whose turn moves the piece most, from the fourth on; -1: none moves it to speak of.
  int widest_motion(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) const {
    const Eigen::VectorXd middle = 0.5 * (lower + upper);
    int widest = -1;
    double most = kNarrowest;
    for (int j = still_.depth; j < moved_.depth; ++j) {
      const Vector3d& axis = robot_.joints[static_cast<std::size_t>(j)].axis;
      double radius = 0.0;
      const std::vector<Vector3d> here =
          sweep_points(robot_, j + 1, moved_.depth, middle, middle, moved_.points);
      for (const Vector3d& point : here) radius = std::max(radius, axis.cross(point).norm());
      // The longest chord of the way, and a little for the way itself.
      const double range = upper(j - 3) - lower(j - 3);
      const double motion =
          radius * (2.0 * std::sin(0.5 * std::min(range, 3.14159)) + 0.05 * range);
      if (motion <= most) continue;
      most = motion;
      widest = j - 3;
    }
    return widest;
  }

  const Robot& robot_;
  const HandPiece& still_;
  const HandPiece& moved_;
  double gap_;
  int budget_ = kBudget;
};

}  // namespace

bool keeps_clear(const Robot& robot, const std::vector<HandPiece>& pieces,
                 const std::vector<std::pair<int, int>>& mover_pairs, const Eigen::VectorXd& lower,
                 const Eigen::VectorXd& upper, double clearance) {
  for (const std::pair<int, int>& pair : mover_pairs) {
    for (const HandPiece& a : pieces) {
      if (a.mover != pair.first) continue;
      for (const HandPiece& b : pieces) {
        if (b.mover != pair.second) continue;
        const bool a_moves = a.depth > b.depth;
        PairProof proof(robot, a_moves ? b : a, a_moves ? a : b, clearance + 1e-6);
        if (!proof.prove(lower, upper)) return false;
      }
    }
  }
  return true;
}

}  // namespace handey::cspace
